#include "tools/commands/near_miss.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { MAX_LETTERS = 63, LEAST_BEGINNING = 3 };

static bool are_alike(char a, char b) {
  return tolower((unsigned char)a) == tolower((unsigned char)b);
}

static size_t least(size_t a, size_t b) {
  return a < b ? a : b;
}

/*
  How many letters were missed, added, mistaken or swapped. With d(i, j) of the first i letters of a
  and the first j of b:  d(i, j) = min(d(i−1, j) + 1, d(i, j−1) + 1, d(i−1, j−1) + [a_i ≠ b_j]), and
  d(i−2, j−2) + 1 where the last two are swapped.
*/
static size_t distance(const char* a, size_t n_a, const char* b, size_t n_b) {
  size_t d[MAX_LETTERS + 1][MAX_LETTERS + 1];
  for (size_t i = 0; i <= n_a; ++i) {
    for (size_t j = 0; j <= n_b; ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      d[i][j] = least(least(d[i - 1][j], d[i][j - 1]) + 1,
                      d[i - 1][j - 1] + !are_alike(a[i - 1], b[j - 1]));
      if (i > 1 && j > 1 && are_alike(a[i - 1], b[j - 2]) && are_alike(a[i - 2], b[j - 1])) {
        d[i][j] = least(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[n_a][n_b];
}

/* Whether so much of the name was written that the rest is clear. */
static bool is_begun(const char* word, size_t n_word, const char* name, size_t n_name) {
  bool is_begun = n_word >= LEAST_BEGINNING && n_word <= n_name;
  for (size_t i = 0; is_begun && i < n_word; ++i) {
    is_begun = are_alike(word[i], name[i]);
  }
  return is_begun;
}

NearMiss near_miss_of(const char* word) {
  return (NearMiss){.word = word, .distance = (strlen(word) + 2) / 3 + 1};
}

void near_miss_try(NearMiss* miss, const char* name) {
  const size_t n_word = strlen(miss->word);
  const size_t n_name = strlen(name);
  if (n_word > MAX_LETTERS || n_name > MAX_LETTERS) {
    return;
  }
  const size_t d = is_begun(miss->word, n_word, name, n_name)
                       ? n_word < n_name
                       : distance(miss->word, n_word, name, n_name);
  if (d < miss->distance && d < n_name) {
    miss->distance = d;
    miss->name = name;
  }
}

const char* near_miss_hint(const NearMiss* miss, char* hint, size_t size) {
  *hint = '\0';
  if (miss->name) {
    (void)snprintf(hint, size, "; did you mean %s?", miss->name);
  }
  return hint;
}

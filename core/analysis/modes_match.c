#include "core/analysis/modes_match.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static int compare_sizes(const void* left, const void* right) {
  const double p = cabs(*(const double complex*)left);
  const double q = cabs(*(const double complex*)right);
  return p < q ? -1 : p > q;
}

/* The upper ones of conjugate pairs go to the front of `sorted`, real ones to its end; the number
 * of pairs is returned. */
static uint32_t part(uint32_t n_values, const double complex* values, double complex* sorted) {
  uint32_t n_pairs = 0;
  uint32_t end = n_values;
  for (uint32_t i = 0; i < n_values; ++i) {
    if (cimag(values[i]) > 0.0) {
      sorted[n_pairs++] = values[i];
    } else if (cimag(values[i]) == 0.0) {
      sorted[--end] = values[i];
    }
  }
  return n_pairs;
}

/* Real values, rising, of which some are taken. */
typedef struct {
  double complex* at;
  size_t n;
} Reals;

static double complex take(Reals* reals, size_t i) {
  const double complex value = reals->at[i];
  --reals->n;
  memmove(&reals->at[i], &reals->at[i + 1], (reals->n - i) * sizeof(double complex));
  return value;
}

/* The one nearest to −rate that is not 0, if it is to be none. */
static double complex take_nearest(Reals* reals, double rate) {
  size_t best = 0;
  for (size_t i = 1; i < reals->n; ++i) {
    const bool is_better = cabs(reals->at[i] + rate) < cabs(reals->at[best] + rate);
    best = rate > 0.0 && (is_better || reals->at[best] == 0.0) ? i : best;
  }
  return take(reals, best);
}

Status match_pairs(uint32_t n, uint32_t n_free, const double* rate, double complex* values) {
  const size_t n_values = 2 * (size_t)n;
  double complex* const sorted = malloc(n_values * sizeof(double complex));
  if (!sorted) {
    return STATUS_NO_MEMORY;
  }
  const uint32_t n_pairs = part(2 * n, values, sorted);
  Reals reals = {sorted + 2 * (size_t)n_pairs, n_values - 2 * (size_t)n_pairs};
  qsort(reals.at, reals.n, sizeof(double complex), compare_sizes);
  size_t k = 0;
  for (; k < n_pairs; ++k) {
    values[2 * k] = sorted[k];
    values[2 * k + 1] = conj(sorted[k]);
  }
  for (uint32_t p = 0; p < n_free && reals.n >= 2; ++p, ++k) {
    values[2 * k] = take(&reals, 0);
    values[2 * k + 1] = take_nearest(&reals, rate[p]);
  }
  for (size_t r = 0; k < n; ++k, ++r) {
    values[2 * k] = reals.at[r];
    values[2 * k + 1] = reals.at[reals.n - 1 - r];
  }
  free(sorted);
  return STATUS_OK;
}

/* What has been given to whom so far. */
typedef struct {
  uint32_t n;
  const double complex* expected;
  double complex* given; /* n pairs */
  bool* has_given;
  uint32_t n_left;
  double complex* left; /* Upper ones, or single real ones */
} Matching;

/* What is expected of a mode. */
typedef enum { PAIR, REAL, ZERO } Kind;

static Kind kind_of(double complex slower) {
  return cimag(slower) != 0.0 ? PAIR : slower != 0.0 ? REAL : ZERO;
}

/* Take the nearest of what is left. */
static double complex take_left(Matching* matching, double complex wanted) {
  uint32_t best = 0;
  for (uint32_t i = 1; i < matching->n_left; ++i) {
    if (cabs(matching->left[i] - wanted) < cabs(matching->left[best] - wanted)) {
      best = i;
    }
  }
  const double complex found = matching->left[best];
  matching->left[best] = matching->left[--matching->n_left];
  return found;
}

static bool accepts(const Matching* matching, size_t k, Kind kind) {
  return matching->n_left && !matching->has_given[k] && kind_of(matching->expected[2 * k]) == kind;
}

/* Give pairs to each in turn of those that accept them. */
static void give_pairs(Matching* matching, Kind kind) {
  for (size_t k = 0; k < matching->n; ++k) {
    if (accepts(matching, k, kind)) {
      matching->given[2 * k] = take_left(matching, matching->expected[2 * k]);
      matching->given[2 * k + 1] = conj(matching->given[2 * k]);
      matching->has_given[k] = true;
    }
  }
}

/* Give two real values each. */
static void give_reals(Matching* matching, Kind kind) {
  for (size_t k = 0; k < matching->n; ++k) {
    if (accepts(matching, k, kind)) {
      matching->given[2 * k] = take_left(matching, matching->expected[2 * k]);
      matching->given[2 * k + 1] = take_left(matching, matching->expected[2 * k + 1]);
      matching->has_given[k] = true;
    }
  }
}

/* Give a 0 each before anyone has a second. */
static void give_zeros(Matching* matching) {
  for (size_t side = 0; side < 2; ++side) {
    for (size_t k = 0; k < matching->n; ++k) {
      if (accepts(matching, k, ZERO)) {
        matching->given[2 * k + side] = take_left(matching, matching->expected[2 * k + side]);
        matching->has_given[k] = side == 1;
      }
    }
  }
}

Status match_poles(uint32_t n, const double complex* expected, double complex* values) {
  const size_t n_values = 2 * (size_t)n;
  double complex* const sorted = malloc(2 * n_values * sizeof(double complex));
  Matching matching = {.n = n, .expected = expected, .has_given = calloc(n, sizeof(bool))};
  const bool has_room = sorted && matching.has_given;
  if (has_room) {
    matching.n_left = part(2 * n, values, sorted);
    const uint32_t n_real = 2 * n - 2 * matching.n_left;
    matching.given = sorted + n_values;
    matching.left = sorted;
    give_pairs(&matching, PAIR);
    give_pairs(&matching, REAL);
    give_pairs(&matching, ZERO);
    matching.left = sorted + n_values - n_real;
    matching.n_left = n_real;
    give_zeros(&matching);
    give_reals(&matching, REAL);
    give_reals(&matching, PAIR);
    memcpy(values, matching.given, n_values * sizeof(double complex));
  }
  free(sorted);
  free(matching.has_given);
  return has_room ? STATUS_OK : STATUS_NO_MEMORY;
}

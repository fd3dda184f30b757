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

Status match_pairs(uint32_t n, double complex* values) {
  const size_t n_values = 2 * (size_t)n;
  double complex* const sorted = malloc(n_values * sizeof(double complex));
  if (!sorted) {
    return STATUS_NO_MEMORY;
  }
  const uint32_t n_pairs = part(2 * n, values, sorted);
  double complex* const real = sorted + 2 * (size_t)n_pairs;
  const size_t n_real = n_values - 2 * (size_t)n_pairs;
  qsort(real, n_real, sizeof(double complex), compare_sizes);
  for (size_t k = 0; k < n; ++k) {
    const size_t r = k - n_pairs;
    values[2 * k] = k < n_pairs ? sorted[k] : real[r];
    values[2 * k + 1] = k < n_pairs ? conj(sorted[k]) : real[n_real - 1 - r];
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

/* Give the nearest of what is left to each in turn of those that accept it. */
static void give(Matching* matching, bool to_complex, bool is_pair) {
  for (size_t k = 0; k < matching->n && matching->n_left; ++k) {
    const bool is_complex = cimag(matching->expected[2 * k]) != 0.0;
    if (matching->has_given[k] || is_complex != to_complex) {
      continue;
    }
    matching->has_given[k] = true;
    for (size_t side = 0; side < (is_pair ? 1 : 2); ++side) {
      const double complex wanted = matching->expected[2 * k + side];
      uint32_t best = 0;
      for (uint32_t i = 1; i < matching->n_left; ++i) {
        if (cabs(matching->left[i] - wanted) < cabs(matching->left[best] - wanted)) {
          best = i;
        }
      }
      const double complex found = matching->left[best];
      matching->left[best] = matching->left[--matching->n_left];
      matching->given[2 * k + side] = found;
      if (is_pair) {
        matching->given[2 * k + 1] = conj(found);
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
    give(&matching, true, true);
    give(&matching, false, true);
    matching.left = sorted + n_values - n_real;
    matching.n_left = n_real;
    give(&matching, false, false);
    give(&matching, true, false);
    memcpy(values, matching.given, n_values * sizeof(double complex));
  }
  free(sorted);
  free(matching.has_given);
  return has_room ? STATUS_OK : STATUS_NO_MEMORY;
}

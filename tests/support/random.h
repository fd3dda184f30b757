/** Random numbers that can be had again: the seed is printed, and HOOKE_TEST_SEED sets it. */
#ifndef HOOKE_TESTS_SUPPORT_RANDOM_H
#define HOOKE_TESTS_SUPPORT_RANDOM_H

#include <stdint.h>

typedef struct {
  uint64_t state;
} Random;

/** Start a sequence and print its seed. */
Random random_start(void);

/** Evenly between `low` and `high`. */
double random_between(Random* random, double low, double high);

/** Between `low` and `high`, both > 0, evenly in the logarithm. */
double random_log_between(Random* random, double low, double high);

/** One of 0, 1, … n − 1. */
uint32_t random_below(Random* random, uint32_t n);

#endif

#include "tests/support/random.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const uint64_t DEFAULT_SEED = 20090907;

/* SplitMix64 of Steele, Lea and Flood. */
static uint64_t next(Random* random) {
  uint64_t z = (random->state += UINT64_C(0x9e3779b97f4a7c15));
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return z ^ (z >> 31);
}

Random random_start(void) {
  const char* const given = getenv("HOOKE_TEST_SEED");
  const uint64_t seed = given ? strtoull(given, NULL, 0) : DEFAULT_SEED;
  printf("seed %llu\n", (unsigned long long)seed);
  return (Random){.state = seed};
}

double random_between(Random* random, double low, double high) {
  return low + (high - low) * (double)(next(random) >> 11) * 0x1p-53;
}

double random_log_between(Random* random, double low, double high) {
  return exp(random_between(random, log(low), log(high)));
}

uint32_t random_below(Random* random, uint32_t n) {
  return (uint32_t)(next(random) % n);
}

#include "core/base/chance.h"

static const uint64_t GOLDEN = UINT64_C(0x9e3779b97f4a7c15);

static uint64_t mix(uint64_t z) {
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return z ^ (z >> 31);
}

uint64_t chance_bits(uint64_t seed, uint64_t n) {
  return mix(mix(seed + GOLDEN) + (n + 1) * GOLDEN);
}

double chance_even(uint64_t seed, uint64_t n) {
  return (double)(chance_bits(seed, n) >> 11) * 0x1p-52 - 1.0;
}

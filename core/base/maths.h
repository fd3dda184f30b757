/** Numbers and small functions that every room needs. */
#ifndef HOOKE_CORE_BASE_MATHS_H
#define HOOKE_CORE_BASE_MATHS_H

#include <math.h>
#include <stdint.h>

#define PI 3.14159265358979323846

/** The nearest number to `value` from `low` to `high`. */
static inline double clamp(double value, double low, double high) {
  return fmin(fmax(value, low), high);
}

/** The lesser of two counts. */
static inline uint32_t least(uint32_t a, uint32_t b) {
  return a < b ? a : b;
}

#endif

/** Complex numbers from their parts.  Thread: any; real-time safe. */
#ifndef HOOKE_CORE_BASE_COMPLEX_OF_H
#define HOOKE_CORE_BASE_COMPLEX_OF_H

#include <complex.h>

/** re + j im, with no arithmetic that would lose an infinity: C11's CMPLX, which not every compiler
 * has. */
static inline double complex complex_of(double re, double im) {
  union {
    double parts[2];
    double complex whole;
  } const number = {.parts = {re, im}};
  return number.whole;
}

#endif

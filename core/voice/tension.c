#include "core/voice/tension.h"

#include "core/voice/ledger.h"

#include <math.h>

/* Below which it is at its pitch [cents]. */
static const double LEAST_CENTS = 0.01;

void tension_see(Tension* tension, const Chain* chain, bool is_fed) {
  const double square = tension->is_free ? ledger_square(chain) : 0.0;
  const double cents = tension->cents * square / (TENSION_AMPLITUDE * TENSION_AMPLITUDE);
  tension->is_moving = tension->cents > 0.0 && tension->is_free && (is_fed || cents > LEAST_CENTS);
  tension->rise = tension->is_moving ? fmin(fmax(cents, 0.0), TENSION_MOST_CENTS) : 0.0;
}

double tension_raised_hz(const Tension* tension, double f0_hz) {
  return tension->rise > 0.0 ? f0_hz * exp2(tension->rise / 1200.0) : f0_hz;
}

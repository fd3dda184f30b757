#include "core/excite/felt.h"

#include <math.h>
#include <stdbool.h>

/* Newton's steps, which near the solution double the digits each; halvings come in between should
 * rounding lead one astray. */
enum { MOST_STEPS = 200 };

/* Change, of the compression, up to which the slope of φ comes from its series: what that leaves
 * out is below rounding, which would eat the difference. */
static const double SMALL_CHANGE = 1e-4;

/* Where the solution is taken for found, of the compression. */
static const double PRECISION = 1e-15;

/* Excess, of what the string and the hammer came nearer, that only a force too steep for rounding
 * leaves. */
static const double STEEP = 1e-12;

/* How far beyond the solution the first guess may be before a nearer one is worth its price. */
static const double FAR = 8.0;

/* Energy that counts for nothing. */
static const double LEAST_STORED = 1e-300;

/* What a step needs of φ. */
typedef struct {
  const Felt* felt;
  double before;
  double stored; /* φ(before) */
} Press;

static double power_of(double c, double p) {
  return p == FELT_EXPONENT ? c * c * sqrt(c) : pow(c, p);
}

static double slope_at(const Felt* felt, double c) {
  return c > 0.0 ? felt->stiffness * power_of(c, felt->exponent) : 0.0;
}

/* The force for a compression `after`, and how fast it grows with it. */
static double force_at(const Press* press, double after, double* growth) {
  const Felt* const felt = press->felt;
  const double p = felt->exponent;
  const double change = after - press->before;
  double force = 0.0;
  if (fabs(change) <= SMALL_CHANGE * after) {
    const double middle = 0.5 * (after + press->before);
    const double way = change / middle;
    force = slope_at(felt, middle) * (1.0 + p * (p - 1.0) * way * way / 24.0);
    *growth = 0.5 * p * force / middle;
  } else {
    const double slope = slope_at(felt, after);
    force = (slope * fmax(after, 0.0) / (p + 1.0) - press->stored) / change;
    *growth = (slope - force) / change;
  }
  const double lossy = fmax(0.0, 1.0 + felt->loss * change);
  *growth = lossy > 0.0 ? *growth * lossy + force * felt->loss : 0.0;
  return force * lossy;
}

/*
  A compression below `free`, near the solution: the slope of φ from `before` is no less than that
  from 0, or, if nothing was pressed, than φ over the whole way.
*/
static double nearer(const Press* press, double free, double admittance) {
  const Felt* const felt = press->felt;
  const double p = felt->exponent;
  const double weight = (p + 1.0) / (admittance * felt->stiffness);
  const double bound = press->before > 0.0
                           ? pow(free * weight, 1.0 / p)
                           : pow(free * (free - press->before) * weight, 1.0 / (p + 1.0));
  return fmin(free, bound);
}

/* The felt comes loose in this step: what it stored, over the whole way, decides it. */
static double come_loose(const Press* press, double free, double admittance, double* after) {
  const double push = admittance * press->stored;
  const double half = 0.5 * (free - press->before + press->felt->loss * push);
  const double root = sqrt(half * half + push);
  /* The way back, ρ² + 2 half ρ = push, without a difference of likes. */
  const double way = half > 0.0 ? push / (half + root) : root - half;
  const double kept = 1.0 - press->felt->loss * way;
  /* Where little is kept, it is the little that is rounded. */
  const double force = kept > 0.5 ? press->stored / way * kept
                                  : fmax(0.0, (free - press->before + way) / admittance);
  *after = free - admittance * force;
  return force;
}

double felt_energy(const Felt* felt, double compression) {
  return slope_at(felt, compression) * fmax(compression, 0.0) / (felt->exponent + 1.0);
}

double felt_press(const Felt* felt, double before, double free, double admittance, double* after) {
  const Press press = {felt, before, felt_energy(felt, before)};
  double growth = 0.0;
  *after = free;
  if (!(felt->stiffness > 0.0) || (press.stored < LEAST_STORED && free <= 0.0)) {
    return 0.0;
  }
  if (press.stored >= LEAST_STORED) {
    const double loose = force_at(&press, 0.0, &growth);
    if (free - admittance * loose <= 0.0) {
      return come_loose(&press, free, admittance, after);
    }
  }
  /* Let go faster than this, a lossy felt does not push at all. */
  double low = felt->loss > 0.0 ? fmax(0.0, before - 1.0 / felt->loss) : 0.0;
  double high = free;
  double c = free;
  double force = force_at(&press, c, &growth);
  if (admittance * force > FAR * free) {
    const double guess = nearer(&press, free, admittance);
    c = guess > low ? guess : free;
    force = force_at(&press, c, &growth);
  }
  for (int i = 0; i < MOST_STEPS; ++i) {
    const double excess = c - free + admittance * force;
    const double step = excess / (1.0 + admittance * growth);
    *(excess > 0.0 ? &high : &low) = c;
    if (!(fabs(step) > PRECISION * c)) {
      break;
    }
    c = c - step > low && c - step < high ? c - step : 0.5 * (low + high);
    force = force_at(&press, c, &growth);
  }
  /* Of the two that decide each other, the one that rounding moves less has the word. */
  const double excess = c - free + admittance * force;
  if (admittance * growth > 1.0 || fabs(excess) > STEEP * free) {
    *after = c;
    return (free - c) / admittance;
  }
  *after = free - admittance * force;
  return force;
}

#include "tools/bench/bench_step.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

enum { NEWTON_ROUNDS = 30 };

/* Of the trace and the determinant. */
static const double NEWTON_NUDGE = 1e-7;
static const double NEWTON_CLOSE = 1e-15;

static BenchStep multiply(BenchStep l, BenchStep r) {
  return (BenchStep){.xx = l.xx * r.xx + l.xu * r.ux,
                     .xu = l.xx * r.xu + l.xu * r.uu,
                     .ux = l.ux * r.xx + l.uu * r.ux,
                     .uu = l.ux * r.xu + l.uu * r.uu};
}

/* Of `w` steps: dampers by half, a kick by half, a drift, a kick by half, dampers by half. */
static BenchStep leapfrog(Pole mass, double w) {
  const double d = exp(-0.5 * w * mass.g);
  const BenchStep damp = {.xx = 1.0, .uu = d};
  const BenchStep kick = {.xx = 1.0, .ux = -0.5 * w * mass.a, .uu = 1.0};
  const BenchStep drift = {.xx = 1.0, .xu = w, .uu = 1.0};
  return multiply(damp, multiply(kick, multiply(drift, multiply(kick, damp))));
}

static BenchStep backward(Pole mass) {
  const double brake = 1.0 + mass.g + mass.a;
  const BenchStep kick = {.xx = 1.0, .ux = -mass.a / brake, .uu = 1.0 / brake};
  return multiply((BenchStep){.xx = 1.0, .xu = 1.0, .uu = 1.0}, kick);
}

static BenchStep fourth(Pole mass) {
  const double outer = 1.0 / (2.0 - cbrt(2.0));
  const BenchStep first = leapfrog(mass, outer);
  return multiply(first, multiply(leapfrog(mass, 1.0 - 2.0 * outer), first));
}

BenchStep bench_step_of(NetworkScheme scheme, Pole mass) {
  switch (scheme) {
  case NETWORK_FORWARD:
    return (BenchStep){.xx = 1.0, .xu = 1.0, .ux = -mass.a, .uu = 1.0 - mass.g};
  case NETWORK_BACKWARD:
    return backward(mass);
  case NETWORK_LEAPFROG:
    return leapfrog(mass, 1.0);
  case NETWORK_FOURTH:
    return fourth(mass);
  default:
    return (BenchStep){.xx = 1.0 - mass.a, .xu = 1.0 - mass.g, .ux = -mass.a, .uu = 1.0 - mass.g};
  }
}

static double trace(BenchStep step) {
  return step.xx + step.uu;
}

static double determinant(BenchStep step) {
  return step.xx * step.uu - step.xu * step.ux;
}

double bench_step_radius(NetworkScheme scheme, Pole mass) {
  const BenchStep step = bench_step_of(scheme, mass);
  const double half = 0.5 * trace(step);
  const double under = half * half - determinant(step);
  return under < 0.0 ? sqrt(determinant(step)) : fabs(half) + sqrt(under);
}

Tone bench_step_tone(NetworkScheme scheme, double rate_hz, Pole mass) {
  const BenchStep step = bench_step_of(scheme, mass);
  const double half = 0.5 * trace(step);
  const double under = half * half - determinant(step);
  const double angle = under < 0.0 ? atan2(sqrt(-under), half) : 0.0;
  return (Tone){.f0_hz = angle * rate_hz / (2.0 * PI),
                .tau_s = -1.0 / (rate_hz * log(bench_step_radius(scheme, mass)))};
}

bool bench_step_solve(NetworkScheme scheme, double rate_hz, Tone tone, Pole* mass) {
  const double turn = 2.0 * PI * tone.f0_hz / rate_hz;
  const double decay = 1.0 / (tone.tau_s * rate_hz);
  const double wanted_trace = 2.0 * exp(-decay) * cos(turn);
  const double wanted_determinant = exp(-2.0 * decay);
  Pole now = {.a = turn * turn, .g = 2.0 * decay};
  double miss = HUGE_VAL;
  for (int round = 0; round < NEWTON_ROUNDS && !(miss < NEWTON_CLOSE); ++round) {
    const BenchStep here = bench_step_of(scheme, now);
    const double t = trace(here) - wanted_trace;
    const double d = determinant(here) - wanted_determinant;
    const double nudge = NEWTON_NUDGE * now.a;
    const BenchStep by_a = bench_step_of(scheme, (Pole){now.a + nudge, now.g});
    const BenchStep by_g = bench_step_of(scheme, (Pole){now.a, now.g + nudge});
    const double ta = (trace(by_a) - trace(here)) / nudge;
    const double tg = (trace(by_g) - trace(here)) / nudge;
    const double da = (determinant(by_a) - determinant(here)) / nudge;
    const double dg = (determinant(by_g) - determinant(here)) / nudge;
    const double volume = ta * dg - tg * da;
    now.a -= (t * dg - tg * d) / volume;
    now.g -= (ta * d - t * da) / volume;
    miss = fabs(t) + fabs(d);
  }
  if (!(miss < 1e-12) || !(now.g >= 0.0) || !(now.a > 0.0)) {
    return false;
  }
  *mass = now;
  return true;
}

#include "tools/bench/bench_way.h"

#include "core/string/chain_fixed.h"
#include "tools/bench/bench_bank.h"
#include "tools/bench/bench_step.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

enum { N_PARTIALS_KINDS = PARTIALS_TRUEST + 1, N_CHAINS = N_PARTIALS_KINDS * N_CHAIN_NUMBERS };

BenchWay bench_way_at(unsigned i) {
  BenchWay way = {.scheme = NETWORK_SYMPLECTIC, .numbers = CHAIN_DOUBLE, .is_corrected = true};
  if (i < N_CHAINS) {
    way.partials = (Partials)(i % N_PARTIALS_KINDS);
    way.numbers = (ChainNumbers)(i / N_PARTIALS_KINDS);
  } else if (i == N_CHAINS) {
    way.is_corrected = false;
  } else if (i + 1 < BENCH_N_WAYS) {
    way.kind = BENCH_NETWORK;
    way.scheme = (NetworkScheme)((i - N_CHAINS - 1) / 2);
    way.is_corrected = (i - N_CHAINS) % 2 == 0;
  } else {
    way.kind = BENCH_BANK;
  }
  return way;
}

/* Networks have no bending. */
static TuningTarget target_of(BenchWay way, TuningTarget wanted) {
  wanted.partials = way.partials;
  wanted.inharmonicity = way.kind == BENCH_NETWORK ? 0.0 : wanted.inharmonicity;
  return wanted;
}

/* The fundamental of a way as one mass. */
static bool first_mass(BenchWay way, TuningTarget wanted, Pole* mass) {
  const Tone tone = wanted.tone;
  if (way.is_corrected) {
    return bench_step_solve(way.scheme, wanted.rate_hz, tone, mass);
  }
  const double omega0 = hypot(2.0 * PI * tone.f0_hz, 1.0 / tone.tau_s);
  *mass = pole_from_analog(wanted.rate_hz, omega0, 2.0 / tone.tau_s);
  return true;
}

bool bench_way_coefs(BenchWay way, TuningTarget wanted, uint32_t n_masses, StringCoefs* coefs) {
  const TuningTarget target = target_of(way, wanted);
  StringCoefs solved = {0};
  Pole mass = {0};
  if (way.kind == BENCH_BANK || tuning_solve(&target, n_masses, &solved)) {
    return false;
  }
  if (way.kind == BENCH_NETWORK || !way.is_corrected) {
    if (!first_mass(way, wanted, &mass)) {
      return false;
    }
    /* The same wanted, but for a and g of its fundamental. */
    const Pole tuned = tuning_mode(solved, n_masses, 1);
    const double stiffer = mass.a / tuned.a;
    const double damper = tuned.g > 0.0 ? mass.g / tuned.g : 0.0;
    solved = (StringCoefs){.k1 = solved.k1 * stiffer,
                           .k2 = solved.k2 * stiffer,
                           .k3 = solved.k3 * stiffer,
                           .z0 = solved.z0 * damper,
                           .z1 = solved.z1 * damper};
  }
  *coefs = solved;
  return true;
}

/* Through memory: gcc 12 leaves out the way there and back where it makes vectors of it. */
static double as_float(double value) {
  const volatile float rounded = (float)value;
  return (double)rounded;
}

StringCoefs bench_way_rounded(StringCoefs c) {
  return (StringCoefs){.k1 = as_float(c.k1),
                       .k2 = as_float(c.k2),
                       .z0 = as_float(c.z0),
                       .z1 = as_float(c.z1),
                       .k3 = as_float(c.k3)};
}

/* Whole numbers: the string without air, whose gain fades instead; its scale does not matter. */
static bool
whole_tone(double rate_hz, StringCoefs coefs, uint32_t n_masses, uint32_t k, Tone* tone) {
  const double lambda = tuning_lambda(n_masses, 1);
  const double half = 0.5 * (n_masses + 1.0);
  const ChainSums sums = {
      .xx = half, .slope = half * lambda, .twist = half * lambda * lambda * lambda};
  ChainFixed whole;
  if (!chain_fixed_design(coefs, n_masses, sums, &whole)) {
    return false;
  }
  *tone = pole_tone(rate_hz, tuning_mode(bench_way_rounded(whole.coefs), n_masses, k));
  tone->tau_s = 1.0 / (1.0 / tone->tau_s - rate_hz * log(whole.fade));
  return true;
}

double bench_way_ideal_hz(TuningTarget wanted, uint32_t k) {
  const double b = wanted.inharmonicity;
  return k * wanted.tone.f0_hz * sqrt((1.0 + b * k * k) / (1.0 + b));
}

bool bench_way_tone(BenchWay way, TuningTarget wanted, uint32_t n_masses, uint32_t k, Tone* tone) {
  StringCoefs coefs = {0};
  if (way.kind == BENCH_BANK) {
    *tone = (Tone){bench_way_ideal_hz(wanted, k), wanted.tone.tau_s};
    return true;
  }
  if (!bench_way_coefs(way, wanted, n_masses, &coefs)) {
    return false;
  }
  if (way.kind == BENCH_CHAIN && way.numbers == CHAIN_FIXED) {
    return whole_tone(wanted.rate_hz, coefs, n_masses, k, tone);
  }
  if (way.numbers == CHAIN_FLOAT) {
    coefs = bench_way_rounded(coefs);
  }
  const Pole mass = tuning_mode(coefs, n_masses, k);
  *tone = way.kind == BENCH_CHAIN ? pole_tone(wanted.rate_hz, mass)
                                  : bench_step_tone(way.scheme, wanted.rate_hz, mass);
  return true;
}

bool bench_way_is_stable(BenchWay way, TuningTarget wanted, uint32_t n_masses) {
  StringCoefs coefs = {0};
  if (way.kind == BENCH_BANK) {
    return true;
  }
  if (!bench_way_coefs(way, wanted, n_masses, &coefs)) {
    return false;
  }
  if (way.kind == BENCH_CHAIN) {
    return tuning_headroom(coefs, n_masses) >= 0.0;
  }
  bool is_stable = true;
  for (uint32_t k = 1; k <= n_masses; ++k) {
    const Pole mass = tuning_mode(coefs, n_masses, k);
    is_stable = is_stable && bench_step_radius(way.scheme, mass) <= 1.0;
  }
  return is_stable;
}

uint32_t bench_way_max_masses(BenchWay way, TuningTarget wanted) {
  const TuningTarget target = target_of(way, wanted);
  if (way.kind == BENCH_BANK) {
    uint32_t n_modes = 0;
    while (n_modes < BENCH_BANK_MAX &&
           bench_way_ideal_hz(wanted, n_modes + 1) < 0.5 * wanted.rate_hz) {
      ++n_modes;
    }
    return n_modes;
  }
  const uint32_t most = tuning_max_masses(&target, CHAIN_MAX_MASSES);
  const bool is_picky =
      way.kind == BENCH_NETWORK && (way.scheme == NETWORK_LEAPFROG || way.scheme == NETWORK_FOURTH);
  if (!is_picky || bench_way_is_stable(way, wanted, most)) {
    return most;
  }
  uint32_t low = 0;
  uint32_t high = most;
  while (high - low > 1) {
    const uint32_t middle = low + (high - low) / 2;
    const bool is_stable = bench_way_is_stable(way, wanted, middle);
    low = is_stable ? middle : low;
    high = is_stable ? high : middle;
  }
  return low;
}

double bench_way_partial_cents(BenchWay way, TuningTarget wanted, uint32_t n_masses, uint32_t k) {
  Tone tone = {0};
  if (k > n_masses || !bench_way_tone(way, wanted, n_masses, k, &tone) || !(tone.f0_hz > 0.0)) {
    return (double)NAN;
  }
  return 1200.0 * log2(tone.f0_hz / bench_way_ideal_hz(wanted, k));
}

unsigned bench_way_loop(BenchWay way, StringCoefs coefs) {
  const unsigned n_terms = coefs.k3 != 0.0 ? 2 : coefs.k2 != 0.0 ? 1 : 0;
  const unsigned scheme = way.kind == BENCH_NETWORK ? (unsigned)way.scheme : 0;
  return ((unsigned)way.kind * N_CHAIN_NUMBERS + (unsigned)way.numbers) * 16 + scheme * 3 + n_terms;
}

double bench_way_decay_percent(BenchWay way, TuningTarget wanted, uint32_t n_masses) {
  Tone tone = {0};
  if (!bench_way_tone(way, wanted, n_masses, 1, &tone)) {
    return (double)NAN;
  }
  return 100.0 * fabs(tone.tau_s / wanted.tone.tau_s - 1.0);
}

double bench_way_partials_cents(BenchWay way, TuningTarget wanted, uint32_t n_masses) {
  double sum = 0.0;
  uint32_t n = 0;
  for (uint32_t k = 1; k <= BENCH_N_PARTIALS; ++k) {
    if (bench_way_ideal_hz(wanted, k) < 0.5 * wanted.rate_hz) {
      const double cents = fabs(bench_way_partial_cents(way, wanted, n_masses, k));
      const double counted = cents < BENCH_MISSING_CENTS ? cents : BENCH_MISSING_CENTS;
      sum += counted * counted;
      ++n;
    }
  }
  return n > 0 ? sqrt(sum / n) : (double)NAN;
}

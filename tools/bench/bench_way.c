#include "tools/bench/bench_way.h"

#include "core/string/chain_whole.h"
#include "tools/bench/bench_bank.h"
#include "tools/bench/bench_step.h"

#include <math.h>
#include <stdio.h>

static const double PI = 3.14159265358979323846;

enum { N_PARTIALS_KINDS = PARTIALS_TRUEST + 1, N_CHAINS = 2 * N_PARTIALS_KINDS * N_CHAIN_NUMBERS };

BenchWay bench_way_at(unsigned i) {
  static const ChainNumbers numbers[N_CHAIN_NUMBERS] = {CHAIN_FIXED, CHAIN_FLOAT, CHAIN_DOUBLE};
  BenchWay method = {.scheme = NETWORK_SYMPLECTIC, .numbers = CHAIN_DOUBLE};
  if (i < N_CHAINS) {
    method.kind = BENCH_CHAIN;
    method.is_corrected = i % 2 == 0;
    method.partials = (Partials)(i / 2 % N_PARTIALS_KINDS);
    method.numbers = numbers[i / (2 * N_PARTIALS_KINDS)];
  } else if (i < N_CHAINS + 2 * NETWORK_SCHEME_COUNT) {
    method.kind = BENCH_NETWORK;
    method.is_corrected = i % 2 == 0;
    method.scheme = (NetworkScheme)((i - N_CHAINS) / 2);
  } else {
    method.kind = BENCH_BANK;
    method.is_corrected = true;
    method.numbers = i + 1 == BENCH_N_WAYS ? CHAIN_DOUBLE : CHAIN_FLOAT;
  }
  return method;
}

void bench_way_name(BenchWay method, char name[TRADE_NAME_SIZE]) {
  static const char* const numbers[N_CHAIN_NUMBERS] = {"float", "double", "whole"};
  static const char* const partials[N_PARTIALS_KINDS] = {"Lumped", "True", "Truest"};
  const char* const correction = method.is_corrected ? "" : ", uncorrected";
  switch (method.kind) {
  case BENCH_CHAIN:
    (void)snprintf(name, TRADE_NAME_SIZE, "chain, %s, %s%s", partials[method.partials],
                   numbers[method.numbers], correction);
    break;
  case BENCH_NETWORK:
    (void)snprintf(name, TRADE_NAME_SIZE, "network, %s%s", network_scheme_text(method.scheme),
                   correction);
    break;
  default:
    (void)snprintf(name, TRADE_NAME_SIZE, "bank of modes, %s", numbers[method.numbers]);
  }
}

TuningTarget bench_way_target(BenchWay method, TradeString string) {
  return (TuningTarget){
      .rate_hz = string.rate_hz,
      .tone = {.f0_hz = string.f0_hz, .tau_s = string.tau_s},
      .loss = string.loss,
      .inharmonicity = method.kind == BENCH_NETWORK ? 0.0 : string.inharmonicity,
      .partials = method.partials,
  };
}

/* The fundamental of a method as one mass. */
static bool first_mass(BenchWay method, TradeString string, Pole* mass) {
  const Tone tone = {string.f0_hz, string.tau_s};
  if (method.is_corrected) {
    return bench_step_solve(method.scheme, string.rate_hz, tone, mass);
  }
  const double omega0 = hypot(2.0 * PI * tone.f0_hz, 1.0 / tone.tau_s);
  *mass = pole_from_analog(string.rate_hz, omega0, 2.0 / tone.tau_s);
  return true;
}

bool bench_way_coefs(BenchWay method, TradeString string, uint32_t n_masses, StringCoefs* coefs) {
  const TuningTarget target = bench_way_target(method, string);
  StringCoefs solved = {0};
  Pole mass = {0};
  if (method.kind == BENCH_BANK || tuning_solve(&target, n_masses, &solved)) {
    return false;
  }
  if (method.kind == BENCH_NETWORK || !method.is_corrected) {
    if (!first_mass(method, string, &mass)) {
      return false;
    }
    /* The same string, but for a and g of its fundamental. */
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

static StringCoefs rounded(StringCoefs c) {
  return (StringCoefs){.k1 = (double)(float)c.k1,
                       .k2 = (double)(float)c.k2,
                       .z0 = (double)(float)c.z0,
                       .z1 = (double)(float)c.z1,
                       .k3 = (double)(float)c.k3};
}

/* Whole numbers: the string without air, whose gain fades instead; its scale does not matter. */
static bool
whole_tone(double rate_hz, StringCoefs coefs, uint32_t n_masses, uint32_t k, Tone* tone) {
  const double lambda = tuning_lambda(n_masses, 1);
  const double half = 0.5 * (n_masses + 1.0);
  const ChainSums sums = {
      .xx = half, .slope = half * lambda, .twist = half * lambda * lambda * lambda};
  ChainWhole whole;
  if (!chain_whole_design(coefs, n_masses, sums, &whole)) {
    return false;
  }
  *tone = pole_tone(rate_hz, tuning_mode(rounded(whole.coefs), n_masses, k));
  tone->tau_s = 1.0 / (1.0 / tone->tau_s - rate_hz * log(whole.fade));
  return true;
}

static Tone bank_tone(BenchWay method, TradeString string, uint32_t k) {
  const double turn = 2.0 * PI * bench_way_ideal_hz(string, k) / string.rate_hz;
  const double r = exp(-1.0 / (string.tau_s * string.rate_hz));
  double c = r * cos(turn);
  double s = r * sin(turn);
  if (method.numbers == CHAIN_FLOAT) {
    c = (double)(float)c;
    s = (double)(float)s;
  }
  return (Tone){.f0_hz = atan2(s, c) * string.rate_hz / (2.0 * PI),
                .tau_s = -1.0 / (string.rate_hz * log(hypot(c, s)))};
}

double bench_way_ideal_hz(TradeString string, uint32_t k) {
  const double b = string.inharmonicity;
  return k * string.f0_hz * sqrt((1.0 + b * k * k) / (1.0 + b));
}

bool bench_way_tone(
    BenchWay method, TradeString string, uint32_t n_masses, uint32_t k, Tone* tone) {
  StringCoefs coefs = {0};
  if (method.kind == BENCH_BANK) {
    *tone = bank_tone(method, string, k);
    return true;
  }
  if (!bench_way_coefs(method, string, n_masses, &coefs)) {
    return false;
  }
  if (method.kind == BENCH_CHAIN && method.numbers == CHAIN_FIXED) {
    return whole_tone(string.rate_hz, coefs, n_masses, k, tone);
  }
  const bool is_float = method.numbers == CHAIN_FLOAT;
  const Pole mass = tuning_mode(is_float ? rounded(coefs) : coefs, n_masses, k);
  *tone = method.kind == BENCH_CHAIN ? pole_tone(string.rate_hz, mass)
                                     : bench_step_tone(method.scheme, string.rate_hz, mass);
  return true;
}

bool bench_way_is_stable(BenchWay method, TradeString string, uint32_t n_masses) {
  StringCoefs coefs = {0};
  if (method.kind == BENCH_BANK) {
    return true;
  }
  if (!bench_way_coefs(method, string, n_masses, &coefs)) {
    return false;
  }
  if (method.kind == BENCH_CHAIN) {
    return tuning_headroom(coefs, n_masses) >= 0.0;
  }
  bool is_stable = true;
  for (uint32_t k = 1; k <= n_masses; ++k) {
    const Pole mass = tuning_mode(coefs, n_masses, k);
    is_stable = is_stable && bench_step_radius(method.scheme, mass) <= 1.0;
  }
  return is_stable;
}

uint32_t bench_way_max_masses(BenchWay method, TradeString string) {
  const TuningTarget target = bench_way_target(method, string);
  if (method.kind == BENCH_BANK) {
    uint32_t n_modes = 0;
    while (n_modes < BENCH_BANK_MAX &&
           bench_way_ideal_hz(string, n_modes + 1) < 0.5 * string.rate_hz) {
      ++n_modes;
    }
    return n_modes;
  }
  const uint32_t most = tuning_max_masses(&target, CHAIN_MAX_MASSES);
  const bool is_picky = method.kind == BENCH_NETWORK &&
                        (method.scheme == NETWORK_LEAPFROG || method.scheme == NETWORK_FOURTH);
  if (!is_picky || bench_way_is_stable(method, string, most)) {
    return most;
  }
  uint32_t low = 0;
  uint32_t high = most;
  while (high - low > 1) {
    const uint32_t middle = low + (high - low) / 2;
    const bool is_stable = bench_way_is_stable(method, string, middle);
    low = is_stable ? middle : low;
    high = is_stable ? high : middle;
  }
  return low;
}

double bench_way_partial_cents(BenchWay method, TradeString string, uint32_t n_masses, uint32_t k) {
  Tone tone = {0};
  if (k > n_masses || !bench_way_tone(method, string, n_masses, k, &tone) || !(tone.f0_hz > 0.0)) {
    return (double)NAN;
  }
  return 1200.0 * log2(tone.f0_hz / bench_way_ideal_hz(string, k));
}

uint32_t
bench_way_true_up_to(BenchWay method, TradeString string, uint32_t n_masses, double cents) {
  uint32_t k = 0;
  while (k < n_masses && fabs(bench_way_partial_cents(method, string, n_masses, k + 1)) <= cents) {
    ++k;
  }
  return k;
}

unsigned bench_way_loop(BenchWay method, StringCoefs coefs) {
  const unsigned n_terms = coefs.k3 != 0.0 ? 2 : coefs.k2 != 0.0 ? 1 : 0;
  const unsigned scheme = method.kind == BENCH_NETWORK ? (unsigned)method.scheme : 0;
  return ((unsigned)method.kind * N_CHAIN_NUMBERS + (unsigned)method.numbers) * 16 + scheme * 3 +
         n_terms;
}

double bench_way_pitch_error(BenchWay method, TradeString string, uint32_t n_masses) {
  return fabs(bench_way_partial_cents(method, string, n_masses, 1));
}

double bench_way_decay_error(BenchWay method, TradeString string, uint32_t n_masses) {
  Tone tone = {0};
  if (!bench_way_tone(method, string, n_masses, 1, &tone)) {
    return (double)NAN;
  }
  return 100.0 * fabs(tone.tau_s / string.tau_s - 1.0);
}

double bench_way_partials_error(BenchWay method, TradeString string, uint32_t n_masses) {
  double sum = 0.0;
  uint32_t n = 0;
  for (uint32_t k = 1; k <= TRADE_N_PARTIALS; ++k) {
    if (bench_way_ideal_hz(string, k) < 0.5 * string.rate_hz) {
      const double cents = fabs(bench_way_partial_cents(method, string, n_masses, k));
      const double counted = cents < TRADE_MISSING_CENTS ? cents : TRADE_MISSING_CENTS;
      sum += counted * counted;
      ++n;
    }
  }
  return n > 0 ? sqrt(sum / n) : (double)NAN;
}

#include "tests/support/strung.h"

#include "tests/support/chains.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

double strung_rate_hz(uint32_t i) {
  static const double rates_hz[STRUNG_N_RATES] = {22050.0, 44100.0, 48000.0, 96000.0, 192000.0};
  return rates_hz[i];
}

double strung_pitch_hz(uint32_t key) {
  return 440.0 * exp2(((double)key - 69.0) / 12.0);
}

void strung_up(Strung* strung,
               void* memory,
               const TuningTarget* target,
               uint32_t limit,
               ChainNumbers numbers) {
  StringCoefs coefs = {0};
  const uint32_t n_masses = tuning_max_masses(target, limit);
  assert_int_equal(tuning_solve(target, n_masses, &coefs), STATUS_OK);
  *strung = (Strung){
      .rate_hz = target->rate_hz,
      .f0_hz = target->tone.f0_hz,
      .angle1 = 2.0 * PI * target->tone.f0_hz / target->rate_hz,
  };
  chain_init(&strung->chain, chain_kernel(0), memory, n_masses);
  chain_set(&strung->chain, coefs);
  assert_true(chain_hold(&strung->chain, numbers));
}

void strung_key(
    Strung* strung, void* memory, uint32_t key, double rate_hz, uint32_t limit, double tau_s) {
  const TuningTarget target = {.rate_hz = rate_hz,
                               .tone = {strung_pitch_hz(key), tau_s},
                               .loss = 0.01,
                               .partials = PARTIALS_TRUEST};
  strung_up(strung, memory, &target, limit, CHAIN_FLOAT);
}

void strung_up_anywhere(Strung* strung, void* memory, Random* random, ChainNumbers numbers) {
  const uint32_t key = 21 + random_below(random, 88);
  const TuningTarget target = {
      .rate_hz = strung_rate_hz(random_below(random, STRUNG_N_RATES)),
      .tone = {strung_pitch_hz(key), random_log_between(random, 0.005, 100.0)},
      .loss = random_below(random, 3) ? random_log_between(random, 1e-4, 1.0) : 0.0,
      .inharmonicity = random_below(random, 2) ? random_log_between(random, 1e-6, 1e-2) : 0.0,
      .partials = random_below(random, 2) ? PARTIALS_LUMPED : PARTIALS_TRUEST,
  };
  const uint32_t limit = random_below(random, 4) ? (uint32_t)random_log_between(random, 1.0, 200.0)
                                                 : CHAIN_MAX_MASSES / 4;
  strung_up(strung, memory, &target, limit, numbers);
}

float strung_step(Strung* strung, uint32_t i) {
  const ChainTap tap = {{i, i}, {1.0f, 0.0f}, false};
  float heard = 0.0f;
  float* const out[] = {&heard};
  chain_run(&strung->chain, 1, &tap, 1, out);
  return heard;
}

void strung_read(const Strung* strung, Motion* motion) {
  motion->n = strung->chain.n_masses;
  chains_read(&strung->chain, motion->x, motion->u);
}

double strung_energy(const Motion* motion, StringCoefs coefs) {
  const StringCoefs undamped = {.k1 = coefs.k1, .k2 = coefs.k2, .k3 = coefs.k3};
  return motion_energy(motion, undamped);
}

double strung_lost(const Motion* before, const Motion* after, StringCoefs coefs) {
  const double* const u = before->u;
  double lost = 0.0;
  for (uint32_t i = 0; i < before->n; ++i) {
    const double left = i > 0 ? u[i - 1] : 0.0;
    const double right = i + 1 < before->n ? u[i + 1] : 0.0;
    lost += 0.5 * (u[i] + after->u[i]) * (coefs.z0 * u[i] + coefs.z1 * (2.0 * u[i] - left - right));
  }
  return lost;
}

double strung_fundamental(const Strung* strung) {
  Motion motion;
  const double length = strung->chain.n_masses + 1.0;
  const double a = 2.0 - 2.0 * cos(strung->angle1);
  double x = 0.0;
  double u = 0.0;
  strung_read(strung, &motion);
  for (uint32_t i = 0; i < motion.n; ++i) {
    const double share = 2.0 / length * sin(PI * (i + 1.0) / length);
    x += share * motion.x[i];
    u += share * motion.u[i];
  }
  return sqrt((x * x - x * u + u * u / a) / (1.0 - 0.25 * a));
}

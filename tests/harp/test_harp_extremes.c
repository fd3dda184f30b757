/* Every string that the ports can ask for, at every key and rate: it is stable by prediction, mode
 * by mode, and it gains no energy when it is run. */
#include "core/harp/harp.h"

#include "tests/support/energy.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"
#include "tests/support/settings.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

static const double rates_hz[] = {8e3,  11025.0, 22050.0, 44.1e3, 48e3, 88.2e3,
                                  96e3, 176.4e3, 192e3,   384e3,  768e3};

enum { N_RATES = sizeof(rates_hz) / sizeof(rates_hz[0]), DOZE = 1024, LEAST_STEPS = 32 };

/* What a string must keep of the stability limit. */
static const double MARGIN = 1e-4 * (1.0 - 1e-9);

/*
  What rounding may add to the energy.  A float is off by 2^−24 of itself, 6e-8: so many times over
  in a step as a step adds to a sum, and after that the dampers and chance take it away again.
*/
static const double MOST_ROUNDING = 1e-5;

static _Alignas(CHAIN_ALIGNMENT) char memory[1 << 20];
static Motion motion;

/* One string of the harp, and what was asked of it. */
typedef struct {
  double rate_hz;
  uint32_t key;
  Setting setting;
  HarpPatch patch;
  HarpString string;
} Case;

static bool is_long(void) {
  return getenv("HOOKE_TEST_LONG");
}

static void fail_case(const Case* c, const char* what, double value) {
  print_message("%s: %.9g, key %u at %g Hz, %u masses\n", what, value, c->key, c->rate_hz,
                c->string.voice.chain.n_masses);
  settings_print(&c->setting);
  fail();
}

/* Plucked at its loudest, from rest. */
static void pluck(Case* c) {
  assert_true(chain_size(CHAIN_MAX_MASSES) <= sizeof(memory));
  c->patch = settings_patch(&c->setting);
  harp_string_init(&c->string, &c->patch, c->rate_hz, c->key, memory, CHAIN_MAX_MASSES, NULL);
  const Pluck hardest = {c->patch.pluck, c->patch.hardness, HARP_NOTE_PEAK, 0.0};
  harp_group_play(&c->string, hardest, 0);
}

/* How near the limit a single mass of this tone is: what it would take to sound at all. */
static double single_load(const Case* c) {
  const Tone tone = settings_tone(&c->setting, c->key, 0.0);
  if (tone.f0_hz >= 0.5 * c->rate_hz) {
    return HUGE_VAL;
  }
  const double r = exp(-1.0 / (tone.tau_s * c->rate_hz));
  const double g = 1.0 - r * r;
  return 2.0 + g - 2.0 * r * cos(2.0 * PI * tone.f0_hz / c->rate_hz);
}

/* The margin counted mode by mode; the harp's own word on it must not be better. */
static double margin(const Case* c) {
  const StringCoefs coefs = c->string.voice.chain.goal;
  const uint32_t n = c->string.voice.chain.n_masses;
  const double counted = oracle_headroom(coefs, n);
  if (!(counted >= MARGIN)) {
    fail_case(c, "margin counted mode by mode", counted);
  }
  if (!(tuning_headroom(coefs, n) >= MARGIN) || !(c->string.voice.headroom <= counted + 1e-12)) {
    fail_case(c, "margin predicted", c->string.voice.headroom);
  }
  return counted;
}

/* Silent where no mass could have the pitch, and only there; else stable, open, damped and bent. */
static double check_margins(Case* c) {
  static const double bends[] = {0.0, 2.0, -2.0, 24.0, -24.0};
  pluck(c);
  const double load = single_load(c);
  if (c->string.voice.is_awake ? load > 4.0 : load < 4.0 * (1.0 - 1.1e-4)) {
    fail_case(c, c->string.voice.is_awake ? "sounds past Nyquist" : "is silent, its load", load);
  }
  double worst = 1.0;
  for (int b = 0; c->string.voice.is_awake && b < 5; ++b) {
    worst = fmin(worst, margin(c));
    c->string.touch.bend = bends[b];
    c->string.lift = b % 2;
    harp_string_retune(&c->string, 0);
  }
  return worst;
}

/* Ends and middles of all that the stability limit depends on. */
static Setting corner(uint32_t index) {
  static const SettingName names[] = {SETTING_DAMPING,  SETTING_LOSS,     SETTING_STIFFNESS,
                                      SETTING_MASSES,   SETTING_PARTIALS, SETTING_TUNING,
                                      SETTING_TRACKING, SETTING_RELEASE};
  Setting setting = settings_default();
  for (int i = 0; i < 8; ++i) {
    const uint32_t n_ways = i < 5 ? 3 : 2;
    setting.value[names[i]] = settings_on_way(names[i], (index % n_ways) / (n_ways - 1.0));
    index /= n_ways;
  }
  return setting;
}

static void every_corner_has_its_margin(void** state) {
  (void)state;
  enum { CORNERS = 243 * 8, STRIDE = 29 }; /* No factor in common */
  const uint32_t n_corners = is_long() ? CORNERS : 40;
  uint32_t index = 0;
  uint32_t n_silent = 0;
  double worst = 1.0;
  for (uint32_t r = 0; r < N_RATES; ++r) {
    for (uint32_t key = 0; key < HARP_KEYS; ++key) {
      for (uint32_t i = 0; i < n_corners; ++i) {
        index = (index + STRIDE) % CORNERS;
        Case c = {.rate_hz = rates_hz[r], .key = key, .setting = corner(index)};
        worst = fmin(worst, check_margins(&c));
        n_silent += !c.string.voice.is_awake;
      }
    }
  }
  print_message("  %u corners, %u of them silent, least margin %.9g\n",
                N_RATES * HARP_KEYS * n_corners, n_silent, worst);
}

/* What is left of the energy after each of some stretches of a run, at most, over what was left
 * before: 1 in a string that never gains any. */
typedef struct {
  double gain;
  double frames;
  uint32_t n_cases;
} Runs;

static void run_frames(Case* c, uint32_t n_frames) {
  static float sound[DOZE];
  static const ChainTap tap = {{0, 0}, {1.0f, 0.0f}, false};
  float* const out[] = {sound};
  chain_run(&c->string.voice.chain, n_frames, &tap, 1, out);
}

static double energy_now(const Case* c) {
  motion_read(&c->string.voice.chain, &motion);
  return motion_energy(&motion, c->string.voice.chain.goal);
}

/* Single steps at first, then as the harp does it. */
static void run_case(Case* c, uint32_t n_frames, Runs* runs) {
  double least = energy_now(c);
  uint32_t done = 0;
  while (done < n_frames && c->string.voice.is_awake) {
    const uint32_t n = done < LEAST_STEPS ? 1 : voice_stretch(&c->string.voice);
    run_frames(c, n);
    done += n;
    voice_pass(&c->string.voice, n);
    const double energy = energy_now(c);
    if (!isfinite(energy) || !(c->string.voice.is_awake || energy == 0.0)) {
      fail_case(c, "energy", energy);
    }
    runs->gain = fmax(runs->gain, energy / least);
    least = fmin(least, energy);
  }
  runs->frames += done;
}

static void no_string_gains_energy(void** state) {
  (void)state;
  const int n_points = is_long() ? 100000 : 3000;
  Random random = random_start();
  Runs runs = {0};
  double worst = 1.0;
  for (int i = 0; i < n_points; ++i) {
    Case c = {.rate_hz = rates_hz[random_below(&random, N_RATES)],
              .key = random_below(&random, HARP_KEYS),
              .setting = settings_random(&random)};
    worst = fmin(worst, check_margins(&c));
    c.setting.value[SETTING_TENSION] = 0.0; /* Energies of one pitch compare */
    pluck(&c);
    if (!c.string.voice.is_awake) {
      continue;
    }
    /* A second, or as much of it as there is time for; a short string costs as much as one of a
     * hundred masses. */
    const double most = (is_long() ? 1e7 : 4e6) / (c.string.voice.chain.n_masses + 100.0);
    Runs run = {0};
    run_case(&c, (uint32_t)fmin(c.rate_hz, most), &run);
    if (!(run.gain <= 1.0 + MOST_ROUNDING)) {
      fail_case(&c, "energy, over the least before", run.gain);
    }
    runs.gain = fmax(runs.gain, run.gain);
    runs.frames += run.frames;
    ++runs.n_cases;
  }
  print_message("  %d points, %u sound, %.3g frames, least margin %.9g\n", n_points, runs.n_cases,
                runs.frames, worst);
  assert_within("energy gained", runs.gain - 1.0, MOST_ROUNDING);
}

static void undamped_string_keeps_its_energy(void** state) {
  (void)state;
  const int n_points = is_long() ? 10000 : 300;
  Random random = random_start();
  double worst = 0.0;
  for (int i = 0; i < n_points; ++i) {
    Case c = {.rate_hz = rates_hz[random_below(&random, N_RATES)],
              .key = random_below(&random, HARP_KEYS),
              .setting = settings_random(&random)};
    pluck(&c);
    if (!c.string.voice.is_awake) {
      continue;
    }
    StringCoefs coefs = c.string.voice.chain.goal;
    coefs.z0 = coefs.z1 = 0.0;
    motion_read(&c.string.voice.chain, &motion);
    const double first = motion_energy(&motion, coefs);
    const uint32_t n_steps = 1000000 / (motion.n + 10);
    for (uint32_t n = 1; n <= n_steps; ++n) {
      motion_step(&motion, coefs);
      if (n % 499 == 0 || n == n_steps) {
        worst = fmax(worst, fabs(motion_energy(&motion, coefs) / first - 1.0));
      }
    }
  }
  assert_within("drift in doubles", worst, 1e-11);
}

/* Pitches close to Nyquist, from both sides: one mass at most, or silence. */
static void pitches_round_nyquist_are_stable_or_silent(void** state) {
  (void)state;
  uint32_t n_cases = 0;
  uint32_t n_silent = 0;
  for (uint32_t r = 0; r < N_RATES; ++r) {
    for (uint32_t key = 0; key < HARP_KEYS; ++key) {
      for (int step = -200; step <= 50; ++step) {
        const double f0_hz = 0.5 * rates_hz[r] * (1.0 + 1e-4 * step);
        Case c = {
            .rate_hz = rates_hz[r], .key = key, .setting = corner((uint32_t)(step + 200) * 7)};
        double* const tuning_hz = &c.setting.value[SETTING_TUNING];
        *tuning_hz = f0_hz / exp2((key - 69.0) / 12.0);
        if (*tuning_hz >= settings_on_way(SETTING_TUNING, 0.0) &&
            *tuning_hz <= settings_on_way(SETTING_TUNING, 1.0)) {
          check_margins(&c);
          n_silent += !c.string.voice.is_awake;
          ++n_cases;
        }
      }
    }
  }
  print_message("  %u strings, %u of them silent\n", n_cases, n_silent);
  assert_true(n_silent > 100 && n_silent < n_cases - 100);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_corner_has_its_margin),
      cmocka_unit_test(pitches_round_nyquist_are_stable_or_silent),
      cmocka_unit_test(no_string_gains_energy),
      cmocka_unit_test(undamped_string_keeps_its_energy),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

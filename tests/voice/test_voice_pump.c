/* Nothing that swings in time with a string feeds it: whatever moves its pitch or its partials, it
 * has what its exciters' own work explains, and no more. */
#include "core/voice/voice.h"

#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

static const double RATE_HZ = 48e3;
static const double F0_HZ = 110.0;
static const double TAU_S = 20.0;

enum { CAPACITY = 128, PIECE = 16 };

static _Alignas(CHAIN_ALIGNMENT) char memory[1 << 15];

typedef enum { PLUCKED, STRUCK, BOWED, N_PLAYED } Played;
typedef enum { PITCH, STIFFNESS, LOSS, PARTIALS, DAMPING, MASSES, N_SWINGS } Swing;

static const char* const played_names[N_PLAYED] = {"plucked", "struck", "bowed"};
static const char* const swing_names[N_SWINGS] = {"pitch",    "stiffness", "loss",
                                                  "partials", "damping",   "masses"};

/* What is thrown from one end to the other, how far, and how often. */
typedef struct {
  Played played;
  Swing swing;
  double range;
  double period; /* [frames]; 0: it is not */
  double seconds;
  uint32_t n_masses;
} Trial;

static VoiceAim aim_of(const Trial* trial, bool is_high) {
  const double end = is_high ? 1.0 : -1.0;
  TuningTarget open = {RATE_HZ, {F0_HZ, TAU_S}, 0.0, 0.0, PARTIALS_TRUEST};
  switch (trial->swing) {
  case PITCH:
    open.tone.f0_hz *= exp2(end * trial->range / 12.0);
    break;
  case STIFFNESS:
    open.inharmonicity = is_high ? trial->range : 0.0;
    break;
  case LOSS:
    open.loss = is_high ? 0.1 : 0.0;
    break;
  case PARTIALS:
    open.inharmonicity = 1e-3;
    open.partials = is_high ? PARTIALS_TRUEST : PARTIALS_LUMPED;
    break;
  case DAMPING:
    open.tone.tau_s = is_high ? TAU_S : 0.2 * TAU_S;
    break;
  default:
    break;
  }
  return (VoiceAim){.open = open};
}

static double square_per_energy(const Voice* voice) {
  const double a = tuning_mode(voice->chain.now, voice->chain.n_masses, 1).a;
  return 4.0 / ((voice->chain.n_masses + 1.0) * a * (1.0 - 0.25 * a));
}

static void run(Voice* voice, uint32_t n_frames) {
  static const Reading reading = {.at = {{PICKUP_DISPLACEMENT, 0.1}}, .n_taps = 1};
  float heard[2048] = {0};
  float* const out[] = {heard};
  voice_run(voice, &reading, 0.0, n_frames, out);
}

static void play(Voice* voice, Played played, const TuningTarget* target) {
  switch (played) {
  case PLUCKED:
    voice_pluck(voice, (Pluck){0.13, 0.5, 0.2, 0.0});
    break;
  case STRUCK:
    voice_strike(voice, (Strike){0.12, 0.5, 0.25, 0.2});
    break;
  default:
    voice_bow(voice, (Stroke){0.12, 0.5, 0.2, 0.04, 0.03}, target);
    break;
  }
}

static void throw_it(Voice* voice, const Trial* trial, bool is_high) {
  const VoiceAim aim = aim_of(trial, is_high);
  if (trial->swing == MASSES && is_high) {
    voice_shorten(voice, &aim, trial->n_masses / 2);
  } else if (trial->swing == MASSES) {
    voice_lengthen(voice, &aim, trial->n_masses);
  }
  voice_aim(voice, &aim, voice->n_gesture);
}

/* What exciters' work explains. */
typedef struct {
  double work;      /* Counted so far */
  double explained; /* The square of the amplitude that comes of it */
} Account;

static void credit(Account* account, const Voice* voice) {
  const double gift = fmax(0.0, voice_work(voice) - account->work);
  account->explained += gift * square_per_energy(voice);
  account->work = voice_work(voice);
}

/* The most that it has of what its exciters' work explains, plucks and strikes coming eight times a
 * second; as the square of the amplitude of a fundamental with all of the energy. */
static double unexplained(const Trial* trial) {
  const VoiceAim aim = aim_of(trial, false);
  const uint32_t n_frames = (uint32_t)(trial->seconds * RATE_HZ);
  const double kept = exp(-2.0 * PIECE / (RATE_HZ * TAU_S));
  double worst = 0.0;
  Voice voice;
  double next_throw = trial->period > 0.0 ? 0.5 * trial->period : HUGE_VAL;
  Account account = {0};
  bool is_high = false;
  voice_init(&voice, RATE_HZ, 3, memory, CAPACITY, (VoiceOwner){0}, NULL);
  assert_true(voice_string(&voice, &aim, trial->n_masses, 0));
  for (uint32_t done = 0; done < n_frames; done += PIECE) {
    if (done == 0 || (trial->played != BOWED && done % 6000 == 0)) {
      play(&voice, trial->played, &aim.open);
      credit(&account, &voice);
    }
    account.explained *= kept;
    for (uint32_t left = PIECE; left > 0;) {
      const double until = fmax(1.0, ceil(next_throw - (done + PIECE - left)));
      const uint32_t n = until < left ? (uint32_t)until : left;
      run(&voice, n);
      left -= n;
      if (done + PIECE - left >= next_throw) {
        is_high = !is_high;
        next_throw += 0.5 * trial->period;
        throw_it(&voice, trial, is_high);
      }
    }
    const double square = voice_energy(&voice) * square_per_energy(&voice);
    credit(&account, &voice);
    assert_true(isfinite(square));
    worst = fmax(worst, square / account.explained);
  }
  return worst;
}

static double worst_of_periods(Trial* trial) {
  static const double ratios[] = {0.25, 1.0 / 3.0, 0.5, 2.0 / 3.0, 0.8, 1.0,
                                  1.25, 1.5,       2.0, 3.0,       4.0};
  double worst = 0.0;
  for (uint32_t k = 1; k <= 5; ++k) {
    for (size_t i = 0; i < sizeof ratios / sizeof *ratios; ++i) {
      trial->period = RATE_HZ / (k * F0_HZ) * ratios[i];
      worst = fmax(worst, unexplained(trial));
    }
  }
  return worst;
}

/* Every period from a quarter to four times that of each of the first five partials. */
static void no_period_of_a_swing_feeds_it(void** state) {
  static const double ranges[N_SWINGS][3] = {
      {2.0, 12.0, 24.0}, {1e-4, 1e-3, 1e-2}, {1.0}, {1.0}, {1.0}, {1.0}};
  (void)state;
  double worst = 0.0;
  for (Trial trial = {.n_masses = 24}; trial.played < N_PLAYED; ++trial.played) {
    const double short_s = trial.played == BOWED ? 0.5 : 2.0;
    trial.seconds = getenv("HOOKE_TEST_LONG") ? 120.0 : short_s;
    for (trial.swing = 0; trial.swing < N_SWINGS; ++trial.swing) {
      double most = 0.0;
      for (int r = 0; r < 3 && ranges[trial.swing][r] > 0.0; ++r) {
        trial.range = ranges[trial.swing][r];
        most = fmax(most, worst_of_periods(&trial));
      }
      print_message("  %-8s %-10s %6.2f dB\n", played_names[trial.played], swing_names[trial.swing],
                    10.0 * log10(most));
      worst = fmax(worst, most);
    }
  }
  assert_within("over what its exciters' work explains [dB]", 10.0 * log10(worst), 3.0);
}

/* Left alone but for the wheel, a string that nothing damps is as loud after minutes. */
static void bends_neither_feed_nor_starve_it(void** state) {
  (void)state;
  const uint32_t n_frames = (getenv("HOOKE_TEST_LONG") ? 120 : 10) * 48000;
  double most = 0.0;
  double least = HUGE_VAL;
  for (int range = 2; range <= 24; range += 11) {
    for (uint32_t period = 60; period < 2000; period += period / 3) {
      const Trial trial = {.swing = PITCH, .range = range};
      VoiceAim aims[2] = {aim_of(&trial, false), aim_of(&trial, true)};
      Voice voice;
      aims[0].open.tone.tau_s = aims[1].open.tone.tau_s = HUGE_VAL;
      voice_init(&voice, RATE_HZ, 3, memory, CAPACITY, (VoiceOwner){0}, NULL);
      assert_true(voice_string(&voice, &aims[0], 24, 0));
      voice_pluck(&voice, (Pluck){0.3, 0.0, 0.2, 0.0});
      const double before = voice_energy(&voice) * square_per_energy(&voice);
      for (uint32_t done = 0, i = 0; done < n_frames; done += period, ++i) {
        voice_aim(&voice, &aims[i % 2], 192);
        run(&voice, period);
      }
      const double gain = voice_energy(&voice) * square_per_energy(&voice) / before;
      most = fmax(most, gain);
      least = fmin(least, gain);
    }
  }
  assert_within("energy after it all [dB]", 10.0 * log10(most), 1.5);
  assert_within("of which it has lost [dB]", -10.0 * log10(least), 1.5);
}

/* What is not a number stays where it is, and is gone with the next note. */
static void what_is_no_number_is_mended(void** state) {
  static const float others[] = {NAN, INFINITY, -INFINITY};
  (void)state;
  for (int i = 0; i < 3; ++i) {
    const VoiceAim aim = aim_of(&(Trial){.swing = MASSES}, false);
    Voice voice;
    voice_init(&voice, RATE_HZ, 3, memory, CAPACITY, (VoiceOwner){0}, NULL);
    assert_true(voice_string(&voice, &aim, 24, 0));
    voice_bow(&voice, (Stroke){0.12, 0.5, 0.2, 0.04, 0.03}, &aim.open);
    run(&voice, 100);
    voice_mend(&voice);
    assert_true(voice.is_awake);
    chain_place(&voice.chain, 11, others[i], others[i]);
    run(&voice, 100);
    voice_mend(&voice);
    assert_false(voice.is_awake || voice_is_touched(&voice));
    assert_true(voice_string(&voice, &aim, 24, 0));
    voice_pluck(&voice, (Pluck){0.3, 0.5, 0.2, 0.0});
    run(&voice, 1000);
    const double square = voice_energy(&voice) * square_per_energy(&voice);
    assert_true(square > 1e-3 && square < 1.0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(no_period_of_a_swing_feeds_it),
      cmocka_unit_test(bends_neither_feed_nor_starve_it),
      cmocka_unit_test(what_is_no_number_is_mended),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

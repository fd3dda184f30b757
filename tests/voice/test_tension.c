/* What moves far is sharp, by the square of how far, and comes to its pitch as it dies away; and
 * that gives it nothing. */
#include "core/voice/voice.h"

#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static const double RATE_HZ = 48e3;
static const double LOW_E_HZ = 82.4069;

enum { CAPACITY = 128, N_MASSES = 80, PIECE = 64, BLOCK = 2048 };

static _Alignas(CHAIN_ALIGNMENT) char memories[2][1 << 15];

static VoiceAim aim_of(double f0_hz, double tau_s, double tension) {
  return (VoiceAim){.open = {RATE_HZ, {f0_hz, tau_s}, 0.003, 1e-5, PARTIALS_TRUEST},
                    .tension = tension};
}

/* At rest. */
static void string_it(Voice* voice, int which, const VoiceAim* aim) {
  voice_init(voice, RATE_HZ, 3, memories[which], CAPACITY, (VoiceOwner){0}, NULL);
  assert_true(voice_string(voice, aim, N_MASSES, 0));
}

static void run_into(Voice* voice, uint32_t n_frames, float* out) {
  static const Reading reading = {.at = {{PICKUP_DISPLACEMENT, 0.1}}, .n_taps = 1};
  memset(out, 0, n_frames * sizeof(float));
  voice_run(voice, &reading, 0.0, n_frames, &out);
}

static void run(Voice* voice, double seconds) {
  float heard[BLOCK];
  for (double left = round(seconds * RATE_HZ); left > 0.0; left -= BLOCK) {
    run_into(voice, left < BLOCK ? (uint32_t)left : BLOCK, heard);
  }
}

/* Of the amplitude that the fundamental would have, a second way: by the dense matrix. */
static double square_of(const Voice* voice) {
  static double stiffness[CAPACITY * CAPACITY];
  static double damping[CAPACITY * CAPACITY];
  const Chain* const chain = &voice->chain;
  const uint32_t n = chain->n_masses;
  double x[CAPACITY];
  double u[CAPACITY];
  for (uint32_t i = 0; i < n; ++i) {
    x[i] = (double)chain_position(chain, i);
    u[i] = (double)chain_velocity(chain, i);
  }
  oracle_forces(chain->now, n, stiffness, damping);
  const double a = tuning_mode(chain->now, n, 1).a;
  return 4.0 * oracle_energy(stiffness, n, x, u) / ((n + 1.0) * a * (1.0 - 0.25 * a));
}

static double cents_above(const Voice* voice, StringCoefs coefs, double f0_hz) {
  const Tone tone = pole_tone(RATE_HZ, tuning_mode(coefs, voice->chain.n_masses, 1));
  return 1200.0 * log2(tone.f0_hz / f0_hz);
}

/* Where it goes to at once when it is plucked. */
static double rise_of(double amplitude, double tension, double* square) {
  const VoiceAim aim = aim_of(LOW_E_HZ, 5.0, tension);
  Voice voice;
  string_it(&voice, 0, &aim);
  voice_pluck(&voice, (Pluck){0.13, 0.7, amplitude, 0.0});
  *square = square_of(&voice);
  return cents_above(&voice, voice.chain.goal, LOW_E_HZ);
}

static void the_rise_goes_with_the_square_of_the_amplitude(void** state) {
  const double full = TENSION_AMPLITUDE * TENSION_AMPLITUDE;
  (void)state;
  double worst = 0.0;
  double worst_quarter = 0.0;
  double last = 0.0;
  for (double amplitude = 0.32; amplitude > 0.004; amplitude *= 0.5) {
    double square = 0.0;
    const double rise = rise_of(amplitude, 40.0, &square);
    worst = fmax(worst, fabs(rise / (40.0 * square / full) - 1.0));
    worst_quarter = fmax(worst_quarter, last > 0.0 ? fabs(last / rise - 4.0) : 0.0);
    last = rise;
  }
  assert_within("cents, relative", worst, 1e-4);
  assert_within("of half the amplitude, over a quarter", worst_quarter, 1e-3);
}

static void it_is_two_semitones_at_most(void** state) {
  (void)state;
  double square = 0.0;
  assert_within("off two semitones", fabs(rise_of(1.0, 100.0, &square) - 200.0), 1e-6);
  assert_true(100.0 * square / (TENSION_AMPLITUDE * TENSION_AMPLITUDE) > 1e3);
}

/* Beside one that does not stretch, plucked alike: what it has, at all times. */
static void it_dies_as_if_it_were_not(void** state) {
  const VoiceAim aims[] = {aim_of(LOW_E_HZ, 1.0, 0.0), aim_of(LOW_E_HZ, 1.0, 50.0)};
  (void)state;
  double worst = 0.0;
  double highest = 0.0;
  Voice voices[2];
  for (int i = 0; i < 2; ++i) {
    string_it(&voices[i], i, &aims[i]);
    voice_pluck(&voices[i], (Pluck){0.13, 0.5, 0.25, 0.0});
  }
  for (int step = 0; step < 300; ++step) {
    run(&voices[0], 0.01);
    run(&voices[1], 0.01);
    worst = fmax(worst, fabs(10.0 * log10(square_of(&voices[1]) / square_of(&voices[0]))));
    highest = fmax(highest, cents_above(&voices[1], voices[1].chain.now, LOW_E_HZ));
  }
  assert_within("of what it has [dB]", worst, 0.01);
  assert_true(highest > 10.0);
}

/* Eight times a second at full force: never more than the work of it explains. */
static void what_is_plucked_again_and_again_is_no_richer(void** state) {
  const VoiceAim aim = aim_of(LOW_E_HZ, 20.0, 100.0);
  (void)state;
  double worst = 0.0;
  double work = 0.0;
  double explained = 0.0;
  Voice voice;
  string_it(&voice, 0, &aim);
  for (int note = 0; note < 64; ++note) {
    const double a = tuning_mode(voice.chain.now, N_MASSES, 1).a;
    voice_pluck(&voice, (Pluck){0.13, 0.5, 0.25, 0.0});
    explained += 4.0 * (voice_work(&voice) - work) / ((N_MASSES + 1.0) * a * (1.0 - 0.25 * a));
    work = voice_work(&voice);
    for (int step = 0; step < 25; ++step) {
      run(&voice, 0.005);
      explained *= exp(-2.0 * 0.005 / 20.0);
      worst = fmax(worst, square_of(&voice) / explained);
      assert_true(cents_above(&voice, voice.chain.now, LOW_E_HZ) < 200.001);
    }
  }
  assert_within("over what plucks explain [dB]", 10.0 * log10(worst), 0.1);
}

static bool is_same(StringCoefs a, StringCoefs b) {
  return a.k1 == b.k1 && a.k2 == b.k2 && a.k3 == b.k3 && a.z0 == b.z0 && a.z1 == b.z1;
}

/* All coefficients, to the last bit, and the numbers that suit it. */
static void once_it_has_died_it_is_as_if_it_had_never_been(void** state) {
  const VoiceAim aims[] = {aim_of(LOW_E_HZ, 1.0, 0.0), aim_of(LOW_E_HZ, 1.0, 100.0)};
  (void)state;
  for (int kind = 0; kind < 2; ++kind) {
    Voice voices[2];
    for (int i = 0; i < 2; ++i) {
      string_it(&voices[i], i, &aims[i]);
      if (kind) {
        voice_strike(&voices[i], (Strike){0.13, 0.5, 0.25, 0.25});
      } else {
        voice_pluck(&voices[i], (Pluck){0.13, 0.5, 0.25, 0.0});
      }
      run(&voices[i], 0.05);
    }
    assert_true(cents_above(&voices[1], voices[1].chain.now, LOW_E_HZ) > 1.0);
    assert_true(cents_above(&voices[0], voices[0].chain.now, LOW_E_HZ) < 1e-9);
    run(&voices[0], 7.0);
    run(&voices[1], 7.0);
    assert_int_equal(voices[1].chain.n_gliding, 0);
    assert_true(is_same(voices[0].chain.now, voices[1].chain.now));
    assert_int_equal(voices[0].chain.numbers, voices[1].chain.numbers);
    assert_true(voices[1].is_awake && !voices[1].tension.is_moving);
  }
}

/* Whoever bows it listens: bit by bit as if it did not stretch. */
static void what_is_bowed_keeps_its_pitch(void** state) {
  const VoiceAim aims[] = {aim_of(LOW_E_HZ, 1.0, 0.0), aim_of(LOW_E_HZ, 1.0, 100.0)};
  static float heard[2][1 << 16];
  (void)state;
  for (int i = 0; i < 2; ++i) {
    Voice voice;
    string_it(&voice, i, &aims[i]);
    voice_bow(&voice, (Stroke){0.12, 0.5, 0.2, 0.04, 0.03}, &aims[i].open);
    run_into(&voice, 20000, heard[i]);
    voice_aim(&voice, &aims[i], 300);
    run_into(&voice, 10000, heard[i] + 20000);
    voice_lift_bow(&voice);
    run_into(&voice, 30000, heard[i] + 30000);
  }
  assert_true(heard[0][59999] != 0.0f);
  assert_memory_equal(heard[0], heard[1], sizeof heard[0]);
}

/* And one that rings when the bow comes goes to its pitch. */
static void a_bow_brings_it_to_its_pitch(void** state) {
  const VoiceAim aim = aim_of(LOW_E_HZ, 5.0, 100.0);
  (void)state;
  Voice voice;
  string_it(&voice, 0, &aim);
  voice_pluck(&voice, (Pluck){0.13, 0.5, 0.25, 0.0});
  run(&voice, 0.1);
  assert_true(cents_above(&voice, voice.chain.now, LOW_E_HZ) > 10.0);
  voice_bow(&voice, (Stroke){0.12, 0.5, 0.2, 0.04, 0.03}, &aim.open);
  assert_within("aim [cents]", fabs(cents_above(&voice, voice.chain.goal, LOW_E_HZ)), 1e-9);
  assert_false(voice.tension.is_moving);
}

/* In a gesture, whatever else is under way, and on top of it. */
static void it_multiplies_what_is_asked_for(void** state) {
  (void)state;
  double worst = 0.0;
  for (double bend = -12.0; bend <= 12.0; bend += 3.0) {
    const VoiceAim aim = aim_of(LOW_E_HZ, 1e4, 60.0);
    const VoiceAim bent = aim_of(LOW_E_HZ * exp2(bend / 12.0), 1e4, 60.0);
    Voice voice;
    string_it(&voice, 0, &aim);
    voice_pluck(&voice, (Pluck){0.13, 0.3, 0.1, 0.0});
    run(&voice, 0.05);
    const double before = cents_above(&voice, voice.chain.now, LOW_E_HZ);
    voice_aim(&voice, &bent, 100000);
    run(&voice, 0.05);
    const double after = cents_above(&voice, voice.chain.now, LOW_E_HZ) - 100.0 * bend;
    worst = fmax(worst, fabs(after / before - 1.0));
    assert_true(before > 1.0);
  }
  assert_within("of the rise, after a bend", worst, 0.02);
}

/* Plucks, hammers, bends and dampers; cut into `block`. */
static void play_cut(uint32_t block, float* heard, uint32_t n_frames) {
  const VoiceAim aims[] = {aim_of(LOW_E_HZ, 1.0, 80.0), aim_of(90.0, 1.0, 80.0),
                           aim_of(90.0, 0.05, 80.0), aim_of(LOW_E_HZ, 1.0, 30.0)};
  Voice voice;
  string_it(&voice, 0, &aims[0]);
  for (uint32_t done = 0, event = 0; done < n_frames; ++event) {
    const uint32_t end = done + 1777;
    if (event % 3 == 0) {
      voice_pluck(&voice, (Pluck){0.13, 0.5, 0.2, 0.0});
    } else if (event % 7 == 0) {
      voice_strike(&voice, (Strike){0.13, 0.5, 0.25, 0.2});
    } else {
      voice_aim(&voice, &aims[event % 4], 100 * event);
    }
    while (done < end && done < n_frames) {
      const uint32_t left = end < n_frames ? end - done : n_frames - done;
      const uint32_t n = left < block ? left : block;
      run_into(&voice, n, heard + done);
      done += n;
    }
  }
}

static void blocks_do_not_change_it(void** state) {
  enum { N_FRAMES = 60000 };
  static const uint32_t blocks[] = {1, 7, 64, 1000};
  static float whole[N_FRAMES];
  static float cut[N_FRAMES];
  (void)state;
  play_cut(4096, whole, N_FRAMES);
  for (size_t b = 0; b < sizeof blocks / sizeof *blocks; ++b) {
    play_cut(blocks[b], cut, N_FRAMES);
    assert_memory_equal(whole, cut, sizeof whole);
  }
}

/* One so high that it can be no higher is at its pitch, and rings. */
static void what_cannot_be_sharp_is_in_tune(void** state) {
  const double f0_hz = 0.4955 * RATE_HZ;
  const VoiceAim aim = aim_of(f0_hz, 1.0, 100.0);
  (void)state;
  Voice voice;
  string_it(&voice, 0, &aim);
  voice_pluck(&voice, (Pluck){0.13, 0.5, 5.0, 0.0});
  run(&voice, 0.01);
  assert_true(voice.is_awake && !voice.is_choked);
  assert_within("pitch [cents]", fabs(cents_above(&voice, voice.chain.now, f0_hz)), 1e-6);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_rise_goes_with_the_square_of_the_amplitude),
      cmocka_unit_test(it_is_two_semitones_at_most),
      cmocka_unit_test(it_dies_as_if_it_were_not),
      cmocka_unit_test(what_is_plucked_again_and_again_is_no_richer),
      cmocka_unit_test(once_it_has_died_it_is_as_if_it_had_never_been),
      cmocka_unit_test(what_is_bowed_keeps_its_pitch),
      cmocka_unit_test(a_bow_brings_it_to_its_pitch),
      cmocka_unit_test(it_multiplies_what_is_asked_for),
      cmocka_unit_test(blocks_do_not_change_it),
      cmocka_unit_test(what_cannot_be_sharp_is_in_tune),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

#include "core/voice/voice.h"

#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;
static const double RATE_HZ = 48e3;

enum { CAPACITY = 128 };

static _Alignas(CHAIN_ALIGNMENT) char memory[1 << 15];

static VoiceAim aim_of(double f0_hz, double tau_s) {
  return (VoiceAim){.open = {RATE_HZ, {f0_hz, tau_s}, 0.01, 0.0, PARTIALS_TRUEST}};
}

static void run(Voice* voice, uint32_t n_frames) {
  static const Reading reading = {.at = {{PICKUP_DISPLACEMENT, 0.1}}, .n_taps = 1};
  float none[1024];
  float* const out[] = {none};
  while (n_frames > 0) {
    const uint32_t n = n_frames < 1024 ? n_frames : 1024;
    voice_run(voice, &reading, 0.0, n, out);
    n_frames -= n;
  }
}

static void lay(Voice* voice) {
  assert_true(chain_size(CAPACITY) <= sizeof(memory));
  voice_init(voice, RATE_HZ, 3, memory, CAPACITY, (VoiceOwner){0}, NULL);
}

static void ring(Voice* voice, double f0_hz, double tau_s) {
  const VoiceAim aim = aim_of(f0_hz, tau_s);
  lay(voice);
  assert_true(voice_string(voice, &aim, CAPACITY, 0));
  voice_pluck(voice, (Pluck){0.3, 0.3, 0.25, 0.0});
}

static Tone tone_of(const Voice* voice) {
  return pole_tone(RATE_HZ, tuning_mode(voice->chain.now, voice->chain.n_masses, 1));
}

/* The fundamental's amplitude: what partials do in the voice's own measure comes and goes.
 */
static double amplitude_of(const Voice* voice) {
  const double length = voice->chain.n_masses + 1.0;
  const double angle = 2.0 * PI * voice->f0_hz / RATE_HZ;
  double x = 0.0;
  double u = 0.0;
  for (uint32_t i = 0; i < voice->chain.n_masses; ++i) {
    const double shape = 2.0 / length * sin(PI * (i + 1.0) / length);
    x += shape * (double)chain_position(&voice->chain, i);
    u += shape * (double)chain_velocity(&voice->chain, i);
  }
  return hypot(x, (x - u - x * cos(angle)) / sin(angle));
}

static void gesture_is_four_milliseconds_and_enough_frames(void** state) {
  (void)state;
  assert_int_equal(voice_gesture_frames(8e3), 192);
  assert_int_equal(voice_gesture_frames(48e3), 192);
  assert_int_equal(voice_gesture_frames(96e3), 384);
  assert_int_equal(voice_gesture_frames(192e3), 768);
}

static void string_has_the_most_masses_that_are_stable(void** state) {
  (void)state;
  static const double pitches_hz[] = {50.0, 330.0, 660.0, 5e3, 20e3};
  for (int i = 0; i < 5; ++i) {
    const VoiceAim aim = aim_of(pitches_hz[i], 1.0);
    StringCoefs coefs = {0};
    Voice voice;
    uint32_t n = CAPACITY;
    for (bool is_stable = false; !is_stable; n -= !is_stable) {
      assert_int_equal(tuning_solve(&aim.open, n, &coefs), STATUS_OK);
      is_stable = n == 1 || oracle_headroom(coefs, n) >= TUNING_MARGIN;
    }
    lay(&voice);
    assert_true(voice_string(&voice, &aim, 1000000, 0));
    assert_int_equal(voice.chain.n_masses, n);
    assert_true(voice.headroom >= TUNING_LAST_MARGIN && voice.is_awake);
    assert_true(voice_string(&voice, &aim, 5, 0));
    assert_int_equal(voice.chain.n_masses, n < 5 ? n : 5);
  }
}

static void pitch_that_cannot_be_had_chokes_it(void** state) {
  (void)state;
  const VoiceAim aim = aim_of(24e3, 1.0);
  Voice voice;
  lay(&voice);
  assert_false(voice_string(&voice, &aim, CAPACITY, 0));
  assert_false(voice.is_awake);
  ring(&voice, 110.0, 1.0);
  const uint32_t n_masses = voice.chain.n_masses;
  voice_aim(&voice, &aim, 192);
  assert_true(voice.is_choked && voice.is_awake && voice.chain.n_masses == n_masses);
  run(&voice, 192);
  assert_within("cents off", fabs(1200.0 * log2(tone_of(&voice).f0_hz / 110.0)), 1e-6);
  assert_within("τ off, relative", fabs(tone_of(&voice).tau_s / VOICE_CHOKE_S - 1.0), 1e-6);
}

static void retuned_it_arrives_and_has_its_motion(void** state) {
  (void)state;
  const VoiceAim aim = aim_of(123.0, 0.5);
  Voice voice;
  ring(&voice, 110.0, 1e3);
  run(&voice, 1000);
  const double before = amplitude_of(&voice);
  voice_aim(&voice, &aim, 4000);
  assert_true(voice_stretch(&voice) <= 4000);
  run(&voice, 4000);
  assert_within("cents off", fabs(1200.0 * log2(tone_of(&voice).f0_hz / 123.0)), 1e-6);
  assert_within("τ off, relative", fabs(tone_of(&voice).tau_s / 0.5 - 1.0), 1e-6);
  const double after = amplitude_of(&voice);
  /* Half of the way to a decay of half a second, for a twelfth of one. */
  assert_within("motion off, relative", fabs(after / before / exp(-4000.0 / RATE_HZ) - 1.0), 0.005);
}

static void meshed_it_keeps_pitch_decay_and_motion(void** state) {
  (void)state;
  static const uint32_t meshes[] = {60, 31, 90, CAPACITY};
  const VoiceAim elsewhere = aim_of(123.0, 0.1);
  Voice voice;
  ring(&voice, 110.0, 2.0);
  run(&voice, 3000);
  const double before = chain_amplitude(&voice.chain, voice.a1);
  for (int i = 0; i < 4; ++i) {
    voice_shorten(&voice, &elsewhere, meshes[i]);
    voice_lengthen(&voice, &elsewhere, meshes[i]);
    assert_int_equal(voice.chain.n_masses, meshes[i]);
    assert_within("cents off", fabs(1200.0 * log2(tone_of(&voice).f0_hz / 110.0)), 1e-6);
    assert_within("τ off, relative", fabs(tone_of(&voice).tau_s / 2.0 - 1.0), 1e-6);
  }
  /* What the partials had that 31 masses do not hold is gone. */
  assert_within("motion off, relative",
                fabs(chain_amplitude(&voice.chain, voice.a1) / before - 1.0), 0.02);
}

/* Undamped, so that all that it has was given to it; by all that plays it, on what already rings.
 */
static void its_energy_is_what_played_it(void** state) {
  (void)state;
  double worst = 0.0;
  Random random = random_start();
  for (int trial = 0; trial < 40; ++trial) {
    const double f0_hz = random_log_between(&random, 60.0, 1200.0);
    VoiceAim aim = aim_of(f0_hz, HUGE_VAL);
    aim.open.loss = 0.0;
    aim.open.partials = (Partials)(trial % 3);
    Voice voice;
    lay(&voice);
    assert_true(voice_string(&voice, &aim, CAPACITY, 0));
    double most = 0.0;
    for (int deed = 0; deed < 30; ++deed) {
      const double place = random_between(&random, 0.05, 0.3);
      const double hardness = random_between(&random, 0.0, 1.0);
      switch (deed == 0 ? 0 : random_below(&random, 5)) {
      case 0:
        voice_pluck(&voice, (Pluck){place, hardness, 0.1, 0.0});
        break;
      case 1:
        voice_strike(&voice, (Strike){0.4, hardness, 0.25, 0.1});
        break;
      case 2:
        voice_bow(&voice, (Stroke){0.12, 0.5, 0.1, 0.02, 0.02}, &aim.open);
        voice.intonation.is_active = false; /* It would move the string */
        break;
      case 3:
        voice_lift_bow(&voice);
        break;
      default:
        voice_touch(&voice, place, 300);
        break;
      }
      run(&voice, 400);
      most = fmax(most, voice_energy(&voice));
      worst = fmax(worst, fabs(voice_energy(&voice) - voice_work(&voice)) / most);
    }
    assert_true(most > 0.0);
  }
  assert_within("of the most that it had", worst, 1e-5);
}

/* Who bends it does work on it, as the square of the pitch, which is not counted as given. */
static void movement_gives_no_work(void** state) {
  (void)state;
  const VoiceAim low = aim_of(200.0, HUGE_VAL);
  const VoiceAim high = aim_of(280.0, HUGE_VAL);
  Voice voice;
  lay(&voice);
  assert_true(voice_string(&voice, &low, CAPACITY, 0));
  voice_pluck(&voice, (Pluck){0.3, 0.3, 0.25, 0.0});
  const double given = voice_work(&voice);
  assert_within("of what it was given", fabs(voice_energy(&voice) / given - 1.0), 1e-5);
  double worst = 0.0;
  for (int i = 0; i < 200; ++i) {
    voice_aim(&voice, i % 2 ? &low : &high, 52);
    run(&voice, 52);
    const double bent = i % 2 ? 1.0 : 1.4 * 1.4;
    worst = fmax(worst, fabs(voice_energy(&voice) / (given * bent) - 1.0));
    assert_true(voice_work(&voice) == given);
  }
  assert_within("energy, over what the bend makes of it", worst, 0.1);
}

static void choked_it_sleeps_after_a_tenth_of_a_second(void** state) {
  (void)state;
  Voice voice;
  ring(&voice, 110.0, 100.0);
  run(&voice, 500);
  voice_choke(&voice, true);
  run(&voice, 4000);
  assert_true(voice.is_awake);
  voice_choke(&voice, false);
  run(&voice, 3000);
  assert_true(voice.is_awake);
  voice_choke(&voice, true);
  run(&voice, 4000);
  assert_true(voice.is_awake); /* Counted anew */
  run(&voice, 2000);
  assert_false(voice.is_awake);
  for (uint32_t i = 0; i < voice.chain.n_masses; ++i) {
    assert_true(chain_position(&voice.chain, i) == 0.0f && chain_velocity(&voice.chain, i) == 0.0f);
  }
}

static void dies_at_120_db_below_its_loudest(void** state) {
  (void)state;
  Voice voice;
  ring(&voice, 440.0, 0.02);
  uint32_t n = 0;
  for (; voice.is_awake && n < 100000; n += 64) {
    run(&voice, 64);
  }
  assert_within("seconds from ln(10⁶) τ", fabs(n / RATE_HZ - 0.02 * log(1e6)), 0.03);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gesture_is_four_milliseconds_and_enough_frames),
      cmocka_unit_test(string_has_the_most_masses_that_are_stable),
      cmocka_unit_test(pitch_that_cannot_be_had_chokes_it),
      cmocka_unit_test(retuned_it_arrives_and_has_its_motion),
      cmocka_unit_test(meshed_it_keeps_pitch_decay_and_motion),
      cmocka_unit_test(its_energy_is_what_played_it),
      cmocka_unit_test(movement_gives_no_work),
      cmocka_unit_test(choked_it_sleeps_after_a_tenth_of_a_second),
      cmocka_unit_test(dies_at_120_db_below_its_loudest),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

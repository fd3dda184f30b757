/* What a player's gestures do: every pitch and every decay that they ask for is measured. */
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/strings_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 480 };

/* A gesture takes 4 ms to act; some periods more are left out. */
static size_t settled(size_t frame, Tone tone) {
  return frame + (size_t)(RATE * (0.005 + 2.0 / tone.f0_hz));
}

static Host* open_plain(void) {
  Host* const host = strings_open(RATE, BLOCK);
  strings_set_plain(host);
  return host;
}

static ToneError measure(const Sound* sound, size_t from, size_t to, Tone asked) {
  return strings_measure(sound, RATE, settled(from, asked), to, asked);
}

/* Another channel's changes nothing. */
static void the_wheel_bends_exactly_and_back(void** state) {
  static const double bends[] = {2.0, -2.0, 0.37, -1.0, 1.99};
  (void)state;
  Host* const host = open_plain();
  Sound sound = sound_new(3 * RATE);
  ToneError worst = {0};
  unsigned channel = 0;
  for (uint32_t key = 33; key <= 96; key += 9) {
    const double bend = strings_bend_made(bends[key % 5]);
    const Tone straight = strings_tone(host, key, 0.0);
    const unsigned value = (unsigned)lround(8192.0 + 4096.0 * bend);
    strings_restart(host);
    strings_midi(host, 0, 0x90 | channel, key, 100);
    strings_midi(host, RATE / 2, 0xE0 | (15 - channel), 0, 0);
    strings_midi(host, RATE, 0xE0 | channel, value & 0x7F, value >> 7);
    strings_midi(host, 2 * RATE, 0xE0 | channel, 0, 64);
    strings_run(host, &sound, 0, sound.n_frames, BLOCK);
    worst = strings_worse(worst, measure(&sound, 0, RATE, straight));
    worst = strings_worse(worst, measure(&sound, RATE, 2 * RATE, strings_tone(host, key, bend)));
    worst = strings_worse(worst, measure(&sound, 2 * RATE, 3 * RATE, straight));
    channel = (channel + 5) % 16;
  }
  strings_assert_exact("before, while and after the wheel is turned", worst);
  sound_free(&sound);
  host_free(host);
}

/* The wheel is where it is when a note starts, too. */
static void a_note_starts_bent(void** state) {
  (void)state;
  Host* const host = open_plain();
  Sound sound = sound_new(RATE);
  ToneError worst = {0};
  for (uint32_t key = 36; key <= 96; key += 12) {
    strings_restart(host);
    strings_bend(host, 0, -2.0);
    strings_note_on(host, 10, key, 100);
    strings_run(host, &sound, 0, RATE, BLOCK);
    worst = strings_worse(worst, measure(&sound, 10, RATE, strings_tone(host, key, -2.0)));
  }
  strings_assert_exact("bent before the note", worst);
  sound_free(&sound);
  host_free(host);
}

/* Down until `up`, then measured for as long as it is heard. */
static ToneError play_release(Host* host, Sound* sound, uint32_t key, bool by_velocity) {
  const Tone asked = strings_released_tone(host, key, 0.0);
  const size_t up = RATE / 4;
  strings_restart(host);
  strings_note_on(host, 0, key, 100);
  strings_midi(host, up, by_velocity ? 0x90 : 0x80, key, 0);
  strings_run(host, sound, 0, sound->n_frames, BLOCK);
  return measure(sound, up, sound->n_frames, asked);
}

/* Sooner than its release if it dies sooner by itself: a damper never makes a string ring on. */
static void a_released_key_dies_with_the_release(void** state) {
  static const double releases_s[] = {0.03, 0.1, 0.5, 10.0};
  static const double dampings[] = {0.02, 0.6, 8.0};
  (void)state;
  Host* const host = open_plain();
  Sound sound = sound_new(3 * RATE);
  ToneError worst = {0};
  unsigned n_measured = 0;
  for (int r = 0; r < 4; ++r) {
    for (int d = 0; d < 3; ++d) {
      strings_set(host, "release", releases_s[r]);
      strings_set(host, "damping", dampings[d]);
      strings_set(host, "loss", d == 1 ? 1.0 : 0.01);
      for (uint32_t key = 33; key <= 96; key += 21) {
        const Tone asked = strings_released_tone(host, key, 0.0);
        if (asked.tau_s * asked.f0_hz >= 12.0) {
          worst = strings_worse(worst, play_release(host, &sound, key, (r + d) % 2));
          ++n_measured;
        }
      }
    }
  }
  assert_true(n_measured >= 30);
  strings_assert_exact("keys that go up", worst);
  sound_free(&sound);
  host_free(host);
}

static void velocity_nought_is_note_off(void** state) {
  (void)state;
  Host* const host = open_plain();
  Sound sounds[2] = {sound_new(RATE), sound_new(RATE)};
  for (int i = 0; i < 2; ++i) {
    (void)play_release(host, &sounds[i], 60, i == 1);
  }
  assert_true(sound_is_same(&sounds[0], &sounds[1]));
  sound_free(&sounds[0]);
  sound_free(&sounds[1]);
  host_free(host);
}

/* Held by the least value that is all the way down, and lifted at three seconds by `controller`. */
static void check_pedal(uint32_t controller, double bend_after, double bend, const char* what) {
  Host* const host = open_plain();
  Sound sound = sound_new(5 * RATE);
  ToneError held = {0};
  ToneError lifted = {0};
  strings_set(host, "release", 0.2);
  for (uint32_t key = 45; key <= 90; key += 15) {
    strings_restart(host);
    strings_controller(host, 100, STRINGS_PEDAL, 64);
    strings_bend(host, 200, bend);
    strings_note_on(host, 300, key, 100);
    strings_note_off(host, RATE, key);
    strings_controller(host, 3 * RATE, controller, 0);
    strings_run(host, &sound, 0, sound.n_frames, BLOCK);
    held = strings_worse(held, measure(&sound, RATE, 3 * RATE, strings_tone(host, key, bend)));
    lifted = strings_worse(lifted, measure(&sound, 3 * RATE, sound.n_frames,
                                           strings_released_tone(host, key, bend_after)));
  }
  print_message("%s\n", what);
  strings_assert_exact("held by the pedal", held);
  strings_assert_exact("let go", lifted);
  sound_free(&sound);
  host_free(host);
}

static void the_pedal_holds_and_lets_go(void** state) {
  (void)state;
  check_pedal(STRINGS_PEDAL, 1.0, 1.0, "pedal up");
}

static void reset_controllers_lifts_the_pedal_and_centres_the_wheel(void** state) {
  (void)state;
  check_pedal(STRINGS_RESET, 0.0, 1.0, "reset controllers");
}

/* A key that is down stays so when the pedal goes up, and when another goes up. */
static void the_pedal_lets_go_of_what_is_up_alone(void** state) {
  (void)state;
  Host* const host = open_plain();
  Sound sound = sound_new(2 * RATE);
  strings_controller(host, 0, STRINGS_PEDAL, 127);
  strings_note_on(host, 0, 60, 100);
  strings_note_off(host, 100, 60);
  strings_note_on(host, 200, 60, 100);
  strings_controller(host, 300, STRINGS_PEDAL, 0);
  strings_run(host, &sound, 0, sound.n_frames, BLOCK);
  strings_assert_exact("down again before the pedal went up",
                       measure(&sound, 300, sound.n_frames, strings_tone(host, 60, 0.0)));
  strings_note_on(host, 0, 72, 100);
  strings_note_off(host, RATE / 2, 72);
  strings_set(host, "release", 0.3);
  strings_run(host, &sound, 0, sound.n_frames, BLOCK);
  strings_assert_exact("another key that goes up lets this one ring",
                       measure(&sound, RATE, sound.n_frames, strings_tone(host, 60, 0.0)));
  sound_free(&sound);
  host_free(host);
}

static void all_notes_off_is_every_key_up(void** state) {
  (void)state;
  Host* const host = open_plain();
  Sound sounds[2] = {sound_new(RATE), sound_new(RATE)};
  for (uint32_t controller = STRINGS_NOTES_OFF; controller <= 127; ++controller) {
    for (int i = 0; i < 2; ++i) {
      strings_restart(host);
      for (uint32_t key = 0; key < 128; key += 9) {
        strings_note_on(host, key, key, 90);
        if (i == 0) {
          strings_note_off(host, RATE / 2, key);
        }
      }
      if (i == 1) {
        strings_controller(host, RATE / 2, controller, 0);
      }
      strings_run(host, &sounds[i], 0, RATE, BLOCK);
    }
    assert_true(sound_is_same(&sounds[0], &sounds[1]));
  }
  sound_free(&sounds[0]);
  sound_free(&sounds[1]);
  host_free(host);
}

/*
  While the damping goes to its new value in a straight line of n frames, many periods, the sound
  loses what it would in n/2 frames there: so a change over time is told from one at once.
*/
static void check_fall(const char* what, bool is_key, size_t length) {
  enum { CHANGE = 20 * BLOCK };
  const double rise_per_s = 50.0;
  Host* const host = open_plain();
  Sound sounds[2] = {sound_new(30 * BLOCK), sound_new(30 * BLOCK)};
  double error = 0.0;
  strings_set(host, "tracking", 0.0);
  strings_set(host, "loss", 1e-5);
  for (int i = 0; i < 2; ++i) {
    strings_set(host, "damping", 1.0);
    strings_set(host, "release", 1.0 / (1.0 + rise_per_s));
    strings_restart(host);
    strings_note_on(host, 0, 93, 100);
    strings_run(host, &sounds[i], 0, CHANGE, BLOCK);
    if (i == 1 && is_key) {
      strings_note_off(host, 0, 93);
    } else if (i == 1) {
      strings_set(host, "damping", 1.0 + rise_per_s);
    }
    strings_run(host, &sounds[i], CHANGE, sounds[i].n_frames, BLOCK);
  }
  for (size_t i = CHANGE + length; i < sounds[0].n_frames; ++i) {
    const double lost_s = ((double)(i - CHANGE) - 0.5 * (double)length) / RATE;
    const double wanted = (double)sounds[0].left[i] * exp(-rise_per_s * lost_s);
    error = fmax(error, fabs((double)sounds[1].left[i] - wanted));
  }
  assert_within(what, error / measure_peak(sounds[0].left, sounds[0].n_frames), 0.01);
  sound_free(&sounds[0]);
  sound_free(&sounds[1]);
  host_free(host);
}

/* At once, they would be off by 0.06 and 0.11. */
static void dampers_fall_in_4_ms_and_ports_over_the_block(void** state) {
  (void)state;
  check_fall("key up", true, RATE / 250);
  check_fall("damping", false, BLOCK);
}

/* Whatever holds the strings: keys, the pedal, nothing, the longest release. */
static void all_sound_off_is_silence_in_a_tenth_of_a_second(void** state) {
  (void)state;
  Host* const host = open_plain();
  Sound sound = sound_new(RATE);
  double worst = 0.0;
  for (int i = 0; i < 4; ++i) {
    const size_t off = RATE / 2;
    strings_set(host, "release", i % 2 ? 10.0 : 0.005);
    strings_set(host, "damping", 0.02);
    strings_set(host, "stiffness", i < 2 ? 1e-6 : 0.01);
    strings_restart(host);
    strings_controller(host, 0, STRINGS_PEDAL, i < 2 ? 127 : 0);
    for (uint32_t key = 21; key <= 108; key += 3) {
      strings_note_on(host, key, key, 127);
      if (key % 2) {
        strings_note_off(host, RATE / 4, key);
      }
    }
    strings_controller(host, off, STRINGS_SOUND_OFF, 0);
    strings_run(host, &sound, 0, RATE, BLOCK);
    const double before = measure_peak(sound.left + off - BLOCK, BLOCK);
    const size_t late = off + RATE / 10;
    worst = fmax(worst, measure_peak(sound.left + late, RATE - late) / before);
    assert_true(host_get(host, "sounding") == 0.0f);
  }
  assert_within("what is left of it", worst, 1e-5); /* −100 dB */
  sound_free(&sound);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_wheel_bends_exactly_and_back),
      cmocka_unit_test(a_note_starts_bent),
      cmocka_unit_test(a_released_key_dies_with_the_release),
      cmocka_unit_test(velocity_nought_is_note_off),
      cmocka_unit_test(the_pedal_holds_and_lets_go),
      cmocka_unit_test(reset_controllers_lifts_the_pedal_and_centres_the_wheel),
      cmocka_unit_test(the_pedal_lets_go_of_what_is_up_alone),
      cmocka_unit_test(all_notes_off_is_every_key_up),
      cmocka_unit_test(dampers_fall_in_4_ms_and_ports_over_the_block),
      cmocka_unit_test(all_sound_off_is_silence_in_a_tenth_of_a_second),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

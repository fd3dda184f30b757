/* What hosts do, each of them somewhere: none of it may crash, reach outside, or change the sound
 * of the guitar.  What has broken other plugins is in test_host_habits.c. */
#include "plugin/guitar_ports.h"
#include "tests/support/guitar_host.h"
#include "tests/support/host_inside.h"
#include "tests/support/measure.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 256, LARGEST = 4096, N_FRAMES = 60 * BLOCK, CC_PALM = 67 };

/* Notes, a strum's worth of them, the wheel with a wide range, and a script on top. */
static void play_piece(Host* host) {
  strings_note_on(host, 3, 45, 100);
  strings_note_on(host, 3, 52, 80);
  strings_controller(host, 500, 101, 0);
  strings_controller(host, 500, 100, 0);
  strings_controller(host, 501, 6, 7);
  strings_controller(host, 600, 1, 90);
  strings_bend(host, 1500, 1.0);
  guitar_send(host, 2001, (GuitarEvent){GUITAR_PLUCK, 0, {0.5f, NAN, NAN}});
  guitar_send(host, 3007, (GuitarEvent){GUITAR_SLIDE, 0, {7.0f, 0.06f, 0.0f}});
  strings_controller(host, 4000, CC_PALM, 40);
  strings_note_off(host, 5000, 45);
  strings_note_on(host, 9000, 57, 20);
}

static Host* open_strumming(uint32_t max_block) {
  Host* const host = guitar_open(RATE, max_block);
  strings_set(host, "strum", 15.0);
  return host;
}

static Sound play_in_blocks(uint32_t block) {
  Host* const host = open_strumming(LARGEST);
  Sound sound = sound_new(N_FRAMES);
  play_piece(host);
  strings_run(host, &sound, 0, N_FRAMES, block);
  host_free(host);
  return sound;
}

static void assert_same_and_free(Sound* a, Sound* b) {
  assert_true(measure_peak(a->left, a->n_frames) > 0.01);
  assert_true(sound_is_same(a, b));
  sound_free(a);
  sound_free(b);
}

static void block_size_does_not_change_the_sound(void** state) {
  static const uint32_t blocks[] = {1, 17, 64, 255, 256, 257, 1024};
  (void)state;
  Sound whole = play_in_blocks(LARGEST);
  for (size_t i = 0; i < sizeof(blocks) / sizeof(blocks[0]); ++i) {
    Sound cut = play_in_blocks(blocks[i]);
    assert_true(sound_is_same(&whole, &cut));
    sound_free(&cut);
  }
  sound_free(&whole);
}

static void random_blocks_do_not_change_the_sound(void** state) {
  (void)state;
  Random random = random_start();
  for (int i = 0; i < 3; ++i) {
    Host* const host = open_strumming(LARGEST);
    Sound whole = play_in_blocks(LARGEST);
    Sound cut = sound_new(N_FRAMES);
    play_piece(host);
    for (size_t at = 0; at < N_FRAMES;) {
      const uint32_t wanted = (uint32_t)random_log_between(&random, 1.0, LARGEST + 1.0);
      const size_t n = wanted < N_FRAMES - at ? wanted : N_FRAMES - at;
      assert_true(random_below(&random, 5) > 0 || host_run(host, 0));
      strings_run(host, &cut, at, at + n, LARGEST);
      at += n;
    }
    assert_same_and_free(&whole, &cut);
    host_free(host);
  }
}

static void a_note_and_an_event_start_on_their_frame(void** state) {
  (void)state;
  Host* const host = guitar_open(RATE, 64);
  Sound sound = sound_new(256);
  strings_set(host, "masses", 1.0);
  for (size_t frame = 0; frame < 130; ++frame) {
    strings_restart(host);
    if (frame % 2) {
      strings_note_on(host, frame, 64, 127);
    } else {
      guitar_send(host, frame, (GuitarEvent){GUITAR_PLUCK, 0, {1.0f, NAN, NAN}});
    }
    strings_run(host, &sound, 0, 256, 64);
    for (size_t i = 0; i < frame; ++i) {
      assert_true(sound.left[i] == 0.0f && sound.right[i] == 0.0f);
    }
    assert_true(sound.left[frame] != 0.0f && sound.right[frame] != 0.0f);
  }
  sound_free(&sound);
  host_free(host);
}

/* One port after another missing: the rest does its work; and with all of them missing, too. */
static void any_port_may_be_null(void** state) {
  (void)state;
  Sound alone = play_in_blocks(BLOCK);
  for (uint32_t port = 0; port < GUITAR_N_PORTS; ++port) {
    Host* const host = open_strumming(BLOCK);
    Sound sound = sound_new(N_FRAMES);
    const Sound kept = {port == PORT_OUT_LEFT ? alone.left : sound.left,
                        port == PORT_OUT_RIGHT ? alone.right : sound.right, N_FRAMES};
    host_connect(host, port, NULL);
    play_piece(host);
    strings_run(host, &sound, 0, N_FRAMES, BLOCK);
    assert_int_equal(sound_is_same(&alone, &kept),
                     port != PORT_CONTROL && port != GUITAR_PORT_STRUM);
    for (uint32_t i = 0; i < GUITAR_N_PORTS + 9; ++i) {
      host_connect(host, i, NULL);
    }
    assert_true(host_run(host, BLOCK) && host_run(host, 0));
    sound_free(&sound);
    host_free(host);
  }
  sound_free(&alone);
}

/* They are of the frame that comes next, as is the rest of their chord. */
static void an_empty_run_takes_its_events(void** state) {
  (void)state;
  const uint8_t note_on[3] = {0x90, 60, 100};
  Host* const host = guitar_open(RATE, BLOCK);
  assert_true(host_run(host, 0));
  assert_true(host_get(host, "sounding") == 0.0f && host_get(host, "headroom") == 1.0f);
  assert_true(host_midi_raw(host, 0, note_on, 3));
  assert_true(host_run(host, 0));
  assert_true(host_run(host, 0));
  assert_true(host_run(host, 1));
  assert_true(host_get(host, "sounding") == 1.0f);
  host_free(host);
}

static void meters_report_the_guitar(void** state) {
  (void)state;
  Host* const host = guitar_open(RATE, BLOCK);
  Sound sound = sound_new(BLOCK);
  strings_set(host, "course", 0.5);
  strings_set(host, "masses", 50.0);
  Duo duo = duo_new(host, RATE);
  for (uint32_t i = 0; i < 3; ++i) {
    strings_note_on(host, 0, 40 + 7 * i, 100);
    guitarist_note_on(duo.guitarist, 0, 40 + 7 * i, 100);
    strings_run(host, &sound, 0, BLOCK, BLOCK);
    duo_run(&duo, &sound, 0, BLOCK);
    const VoiceReport report = guitar_report(duo.guitar);
    assert_int_equal(report.n_strings, 2 * (i + 1));
    assert_true(host_get(host, "sounding") == (float)report.n_strings);
    assert_true(host_get(host, "mass_count") == (float)report.n_masses);
    assert_true(host_get(host, "headroom") == (float)report.headroom && report.headroom < 1.0);
  }
  duo_free(&duo);
  sound_free(&sound);
  host_free(host);
}

/* Whatever was held, bent, laid on or still to be plucked is gone, and the patch is not. */
static void activation_begins_anew(void** state) {
  (void)state;
  Sound alone = play_in_blocks(BLOCK);
  Host* const host = open_strumming(BLOCK);
  Sound sound = sound_new(N_FRAMES);
  for (int i = 0; i < 2; ++i) {
    play_piece(host);
    strings_controller(host, 4500, STRINGS_PEDAL, 127);
    strings_run(host, &sound, 0, 40 * BLOCK, BLOCK);
    strings_note_on(host, 0, 40, 100);
    strings_note_on(host, 0, 47, 100);
    strings_run(host, &sound, 0, 100, BLOCK);
    strings_restart(host);
    strings_run(host, &sound, 0, 10 * BLOCK, BLOCK);
    assert_true(measure_peak(sound.left, 10 * BLOCK) == 0.0);
  }
  play_piece(host);
  strings_run(host, &sound, 0, N_FRAMES, BLOCK);
  assert_same_and_free(&alone, &sound);
  host_free(host);
}

/* Choked at once; while it is off keys, plucks and hammers do nothing, all else does; and then it
 * plays again. */
static void off_is_silence(void** state) {
  (void)state;
  Host* const host = guitar_open(RATE, BLOCK);
  Sound sound = sound_new(RATE);
  strings_controller(host, 0, STRINGS_PEDAL, 127);
  strings_note_on(host, 0, 45, 127);
  strings_note_on(host, 0, 64, 127);
  strings_run(host, &sound, 0, RATE / 2, BLOCK);
  const double before = measure_peak(sound.left, RATE / 2);
  strings_set(host, "enabled", 0.0);
  strings_note_on(host, 0, 50, 127);
  guitar_send(host, 30, (GuitarEvent){GUITAR_PLUCK, 2, {1.0f, NAN, NAN}});
  guitar_send(host, 50, (GuitarEvent){GUITAR_HAMMER, 3, {5.0f, 1.0f, 0.0f}});
  guitar_send(host, 60, (GuitarEvent){GUITAR_SLIDE, 1, {2.0f, 0.01f, 0.0f}});
  strings_run(host, &sound, RATE / 2, RATE, BLOCK);
  assert_true(measure_peak(sound.left + 6 * RATE / 10, 4 * RATE / 10) < 1e-5 * before);
  assert_true(host_get(host, "sounding") == 0.0f);
  strings_set(host, "enabled", 1.0);
  guitar_send(host, 0, (GuitarEvent){GUITAR_PLUCK, 1, {1.0f, NAN, NAN}});
  strings_run(host, &sound, 0, RATE, BLOCK);
  const ToneError error = strings_measure(&sound, RATE, RATE / 20, RATE,
                                          (Tone){strings_tone(host, 61, 0.0).f0_hz, 1.0});
  assert_true(error.cents < 0.1); /* The second string at the second fret, where it was slid to */
  sound_free(&sound);
  host_free(host);
}

static void two_instances_and_two_plugins_do_not_hear_each_other(void** state) {
  (void)state;
  Sound alone = play_in_blocks(BLOCK);
  Sound sound = sound_new(N_FRAMES);
  Sound other = sound_new(N_FRAMES);
  Host* const host = open_strumming(BLOCK);
  Host* const neighbour = guitar_open(44100.0, BLOCK);
  Host* const harp = strings_open(44100.0, BLOCK);
  strings_set(neighbour, "tuning", 415.0);
  play_piece(host);
  play_piece(neighbour);
  strings_note_on(harp, 0, 60, 100);
  for (size_t at = 0; at < N_FRAMES; at += BLOCK) {
    strings_run(neighbour, &other, at, at + BLOCK, 100);
    strings_run(harp, &other, at, at + BLOCK, BLOCK);
    strings_run(host, &sound, at, at + BLOCK, BLOCK);
  }
  assert_same_and_free(&alone, &sound);
  sound_free(&other);
  host_free(harp);
  host_free(neighbour);
  host_free(host);
}

static void it_wants_a_map_and_a_rate(void** state) {
  static const double rates_hz[] = {0.0, -48000.0, (double)NAN, HUGE_VAL, 1e12};
  (void)state;
  Host* const host = guitar_open(RATE, BLOCK);
  const LV2_Feature* const none[1] = {NULL};
  assert_null(lilv_plugin_instantiate(host_plugin(host), RATE, none));
  for (int i = 0; i < 5; ++i) {
    assert_null(lilv_plugin_instantiate(host_plugin(host), rates_hz[i], host_features(host)));
  }
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(block_size_does_not_change_the_sound),
      cmocka_unit_test(random_blocks_do_not_change_the_sound),
      cmocka_unit_test(a_note_and_an_event_start_on_their_frame),
      cmocka_unit_test(any_port_may_be_null),
      cmocka_unit_test(an_empty_run_takes_its_events),
      cmocka_unit_test(meters_report_the_guitar),
      cmocka_unit_test(activation_begins_anew),
      cmocka_unit_test(off_is_silence),
      cmocka_unit_test(two_instances_and_two_plugins_do_not_hear_each_other),
      cmocka_unit_test(it_wants_a_map_and_a_rate),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

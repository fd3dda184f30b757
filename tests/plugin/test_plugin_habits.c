/* What hosts do, each of them somewhere: none of it may crash, reach outside, or change the sound.
 * What has broken other plugins is in test_host_habits.c, for both of ours. */
#include "plugin/strings_ports.h"
#include "tests/support/host_inside.h"
#include "tests/support/measure.h"
#include "tests/support/strings_host.h"

#include <lv2/log/log.h>
#include <lv2/urid/urid.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 256, N_FRAMES = 40 * BLOCK, LINE_SIZE = 256 };

static void play_piece(Host* host, size_t offset) {
  strings_note_on(host, offset + 3, 45, 100);
  strings_note_on(host, offset + 700, 52, 80);
  strings_bend(host, offset + 1500, 1.0);
  strings_note_off(host, offset + 5000, 45);
}

static Sound play_alone(void) {
  Host* const host = strings_open(RATE, BLOCK);
  Sound sound = sound_new(N_FRAMES);
  play_piece(host, 0);
  strings_run(host, &sound, 0, N_FRAMES, BLOCK);
  host_free(host);
  return sound;
}

static void assert_same_and_free(Sound* a, Sound* b) {
  assert_true(measure_peak(a->left, a->n_frames) > 0.01);
  assert_true(sound_is_same(a, b));
  sound_free(a);
  sound_free(b);
}

static void disconnect_all(Host* host) {
  for (uint32_t i = 0; i < host_n_ports(host); ++i) {
    host_connect(host, i, NULL);
  }
}

/* With nothing connected time goes on unheard, and nothing is lost of it. */
static void ports_may_be_null_before_and_between_runs(void** state) {
  (void)state;
  Sound alone = play_alone();
  Sound sound = sound_new(N_FRAMES);
  Host* const host = strings_open(RATE, BLOCK);
  disconnect_all(host);
  host_activate(host);
  assert_true(host_run(host, 0));
  assert_true(host_run(host, BLOCK));
  strings_restart(host);
  host_reconnect(host);
  play_piece(host, 0);
  strings_run(host, &sound, 0, 10 * BLOCK, BLOCK);
  disconnect_all(host);
  assert_true(host_run(host, BLOCK));
  host_reconnect(host);
  strings_run(host, &sound, 11 * BLOCK, N_FRAMES, BLOCK);
  memcpy(sound.left + 10 * BLOCK, alone.left + 10 * BLOCK, BLOCK * sizeof(float));
  memcpy(sound.right + 10 * BLOCK, alone.right + 10 * BLOCK, BLOCK * sizeof(float));
  assert_same_and_free(&alone, &sound);
  host_free(host);
}

/* One port after another missing: the rest does its work. */
static void any_port_may_be_null_alone(void** state) {
  (void)state;
  Sound alone = play_alone();
  for (uint32_t port = 0; port < STRINGS_N_PORTS; ++port) {
    Host* const host = strings_open(RATE, BLOCK);
    Sound sound = sound_new(N_FRAMES);
    const Sound kept = {port == PORT_OUT_LEFT ? alone.left : sound.left,
                        port == PORT_OUT_RIGHT ? alone.right : sound.right, N_FRAMES};
    host_connect(host, port, NULL);
    play_piece(host, 0);
    strings_run(host, &sound, 0, N_FRAMES, BLOCK);
    assert_int_equal(sound_is_same(&alone, &kept), port != PORT_CONTROL);
    sound_free(&sound);
    host_free(host);
  }
  sound_free(&alone);
}

/* Events in an empty run are played, and reports are brought up to date. */
static void an_empty_run_plays_its_events(void** state) {
  (void)state;
  const uint8_t note_on[3] = {0x90, 60, 100};
  Host* const host = strings_open(RATE, BLOCK);
  assert_true(host_midi_raw(host, 0, note_on, 3));
  assert_true(host_run(host, 0));
  assert_true(host_get(host, "sounding") == 1.0f);
  host_free(host);
}

/* An event that is not within its block is played at the nearest time there is. */
static void events_outside_the_block_are_brought_inside(void** state) {
  static const struct {
    int64_t frame;
    size_t heard_at;
  } cases[] = {{-1, 0},
               {INT64_MIN, 0},
               {0, 0},
               {BLOCK - 1, BLOCK - 1},
               {BLOCK, BLOCK},
               {BLOCK + 9999, BLOCK},
               {INT64_MAX, BLOCK},
               {1LL << 32, BLOCK}};
  (void)state;
  const uint8_t note_on[3] = {0x90, 69, 127};
  for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); ++i) {
    Host* const host = strings_open(RATE, BLOCK);
    Sound sound = sound_new(2 * BLOCK);
    strings_set(host, "masses", 1.0);
    assert_true(host_midi_raw(host, cases[i].frame, note_on, 3));
    strings_run(host, &sound, 0, 2 * BLOCK, BLOCK);
    size_t first = 0;
    while (first < 2 * BLOCK && sound.left[first] == 0.0f) {
      ++first;
    }
    assert_int_equal(first, cases[i].heard_at);
    sound_free(&sound);
    host_free(host);
  }
}

static void two_instances_do_not_hear_each_other(void** state) {
  (void)state;
  Sound alone = play_alone();
  Sound sound = sound_new(N_FRAMES);
  Sound other = sound_new(N_FRAMES);
  Host* const host = strings_open(RATE, BLOCK);
  Host* const neighbour = strings_open(44100.0, BLOCK);
  strings_set(neighbour, "stiffness", 0.01);
  strings_set(neighbour, "tuning", 415.0);
  play_piece(host, 0);
  play_piece(neighbour, 50);
  for (size_t at = 0; at < N_FRAMES; at += BLOCK) {
    strings_run(neighbour, &other, at, at + BLOCK, 100);
    strings_run(host, &sound, at, at + BLOCK, BLOCK);
  }
  assert_same_and_free(&alone, &sound);
  sound_free(&other);
  host_free(neighbour);
  host_free(host);
}

static void it_wants_a_map_and_nothing_else(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  const LV2_Feature* const none[1] = {NULL};
  assert_null(lilv_plugin_instantiate(host_plugin(host), RATE, none));
  const LV2_Descriptor* const descriptor = lilv_instance_get_descriptor(host_instance(host));
  assert_null(descriptor->instantiate(descriptor, RATE, "", NULL));
  host_free(host);
  char error[256] = "";
  const HostConfig bare = {.rate_hz = RATE, .max_block = BLOCK, .is_bare = true};
  Host* const poor = host_new_with(STRINGS_URI, &bare, error, sizeof(error));
  assert_non_null(poor);
  Sound alone = play_alone();
  Sound sound = sound_new(N_FRAMES);
  play_piece(poor, 0);
  strings_run(poor, &sound, 0, N_FRAMES, BLOCK);
  assert_same_and_free(&alone, &sound);
  host_free(poor);
}

static int keep_line(LV2_Log_Handle handle, LV2_URID type, const char* format, ...) {
  va_list args;
  (void)type;
  va_start(args, format);
  const int n = vsnprintf((char*)handle, LINE_SIZE, format, args);
  va_end(args);
  return n;
}

/* What is no rate, and those at which times in frames would have more than 32 bits; the log names
 * those that are taken. */
static void no_rate_is_refused(void** state) {
  static const double rates_hz[] = {0.0, -48000.0, (double)NAN, HUGE_VAL, 1.0000001e9, 1e12, 1e300};
  (void)state;
  char line[LINE_SIZE];
  LV2_Log_Log log = {.handle = line, .printf = keep_line};
  const LV2_Feature logged = {LV2_LOG__log, &log};
  Host* const host = strings_open(RATE, BLOCK);
  const LV2_Feature* const features[] = {&logged, host_features(host)[0], NULL};
  assert_string_equal(features[1]->URI, LV2_URID__map);
  for (size_t i = 0; i < sizeof(rates_hz) / sizeof(rates_hz[0]); ++i) {
    *line = '\0';
    assert_null(lilv_plugin_instantiate(host_plugin(host), rates_hz[i], features));
    assert_non_null(strstr(line, " Hz, expected one above 0 and up to 1e+09 Hz\n"));
    assert_null(lilv_plugin_instantiate(host_plugin(host), rates_hz[i], features + 1));
  }
  host_free(host);
  host_free(strings_open(1e9, BLOCK));
}

/* The sound depends neither on whether the host renders faster than time nor on when it says so. */
static void freewheeling_sounds_the_same(void** state) {
  (void)state;
  for (int weakly = 0; weakly < 2; ++weakly) {
    Sound sounds[2] = {sound_new(N_FRAMES), sound_new(N_FRAMES)};
    for (int i = 0; i < 2; ++i) {
      Host* const host = strings_open(RATE, BLOCK);
      strings_set(host, "damping", weakly ? 0.02 : 0.6);
      play_piece(host, 0);
      for (size_t at = 0; at < N_FRAMES; at += BLOCK) {
        assert_true(host_set_freewheel(host, i == 1 && at / BLOCK % 7 > 3));
        strings_run(host, &sounds[i], at, at + BLOCK, BLOCK);
      }
      host_free(host);
    }
    assert_same_and_free(&sounds[0], &sounds[1]);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(ports_may_be_null_before_and_between_runs),
      cmocka_unit_test(any_port_may_be_null_alone),
      cmocka_unit_test(an_empty_run_plays_its_events),
      cmocka_unit_test(events_outside_the_block_are_brought_inside),
      cmocka_unit_test(two_instances_do_not_hear_each_other),
      cmocka_unit_test(it_wants_a_map_and_nothing_else),
      cmocka_unit_test(no_rate_is_refused),
      cmocka_unit_test(freewheeling_sounds_the_same),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

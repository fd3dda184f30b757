/* Notes differ a little from each other, as much as is asked, and the same notes from silence are
 * the same again; all heard through a host. */
#include "tests/support/guitar_host.h"
#include "tests/support/loudness.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/plugins.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum {
  RATE = 48000,
  BLOCK = PLUGINS_BLOCK,
  KEY = 57,
  N_NOTES = 4,
  GAP = RATE / 2,
  N_FRAMES = N_NOTES * GAP,
  N_TAKES = 24
};

/* To what Hooke Strings has by its exciter; the last is Hooke Guitar. */
enum { BOW = 2, GUITAR = 3, N_WAYS };
static const char* const ways[N_WAYS] = {"plucked", "struck", "bowed", "guitar"};

/* A decibel, and what the making up is off by [dB]; and what evenly spread ones cover. */
static const double MOST_DB = 1.15;
static const double LEAST_RANGE_DB = 1.5;

static Host* open_way(int way, double variation, double take) {
  Host* const host = plugins_open(way == GUITAR);
  if (way != GUITAR) {
    strings_set(host, "exciter", way);
  }
  strings_set(host, "release", 0.02);
  strings_set(host, "variation", variation);
  strings_set(host, "take", take);
  return host;
}

/* One key, time and again, each dying away before the next but not to silence. */
static Sound play(Host* host, uint32_t block) {
  Sound sound = sound_new(N_FRAMES);
  for (uint32_t i = 0; i < N_NOTES; ++i) {
    strings_note_on(host, (size_t)i * GAP, KEY, 100);
    strings_note_off(host, (size_t)i * GAP + GAP - 4000, KEY);
  }
  strings_run(host, &sound, 0, N_FRAMES, block);
  return sound;
}

static Sound play_new(int way, double variation, double take, uint32_t block) {
  Host* const host = open_way(way, variation, take);
  Sound sound = play(host, block);
  host_free(host);
  return sound;
}

static bool are_same_and_freed(Sound a, Sound b) {
  const bool is_same = sound_is_same(&a, &b);
  sound_free(&a);
  sound_free(&b);
  return is_same;
}

static void without_variation_a_take_is_no_other(void** state) {
  (void)state;
  for (int way = 0; way < N_WAYS; ++way) {
    assert_true(
        are_same_and_freed(play_new(way, 0.0, 1.0, BLOCK), play_new(way, 0.0, 999.0, BLOCK)));
  }
}

static void a_take_is_the_same_again_in_any_blocks(void** state) {
  (void)state;
  for (int way = 0; way < N_WAYS; ++way) {
    assert_true(are_same_and_freed(play_new(way, 1.0, 7.0, 1), play_new(way, 1.0, 7.0, BLOCK)));
    assert_false(
        are_same_and_freed(play_new(way, 1.0, 7.0, BLOCK), play_new(way, 1.0, 8.0, BLOCK)));
    assert_false(
        are_same_and_freed(play_new(way, 1.0, 7.0, BLOCK), play_new(way, 0.0, 7.0, BLOCK)));
  }
}

/* Where a host's playhead goes back, nothing else says so. */
static void a_take_is_the_same_again_from_silence(void** state) {
  (void)state;
  for (int way = 0; way < N_WAYS; ++way) {
    Host* const host = open_way(way, 1.0, 3.0);
    Sound first = play(host, BLOCK);
    Sound between = sound_new(2 * RATE);
    strings_run(host, &between, 0, between.n_frames, BLOCK);
    assert_true(host_get(host, "sounding") == 0.0f);
    Sound again = play(host, BLOCK);
    assert_true(sound_is_same(&first, &again));
    sound_free(&between);
    sound_free(&first);
    sound_free(&again);
    host_free(host);
  }
}

/* A note of another take. */
static double level_of(Host* host, double take, uint32_t key) {
  Sound sound = sound_new(RATE / 2);
  strings_set(host, "take", take);
  strings_restart(host);
  strings_note_on(host, 0, key, 100);
  strings_run(host, &sound, 0, sound.n_frames, BLOCK);
  const double lufs = loudness_lufs(sound.left, sound.right, sound.n_frames);
  sound_free(&sound);
  return lufs;
}

/* Place and hardness differ too, and what that does to the loudness is made up for. */
static void notes_are_as_loud_as_asked_within_a_decibel(void** state) {
  (void)state;
  static const uint32_t keys[] = {40, 57, 76};
  for (int way = 0; way < N_WAYS; ++way) {
    for (int k = 0; k < 3; ++k) {
      Host* const host = open_way(way, 0.0, 1.0);
      HostRange sense;
      if (host_range(host, "sense", &sense)) {
        strings_set(host, "sense", 0.0); /* A bow's velocity tells how it begins. */
      }
      const double asked = level_of(host, 1.0, keys[k]);
      double least = 0.0;
      double most = 0.0;
      strings_set(host, "variation", 1.0);
      for (int take = 1; take <= N_TAKES; ++take) {
        const double off = level_of(host, take, keys[k]) - asked;
        least = fmin(least, off);
        most = fmax(most, off);
      }
      print_message("%s, key %u: %.2f to %.2f dB\n", ways[way], keys[k], least, most);
      assert_true(least > -MOST_DB && most < MOST_DB && most - least > LEAST_RANGE_DB);
      host_free(host);
    }
  }
}

static Sound play_script(double variation) {
  Host* const host = open_way(GUITAR, variation, 1.0);
  Sound sound = sound_new(GAP);
  guitar_send(host, 10, (GuitarEvent){GUITAR_FRET, 3, {2.0f, 0.0f, 0.0f}});
  guitar_send(host, 10, (GuitarEvent){GUITAR_PLUCK, 3, {0.5f, NAN, NAN}});
  guitar_send(host, 5000, (GuitarEvent){GUITAR_PLUCK, 3, {0.5f, 0.2f, 0.3f}});
  guitar_send(host, 9000, (GuitarEvent){GUITAR_HAMMER, 3, {4.0f, 0.5f, 0.0f}});
  strings_run(host, &sound, 0, GAP, BLOCK);
  host_free(host);
  return sound;
}

static void a_script_is_played_as_it_is_written(void** state) {
  (void)state;
  Sound exact = play_script(0.0);
  assert_true(measure_peak(exact.left, GAP) > 0.01);
  assert_true(are_same_and_freed(exact, play_script(1.0)));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(without_variation_a_take_is_no_other),
      cmocka_unit_test(a_take_is_the_same_again_in_any_blocks),
      cmocka_unit_test(a_take_is_the_same_again_from_silence),
      cmocka_unit_test(notes_are_as_loud_as_asked_within_a_decibel),
      cmocka_unit_test(a_script_is_played_as_it_is_written),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* What fingers, picks and hammers make themselves, through a host: as loud as is asked, gone in a
 * moment, and nothing else is changed by it. */
#include "tests/support/guitar_host.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/plugins.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = PLUGINS_BLOCK, N_FRAMES = RATE / 2, PERIOD = RATE / 960, KEY = 52 };

/* How Hooke Strings is played; the last is Hooke Guitar. */
enum { STRIKE = 1, BOW = 2, GUITAR = 3, N_WAYS };

static Host* open_way(int way, double noise) {
  Host* const host = plugins_open(way == GUITAR);
  if (way != GUITAR) {
    strings_set(host, "exciter", way);
  }
  strings_set(host, "limiter", 0.0);
  strings_set(host, "noise", noise);
  return host;
}

/* The notes are queued. */
static Sound render(Host* host, uint32_t block) {
  Sound sound = sound_new(N_FRAMES);
  strings_run(host, &sound, 0, N_FRAMES, block);
  return sound;
}

static Sound note_of(int way, double noise, uint32_t velocity) {
  Host* const host = open_way(way, noise);
  strings_note_on(host, 0, KEY, velocity);
  Sound sound = render(host, BLOCK);
  host_free(host);
  return sound;
}

/* What the second has more, in its place. */
static void take_away(const Sound* from, Sound* sound) {
  for (size_t n = 0; n < sound->n_frames; ++n) {
    sound->left[n] -= from->left[n];
    sound->right[n] -= from->right[n];
  }
}

static Sound noise_of(int way, double noise, uint32_t velocity) {
  Sound without = note_of(way, 0.0, velocity);
  Sound with = note_of(way, noise, velocity);
  take_away(&without, &with);
  sound_free(&without);
  return with;
}

static double peak_from(const Sound* sound, size_t from) {
  return fmax(measure_peak(sound->left + from, sound->n_frames - from),
              measure_peak(sound->right + from, sound->n_frames - from));
}

static void it_is_gone_after_a_moment(void** state) {
  (void)state;
  for (int way = 0; way < N_WAYS; ++way) {
    Sound noise = noise_of(way, 1.0, 127);
    const double peak = peak_from(&noise, 0);
    print_message("way %d: %.1f dB\n", way, 20.0 * log10(peak));
    assert_true(way == BOW ? peak == 0.0 : peak > 0.01);
    assert_true(peak_from(&noise, RATE * 15 / 100) == 0.0);
    sound_free(&noise);
  }
}

/* The peak of a note, and in the mean that of its noise, over some keys; of plucks. */
static void it_is_14_dB_below_a_pluck(void** state) {
  (void)state;
  for (int way = 0; way < N_WAYS; ++way) {
    double sum = 0.0;
    unsigned n = 0;
    for (uint32_t key = 40; key <= 76 && way != BOW; key += 3) {
      double peaks[2];
      for (int i = 0; i < 2; ++i) {
        Host* const host = open_way(way, i);
        strings_note_on(host, 0, key, 127);
        Sound sound = render(host, BLOCK);
        if (i == 1) {
          Host* const other = open_way(way, 0.0);
          strings_note_on(other, 0, key, 127);
          Sound without = render(other, BLOCK);
          take_away(&without, &sound);
          sound_free(&without);
          host_free(other);
        }
        peaks[i] = peak_from(&sound, 0);
        sound_free(&sound);
        host_free(host);
      }
      sum += 20.0 * log10(peaks[1] / peaks[0]);
      ++n;
    }
    if (way != BOW) {
      print_message("way %d: %.1f dB\n", way, sum / n);
      assert_within("dB from 14 below", fabs(sum / n + 14.0), 4.0);
    }
  }
}

/* In the first 20 ms: what is not the same a period later, and so lies between the partials,
 * against all [dB]. */
static double between_db(const Sound* sound) {
  double between = 0.0;
  double all = 0.0;
  for (size_t n = PERIOD; n < RATE / 50; ++n) {
    const double x = (double)sound->left[n];
    const double change = x - (double)sound->left[n - PERIOD];
    all += x * x;
    between += 0.5 * change * change;
  }
  return 10.0 * log10(between / all);
}

static void it_fills_what_is_between_the_partials(void** state) {
  (void)state;
  for (int way = 0; way < N_WAYS; ++way) {
    double db[2];
    for (int i = 0; i < 2; ++i) {
      Host* const host = open_way(way, i);
      strings_set(host, "tuning", 480.0);
      strings_set(host, "stiffness", 0.0);
      if (way != GUITAR) {
        strings_set(host, "spread", 0.0); /* What is late has no period before its first. */
      }
      strings_note_on(host, 0, 81, 100);
      Sound sound = render(host, BLOCK);
      db[i] = between_db(&sound);
      sound_free(&sound);
      host_free(host);
    }
    print_message("way %d: %.1f dB, with noise %.1f dB\n", way, db[0], db[1]);
    const double least_rise = way == STRIKE ? 3.0 : 9.0; /* A blow is noise enough. */
    assert_true(way == BOW ? db[1] == db[0] : db[1] > db[0] + least_rise);
    assert_true(way == STRIKE || way == BOW || (db[0] < -33.0 && db[1] > -28.0));
  }
}

/* Notes that overlap, on two channels with other gains, one of them on its way. */
static Sound piece_of(int way, double noise, uint32_t block) {
  Host* const host = open_way(way, noise);
  strings_midi(host, 0, 0xB1, 7, 40);
  for (uint32_t i = 0; i < 8; ++i) {
    strings_midi(host, (size_t)1 + 997 * i, 0x90 | (i % 2), 45 + 3 * i, 127);
  }
  strings_midi(host, 3000, 0xB0, 7, 90);
  Sound sound = render(host, block);
  host_free(host);
  return sound;
}

static void blocks_do_not_change_it(void** state) {
  (void)state;
  for (int way = 0; way < N_WAYS; ++way) {
    Sound whole = piece_of(way, 1.0, BLOCK);
    Sound cut = piece_of(way, 1.0, 1);
    assert_true(sound_is_same(&whole, &cut));
    sound_free(&whole);
    sound_free(&cut);
  }
}

static Sound noise_at_volume(int way, uint32_t volume) {
  Sound sounds[2];
  for (int i = 0; i < 2; ++i) {
    Host* const host = open_way(way, i);
    strings_controller(host, 0, 7, volume);
    strings_note_on(host, RATE / 10, KEY, 127);
    sounds[i] = render(host, BLOCK);
    host_free(host);
  }
  take_away(&sounds[0], &sounds[1]);
  sound_free(&sounds[0]);
  return sounds[1];
}

/* It is heard with the gain of its channel: at half the volume as at the whole of it, but softer.
 */
static void its_channel_turns_it_down(void** state) {
  (void)state;
  for (int way = 0; way < N_WAYS; ++way) {
    Sound loud = noise_at_volume(way, 127);
    Sound soft = noise_at_volume(way, 64);
    if (way != BOW) {
      const double gain = peak_from(&soft, 0) / peak_from(&loud, 0);
      assert_true(gain > 0.1 && gain < 0.9);
      assert_within("from the same", sound_distance(&loud, &soft), 1e-6);
    }
    sound_free(&loud);
    sound_free(&soft);
  }
}

/* It is no motion of the string: pickups of velocity hear it as it is. */
static void pickups_hear_it_as_it_is(void** state) {
  (void)state;
  Sound noises[3];
  for (int type = 0; type < 3; ++type) {
    Sound sounds[2];
    for (int i = 0; i < 2; ++i) {
      Host* const host = open_way(STRIKE, i);
      strings_set(host, "sense", type);
      strings_note_on(host, 0, KEY, 127);
      sounds[i] = render(host, BLOCK);
      host_free(host);
    }
    take_away(&sounds[0], &sounds[1]);
    sound_free(&sounds[0]);
    noises[type] = sounds[1];
    assert_true(measure_peak(noises[type].left, N_FRAMES) > 0.01);
    assert_within("from that of displacement", sound_distance(&noises[0], &noises[type]), 1e-6);
  }
  for (int type = 0; type < 3; ++type) {
    sound_free(&noises[type]);
  }
}

/* All sound off, and the host's switch: from a few hundredths of a second on all is as without. */
static void it_falls_silent_when_all_does(void** state) {
  enum { OFF = BLOCK, GONE = OFF + RATE / 50 };
  (void)state;
  for (int i = 0; i < 2 * N_WAYS; ++i) {
    Sound sounds[2];
    for (int k = 0; k < 2; ++k) {
      Host* const host = open_way(i / 2, k);
      strings_set(host, "hardness", 0.0);
      sounds[k] = sound_new(N_FRAMES);
      strings_note_on(host, 0, KEY, 127);
      strings_run(host, &sounds[k], 0, OFF, BLOCK);
      if (i % 2) {
        strings_set(host, "enabled", 0.0);
      } else {
        strings_controller(host, 0, STRINGS_SOUND_OFF, 0);
      }
      strings_run(host, &sounds[k], OFF, N_FRAMES, BLOCK);
      host_free(host);
    }
    take_away(&sounds[0], &sounds[1]);
    assert_true(i / 2 == BOW || peak_from(&sounds[1], 0) > 0.01);
    assert_true(peak_from(&sounds[1], GONE) == 0.0);
    sound_free(&sounds[0]);
    sound_free(&sounds[1]);
  }
}

/* All keys of a keyboard, as hard as can be, over and over. */
static void the_limiter_bears_the_worst_of_it(void** state) {
  (void)state;
  Random random = random_start();
  for (int way = 0; way < N_WAYS; ++way) {
    Host* const host = open_way(way, 1.0);
    strings_set(host, "limiter", 1.0);
    strings_set(host, "level", 12.0);
    for (size_t n = 0; n < N_FRAMES; n += 1 + random_below(&random, 200)) {
      strings_midi(host, n, 0x90 | random_below(&random, 16), 30 + random_below(&random, 70), 127);
    }
    Sound sound = render(host, BLOCK);
    const double peak = peak_from(&sound, 0);
    print_message("way %d: peak %.3f\n", way, peak);
    assert_true(peak > 0.5 && peak <= 1.0);
    sound_free(&sound);
    host_free(host);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(it_is_gone_after_a_moment),
      cmocka_unit_test(it_is_14_dB_below_a_pluck),
      cmocka_unit_test(it_fills_what_is_between_the_partials),
      cmocka_unit_test(blocks_do_not_change_it),
      cmocka_unit_test(its_channel_turns_it_down),
      cmocka_unit_test(pickups_hear_it_as_it_is),
      cmocka_unit_test(it_falls_silent_when_all_does),
      cmocka_unit_test(the_limiter_bears_the_worst_of_it),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

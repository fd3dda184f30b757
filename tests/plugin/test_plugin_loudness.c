/* Hooke Strings through a host is as loud whatever plays it, wherever, and on every key. */
#include "tests/support/loudness.h"
#include "tests/support/oracle.h"
#include "tests/support/strings_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 512, BOW = 2, VELOCITY = 100, HIGHEST_BOWED = 80, N_KEYS = 4 };

/* The middle of what is heard [LUFS], as tests/harp/test_harp_balance.c has it; what is promised
 * either way [dB], and of bows on keys whose periods have few frames. */
static const double LOUDNESS = -15.5;
static const double PROMISED_DB = 3.0;
static const double PROMISED_HIGH_DB = 4.5;

static const char* const exciters[] = {"pluck", "strike", "bow"};
static const char* const pickup_types[] = {"displacement", "velocity", "force"};

/* Far from a wall and near one. */
static const double plucks[] = {0.07, 0.4};
static const double pickups[] = {0.08, 0.45};
static const uint32_t keys[N_KEYS] = {33, 54, 75, 96};

/* A note, from what it should be [dB]; a bow comes to its speed in the first half second. */
static double off(Host* host, uint32_t key, double length_s) {
  Sound sound = sound_new((size_t)(length_s * RATE));
  strings_restart(host);
  strings_note_on(host, 0, key, VELOCITY);
  strings_run(host, &sound, 0, sound.n_frames, BLOCK);
  const double lufs = loudness_lufs(sound.left, sound.right, sound.n_frames);
  sound_free(&sound);
  return lufs - LOUDNESS - 40.0 * log10(VELOCITY / 127.0);
}

/* How far it is off, in dB, with each key; [1]: of high keys under a bow. */
static void stretch_to_keys(Host* host, int exciter, double worst[2]) {
  for (int k = 0; k < N_KEYS; ++k) {
    const double db = off(host, keys[k], exciter == BOW ? 1.0 : 0.5);
    double* const kind = &worst[exciter == BOW && keys[k] > HIGHEST_BOWED];
    print_message(" %4.1f", db);
    *kind = fmax(*kind, fabs(db));
  }
}

static void every_way_and_place_is_as_loud(void** state) {
  (void)state;
  double worst[2] = {0.0};
  Host* const host = strings_open(RATE, BLOCK);
  strings_set(host, "limiter", 0.0);
  for (int way = 0; way < 9; ++way) {
    strings_set(host, "exciter", way / 3);
    strings_set(host, "sense", way % 3);
    print_message("  %-7s%-13s", exciters[way / 3], pickup_types[way % 3]);
    for (int place = 0; place < 4; ++place) {
      strings_set(host, "pluck", plucks[place / 2]);
      strings_set(host, "pickup", pickups[place % 2]);
      stretch_to_keys(host, way / 3, worst);
      print_message("%s", place < 3 ? " |" : "\n");
    }
  }
  host_free(host);
  assert_within("dB off", worst[0], PROMISED_DB);
  assert_within("dB off, of high keys that are bowed", worst[1], PROMISED_HIGH_DB);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_way_and_place_is_as_loud),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

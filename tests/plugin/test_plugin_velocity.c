/* Harder is never softer: every preset of both plugins gets louder with the velocity, whatever else
 * that changes, on every key. */
#include "tests/support/loudness.h"
#include "tests/support/plugins.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

enum { RATE = PLUGINS_RATE, BLOCK = PLUGINS_BLOCK, N_KEYS = 11, N_VELOCITIES = 6 };
enum { FIRST_KEY = 30, KEY_STEP = 6, KEYS_APART = 4, MIDDLE_KEY = 60 };

static const uint32_t velocities[N_VELOCITIES] = {20, 40, 60, 80, 100, 127};

/* What the ear would have to be told [dB]. */
static const double MOST_DB = 0.1;

/* Loudness of a note from rest [LUFS]; a bow comes to its speed first. */
static double level_of(Host* host, uint32_t key, uint32_t velocity) {
  const bool is_bowed = host_get(host, "exciter") == 2.0f;
  Sound sound = sound_new(is_bowed ? RATE : RATE / 2);
  strings_restart(host);
  strings_note_on(host, 0, key, velocity);
  strings_run(host, &sound, 0, sound.n_frames, BLOCK);
  const double lufs = loudness_lufs(sound.left, sound.right, sound.n_frames);
  sound_free(&sound);
  return lufs;
}

/* Most that the loudness of a key falls by from one velocity to the next [dB]. */
static double fall_of(Host* host, const char* preset, uint32_t key) {
  double before = -HUGE_VAL;
  double most = 0.0;
  for (int v = 0; v < N_VELOCITIES; ++v) {
    const double level = level_of(host, key, velocities[v]);
    const double fall = isinf(before) ? 0.0 : before - level;
    if (fall > MOST_DB) {
      print_message("%s, key %u: %.2f dB softer at velocity %u than at %u\n", preset, key, fall,
                    velocities[v], velocities[v - 1]);
    }
    most = fmax(most, fall);
    before = level;
  }
  return most;
}

/* All keys in a long run, else the middle one and a few others, not the same of each preset. */
static unsigned falls_of(Host* host, uint32_t preset) {
  const char* const label = host_preset_label(host, preset);
  const uint32_t step = getenv("HOOKE_TEST_LONG") ? 1 : KEYS_APART;
  unsigned n_falls = 0;
  assert_true(host_preset(host, host_preset_uri(host, preset)));
  for (uint32_t k = 0; k < N_KEYS; ++k) {
    const uint32_t key = FIRST_KEY + KEY_STEP * k;
    if (k % step == preset % step || key == MIDDLE_KEY) {
      n_falls += fall_of(host, label, key) > MOST_DB;
    }
  }
  return n_falls;
}

static void harder_is_never_softer(void** state) {
  (void)state;
  unsigned n_falls = 0;
  for (int plugin = 0; plugin < N_PLUGINS; ++plugin) {
    Host* const host = plugins_open(plugin);
    for (uint32_t i = 0; i < host_n_presets(host); ++i) {
      n_falls += falls_of(host, i);
    }
    host_free(host);
  }
  assert_int_equal(n_falls, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(harder_is_never_softer),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* What the pickups of a guitar's string read is added up by their gains, frame by frame. */
#include "core/guitar/guitar_string.h"
#include "tests/support/guitars.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { FRAMES = GUITAR_MIX_FRAMES, N_BLOCKS = 8, N = N_BLOCKS * FRAMES };

/* Plucked, and slid to a fret on the way, so that its pickups fade; added to `out`. */
static void play(const GuitarGains gains[N_BLOCKS], float out[N]) {
  static _Alignas(CHAIN_ALIGNMENT) char memory[1 << 16];
  const GuitarPatch patch = guitars_patch();
  GuitarString string;
  assert_true(chain_size(GUITAR_MAX_MASSES) <= sizeof(memory));
  guitar_string_init(&string, &patch, 48e3, 0, memory);
  string.open = 45.0;
  guitar_string_pluck(&string, (Pluck){0.3, 0.5, 0.25, 0.0});
  for (int block = 0; block < N_BLOCKS; ++block) {
    if (block == 2) {
      guitar_string_slide(&string, 5.0, 400);
    }
    guitar_string_run(&string, &gains[block], FRAMES, &out[(size_t)block * FRAMES], NULL);
  }
}

static double gain_at(int pickup, int frame) {
  return pickup ? sin(0.01 * frame) : 0.3 + 1e-4 * frame;
}

/* `unit` −1: by the gains above; else that pickup alone, by 1. */
static void set(GuitarGains gains[N_BLOCKS], int unit) {
  for (int i = 0; i < N; ++i) {
    GuitarGains* const g = &gains[i / FRAMES];
    for (int p = 0; p < GUITAR_PICKUPS; ++p) {
      g->is_read[p] = unit < 0 || unit == p;
      g->gain[p][i % FRAMES] = unit < 0 ? (float)gain_at(p, i) : 1.0f;
    }
  }
}

static void gain_is_that_of_its_frame(void** state) {
  (void)state;
  static GuitarGains gains[N_BLOCKS];
  static float mixed[N];
  static float alone[GUITAR_PICKUPS][N];
  double worst = 0.0;
  for (int p = 0; p < GUITAR_PICKUPS; ++p) {
    set(gains, p);
    play(gains, alone[p]);
    assert_true(measure_peak(alone[p], N) > 0.01);
  }
  set(gains, -1);
  play(gains, mixed);
  for (int i = 0; i < N; ++i) {
    const double wanted = gain_at(0, i) * (double)alone[0][i] + gain_at(1, i) * (double)alone[1][i];
    worst = fmax(worst, fabs((double)mixed[i] - wanted));
  }
  assert_within("off the sum", worst, 1e-7);
}

/* What is read is added to what is there; and a string that nothing reads goes on all the same. */
static void reading_adds_and_does_not_matter_to_the_string(void** state) {
  (void)state;
  static GuitarGains gains[N_BLOCKS];
  static float plain[N];
  static float added[N];
  static float late[N];
  set(gains, 0);
  play(gains, plain);
  for (int i = 0; i < N; ++i) {
    added[i] = 0.5f;
  }
  play(gains, added);
  for (int block = 0; block < N_BLOCKS - 1; ++block) {
    gains[block].is_read[0] = false;
  }
  play(gains, late);
  for (int i = 0; i < N; ++i) {
    assert_true(added[i] == 0.5f + plain[i]);
    assert_true(late[i] == (i < N - FRAMES ? 0.0f : plain[i]));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gain_is_that_of_its_frame),
      cmocka_unit_test(reading_adds_and_does_not_matter_to_the_string),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

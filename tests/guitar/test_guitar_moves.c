/* A string that is moved from pitch to pitch keeps its motion. */
#include "core/guitar/guitar_string.h"

#include "tests/support/guitars.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;
static const double RATE_HZ = 48e3;

enum { GESTURE = 192 };

/* One string, by itself. */
typedef struct {
  GuitarString string;
  GuitarPatch patch;
  GuitarGains gains;
} Solo;

static _Alignas(CHAIN_ALIGNMENT) char memory[1 << 16];

static void solo_start(Solo* solo, double open) {
  *solo = (Solo){.patch = guitars_patch()};
  solo->patch.string.damping_per_s = 1e-3;
  solo->patch.string.loss = 0.0;
  assert_true(chain_size(GUITAR_MAX_MASSES) <= sizeof(memory));
  guitar_string_init(&solo->string, &solo->patch, RATE_HZ, 0, memory);
  solo->string.open = open;
}

static void solo_run(Solo* solo, uint32_t n_frames) {
  float none[GUITAR_MIX_FRAMES];
  while (n_frames > 0) {
    const uint32_t n = n_frames < GUITAR_MIX_FRAMES ? n_frames : GUITAR_MIX_FRAMES;
    guitar_string_run(&solo->string, &solo->gains, n, none, NULL);
    n_frames -= n;
  }
}

/* The fundamental's amplitude. */
static double amplitude_of(const Solo* solo) {
  const Chain* const chain = &solo->string.voice.chain;
  const double length = chain->n_masses + 1.0;
  const double angle = 2.0 * PI * solo->string.voice.f0_hz / RATE_HZ;
  double x = 0.0;
  double u = 0.0;
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    const double shape = 2.0 / length * sin(PI * (i + 1.0) / length);
    x += shape * (double)chain_position(chain, i);
    u += shape * (double)chain_velocity(chain, i);
  }
  return hypot(x, (x - u - x * cos(angle)) / sin(angle));
}

/* How much of its amplitude a move to a fret keeps, at most and at least over many moments: in
 * octaves. */
static double kept(double open, double from, double to, bool is_bent, uint32_t n_frames) {
  double most = 0.0;
  for (uint32_t i = 0; i < 12; ++i) {
    Solo solo;
    solo_start(&solo, open);
    guitar_string_slide(&solo.string, is_bent ? 0.0 : from, 0);
    guitar_string_bend(&solo.string, is_bent ? from : 0.0, 0);
    guitar_string_pluck(&solo.string, (Pluck){0.5, 0.3, 0.25, 0.0});
    solo_run(&solo, 1000 + 53 * i);
    const double before = amplitude_of(&solo);
    if (is_bent) {
      guitar_string_bend(&solo.string, to, n_frames);
    } else {
      guitar_string_slide(&solo.string, to, n_frames);
    }
    solo_run(&solo, n_frames + 3 * GESTURE);
    most = fmax(most, fabs(log2(amplitude_of(&solo) / before)));
  }
  return most;
}

/* A move bends the string's clock: it is as loud after it as before, however fast it was. */
static void moves_keep_the_amplitude(void** state) {
  (void)state;
  static const double ways[][2] = {{0, 1}, {0, 5}, {5, 0}, {0, 12}, {12, 0}, {22, 3}, {3, 22}};
  static const double opens[] = {40.0, 50.0, 64.0};
  double worst = 0.0;
  double worst_slow = 0.0;
  for (int w = 0; w < 7; ++w) {
    for (int s = 0; s < 3; ++s) {
      for (int is_bent = 0; is_bent < 2; ++is_bent) {
        const double quick = kept(opens[s], ways[w][0], ways[w][1], is_bent, GESTURE);
        const double slow = kept(opens[s], ways[w][0], ways[w][1], is_bent, 24000);
        worst = fmax(worst, quick);
        worst_slow = fmax(worst_slow, slow);
      }
    }
  }
  assert_within("amplitude that a gesture gives or takes [octaves]", worst, 0.05);
  assert_within("amplitude that a slow one does [octaves]", worst_slow, 0.02);
}

/* Plucked as it is being fretted, it is in the end as loud as one plucked at the fret. */
static void pluck_in_a_gesture_is_as_loud(void** state) {
  (void)state;
  for (int way = 0; way < 2; ++way) {
    double motion[2];
    for (int is_moving = 0; is_moving < 2; ++is_moving) {
      Solo solo;
      solo_start(&solo, 64.0);
      guitar_string_slide(&solo.string, is_moving == way ? 12.0 : 0.0, 0);
      guitar_string_pluck(&solo.string, (Pluck){0.5, 0.3, 1e-6, 0.0});
      solo_run(&solo, 1000);
      if (is_moving) {
        guitar_string_slide(&solo.string, way ? 0.0 : 12.0, GESTURE);
      }
      guitar_string_pluck(&solo.string, (Pluck){0.5, 0.3, 0.25, 0.0});
      solo_run(&solo, 4 * GESTURE);
      motion[is_moving] = amplitude_of(&solo);
    }
    /* A gesture of one period is not slow; without regard to it this would be half an octave. */
    assert_within("octaves between them", fabs(log2(motion[1] / motion[0])), 0.25);
  }
}

/* Where strings are plucked and read stays, so it is another part of what sounds. */
static void places_stay_when_strings_are_fretted(void** state) {
  (void)state;
  Solo solo;
  solo_start(&solo, 64.0);
  guitar_string_slide(&solo.string, 5.0, 0);
  solo.patch.capo = 7.0;
  assert_within("off twice", fabs(guitar_string_place(&solo.string, 0.2) - 0.4), 1e-12);
  assert_true(guitar_string_place(&solo.string, 0.46) == GUITAR_FARTHEST);
  guitar_string_pluck(&solo.string, (Pluck){0.5, 0.3, 0.25, 0.0});
  assert_within("read off it", fabs(solo.string.pickups.heard[0].place - 0.2), 1e-12);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(moves_keep_the_amplitude),
      cmocka_unit_test(pluck_in_a_gesture_is_as_loud),
      cmocka_unit_test(places_stay_when_strings_are_fretted),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

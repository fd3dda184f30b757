/* The body of the harp: it hears what its strings pull at the bridge, beside what the pickup reads,
 * and does nothing to them. */
#include "core/harp/harp.h"
#include "core/string/pickup.h"

#include "tests/support/harps.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, N_FRAMES = RATE };

static float left[N_FRAMES];
static float right[N_FRAMES];
static float others[2][N_FRAMES];
static float pulled[N_FRAMES];

static HarpPatch patch_with(uint32_t way, BodiesChoice choice, double mix) {
  HarpPatch patch = harps_patch(way);
  patch.spread = 0.0;
  patch.body = (BodyPatch){.choice = choice, .mix = mix, .shape = {1.0, 1.0}};
  return patch;
}

/* Play a key, and keep what is heard. */
static Harp* play(const HarpPatch* patch, uint32_t key, float* l, float* r) {
  Harp* const harp = harps_new(RATE, patch);
  harp_note_on(harp, 0, key, 100);
  harps_run(harp, N_FRAMES, l, r);
  return harp;
}

static double rms_of(const float* samples) {
  double sum = 0.0;
  for (int n = 0; n < N_FRAMES; ++n) {
    sum += (double)samples[n] * (double)samples[n];
  }
  return sqrt(sum / N_FRAMES);
}

static void strings_do_not_know_of_it(void** state) {
  (void)state;
  for (uint32_t way = 0; way < HARPS_N_WAYS; ++way) {
    const HarpPatch plain = patch_with(way, BODIES_NONE, 0.0);
    for (BodiesChoice choice = BODIES_NONE + 1; choice < BODIES_FILE; ++choice) {
      const HarpPatch patch = patch_with(way, choice, 0.5);
      Harp* const without = play(&plain, 57, left, right);
      Harp* const with = play(&patch, 57, left, right);
      const Chain* const a = &without->strings[57].voice.chain;
      const Chain* const b = &with->strings[57].voice.chain;
      if (way / HARPS_N_SENSES != EXCITER_BOW) { /* A bow is tuned by ear. */
        assert_memory_equal(&a->now, &b->now, sizeof(a->now));
      }
      assert_int_equal(a->n_masses, b->n_masses);
      harp_free(without);
      harp_free(with);
    }
  }
}

/* What a piezo at the bridge reads, through the modes of a body one by one: their impulses, summed
 * as they come by convolution. */
static void convolve(const Body* body, float out[2][N_FRAMES]) {
  static double response[2][N_FRAMES];
  memset(response, 0, sizeof(response));
  for (uint32_t k = 0; k < body->n_modes; ++k) {
    const BodyMode* const mode = &body->modes[k];
    Pole pole;
    if (mode->f0_hz >= BODY_HIGHEST * RATE) {
      continue;
    }
    const double tau_s = mode->q / (acos(-1.0) * mode->f0_hz);
    assert_int_equal(pole_solve(RATE, (Tone){mode->f0_hz, tau_s}, &pole), STATUS_OK);
    /* What is heard of a mass that is stepped peaks as high as the body's. */
    const double half = acos(-1.0) * mode->f0_hz / RATE;
    const double heard = half * sqrt(1.0 - pole.g) / tan(half);
    double x = 0.0;
    double u = 0.0;
    for (int n = 0; n < N_FRAMES; ++n) {
      const double before = u;
      u += heard * (n == 0) / mode->mass_kg - pole.a * x - pole.g * u;
      x += u;
      response[0][n] += mode->radiation[0] * (u - before);
      response[1][n] += mode->radiation[1] * (u - before);
    }
  }
  for (int side = 0; side < 2; ++side) {
    for (int n = 0; n < N_FRAMES; n += 97) { /* Some of them: each costs as many products. */
      double sum = 0.0;
      for (int m = 0; m <= n; ++m) {
        sum += response[side][n - m] * (double)pulled[m];
      }
      out[side][n] = (float)sum;
    }
  }
}

static void what_is_heard_is_the_pull_through_its_modes(void** state) {
  (void)state;
  for (BodiesChoice choice = BODIES_NONE + 1; choice < BODIES_FILE; ++choice) {
    const uint32_t key = 40 + 4 * (uint32_t)choice;
    const HarpPatch patch = patch_with(0, choice, 1.0);
    HarpPatch piezo = patch_with(0, BODIES_NONE, 0.0);
    piezo.pickup_type = PICKUP_FORCE;
    Harp* const harp = play(&patch, key, left, right);
    Harp* const reader = play(&piezo, key, pulled, others[1]);
    /* They are played as hard as they are loud. */
    const double harder = (double)chain_position(&harp->strings[key].voice.chain, 3) /
                          (double)chain_position(&reader->strings[key].voice.chain, 3);
    double worst = 0.0;
    convolve(bodies_shipped(choice), others);
    for (int n = 0; n < N_FRAMES; n += 97) {
      worst = fmax(worst, fabs((double)left[n] - harder * (double)others[0][n]));
      worst = fmax(worst, fabs((double)right[n] - harder * (double)others[1][n]));
    }
    assert_true(rms_of(left) > 1e-3);
    assert_within("from the pull", worst / rms_of(left), 2e-4);
    harp_free(harp);
    harp_free(reader);
  }
}

/* The strings' share, and the body's. */
static void mix_goes_from_strings_to_body(void** state) {
  (void)state;
  const HarpPatch alone = patch_with(0, BODIES_GUITAR, 0.0);
  const HarpPatch plain = patch_with(0, BODIES_NONE, 0.7);
  harp_free(play(&plain, 45, others[0], others[1]));
  harp_free(play(&alone, 45, left, right));
  assert_memory_equal(left, others[0], sizeof(left));
  assert_memory_equal(right, others[1], sizeof(right));
  const HarpPatch half = patch_with(0, BODIES_GUITAR, 0.5);
  harp_free(play(&half, 45, left, right));
  assert_true(fabs(rms_of(left) - rms_of(others[0])) > 1e-4);
}

static void gain_of_a_channel_is_the_body_s_as_well(void** state) {
  (void)state;
  const HarpPatch patch = patch_with(0, BODIES_GUITAR, 1.0);
  for (int i = 0; i < 2; ++i) {
    Harp* const harp = harps_new(RATE, &patch);
    harp_set_gain(harp, 3, i == 0 ? 1.0 : 0.25);
    harps_run(harp, RATE / 10, NULL, NULL);
    harp_note_on(harp, 3, 45, 100);
    harps_run(harp, N_FRAMES, i == 0 ? left : others[0], NULL);
    harp_free(harp);
  }
  double worst = 0.0;
  for (int n = 0; n < N_FRAMES; ++n) {
    worst = fmax(worst, fabs(0.25 * (double)left[n] - (double)others[0][n]));
  }
  assert_within("at a quarter of the gain", worst, 1e-6);
}

/* Of the strings, and so of what they pull by. */
static void level_is_the_body_s_as_well(void** state) {
  (void)state;
  HarpPatch patch = patch_with(0, BODIES_GUITAR, 1.0);
  patch.body.knock = 0.5;
  harp_free(play(&patch, 45, left, right));
  patch.level = 0.25;
  harp_free(play(&patch, 45, others[0], others[1]));
  double worst = 0.0;
  for (int n = 0; n < N_FRAMES; ++n) {
    worst = fmax(worst, fabs(0.25 * (double)left[n] - (double)others[0][n]));
  }
  assert_within("at a quarter of the level", worst, 1e-6);
}

/* What a pluck makes step is hidden from the body, whatever becomes of the pickup meanwhile. */
static void body_does_not_know_of_the_pickup(void** state) {
  (void)state;
  for (int i = 0; i < 2; ++i) {
    HarpPatch patch = patch_with(0, BODIES_GUITAR, 1.0);
    Harp* const harp = harps_new(RATE, &patch);
    float* const l = i == 0 ? left : others[0];
    harp_note_on(harp, 0, 45, 100);
    harp_run(harp, 10, l, right);
    patch.pickup_type = i == 0 ? patch.pickup_type : PICKUP_VELOCITY;
    harp_set_patch(harp, &patch, 500);
    harps_run(harp, N_FRAMES - 10, l + 10, NULL);
    harp_free(harp);
  }
  double worst = 0.0;
  for (int n = 0; n < N_FRAMES; ++n) {
    worst = fmax(worst, fabs((double)left[n] - (double)others[0][n]));
  }
  assert_within("with another pickup", worst, 1e-6);
}

/* Only what plucks or strikes knocks, and what it adds is the same whatever the string. */
static void knock_is_beside_the_string(void** state) {
  (void)state;
  for (int bow = 0; bow < 2; ++bow) {
    HarpPatch patch = patch_with(bow ? 2 * HARPS_N_SENSES : 0, BODIES_GUITAR, 1.0);
    static float added[2][N_FRAMES];
    for (int i = 0; i < 2; ++i) {
      patch.body.knock = 0.0;
      harp_free(play(&patch, 45 + 24 * (uint32_t)i, left, right));
      patch.body.knock = 1.0;
      harp_free(play(&patch, 45 + 24 * (uint32_t)i, others[0], others[1]));
      for (int n = 0; n < N_FRAMES; ++n) {
        added[i][n] = others[0][n] - left[n];
      }
    }
    double worst = 0.0;
    for (int n = 0; n < N_FRAMES; ++n) {
      worst = fmax(worst, fabs((double)added[0][n] - (double)added[1][n]));
    }
    assert_within("from one key to another", worst, 1e-6);
    assert_true(bow ? rms_of(added[0]) == 0.0 : rms_of(added[0]) > 1e-4);
  }
}

/* Gestures and changes of the body among them, in calls of any length. */
static void run_in_pieces(uint32_t piece, float* l, float* r) {
  HarpPatch patch = patch_with(0, BODIES_GUITAR, 0.7);
  patch.body.knock = 0.5;
  Harp* const harp = harps_new(RATE, &patch);
  harp_note_on(harp, 0, 45, 100);
  for (uint32_t done = 0; done < N_FRAMES;) {
    const uint32_t until = 1000 - done % 1000;
    const uint32_t n = piece < until ? piece : until;
    if (until == 1000) {
      patch.body.choice = (BodiesChoice)(done / 1000 % BODIES_FILE);
      patch.resonance = done / 1000 % 3 == 2 ? 0.5 : 0.0;
      patch.pickup = 0.1 + 0.01 * (double)(done / 1000);
      harp_set_patch(harp, &patch, 500);
      harp_note_on(harp, 0, 40 + done / 1000, 90);
    }
    harp_run(harp, n, l + done, r + done);
    done += n;
  }
  harp_free(harp);
}

static void calls_do_not_change_the_sound(void** state) {
  static const uint32_t pieces[] = {1, 7, 64};
  (void)state;
  run_in_pieces(1000, left, right);
  for (int i = 0; i < 3; ++i) {
    run_in_pieces(pieces[i], others[0], others[1]);
    assert_memory_equal(others[0], left, sizeof(left));
    assert_memory_equal(others[1], right, sizeof(right));
  }
}

/* All that was is forgotten. */
static void reset_is_as_new(void** state) {
  (void)state;
  HarpPatch patch = patch_with(0, BODIES_GUITAR, 1.0);
  patch.body.knock = 1.0;
  patch.resonance = 0.5;
  Harp* const harp = play(&patch, 45, left, right);
  harp_reset(harp);
  harp_note_on(harp, 0, 45, 100);
  harps_run(harp, N_FRAMES, others[0], others[1]);
  assert_memory_equal(others[0], left, sizeof(left));
  assert_memory_equal(others[1], right, sizeof(right));
  harp_free(harp);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(strings_do_not_know_of_it),
      cmocka_unit_test(what_is_heard_is_the_pull_through_its_modes),
      cmocka_unit_test(mix_goes_from_strings_to_body),
      cmocka_unit_test(gain_of_a_channel_is_the_body_s_as_well),
      cmocka_unit_test(level_is_the_body_s_as_well),
      cmocka_unit_test(body_does_not_know_of_the_pickup),
      cmocka_unit_test(knock_is_beside_the_string),
      cmocka_unit_test(calls_do_not_change_the_sound),
      cmocka_unit_test(reset_is_as_new),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

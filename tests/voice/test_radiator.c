/* A body is heard as its bank is, beside the strings, however it is changed and cut into calls. */
#include "core/voice/radiator.h"

#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { N_FRAMES = 24000, RATE = 48000 };

static float pull[N_FRAMES];
static float strings[N_FRAMES];
static float sides[2][N_FRAMES];
static float again[2][N_FRAMES];
static Radiator radiator;

/* What happens at a frame. */
typedef void (*Event)(uint32_t frame);

static void nothing(uint32_t frame) {
  (void)frame;
}

static void draw(void) {
  Random random = random_start();
  for (int n = 0; n < N_FRAMES; ++n) {
    pull[n] = (float)random_between(&random, -0.5, 0.5);
    strings[n] = (float)random_between(&random, -0.5, 0.5);
  }
}

static BodyPatch patch_of(BodiesChoice choice, double mix) {
  return (BodyPatch){.choice = choice, .mix = mix, .shape = {1.0, 1.0}};
}

static void begin(BodyPatch patch) {
  radiator_init(&radiator);
  radiator_set(&radiator, &patch, RATE, 0);
}

/* Events come at multiples of 1,000 frames, which no call goes beyond. */
static void run(uint32_t piece, Event event, float out[2][N_FRAMES]) {
  memcpy(out[0], strings, sizeof(strings));
  memcpy(out[1], strings, sizeof(strings));
  for (uint32_t done = 0; done < N_FRAMES;) {
    const uint32_t until = 1000 - done % 1000;
    uint32_t n = piece < until ? piece : until;
    if (until == 1000) {
      event(done);
    }
    const uint32_t stretch = radiator_stretch(&radiator);
    n = n < stretch ? n : stretch;
    radiator_run(&radiator, pull + done, n, out[0] + done, out[1] + done);
    done += n;
  }
}

/* What a bank makes of what is pulled. */
static void hear(BodiesChoice choice, BodyShape shape, const float* force, float out[2][N_FRAMES]) {
  static Bank bank;
  memset(out, 0, 2 * sizeof(out[0]));
  body_bank(bodies_shipped(choice), shape, RATE, &bank);
  bank_run(&bank, force, N_FRAMES, out[0], out[1]);
}

static double
worst_of(float a[2][N_FRAMES], float b[2][N_FRAMES], double gain_a, double gain_b, uint32_t from) {
  double worst = 0.0;
  for (uint32_t n = from; n < N_FRAMES; ++n) {
    for (int side = 0; side < 2; ++side) {
      const double sum =
          gain_a * (double)strings[n] + gain_b * (double)b[side][n] - (double)a[side][n];
      worst = fmax(worst, fabs(sum));
    }
  }
  return worst;
}

static void without_a_body_all_is_as_it_was(void** state) {
  (void)state;
  draw();
  begin(patch_of(BODIES_NONE, 1.0));
  run(256, nothing, sides);
  assert_memory_equal(sides[0], strings, sizeof(strings));
  assert_memory_equal(sides[1], strings, sizeof(strings));
}

static void body_and_strings_share_the_power(void** state) {
  (void)state;
  draw();
  for (int i = 0; i <= 4; ++i) {
    const double mix = 0.25 * i;
    begin(patch_of(BODIES_GUITAR, mix));
    run(256, nothing, sides);
    hear(BODIES_GUITAR, (BodyShape){1.0, 1.0}, pull, again);
    assert_within("strings and body", worst_of(sides, again, sqrt(1.0 - mix), sqrt(mix), 0), 1e-6);
  }
}

static void shapes_are_heard(void** state) {
  (void)state;
  draw();
  BodyPatch patch = patch_of(BODIES_GUITAR, 1.0);
  patch.shape = (BodyShape){1.7, 0.4};
  begin(patch);
  run(256, nothing, sides);
  hear(BODIES_GUITAR, patch.shape, pull, again);
  assert_within("a large body", worst_of(sides, again, 0.0, 1.0, 0), 1e-6);
}

static void change(uint32_t frame) {
  const BodyPatch patch = patch_of(BODIES_VIOLIN, 1.0);
  if (frame == 12000) {
    radiator_set(&radiator, &patch, RATE, 192);
  }
}

/* Another body has heard nothing of what was before, and is heard alone once the fade is over. */
static void another_body_fades_in(void** state) {
  (void)state;
  static float before[2][N_FRAMES];
  const int n_fade = 1440;
  double worst = 0.0;
  draw();
  begin(patch_of(BODIES_GUITAR, 1.0));
  run(100, change, sides);
  hear(BODIES_GUITAR, (BodyShape){1.0, 1.0}, pull, before);
  memset(pull, 0, 12000 * sizeof(float));
  hear(BODIES_VIOLIN, (BodyShape){1.0, 1.0}, pull, again);
  for (int n = 0; n < N_FRAMES; ++n) {
    const double share = fmin(fmax((n - 11999) / (double)n_fade, 0.0), 1.0);
    for (int side = 0; side < 2; ++side) {
      const double sum = (1.0 - share) * (double)before[side][n] + share * (double)again[side][n];
      worst = fmax(worst, fabs(sum - (double)sides[side][n]));
    }
  }
  assert_within("from one to the other", worst, 1e-6);
}

/* All that can happen, each at a place of its own. */
static void meddle(uint32_t frame) {
  BodyPatch patch = patch_of((BodiesChoice)(frame / 1000 % BODIES_FILE), 0.1 * (frame / 1000 % 11));
  patch.shape.size = 0.5 + 0.1 * (frame / 1000 % 9);
  if (frame >= 15000 && frame < 20000) { /* It comes to rest while nothing pulls. */
    patch = patch_of(BODIES_HARP, 0.5);
    patch.shape.damping = 200.0;
  }
  radiator_set(&radiator, &patch, RATE, frame % 3000 == 0 ? 600 : 5000);
  for (uint32_t i = 0; i < frame / 3000; ++i) {
    radiator_knock(&radiator, 0.3, 100 + 30 * i);
  }
}

static void calls_do_not_change_the_sound(void** state) {
  static const uint32_t pieces[] = {1, 7, 64, 100};
  (void)state;
  draw();
  memset(pull + 15000, 0, 5000 * sizeof(float));
  begin(patch_of(BODIES_GUITAR, 0.5));
  run(256, meddle, sides);
  for (int i = 0; i < 4; ++i) {
    begin(patch_of(BODIES_GUITAR, 0.5));
    run(pieces[i], meddle, again);
    assert_memory_equal(again, sides, sizeof(sides));
  }
}

static void knock_now(uint32_t frame) {
  if (frame == 1000) {
    radiator_knock(&radiator, 0.25, 99);
  }
}

static void knock_is_a_raised_cosine(void** state) {
  const double pi = acos(-1.0);
  (void)state;
  memset(pull, 0, sizeof(pull));
  memset(strings, 0, sizeof(strings));
  begin(patch_of(BODIES_GUITAR, 1.0));
  run(256, knock_now, sides);
  for (int n = 1; n < 100; ++n) {
    pull[999 + n] = (float)(0.125 * (1.0 - cos(2.0 * pi * n / 100.0)));
  }
  hear(BODIES_GUITAR, (BodyShape){1.0, 1.0}, pull, again);
  assert_within("knock", worst_of(sides, again, 0.0, 1.0, 0), 1e-6);
}

static void what_has_died_away_costs_nothing(void** state) {
  (void)state;
  draw();
  memset(strings, 0, sizeof(strings));
  for (BodiesChoice choice = BODIES_NONE + 1; choice < BODIES_FILE; ++choice) {
    begin(patch_of(choice, 1.0));
    run(256, nothing, sides);
    assert_true(radiator.is_awake[0]);
    for (int second = 0; second < 40 && radiator.is_awake[0]; ++second) {
      static float none[RATE];
      static float heard[2][RATE];
      memset(heard, 0, sizeof(heard));
      for (int n = 0; n < RATE; n += 240) {
        radiator_run(&radiator, none, 240, heard[0] + n, heard[1] + n);
      }
    }
    assert_false(radiator.is_awake[0]);
    assert_true(bank_level(&radiator.banks[0]) == 0.0);
  }
}

/* As nobody pulls, in a moment. */
static double still_after(uint32_t n_frames) {
  static float none[256];
  static float heard[2][256];
  const BodyPatch patch = patch_of(BODIES_GUITAR, 1.0);
  double peak = 0.0;
  for (uint32_t done = 0; done < n_frames; done += 256) {
    memset(heard, 0, sizeof(heard));
    radiator_set(&radiator, &patch, RATE, 192);
    radiator_run(&radiator, none, 256, heard[0], heard[1]);
    peak = 0.0;
    for (int n = 0; n < 256; ++n) {
      peak = fmax(peak, fmax(fabs((double)heard[0][n]), fabs((double)heard[1][n])));
    }
  }
  return peak;
}

/* And rings as ever when it is played again. */
static void a_hand_silences_it(void** state) {
  (void)state;
  draw();
  memset(strings, 0, sizeof(strings));
  begin(patch_of(BODIES_GUITAR, 1.0));
  run(256, nothing, sides);
  const double open = still_after(RATE / 10);
  begin(patch_of(BODIES_GUITAR, 1.0));
  run(256, nothing, sides);
  radiator_choke(&radiator);
  const double choked = still_after(RATE / 10);
  print_message("  %g, choked %g\n", open, choked);
  assert_true(open > 1e-3 && choked < 1e-3 * open);
  assert_true(still_after(RATE) == 0.0);
  radiator_play(&radiator, RATE, 1.0, 0.0);
  assert_true(still_after(256) == 0.0 && radiator.fade.n_left == 0);
  run(256, nothing, sides);
  hear(BODIES_GUITAR, (BodyShape){1.0, 1.0}, pull, again);
  assert_within("after it", worst_of(sides, again, 0.0, 1.0, 0), 1e-6);
}

/* There is nothing to fade from. */
static void what_is_at_rest_changes_at_once(void** state) {
  const BodyPatch patch = patch_of(BODIES_VIOLIN, 1.0);
  (void)state;
  draw();
  begin(patch_of(BODIES_GUITAR, 1.0));
  radiator_set(&radiator, &patch, RATE, 192);
  run(256, nothing, sides);
  hear(BODIES_VIOLIN, (BodyShape){1.0, 1.0}, pull, again);
  assert_within("another body", worst_of(sides, again, 0.0, 1.0, 0), 1e-6);
}

static void file_is_heard_when_it_comes_and_when_it_goes(void** state) {
  BodyPatch patch = patch_of(BODIES_FILE, 1.0);
  (void)state;
  draw();
  begin(patch);
  assert_false(radiator_is_on(&radiator));
  for (int i = 0; i < 3; ++i) {
    const Body* const body = bodies_shipped(i % 2 ? BODIES_GUITAR : BODIES_HARP);
    radiator_take_file(&radiator, body);
    radiator_set(&radiator, &patch, RATE, 0);
    assert_true(radiator_is_on(&radiator));
    assert_int_equal(radiator.banks[0].n_added, body->n_modes);
  }
  radiator_take_file(&radiator, NULL);
  radiator_set(&radiator, &patch, RATE, 0);
  assert_false(radiator_is_on(&radiator));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(without_a_body_all_is_as_it_was),
      cmocka_unit_test(body_and_strings_share_the_power),
      cmocka_unit_test(shapes_are_heard),
      cmocka_unit_test(another_body_fades_in),
      cmocka_unit_test(calls_do_not_change_the_sound),
      cmocka_unit_test(knock_is_a_raised_cosine),
      cmocka_unit_test(what_has_died_away_costs_nothing),
      cmocka_unit_test(a_hand_silences_it),
      cmocka_unit_test(what_is_at_rest_changes_at_once),
      cmocka_unit_test(file_is_heard_when_it_comes_and_when_it_goes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

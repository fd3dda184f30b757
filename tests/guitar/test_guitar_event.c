#include "core/guitar/guitar_event.h"

#include "tests/support/guitars.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { FRAMES = 3000, N_SAID = 3 };

/* Both sides of a run. */
typedef struct {
  float left[FRAMES];
  float right[FRAMES];
} Sound;

static const float NONE = NAN;
static const float EVER = INFINITY;

/* The same by calling. */
static void call(Guitar* guitar, const GuitarEvent* e) {
  const double a = (double)e->value[0];
  const double b = (double)e->value[1];
  const double c = (double)e->value[2];
  void (*const one[GUITAR_N_VERBS])(Guitar*, uint32_t, double) = {
      [GUITAR_FRET] = guitar_fret, [GUITAR_DAMP] = guitar_damp};
  void (*const two[GUITAR_N_VERBS])(Guitar*, uint32_t, double,
                                    double) = {[GUITAR_HAMMER] = guitar_hammer,
                                               [GUITAR_SLIDE] = guitar_slide,
                                               [GUITAR_BEND] = guitar_bend,
                                               [GUITAR_VIBRATO] = guitar_vibrato,
                                               [GUITAR_TOUCH] = guitar_touch};
  if (one[e->verb]) {
    one[e->verb](guitar, e->string, a);
  } else if (two[e->verb]) {
    two[e->verb](guitar, e->string, a, b);
  } else if (e->verb == GUITAR_PLUCK) {
    guitar_pluck(guitar, e->string, (GuitarPluck){.force = a, .place = b, .hardness = c});
  } else if (e->verb == GUITAR_LET_RING) {
    guitar_let_ring(guitar, e->string);
  } else {
    guitar_palm(guitar, a);
  }
}

static const GuitarEvent valid[] = {
    {GUITAR_PLUCK, 0, {1.0f, 0.3f, 0.7f}},    {GUITAR_PLUCK, 5, {-1.0f, NAN, NAN}},
    {GUITAR_PLUCK, 2, {0.25f, 0.0f, NAN}},    {GUITAR_PLUCK, 2, {0.25f, NAN, 1.0f}},
    {GUITAR_PLUCK, 7, {1.0f, 1.0f, 0.0f}},    {GUITAR_FRET, 2, {7.0f, 0.0f, 0.0f}},
    {GUITAR_FRET, 2, {-48.0f, 0.0f, 0.0f}},   {GUITAR_FRET, 3, {48.0f, 0.0f, 0.0f}},
    {GUITAR_HAMMER, 2, {5.0f, 0.8f, 0.0f}},   {GUITAR_HAMMER, 4, {3.0f, 1.0f, 0.0f}},
    {GUITAR_SLIDE, 2, {12.0f, 0.02f, 0.0f}},  {GUITAR_SLIDE, 2, {12.0f, INFINITY, 0.0f}},
    {GUITAR_BEND, 2, {-2.0f, 0.01f, 0.0f}},   {GUITAR_BEND, 2, {48.0f, 0.0f, 0.0f}},
    {GUITAR_VIBRATO, 2, {0.5f, 6.0f, 0.0f}},  {GUITAR_VIBRATO, 2, {12.0f, 50.0f, 0.0f}},
    {GUITAR_DAMP, 2, {0.01f, 0.0f, 0.0f}},    {GUITAR_DAMP, 3, {INFINITY, 0.0f, 0.0f}},
    {GUITAR_LET_RING, 2, {0.0f, 0.0f, 0.0f}}, {GUITAR_TOUCH, 2, {0.5f, 0.02f, 0.0f}},
    {GUITAR_TOUCH, 2, {0.9f, 0.0f, 0.0f}},    {GUITAR_PALM, 0, {0.7f, 0.0f, 0.0f}},
    {GUITAR_PALM, 7, {1.0f, 0.0f, 0.0f}},
};

/* At the ends of their ranges; they need not be heard. */
static const GuitarEvent extreme[] = {
    {GUITAR_PLUCK, 0, {0.0f, 1.0f, 1.0f}},
    {GUITAR_PLUCK, 0, {-1.0f, 0.0f, 0.0f}},
    {GUITAR_FRET, 0, {48.0f}},
    {GUITAR_FRET, 0, {-48.0f}},
    {GUITAR_HAMMER, 0, {48.0f, 0.0f}},
    {GUITAR_HAMMER, 0, {-48.0f, 1.0f}},
    {GUITAR_SLIDE, 0, {48.0f, 0.0f}},
    {GUITAR_SLIDE, 0, {-48.0f, INFINITY}},
    {GUITAR_BEND, 0, {48.0f, 0.0f}},
    {GUITAR_BEND, 0, {-48.0f, INFINITY}},
    {GUITAR_VIBRATO, 0, {0.0f, 0.0f}},
    {GUITAR_VIBRATO, 0, {12.0f, 50.0f}},
    {GUITAR_DAMP, 0, {0.0f}},
    {GUITAR_DAMP, 0, {INFINITY}},
    {GUITAR_TOUCH, 0, {0.0f, 0.0f}},
    {GUITAR_TOUCH, 0, {1.0f, INFINITY}},
    {GUITAR_PALM, 0, {0.0f}},
    {GUITAR_PALM, 0, {1.0f}},
};

static const GuitarEvent invalid[] = {
    {GUITAR_N_VERBS, 2, {0}},
    {UINT32_MAX, 2, {0}},
    {GUITAR_PLUCK, 8, {1.0f, NAN, NAN}},
    {GUITAR_PALM, 8, {1.0f}},
    {GUITAR_LET_RING, UINT32_MAX, {0}},
    {GUITAR_PLUCK, 2, {1.01f, NAN, NAN}},
    {GUITAR_PLUCK, 2, {-1.01f, NAN, NAN}},
    {GUITAR_PLUCK, 2, {NAN, NAN, NAN}},
    {GUITAR_PLUCK, 2, {1.0f, -0.01f, NAN}},
    {GUITAR_PLUCK, 2, {1.0f, 1.01f, NAN}},
    {GUITAR_PLUCK, 2, {1.0f, NAN, -0.01f}},
    {GUITAR_PLUCK, 2, {1.0f, NAN, 1.01f}},
    {GUITAR_PLUCK, 2, {1.0f, INFINITY, NAN}},
    {GUITAR_FRET, 2, {-48.1f}},
    {GUITAR_FRET, 2, {48.1f}},
    {GUITAR_FRET, 2, {NAN}},
    {GUITAR_HAMMER, 2, {48.1f, 0.5f}},
    {GUITAR_HAMMER, 2, {-48.1f, 0.5f}},
    {GUITAR_HAMMER, 2, {NAN, 0.5f}},
    {GUITAR_HAMMER, 2, {5.0f, -0.01f}},
    {GUITAR_HAMMER, 2, {5.0f, 1.01f}},
    {GUITAR_HAMMER, 2, {5.0f, NAN}},
    {GUITAR_SLIDE, 2, {48.1f, 0.1f}},
    {GUITAR_SLIDE, 2, {-48.1f, 0.1f}},
    {GUITAR_SLIDE, 2, {NAN, 0.1f}},
    {GUITAR_SLIDE, 2, {5.0f, -0.1f}},
    {GUITAR_SLIDE, 2, {5.0f, NAN}},
    {GUITAR_BEND, 2, {48.1f, 0.1f}},
    {GUITAR_BEND, 2, {-48.1f, 0.1f}},
    {GUITAR_BEND, 2, {INFINITY, 0.1f}},
    {GUITAR_BEND, 2, {NAN, 0.1f}},
    {GUITAR_BEND, 2, {1.0f, -0.1f}},
    {GUITAR_BEND, 2, {1.0f, NAN}},
    {GUITAR_VIBRATO, 2, {-0.1f, 5.0f}},
    {GUITAR_VIBRATO, 2, {12.1f, 5.0f}},
    {GUITAR_VIBRATO, 2, {NAN, 5.0f}},
    {GUITAR_VIBRATO, 2, {0.5f, -0.1f}},
    {GUITAR_VIBRATO, 2, {0.5f, 50.1f}},
    {GUITAR_VIBRATO, 2, {0.5f, NAN}},
    {GUITAR_DAMP, 2, {-0.1f}},
    {GUITAR_DAMP, 2, {NAN}},
    {GUITAR_TOUCH, 2, {-0.01f, 0.1f}},
    {GUITAR_TOUCH, 2, {1.01f, 0.1f}},
    {GUITAR_TOUCH, 2, {NAN, 0.1f}},
    {GUITAR_TOUCH, 2, {0.5f, -0.1f}},
    {GUITAR_TOUCH, 2, {0.5f, NAN}},
    {GUITAR_PALM, 2, {-0.01f}},
    {GUITAR_PALM, 2, {1.01f}},
    {GUITAR_PALM, 2, {NAN}},
};

enum {
  N_VALID = sizeof(valid) / sizeof(valid[0]),
  N_INVALID = sizeof(invalid) / sizeof(invalid[0])
};

static Guitar* ringing_guitar(void) {
  GuitarPatch patch = guitars_patch();
  patch.n_strings = GUITAR_STRINGS;
  patch.open[6] = 35.0;
  patch.open[7] = 28.0;
  patch.width = 1.0;
  Guitar* const guitar = guitars_new(48e3, &patch);
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    guitars_pluck(guitar, s, 0.5);
  }
  guitars_run(guitar, 500, NULL);
  return guitar;
}

/* What it sounds like after `event`, if there is one, sent or called. */
static void play(const GuitarEvent* event, bool is_called, Sound* sound) {
  Guitar* const guitar = ringing_guitar();
  guitar_damp(guitar, 2, HUGE_VAL);
  guitars_run(guitar, 500, NULL);
  if (event && is_called) {
    call(guitar, event);
  } else if (event) {
    assert_true(guitar_event_play(guitar, event));
  }
  guitar_run(guitar, FRAMES, sound->left, sound->right);
  guitar_free(guitar);
}

static void event_is_its_call(void** state) {
  (void)state;
  static Sound none;
  static Sound sent;
  static Sound called;
  play(NULL, false, &none);
  for (size_t i = 0; i < N_VALID; ++i) {
    play(&valid[i], false, &sent);
    play(&valid[i], true, &called);
    assert_memory_equal(&sent, &called, sizeof(sent));
    if (memcmp(&sent, &none, sizeof(sent)) == 0) {
      fail_msg("event %zu of verb %u is not heard", i, valid[i].verb);
    }
  }
}

static void every_verb_is_tried(void** state) {
  (void)state;
  bool is_tried[GUITAR_N_VERBS] = {false};
  for (size_t i = 0; i < N_VALID; ++i) {
    is_tried[valid[i].verb] = true;
  }
  for (uint32_t verb = 0; verb < GUITAR_N_VERBS; ++verb) {
    assert_true(is_tried[verb]);
  }
}

static void what_is_out_of_range_is_refused_and_does_nothing(void** state) {
  (void)state;
  static Sound none;
  static Sound after;
  Guitar* guitar = ringing_guitar();
  guitar_run(guitar, FRAMES, none.left, none.right);
  guitar_free(guitar);
  guitar = ringing_guitar();
  for (size_t i = 0; i < N_INVALID; ++i) {
    if (guitar_event_play(guitar, &invalid[i])) {
      fail_msg("event %zu of verb %u was played", i, invalid[i].verb);
    }
  }
  guitar_run(guitar, FRAMES, after.left, after.right);
  guitar_free(guitar);
  assert_memory_equal(&none, &after, sizeof(none));
}

static void ends_of_ranges_are_played(void** state) {
  (void)state;
  Guitar* const guitar = ringing_guitar();
  for (size_t i = 0; i < sizeof(extreme) / sizeof(extreme[0]); ++i) {
    assert_true(guitar_event_play(guitar, &extreme[i]));
  }
  guitar_free(guitar);
}

/* What it does not use may be anything. */
static void values_without_a_meaning_do_not_matter(void** state) {
  (void)state;
#define USED(verb, a, b, c) {a[0] != '\0', b[0] != '\0', c[0] != '\0'},
  static const bool is_used[GUITAR_N_VERBS][N_SAID] = {GUITAR_VERBS(USED)};
#undef USED
  static Sound clean;
  static Sound full;
  const float junk[] = {NONE, EVER, -EVER, 1e30f};
  for (size_t i = 0; i < N_VALID; ++i) {
    GuitarEvent event = valid[i];
    play(&event, false, &clean);
    for (int v = 0; v < N_SAID; ++v) {
      event.value[v] = is_used[event.verb][v] ? event.value[v] : junk[i % 4];
    }
    play(&event, false, &full);
    assert_memory_equal(&clean, &full, sizeof(clean));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(event_is_its_call),
      cmocka_unit_test(every_verb_is_tried),
      cmocka_unit_test(ends_of_ranges_are_played),
      cmocka_unit_test(what_is_out_of_range_is_refused_and_does_nothing),
      cmocka_unit_test(values_without_a_meaning_do_not_matter),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Whatever hands do to a string that rings, nothing clicks. */
#include "core/guitar/guitar.h"

#include "tests/support/guitars.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>

static const double RATE_HZ = 48e3;

enum { FRAMES = 4800, BEFORE = 2400, GESTURE = 192, SLIDE = 2400, N_STARTS = 5, START_STEP = 37 };

/* What makes a click: the largest step from sample to sample, and the largest change of it. */
typedef struct {
  double step, turn;
} Edge;

/* How a string is held, and what its guitar is. */
typedef struct {
  GuitarPatch patch;
  double fret, bend;
  bool is_damped;
  double palm;
} Hold;

typedef enum {
  DO_HAMMER,
  DO_PULL,
  DO_FRET,
  DO_LIFT,
  DO_SLIDE,
  DO_BEND,
  DO_BEND_DOWN,
  DO_OPEN,
  DO_CAPO,
  DO_DAMP,
  DO_LET_RING,
  DO_PALM,
  DO_PICKUP,
  DO_BLEND,
  DO_LEVEL,
  N_DEEDS
} Deed;

static const char* const names[N_DEEDS] = {"hammer",  "pull-off",  "fret",      "lift",  "slide",
                                           "bend up", "bend down", "open note", "capo",  "damp",
                                           "ring",    "the palm",  "pickup",    "blend", "level"};

static Edge edge_of(const float* sound, uint32_t n) {
  Edge edge = {0};
  for (uint32_t i = 2; i < n; ++i) {
    const double step = (double)sound[i] - (double)sound[i - 1];
    const double last = (double)sound[i - 1] - (double)sound[i - 2];
    edge.step = fmax(edge.step, fabs(step));
    edge.turn = fmax(edge.turn, fabs(step - last));
  }
  return edge;
}

/* How it is held before and after. */
static void holds_of(Deed deed, uint32_t string, const GuitarPatch* patch, Hold* from, Hold* to) {
  *from = (Hold){.patch = *patch};
  from->fret = deed == DO_PULL || deed == DO_LIFT ? 7.0 : 0.0;
  from->is_damped = deed == DO_LET_RING;
  *to = *from;
  to->is_damped = deed == DO_DAMP;
  to->fret = deed == DO_HAMMER || deed == DO_FRET ? 7.0 : deed == DO_SLIDE ? 12.0 : 0.0;
  to->bend = deed == DO_BEND ? 24.0 : deed == DO_BEND_DOWN ? -24.0 : 0.0;
  to->palm = deed == DO_PALM ? 1.0 : 0.0;
  to->patch.open[string] += deed == DO_OPEN ? 5.0 : 0.0;
  to->patch.capo = deed == DO_CAPO ? 5.0 : 0.0;
  to->patch.level = deed == DO_LEVEL ? 0.1 : 1.0;
  if (deed == DO_PICKUP) {
    to->patch.pickups[0].place = to->patch.pickups[1].place = 0.45;
  }
  if (deed == DO_BLEND) {
    to->patch.pickups[0].gain = from->patch.pickups[1].gain;
    to->patch.pickups[1].gain = from->patch.pickups[0].gain;
  }
}

static void take(Guitar* guitar, uint32_t string, const Hold* hold) {
  guitar_reset(guitar);
  guitar_set_patch(guitar, &hold->patch, 0);
  guitar_fret(guitar, string, hold->fret);
  guitar_bend(guitar, string, hold->bend, 0.0);
  guitar_palm(guitar, hold->palm);
}

static void act(Guitar* guitar, uint32_t string, Deed deed, const Hold* to) {
  if (deed == DO_HAMMER || deed == DO_PULL) {
    guitar_hammer(guitar, string, to->fret, 1.0);
  } else if (deed == DO_FRET || deed == DO_LIFT) {
    guitar_fret(guitar, string, to->fret);
  } else if (deed == DO_SLIDE) {
    guitar_slide(guitar, string, to->fret, SLIDE / RATE_HZ);
  } else if (deed == DO_BEND || deed == DO_BEND_DOWN) {
    guitar_bend(guitar, string, to->bend, 0.0);
  } else if (deed == DO_DAMP) {
    guitar_damp(guitar, string, HUGE_VAL);
  } else if (deed == DO_LET_RING) {
    guitar_let_ring(guitar, string);
  } else if (deed == DO_PALM) {
    guitar_palm(guitar, to->palm);
  } else {
    guitar_set_patch(guitar, &to->patch, GESTURE);
  }
}

static Edge larger(Edge a, Edge b) {
  return (Edge){fmax(a.step, b.step), fmax(a.turn, b.turn)};
}

/* The edges that a hardest pluck makes on a string that is held so. */
static Edge edge_of_pluck(Guitar* guitar, uint32_t string, const Hold* hold) {
  static float sound[FRAMES];
  take(guitar, string, hold);
  guitars_pluck(guitar, string, 1.0);
  guitars_run(guitar, FRAMES, sound);
  return edge_of(sound, FRAMES);
}

/* A soft pluck, so that clicks are heard; no softer than a hammer-on. */
static GuitarPatch patch_of(Deed deed, bool is_first_read) {
  GuitarPatch patch = guitars_patch();
  patch.pickups[0].gain = is_first_read ? 1.0 : 0.0;
  patch.pickups[1].gain = is_first_read ? 0.0 : 1.0;
  patch.hardness = deed == DO_HAMMER || deed == DO_PULL ? 0.4 : 0.2;
  return patch;
}

/* How a string is held, and what is done to it where. */
typedef struct {
  Deed deed;
  uint32_t string;
  bool is_first_read;
  uint32_t at;
  double click; /* Added to all that is heard after */
} Case;

/*
  The edges in a string that rings of its hardest pluck and is handled, over what they may be: those
  of a hardest pluck before or after, or of one after it at the same part of what sounds, or of what
  goes on to ring after it; and the corner of a straight line of a gesture from peak to peak.
*/
static Edge edge_of_deed(Guitar* guitar, const Case* c) {
  static float sound[BEFORE + 2 * FRAMES];
  const GuitarPatch patch = patch_of(c->deed, c->is_first_read);
  Hold from;
  Hold to;
  holds_of(c->deed, c->string, &patch, &from, &to);
  take(guitar, c->string, &from);
  guitars_pluck(guitar, c->string, 1.0);
  guitars_run(guitar, c->at, sound);
  if (from.is_damped) {
    guitar_damp(guitar, c->string, HUGE_VAL);
    guitars_run(guitar, 2 * GESTURE, sound);
  }
  guitars_run(guitar, 2, sound);
  act(guitar, c->string, c->deed, &to);
  guitars_run(guitar, FRAMES, sound + 2);
  for (uint32_t i = 2; i < FRAMES + 2; ++i) {
    sound[i] += (float)c->click;
  }
  const uint32_t n_deed = (c->deed == DO_SLIDE ? SLIDE : 0) + 3 * GESTURE;
  Hold part = to;
  part.patch.pluck *= exp2((from.fret - to.fret - to.patch.capo) / 12.0);
  Edge most =
      larger(edge_of_pluck(guitar, c->string, &from), edge_of_pluck(guitar, c->string, &to));
  most = larger(most, edge_of_pluck(guitar, c->string, &part));
  most = larger(most, edge_of(sound + n_deed, FRAMES - n_deed));
  const Edge edge = edge_of(sound, n_deed + 2);
  const double corner = 2.0 * GUITAR_NOTE_PEAK / GESTURE;
  const double sum = c->deed == DO_HAMMER || c->deed == DO_PULL ? 1.4 : 1.0; /* Struck as well */
  return (Edge){edge.step / (sum * most.step + corner), edge.turn / (sum * most.turn + corner)};
}

static void nothing_that_hands_do_clicks(void** state) {
  (void)state;
  const GuitarPatch patch = guitars_patch();
  Guitar* const guitar = guitars_new(RATE_HZ, &patch);
  double worst = 0.0;
  for (Deed deed = 0; deed < N_DEEDS; ++deed) {
    Edge most = {0};
    for (uint32_t i = 0; i < 12 * N_STARTS; ++i) {
      const Case c = {deed, i % 6, i / 6 % 2, BEFORE + START_STEP * (i / 12), 0.0};
      most = larger(most, edge_of_deed(guitar, &c));
    }
    print_message("  %-10s step %.3f, turn %.3f of a pluck's\n", names[deed], most.step, most.turn);
    worst = fmax(worst, fmax(most.step, most.turn));
  }
  guitar_free(guitar);
  /* What is bent keeps its amplitude, and partials meet on the way as they do in no pluck; and of
   * what is slid up an octave those near half the rate are louder beside a pluck's, as velocity
   * goes with sin(ω/2). */
  assert_within("largest edge, of a pluck's", worst, 1.1);
}

/* A step of a tenth of a note's peak is seen on every string. */
static void a_click_is_seen(void** state) {
  (void)state;
  const GuitarPatch patch = guitars_patch();
  Guitar* const guitar = guitars_new(RATE_HZ, &patch);
  for (uint32_t i = 0; i < 12; ++i) {
    const Case c = {DO_DAMP, i % 6, i / 6, BEFORE, 0.1 * GUITAR_NOTE_PEAK};
    const Edge edge = edge_of_deed(guitar, &c);
    print_message("  string %u: step %.3f, turn %.3f\n", c.string, edge.step, edge.turn);
    assert_true(edge.turn > 1.0);
  }
  guitar_free(guitar);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_click_is_seen),
      cmocka_unit_test(nothing_that_hands_do_clicks),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

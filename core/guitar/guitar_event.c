#include "core/guitar/guitar_event.h"

#include <math.h>

/* What a value may be. */
typedef struct {
  double least, most;
  bool may_be_nan;
} Range;

#define NOTHING                                                                                    \
  { -HUGE_VAL, HUGE_VAL, true }
#define FRETS                                                                                      \
  { -48.0, 48.0, false }
#define TIME                                                                                       \
  { 0.0, HUGE_VAL, false }
#define SHARE                                                                                      \
  { 0.0, 1.0, false }
#define SHARE_OR_NONE                                                                              \
  { 0.0, 1.0, true }

static const Range ranges[GUITAR_N_VERBS][3] = {
    [GUITAR_PLUCK] = {{-1.0, 1.0, false}, SHARE_OR_NONE, SHARE_OR_NONE},
    [GUITAR_FRET] = {FRETS, NOTHING, NOTHING},
    [GUITAR_HAMMER] = {FRETS, SHARE, NOTHING},
    [GUITAR_SLIDE] = {FRETS, TIME, NOTHING},
    [GUITAR_BEND] = {FRETS, TIME, NOTHING},
    [GUITAR_VIBRATO] = {{0.0, 12.0, false}, {0.0, 50.0, false}, NOTHING},
    [GUITAR_DAMP] = {TIME, NOTHING, NOTHING},
    [GUITAR_LET_RING] = {NOTHING, NOTHING, NOTHING},
    [GUITAR_TOUCH] = {SHARE, TIME, NOTHING},
    [GUITAR_PALM] = {SHARE, NOTHING, NOTHING},
};

static bool is_in(const Range* range, double value) {
  return (value >= range->least && value <= range->most) || (range->may_be_nan && isnan(value));
}

static bool is_valid(const GuitarEvent* event) {
  if (event->verb >= GUITAR_N_VERBS || event->string >= GUITAR_STRINGS) {
    return false;
  }
  bool are_in = true;
  for (int i = 0; i < 3; ++i) {
    are_in = are_in && is_in(&ranges[event->verb][i], (double)event->value[i]);
  }
  return are_in;
}

static void act(void* instrument, const GuitarAct* act) {
  Guitar* const guitar = instrument;
  const uint32_t s = act->string;
  const double a = act->value[0];
  const double b = act->value[1];
  const double c = act->value[2];
  switch (act->verb) {
  case GUITAR_PLUCK:
    guitar_pluck(guitar, s, (GuitarPluck){a, b, c});
    break;
  case GUITAR_FRET:
    guitar_follow_channel(guitar, s, act->channel);
    guitar_fret(guitar, s, a);
    break;
  case GUITAR_HAMMER:
    guitar_follow_channel(guitar, s, act->channel);
    guitar_hammer(guitar, s, a, b);
    break;
  case GUITAR_SLIDE:
    guitar_slide(guitar, s, a, b);
    break;
  case GUITAR_BEND:
    guitar_bend(guitar, s, a, b);
    break;
  case GUITAR_VIBRATO:
    guitar_vibrato(guitar, s, a, b);
    break;
  case GUITAR_DAMP:
    guitar_damp(guitar, s, a);
    break;
  case GUITAR_LET_RING:
    guitar_let_ring(guitar, s);
    break;
  case GUITAR_TOUCH:
    guitar_touch(guitar, s, a, b);
    break;
  case GUITAR_PALM:
    guitar_palm(guitar, a);
    break;
  case GUITAR_CHOKE:
    guitar_choke_string(guitar, s);
    break;
  case GUITAR_GAIN:
    guitar_set_gain(guitar, s, a);
    break;
  }
}

static bool is_awake(const void* guitar, uint32_t string) {
  return guitar_is_awake(guitar, string);
}

static void run(void* guitar, uint32_t n_frames, float* left, float* right) {
  guitar_run(guitar, n_frames, left, right);
}

static void
tune(void* guitar, uint32_t channel, const double semitones[PERFORMANCE_KEYS], bool is_live) {
  guitar_set_scale(guitar, channel, semitones, is_live);
}

GuitarSeat guitar_seat(Guitar* guitar) {
  return (GuitarSeat){guitar, guitar_rate_hz(guitar), act, is_awake, run, tune};
}

bool guitar_event_play(Guitar* guitar, const GuitarEvent* event) {
  if (!is_valid(event)) {
    return false;
  }
  const GuitarAct exact = {
      .verb = (GuitarVerb)event->verb,
      .string = event->string,
      .value = {(double)event->value[0], (double)event->value[1], (double)event->value[2]},
  };
  act(guitar, &exact);
  return true;
}

#include "tests/support/guitar_storm.h"

#include <math.h>

static const double MOST_FRETS = 48.0;

static float odd_float(Random* random) {
  return (float)guitar_storm_odd_value(random);
}

/* A tenth of the times last for ever. */
static float time_of(Random* random) {
  const double time_s = random_log_between(random, 1e-4, 1.0);
  return (float)(random_below(random, 10) > 0 ? time_s : HUGE_VAL);
}

/* Most fingers are on the neck. */
static float fret_of(Random* random) {
  const double whole = random_below(random, 25);
  return (float)(random_below(random, 8) > 0 ? whole
                                             : random_between(random, -MOST_FRETS, MOST_FRETS));
}

static float share_of(Random* random) {
  return (float)random_between(random, 0.0, 1.0);
}

static float share_or_none(Random* random) {
  return random_below(random, 3) > 0 ? share_of(random) : (float)NAN;
}

static void set_values(Random* random, GuitarEvent* event) {
  float* const value = event->value;
  switch ((GuitarVerb)event->verb) {
  case GUITAR_PLUCK:
    value[0] = (float)random_between(random, -1.0, 1.0);
    value[1] = share_or_none(random);
    value[2] = share_or_none(random);
    break;
  case GUITAR_FRET:
    value[0] = fret_of(random);
    break;
  case GUITAR_HAMMER:
    value[0] = fret_of(random);
    value[1] = share_of(random);
    break;
  case GUITAR_SLIDE:
    value[0] = fret_of(random);
    value[1] = time_of(random);
    break;
  case GUITAR_BEND:
    value[0] = (float)random_between(random, -5.0, 5.0);
    value[1] = time_of(random);
    break;
  case GUITAR_VIBRATO:
    value[0] = (float)random_between(random, 0.0, 12.0);
    value[1] = (float)random_between(random, 0.0, 50.0);
    break;
  case GUITAR_DAMP:
    value[0] = time_of(random);
    break;
  case GUITAR_TOUCH:
    value[0] = share_of(random);
    value[1] = time_of(random);
    break;
  case GUITAR_PALM:
    value[0] = share_of(random);
    break;
  case GUITAR_LET_RING:
  case GUITAR_CHOKE:
  case GUITAR_GAIN:
    break;
  }
}

GuitarEvent guitar_storm_event(Random* random) {
  static const uint32_t verbs[] = {GUITAR_PLUCK,    GUITAR_PLUCK, GUITAR_PLUCK, GUITAR_FRET,
                                   GUITAR_HAMMER,   GUITAR_SLIDE, GUITAR_BEND,  GUITAR_VIBRATO,
                                   GUITAR_DAMP,     GUITAR_TOUCH, GUITAR_PALM,  GUITAR_HAMMER,
                                   GUITAR_LET_RING, GUITAR_SLIDE, GUITAR_PLUCK, GUITAR_TOUCH};
  GuitarEvent event = {verbs[random_below(random, 16)], random_below(random, 6), {0.0f}};
  set_values(random, &event);
  if (random_below(random, 8) == 0) {
    const uint32_t what = random_below(random, 5);
    if (what < 3) {
      event.value[what] = odd_float(random);
    } else {
      *(what == 3 ? &event.verb : &event.string) = random_below(random, 20);
    }
  }
  return event;
}

void guitar_storm_midi(Random* random, uint8_t bytes[3]) {
  static const unsigned statuses[] = {0x90, 0x90, 0x90, 0x80, 0xB0, 0xB0, 0xE0};
  static const unsigned controllers[] = {1,   6,   38,  64,  67,  98,  99,  100, 101,
                                         120, 121, 122, 123, 124, 125, 126, 127, 64};
  const unsigned status = statuses[random_below(random, 7)];
  const unsigned channel = random_below(random, random_below(random, 3) > 0 ? 6 : 16);
  bytes[0] = (uint8_t)(status | channel);
  bytes[1] = (uint8_t)(random_below(random, 4) > 0 ? 40 + random_below(random, 48)
                                                   : random_below(random, 128));
  bytes[2] = (uint8_t)random_below(random, 128);
  if (status == 0xB0) {
    bytes[1] = (uint8_t)controllers[random_below(random, 18)];
    /* Parameter 0 is chosen more often than the others, or its range would hardly ever move. */
    bytes[2] = (bytes[1] | 1) == 101 && random_below(random, 4) > 0 ? 0 : bytes[2];
  }
}

uint32_t guitar_storm_malformed(Random* random, uint8_t bytes[GUITAR_STORM_BYTES]) {
  for (uint32_t i = 0; i < GUITAR_STORM_BYTES; ++i) {
    bytes[i] = (uint8_t)random_below(random, 256);
  }
  return random_below(random, GUITAR_STORM_BYTES);
}

double guitar_storm_odd_value(Random* random) {
  static const double values[] = {(double)NAN, HUGE_VAL, -HUGE_VAL, 1e30,  -1e30, 1e-40,
                                  -1e-40,      0.0,      -0.0,      1e-30, -1.0,  1e9};
  return values[random_below(random, sizeof(values) / sizeof(values[0]))];
}

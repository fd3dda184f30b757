#include "core/harp/harp_pickups.h"

#include <math.h>

/* A place beyond an end folds back, so that a wide pair near a wall has no silent side. */
static double fold(double place) {
  const double inside = fabs(place);
  return inside > 1.0 ? 2.0 - inside : inside;
}

static void add_places(HarpReading* reading, HarpPlaces places) {
  const double half = reading->n_sides == 2 ? 0.5 * places.spread : 0.0;
  reading->ears[reading->n_taps++] =
      (HarpEar){places.pickup_type, fold(places.place - half), false};
  if (reading->n_sides == 2) {
    reading->ears[reading->n_taps++] =
        (HarpEar){places.pickup_type, fold(places.place + half), true};
  }
}

void harp_pickups_set(HarpPickups* pickups, HarpPlaces places) {
  pickups->heard = places;
  ramp_init(&pickups->fade, 1.0f);
}

static bool is_same(HarpPlaces a, HarpPlaces b) {
  return a.pickup_type == b.pickup_type && a.place == b.place && a.spread == b.spread;
}

void harp_pickups_move(HarpPickups* pickups, HarpPlaces places, uint32_t n_frames) {
  const HarpPlaces heard = pickups->heard;
  const bool is_there = is_same(places, heard);
  if (pickups->fade.n_left == 0 && !is_there) {
    pickups->fading = heard;
    pickups->heard = places;
    ramp_init(&pickups->fade, 0.0f);
    ramp_to(&pickups->fade, 1.0f, n_frames);
  }
}

HarpReading harp_pickups_reading(const HarpPickups* pickups) {
  const bool is_fading = pickups->fade.n_left > 0;
  const bool is_stereo = pickups->heard.spread > 0.0 || (is_fading && pickups->fading.spread > 0.0);
  HarpReading reading = {.n_sides = is_stereo ? 2 : 1, .is_fading = is_fading};
  add_places(&reading, pickups->heard);
  if (is_fading) {
    add_places(&reading, pickups->fading);
  }
  return reading;
}

bool harp_pickups_are_same(const HarpReading* a, const HarpReading* b) {
  bool are_same = a->n_taps == b->n_taps;
  for (uint32_t t = 0; are_same && t < a->n_taps; ++t) {
    const HarpEar* const x = &a->ears[t];
    const HarpEar* const y = &b->ears[t];
    are_same = x->pickup_type == y->pickup_type && x->place == y->place && x->is_far == y->is_far;
  }
  return are_same;
}

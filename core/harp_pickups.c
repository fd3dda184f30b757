#include "core/harp_pickups.h"

#include <math.h>

/* A place beyond an end folds back, so that a wide pair near a wall has no silent side. */
static double fold(double place) {
  const double inside = fabs(place);
  return inside > 1.0 ? 2.0 - inside : inside;
}

static void add_places(HarpReading* reading, HarpPlaces places) {
  const double half = reading->n_sides == 2 ? 0.5 * places.spread : 0.0;
  reading->place[reading->n_taps++] = fold(places.place - half);
  if (reading->n_sides == 2) {
    reading->place[reading->n_taps++] = fold(places.place + half);
  }
}

void harp_pickups_set(HarpPickups* pickups, HarpPlaces places) {
  pickups->heard = places;
  ramp_init(&pickups->fade, 1.0f);
}

void harp_pickups_move(HarpPickups* pickups, HarpPlaces places, uint32_t n_frames) {
  const HarpPlaces heard = pickups->heard;
  const bool is_there = places.place == heard.place && places.spread == heard.spread;
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

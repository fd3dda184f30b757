#include "core/voice/pickups.h"

#include <string.h>

bool pickups_are_same(const Pickup* a, const Pickup* b) {
  return a->type == b->type && a->place == b->place;
}

void pickups_set(Pickups* pickups, const Pickup places[PICKUPS]) {
  memcpy(pickups->heard, places, sizeof(pickups->heard));
  line_set(&pickups->fade, 1.0);
}

void pickups_move(Pickups* pickups, const Pickup places[PICKUPS], uint32_t n_frames) {
  bool is_there = true;
  for (int p = 0; p < PICKUPS; ++p) {
    is_there = is_there && pickups_are_same(&places[p], &pickups->heard[p]);
  }
  if (pickups->fade.n_left == 0 && !is_there) {
    memcpy(pickups->fading, pickups->heard, sizeof(pickups->heard));
    memcpy(pickups->heard, places, sizeof(pickups->heard));
    line_set(&pickups->fade, 0.0);
    line_to(&pickups->fade, 1.0, n_frames);
  }
}

uint32_t pickups_stretch(const Pickups* pickups) {
  return pickups->fade.n_left > 0 ? pickups->fade.n_left : UINT32_MAX;
}

static void add(Reading* reading, const Pickup from[PICKUPS], const bool is_wanted[PICKUPS]) {
  for (int p = 0; p < PICKUPS; ++p) {
    if (is_wanted[p]) {
      reading->at[reading->n_taps++] = from[p];
    }
  }
}

Reading pickups_reading(const Pickups* pickups, const bool is_wanted[PICKUPS]) {
  Reading reading = {.is_fading = pickups->fade.n_left > 0};
  add(&reading, pickups->heard, is_wanted);
  reading.n_heard = reading.n_taps;
  if (reading.is_fading) {
    add(&reading, pickups->fading, is_wanted);
  }
  return reading;
}

void pickups_cross(Pickups* pickups, const Reading* reading, uint32_t n_frames, float* const* out) {
  for (uint32_t n = 0; reading->is_fading && n < n_frames; ++n) {
    const float share = (float)line_next(&pickups->fade);
    for (uint32_t t = 0; t < reading->n_heard; ++t) {
      const float old = out[t + reading->n_heard][n];
      out[t][n] = old + share * (out[t][n] - old);
    }
  }
}

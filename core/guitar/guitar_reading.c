#include "core/guitar/guitar_reading.h"

#include "core/string/pickup.h"

#include <string.h>

/* What is read in some frames. */
typedef struct {
  uint32_t n_read; /* Pickups */
  bool is_fading;
  ChainPart part;
  float samples[CHAIN_MAX_TAPS][GUITAR_MIX_FRAMES]; /* Of the new places, then of the old */
} Take;

void guitar_reading_set(GuitarReading* reading, const double places[GUITAR_PICKUPS]) {
  memcpy(reading->heard, places, sizeof(reading->heard));
  ramp_init(&reading->fade, 1.0f);
}

void guitar_reading_move(GuitarReading* reading,
                         const double places[GUITAR_PICKUPS],
                         uint32_t n_frames) {
  bool is_there = true;
  for (int p = 0; p < GUITAR_PICKUPS; ++p) {
    is_there = is_there && places[p] == reading->heard[p];
  }
  if (reading->fade.n_left == 0 && !is_there) {
    memcpy(reading->fading, reading->heard, sizeof(reading->heard));
    memcpy(reading->heard, places, sizeof(reading->heard));
    ramp_init(&reading->fade, 0.0f);
    ramp_to(&reading->fade, 1.0f, n_frames);
  }
}

uint32_t guitar_reading_stretch(const GuitarReading* reading) {
  return reading->fade.n_left > 0 ? reading->fade.n_left : UINT32_MAX;
}

static void place_taps(Take* take, const GuitarReading* reading, const GuitarGains* gains) {
  const uint32_t n_masses = take->part.chain->n_masses;
  for (int p = 0; p < GUITAR_PICKUPS; ++p) {
    if (gains->is_read[p]) {
      take->part.taps[take->n_read++] = pickup_tap(n_masses, reading->heard[p]);
    }
  }
  uint32_t t = take->n_read;
  for (int p = 0; take->is_fading && p < GUITAR_PICKUPS; ++p) {
    if (gains->is_read[p]) {
      take->part.taps[t++] = pickup_tap(n_masses, reading->fading[p]);
    }
  }
}

/* A string that no pickup reads is stepped all the same. */
static void step(Take* take, uint32_t n_frames) {
  const uint32_t n_taps = take->n_read == 0 ? 1 : take->n_read * (take->is_fading ? 2 : 1);
  float* out[CHAIN_MAX_TAPS];
  for (uint32_t t = 0; t < n_taps; ++t) {
    out[t] = memset(take->samples[t], 0, n_frames * sizeof(float));
  }
  chain_run_all(&take->part, 1, n_frames, n_taps, out);
}

/* From the old places to the new. */
static void cross(Take* take, Ramp* fade, uint32_t n_frames) {
  for (uint32_t n = 0; n < n_frames; ++n) {
    const float share = ramp_next(fade);
    for (uint32_t t = 0; t < take->n_read; ++t) {
      const float old = take->samples[t + take->n_read][n];
      take->samples[t][n] = old + share * (take->samples[t][n] - old);
    }
  }
}

static void
add(const Take* take, const GuitarGains* gains, uint32_t from, uint32_t n_frames, float* out) {
  uint32_t t = 0;
  for (int p = 0; p < GUITAR_PICKUPS; ++p) {
    if (gains->is_read[p]) {
      const float* const gain = gains->gain[p] + from;
      const float* const samples = take->samples[t];
      for (uint32_t n = 0; n < n_frames; ++n) {
        out[n] += gain[n] * samples[n];
      }
      ++t;
    }
  }
}

void guitar_reading_run(GuitarReading* reading,
                        Chain* chain,
                        const GuitarGains* gains,
                        uint32_t from,
                        uint32_t n_frames,
                        float* out) {
  Take take;
  take.n_read = 0;
  take.is_fading = reading->fade.n_left > 0;
  take.part.chain = chain;
  memset(take.part.taps, 0, sizeof(take.part.taps));
  place_taps(&take, reading, gains);
  step(&take, n_frames);
  if (take.is_fading) {
    cross(&take, &reading->fade, n_frames);
  }
  add(&take, gains, from, n_frames, out);
}

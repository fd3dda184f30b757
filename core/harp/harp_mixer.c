#include "core/harp/harp_mixer.h"

#include "core/string/pickup.h"

#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

/* Below which what is heard of a bow is taken for standing still [Hz]. */
static const double REST_HZ = 5.0;

/* The same once nothing sounds [Hz]; and what is left of it that nobody hears. */
static const double SILENT_REST_HZ = 100.0;
static const double LEAST_REST = 1e-7;

HarpPlaces harp_mixer_places(const Patch* patch) {
  return (HarpPlaces){patch->sense, patch->pickup, patch->spread};
}

/* Velocities are weighed as if a key were in its usual tune: weights must not move while it rings.
 */
static double angle_of(const Harp* harp, const HarpString* string) {
  const double f0_hz = 440.0 * exp2(((double)string->key - 69.0) / 12.0);
  return 2.0 * PI * f0_hz / harp->rate_hz;
}

static ChainTap tap_of(const Harp* harp, const HarpString* string, const HarpEar* ear) {
  const uint32_t n_masses = string->wire.chain.n_masses;
  if (ear->sense == SENSE_DISPLACEMENT) {
    return pickup_tap(n_masses, ear->place);
  }
  return pickup_tap_sensing(ear->sense, n_masses, ear->place, angle_of(harp, string), ear->is_far);
}

static void add_part(Harp* harp, uint32_t i, HarpString* string, const HarpReading* reading) {
  ChainPart* const part = &harp->parts[i];
  part->chain = &string->wire.chain;
  for (uint32_t t = 0; t < reading->n_taps; ++t) {
    part->taps[t] = tap_of(harp, string, &reading->ears[t]);
  }
  harp->awake[i] = string;
}

/* Those of the strings awake that are tied to the bridge, or those that are not. */
static uint32_t
gather_some(Harp* harp, uint32_t n_parts, bool are_tied, const HarpReading* reading) {
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    HarpString* const string = &harp->strings[i];
    if (string->wire.is_awake && grip_is_on(&string->grip) == are_tied) {
      chain_share(&string->wire.chain, are_tied);
      string->wire.is_kept = string->wire.is_kept && are_tied;
      add_part(harp, n_parts++, string, reading);
    }
  }
  return n_parts;
}

/* The strings awake, and where they are read. */
static uint32_t gather(Harp* harp, const HarpReading* reading) {
  const uint32_t n_tied = gather_some(harp, 0, true, reading);
  harp_bridge_gather(harp, n_tied);
  return gather_some(harp, n_tied, false, reading);
}

/* What a tap reads of all strings as they are. */
static float read_now(const Harp* harp, uint32_t n_parts, uint32_t t) {
  float sum = 0.0f;
  for (uint32_t i = 0; i < n_parts; ++i) {
    const ChainPart* const part = &harp->parts[i];
    const ChainTap* const tap = &part->taps[t];
    sum += tap->weight[0] * chain_position(part->chain, tap->mass[0]) +
           tap->weight[1] * chain_position(part->chain, tap->mass[1]);
  }
  return sum;
}

/* Who begins to read velocities must know where the strings were. */
static void take_reading(Harp* harp, const HarpReading* reading, uint32_t n_parts) {
  if (!harp_pickups_are_same(reading, &harp->reading)) {
    harp->reading = *reading;
    for (uint32_t t = 0; t < reading->n_taps; ++t) {
      harp->before[t] = read_now(harp, n_parts, t);
    }
  }
}

/* Fade from the old pickups, and set the level. */
static void
mix_down(Harp* harp, const HarpReading* reading, uint32_t n_frames, float* left, float* right) {
  const uint32_t n_sides = reading->n_sides;
  float* const sides[2] = {left, right};
  for (uint32_t n = 0; n < n_frames; ++n) {
    const float level = ramp_next(&harp->level);
    const float fade = ramp_next(&harp->pickups.fade);
    for (uint32_t s = 0; s < n_sides; ++s) {
      const float now = harp->mix[s][n];
      const float old = reading->is_fading ? harp->mix[n_sides + s][n] : now;
      /* There are two at most.  NOLINTNEXTLINE(clang-analyzer-core.NullDereference) */
      sides[s][n] = level * (old + fade * (now - old));
    }
  }
  if (n_sides == 1) {
    memcpy(right, left, n_frames * sizeof(float));
  }
}

/*
  A bow pulls the string aside for as long as it is drawn, and none can hear that.  So from the
  first note that is bowed on, what stands still is taken out of the sum; before that it is not
  touched.  Exact zeros mean that nothing sounds: then what is left of it is let go.
*/
static void take_out_rest(Harp* harp, uint32_t n_frames, float* left, float* right) {
  if (!harp->is_bowed) {
    return;
  }
  const double share = -expm1(-2.0 * PI * REST_HZ / harp->rate_hz);
  const double share_in_silence = -expm1(-2.0 * PI * SILENT_REST_HZ / harp->rate_hz);
  float* const sides[2] = {left, right};
  for (int s = 0; s < 2; ++s) {
    double rest = harp->rest[s];
    for (uint32_t n = 0; n < n_frames; ++n) {
      const double x = (double)sides[s][n];
      const bool is_silent = x == 0.0;
      rest += (is_silent ? share_in_silence : share) * (x - rest);
      rest = is_silent && fabs(rest) < LEAST_REST ? 0.0 : rest;
      sides[s][n] = (float)(x - rest);
    }
    harp->rest[s] = rest;
  }
}

static uint32_t least(uint32_t a, uint32_t b) {
  return a < b ? a : b;
}

/* Frames that can be run in one go: the pickups may not change within them but by their own ramp.
 */
static uint32_t stretch(const Harp* harp, uint32_t n_frames) {
  const uint32_t n = least(n_frames, HARP_MIX_FRAMES);
  const uint32_t n_left = harp->pickups.fade.n_left;
  return n_left > 0 ? least(n, n_left) : n;
}

static uint32_t stretch_of(const HarpString* string) {
  return harp_string_is_touched(string) ? 1 : harp_string_stretch(string);
}

/* Run a string that something happens to on the way. */
static void run_in_pieces(Harp* harp, uint32_t i, uint32_t n_frames, uint32_t n_taps, float** out) {
  HarpString* const string = harp->awake[i];
  for (uint32_t done = 0; done < n_frames && string->wire.is_awake;) {
    const uint32_t n = least(n_frames - done, stretch_of(string));
    const uint32_t n_masses = string->wire.chain.n_masses;
    float* rest[CHAIN_MAX_TAPS];
    for (uint32_t t = 0; t < n_taps; ++t) {
      rest[t] = out[t] + done;
    }
    chain_run_all(&harp->parts[i], 1, n, n_taps, rest);
    harp_string_act(string);
    harp_string_pass(string, &harp->patch, n);
    /* A swing may have taken some of its masses, and with them the places where it is read. */
    if (string->wire.chain.n_masses != n_masses) {
      add_part(harp, i, string, &harp->reading);
    }
    done += n;
  }
}

/* Run the strings that are not tied in their order, those that nothing happens to side by side. */
static void
run_strings(Harp* harp, uint32_t n_parts, uint32_t n_frames, uint32_t n_taps, float** out) {
  uint32_t first = harp->bridge.n_tied;
  for (uint32_t i = first; i <= n_parts; ++i) {
    if (i < n_parts && stretch_of(harp->awake[i]) > n_frames) {
      continue;
    }
    chain_run_all(&harp->parts[first], i - first, n_frames, n_taps, out);
    for (; first < i; ++first) {
      harp_string_pass(harp->awake[first], &harp->patch, n_frames);
    }
    if (i < n_parts) {
      run_in_pieces(harp, i, n_frames, n_taps, out);
    }
    first = i + 1;
  }
}

/* Run as many of `n_frames` as can be run in one go; how many they were. */
static uint32_t run_stretch(Harp* harp, uint32_t n_frames, float* left, float* right) {
  const HarpReading reading = harp_pickups_reading(&harp->pickups);
  const uint32_t n_parts = gather(harp, &reading);
  const uint32_t n_most = harp_bridge_stretch(harp, stretch(harp, n_frames));
  float* out[CHAIN_MAX_TAPS];
  for (uint32_t t = 0; t < reading.n_taps; ++t) {
    out[t] = memset(harp->mix[t], 0, n_most * sizeof(float));
  }
  take_reading(harp, &reading, n_parts);
  const uint32_t n = harp_bridge_run(harp, n_most, reading.n_taps, out);
  run_strings(harp, n_parts, n, reading.n_taps, out);
  harp_bridge_pass(harp, n);
  for (uint32_t t = 0; t < reading.n_taps; ++t) {
    if (reading.ears[t].sense == SENSE_VELOCITY) {
      pickup_differentiate(out[t], n, &harp->before[t]);
    }
  }
  mix_down(harp, &reading, n, left, right);
  take_out_rest(harp, n, left, right);
  return n;
}

void harp_run(Harp* harp, uint32_t n_frames, float* left, float* right) {
  for (uint32_t done = 0; done < n_frames;) {
    harp_pickups_move(&harp->pickups, harp_mixer_places(&harp->patch), harp->n_fade);
    done += run_stretch(harp, n_frames - done, left + done, right + done);
  }
}

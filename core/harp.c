#include "core/harp.h"

#include "core/pickup.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How much harder the hardest velocity plucks than the one where the patch's hardness is what it
 * says. */
static const double VELOCITY_HARDNESS = 0.25;
static const double VELOCITY_NEUTRAL = 0.75;

static double clamp(double value, double low, double high) {
  return fmin(fmax(value, low), high);
}

static HarpPlaces places_of(const Patch* patch) {
  return (HarpPlaces){patch->pickup, patch->spread};
}

/* The strings awake, and where they are read. */
static uint32_t gather(Harp* harp, const HarpReading* reading) {
  uint32_t n_parts = 0;
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    Wire* const wire = &harp->strings[key].wire;
    if (wire->is_awake) {
      ChainPart* const part = &harp->parts[n_parts];
      part->chain = &wire->chain;
      for (uint32_t t = 0; t < reading->n_taps; ++t) {
        part->taps[t] = pickup_tap(wire->chain.n_masses, reading->place[t]);
      }
      harp->awake[n_parts++] = wire;
    }
  }
  return n_parts;
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
      sides[s][n] = level * (old + fade * (now - old));
    }
  }
  if (n_sides == 1) {
    memcpy(right, left, n_frames * sizeof(float));
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

/* Run a string that something happens to on the way. */
static void
run_in_pieces(Wire* wire, const ChainPart* part, uint32_t n_frames, uint32_t n_taps, float** out) {
  for (uint32_t done = 0; done < n_frames && wire->is_awake;) {
    const uint32_t n = least(n_frames - done, wire_stretch(wire));
    float* rest[CHAIN_MAX_TAPS];
    for (uint32_t t = 0; t < n_taps; ++t) {
      rest[t] = out[t] + done;
    }
    chain_run_all(part, 1, n, n_taps, rest);
    wire_pass(wire, n);
    done += n;
  }
}

/* Run the strings awake in their order, those that nothing happens to side by side. */
static void
run_strings(Harp* harp, uint32_t n_parts, uint32_t n_frames, uint32_t n_taps, float** out) {
  uint32_t first = 0;
  for (uint32_t i = 0; i <= n_parts; ++i) {
    if (i < n_parts && wire_stretch(harp->awake[i]) > n_frames) {
      continue;
    }
    chain_run_all(&harp->parts[first], i - first, n_frames, n_taps, out);
    for (; first < i; ++first) {
      wire_pass(harp->awake[first], n_frames);
    }
    if (i < n_parts) {
      run_in_pieces(harp->awake[i], &harp->parts[i], n_frames, n_taps, out);
    }
    first = i + 1;
  }
}

/* Run as many of `n_frames` as can be run in one go; how many they were. */
static uint32_t run_stretch(Harp* harp, uint32_t n_frames, float* left, float* right) {
  const HarpReading reading = harp_pickups_reading(&harp->pickups);
  const uint32_t n = stretch(harp, n_frames);
  float* out[CHAIN_MAX_TAPS];
  for (uint32_t t = 0; t < reading.n_taps; ++t) {
    out[t] = memset(harp->mix[t], 0, n * sizeof(float));
  }
  run_strings(harp, gather(harp, &reading), n, reading.n_taps, out);
  mix_down(harp, &reading, n, left, right);
  return n;
}

/* What the hands and the pedal let touch a string. */
static Damper damper_of(const Harp* harp, uint32_t key) {
  return harp->keys[key].is_down || harp->keys[key].is_held ? DAMPER_OFF : DAMPER_ON;
}

static void retune(Harp* harp, uint32_t key, uint32_t n_glide) {
  HarpString* const string = &harp->strings[key];
  if (string->wire.is_awake && string->damper != DAMPER_CHOKING) {
    harp_string_retune(string, &harp->patch, harp->bend_semitones, damper_of(harp, key), n_glide);
  }
}

static void retune_all(Harp* harp, uint32_t n_glide) {
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    retune(harp, key, n_glide);
  }
}

/* A scale may give any key any pitch, so all strings have the same memory. */
static void lay_out(Harp* harp, char* memory) {
  const size_t size = chain_size(CHAIN_MAX_MASSES);
  memset(memory, 0, HARP_KEYS * size);
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    harp_string_init(&harp->strings[key], harp->rate_hz, key, memory + key * size,
                     CHAIN_MAX_MASSES);
  }
}

Harp* harp_new(double rate_hz) {
  Harp* const harp = isfinite(rate_hz) && rate_hz > 0.0 ? calloc(1, sizeof(Harp)) : NULL;
  if (!harp) {
    return NULL;
  }
  harp->rate_hz = rate_hz;
  harp->n_gesture = wire_gesture_frames(rate_hz);
  harp->memory = aligned_alloc(CHAIN_ALIGNMENT, HARP_KEYS * chain_size(CHAIN_MAX_MASSES));
  if (!harp->memory) {
    harp_free(harp);
    return NULL;
  }
  lay_out(harp, harp->memory);
  return harp;
}

void harp_free(Harp* harp) {
  if (harp) {
    free(harp->memory);
    free(harp);
  }
}

void harp_reset(Harp* harp) {
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    wire_sleep(&harp->strings[key].wire);
    harp->keys[key] = (HarpKey){0};
  }
  harp->is_pedal_down = false;
  harp->bend_semitones = 0.0;
}

/* Whether what rings has the same coefficients under both. */
static bool is_same_string(const Patch* a, const Patch* b) {
  return a->damping_per_s == b->damping_per_s && a->tracking == b->tracking && a->loss == b->loss &&
         a->inharmonicity == b->inharmonicity && a->release_s == b->release_s &&
         a->tuning_hz == b->tuning_hz && a->partials == b->partials;
}

void harp_set_patch(Harp* harp, const Patch* patch, uint32_t n_frames) {
  const bool is_same = is_same_string(patch, &harp->patch);
  const uint32_t n_glide = n_frames > 0 && n_frames < harp->n_gesture ? harp->n_gesture : n_frames;
  harp->patch = *patch;
  harp->n_fade = n_glide;
  ramp_to(&harp->level, (float)patch->level, n_glide);
  if (n_glide == 0) {
    harp_pickups_set(&harp->pickups, places_of(patch));
  }
  if (!is_same) {
    retune_all(harp, n_glide);
  }
}

void harp_set_scale(Harp* harp, const double semitones[HARP_KEYS]) {
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    HarpString* const string = &harp->strings[key];
    if (semitones[key] != string->semitones) {
      string->semitones = semitones[key];
      retune(harp, key, harp->n_gesture);
    }
  }
}

void harp_note_on(Harp* harp, uint32_t key, uint32_t velocity) {
  assert(key < HARP_KEYS);
  const double force = velocity / 127.0;
  const Pluck pluck = {
      .place = harp->patch.pluck,
      .hardness =
          clamp(harp->patch.hardness + VELOCITY_HARDNESS * (force - VELOCITY_NEUTRAL), 0.0, 1.0),
      .amplitude = HARP_NOTE_PEAK * force * force,
  };
  harp->keys[key] = (HarpKey){.is_down = true};
  harp_string_pluck(&harp->strings[key], &harp->patch, harp->bend_semitones, pluck,
                    harp->n_gesture);
}

void harp_note_off(Harp* harp, uint32_t key) {
  assert(key < HARP_KEYS);
  if (harp->keys[key].is_down) {
    harp->keys[key] = (HarpKey){.is_held = harp->is_pedal_down};
    if (!harp->is_pedal_down) {
      retune(harp, key, harp->n_gesture);
    }
  }
}

void harp_pedal(Harp* harp, bool is_down) {
  harp->is_pedal_down = is_down;
  for (uint32_t key = 0; !is_down && key < HARP_KEYS; ++key) {
    if (harp->keys[key].is_held) {
      harp->keys[key].is_held = false;
      retune(harp, key, harp->n_gesture);
    }
  }
}

void harp_bend(Harp* harp, double semitones) {
  if (semitones != harp->bend_semitones) {
    harp->bend_semitones = semitones;
    retune_all(harp, harp->n_gesture);
  }
}

void harp_all_notes_off(Harp* harp) {
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    harp_note_off(harp, key);
  }
}

void harp_all_sound_off(Harp* harp) {
  harp_pedal(harp, false);
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    HarpString* const string = &harp->strings[key];
    harp->keys[key] = (HarpKey){0};
    if (string->wire.is_awake) {
      harp_string_retune(string, &harp->patch, harp->bend_semitones, DAMPER_CHOKING,
                         harp->n_gesture);
    }
  }
}

void harp_run(Harp* harp, uint32_t n_frames, float* left, float* right) {
  for (uint32_t done = 0; done < n_frames;) {
    harp_pickups_move(&harp->pickups, places_of(&harp->patch), harp->n_fade);
    done += run_stretch(harp, n_frames - done, left + done, right + done);
  }
}

HarpReport harp_report(const Harp* harp) {
  HarpReport report = {.headroom = 1.0};
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    const Wire* const wire = &harp->strings[key].wire;
    if (wire->is_awake) {
      ++report.n_strings;
      report.n_masses += wire->chain.n_masses;
      report.headroom = fmin(report.headroom, wire->headroom);
    }
  }
  return report;
}

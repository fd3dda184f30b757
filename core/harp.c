#include "core/harp.h"

#include "core/pickup.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How often strings are looked at for whether they have died away [frames]. */
enum { DOZE_FRAMES = 1024 };

/* What a gesture (a damper falling, the wheel) takes [s]. */
static const double GESTURE_S = 0.004;

/* How much harder the hardest velocity plucks than the one where the patch's hardness is what it
 * says. */
static const double VELOCITY_HARDNESS = 0.25;
static const double VELOCITY_NEUTRAL = 0.75;

/* Where a string is read: the places of its taps, in the order of the mix buffers. */
typedef struct {
  double place[CHAIN_MAX_TAPS];
  uint32_t n_taps;
  bool is_stereo;
  bool is_fading;
} Reading;

static double clamp(double value, double low, double high) {
  return fmin(fmax(value, low), high);
}

/* A place beyond an end folds back, so that a wide pair near a wall has no silent side. */
static double fold(double place) {
  const double inside = fabs(place);
  return inside > 1.0 ? 2.0 - inside : inside;
}

/* Left and right, or the one that is both. */
static void add_places(Reading* reading, HarpPickups pickups) {
  const double half = reading->is_stereo ? 0.5 * pickups.spread : 0.0;
  reading->place[reading->n_taps++] = fold(pickups.place - half);
  if (reading->is_stereo) {
    reading->place[reading->n_taps++] = fold(pickups.place + half);
  }
}

/* Only what is heard is read: one pickup if both coincide, the old ones only while they fade. */
static Reading reading_of(const Harp* harp) {
  const bool is_fading = harp->fade.n_left > 0;
  Reading reading = {
      .is_fading = is_fading,
      .is_stereo = harp->heard.spread > 0.0 || (is_fading && harp->fading.spread > 0.0),
  };
  add_places(&reading, harp->heard);
  if (is_fading) {
    add_places(&reading, harp->fading);
  }
  return reading;
}

/* Start towards the patch's pickups; while a fade is under way they wait for its end. */
static void move_pickups(Harp* harp) {
  const HarpPickups wanted = {harp->patch.pickup, harp->patch.spread};
  const bool is_there = wanted.place == harp->heard.place && wanted.spread == harp->heard.spread;
  if (harp->fade.n_left == 0 && !is_there) {
    harp->fading = harp->heard;
    harp->heard = wanted;
    ramp_init(&harp->fade, 0.0f);
    ramp_to(&harp->fade, 1.0f, harp->n_fade);
  }
}

/* The strings awake, and where they are read. */
static uint32_t gather(Harp* harp, const Reading* reading) {
  uint32_t n_parts = 0;
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    Chain* const chain = &harp->strings[key].chain;
    if (harp->strings[key].is_awake) {
      ChainPart* const part = &harp->parts[n_parts++];
      part->chain = chain;
      for (uint32_t t = 0; t < reading->n_taps; ++t) {
        part->taps[t] = pickup_tap(chain->n_masses, reading->place[t]);
      }
    }
  }
  return n_parts;
}

/* Fade from the old pickups, and set the level. */
static void
mix_down(Harp* harp, const Reading* reading, uint32_t n_frames, float* left, float* right) {
  const uint32_t n_sides = reading->is_stereo ? 2 : 1;
  float* const sides[2] = {left, right};
  for (uint32_t n = 0; n < n_frames; ++n) {
    const float level = ramp_next(&harp->level);
    const float fade = ramp_next(&harp->fade);
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

/* Frames that can be run in one go: nothing may change within them but by its own ramp. */
static uint32_t stretch(const Harp* harp, uint32_t n_parts, uint32_t n_frames) {
  uint32_t n = least(n_frames, HARP_MIX_FRAMES);
  n = least(n, DOZE_FRAMES - (uint32_t)(harp->frame % DOZE_FRAMES));
  n = harp->fade.n_left > 0 ? least(n, harp->fade.n_left) : n;
  for (uint32_t i = 0; i < n_parts; ++i) {
    n = least(n, chain_stretch(harp->parts[i].chain));
  }
  return n;
}

static void doze_all(Harp* harp) {
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    if (harp->strings[key].is_awake) {
      harp_string_doze(&harp->strings[key]);
    }
  }
}

/* Run as many of `n_frames` as can be run in one go; how many they were. */
static uint32_t run_stretch(Harp* harp, uint32_t n_frames, float* left, float* right) {
  const Reading reading = reading_of(harp);
  const uint32_t n_parts = gather(harp, &reading);
  const uint32_t n = stretch(harp, n_parts, n_frames);
  float* out[CHAIN_MAX_TAPS];
  for (uint32_t t = 0; t < reading.n_taps; ++t) {
    out[t] = memset(harp->mix[t], 0, n * sizeof(float));
  }
  chain_run_all(harp->parts, n_parts, n, reading.n_taps, out);
  mix_down(harp, &reading, n, left, right);
  harp->frame += n;
  if (harp->frame % DOZE_FRAMES == 0) {
    doze_all(harp);
  }
  return n;
}

/* What the hands and the pedal let touch a string. */
static Damper damper_of(const Harp* harp, uint32_t key) {
  return harp->keys[key].is_down || harp->keys[key].is_held ? DAMPER_OFF : DAMPER_ON;
}

static void retune(Harp* harp, uint32_t key, uint32_t n_glide) {
  HarpString* const string = &harp->strings[key];
  if (string->is_awake && string->damper != DAMPER_CHOKING) {
    harp_string_retune(string, &harp->patch, harp->bend_semitones, damper_of(harp, key), n_glide);
  }
}

static void retune_all(Harp* harp, uint32_t n_glide) {
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    retune(harp, key, n_glide);
  }
}

/* Lay out the memory of all strings, or with no memory count the bytes that it takes. */
static size_t lay_out(Harp* harp, char* memory) {
  size_t size = 0;
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    const double lowest_hz = HARP_LOWEST_TUNING_HZ * exp2(HARP_LOWEST_BEND / 12.0);
    const uint32_t capacity = harp_string_capacity(harp->rate_hz, key, lowest_hz);
    if (memory) {
      harp_string_init(&harp->strings[key], harp->rate_hz, key, memory + size, capacity);
    }
    size += chain_size(capacity);
  }
  return size;
}

Harp* harp_new(double rate_hz) {
  Harp* const harp = isfinite(rate_hz) && rate_hz > 0.0 ? calloc(1, sizeof(Harp)) : NULL;
  if (!harp) {
    return NULL;
  }
  harp->rate_hz = rate_hz;
  harp->n_gesture = (uint32_t)fmax(1.0, round(GESTURE_S * rate_hz));
  const size_t size = lay_out(harp, NULL) + chain_size(1);
  harp->memory = aligned_alloc(CHAIN_ALIGNMENT, size);
  if (!harp->memory) {
    harp_free(harp);
    return NULL;
  }
  memset(harp->memory, 0, size);
  lay_out(harp, harp->memory);
  ramp_init(&harp->fade, 1.0f);
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
    harp_string_sleep(&harp->strings[key]);
    harp->keys[key] = (HarpKey){0};
  }
  harp->is_pedal_down = false;
  harp->bend_semitones = 0.0;
  harp->frame = 0;
}

void harp_set_patch(Harp* harp, const Patch* patch, uint32_t n_glide) {
  harp->patch = *patch;
  harp->n_fade = n_glide;
  ramp_to(&harp->level, (float)patch->level, n_glide);
  if (n_glide == 0) {
    harp->heard = (HarpPickups){patch->pickup, patch->spread};
    ramp_init(&harp->fade, 1.0f);
  }
  retune_all(harp, n_glide);
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
    if (string->is_awake) {
      harp_string_retune(string, &harp->patch, harp->bend_semitones, DAMPER_CHOKING,
                         harp->n_gesture);
    }
  }
}

void harp_run(Harp* harp, uint32_t n_frames, float* left, float* right) {
  for (uint32_t done = 0; done < n_frames;) {
    move_pickups(harp);
    done += run_stretch(harp, n_frames - done, left + done, right + done);
  }
}

HarpReport harp_report(const Harp* harp) {
  HarpReport report = {.headroom = 1.0};
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    const HarpString* const string = &harp->strings[key];
    if (string->is_awake) {
      ++report.n_strings;
      report.n_masses += string->chain.n_masses;
      report.headroom = fmin(report.headroom, string->headroom);
    }
  }
  return report;
}

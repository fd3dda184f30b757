#include "core/harp.h"

#include "core/harp_mixer.h"

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
    harp_string_rest(&harp->strings[key]);
    harp->keys[key] = (HarpKey){0};
  }
  harp->is_pedal_down = false;
  harp->bend_semitones = 0.0;
  harp->reading.n_taps = 0;
  harp->is_bowed = false;
  harp->rest[0] = 0.0;
  harp->rest[1] = 0.0;
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
    harp_pickups_set(&harp->pickups, harp_mixer_places(patch));
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

/* Nothing sounds, and nothing is left of what a bow pulled aside. */
static bool is_still(const Harp* harp) {
  return harp->rest[0] == 0.0 && harp->rest[1] == 0.0 && harp_report(harp).n_strings == 0;
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
  harp->is_bowed = harp->patch.exciter == EXCITER_BOW || (harp->is_bowed && !is_still(harp));
  harp_string_play(&harp->strings[key], &harp->patch, harp->bend_semitones, pluck, harp->n_gesture);
}

void harp_note_off(Harp* harp, uint32_t key) {
  assert(key < HARP_KEYS);
  if (harp->keys[key].is_down) {
    harp->keys[key] = (HarpKey){.is_held = harp->is_pedal_down};
    harp_string_lift(&harp->strings[key]);
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

#include "core/guitar/guitar_mixer.h"

#include "core/base/finite.h"

#include <math.h>
#include <string.h>

/* How far to the right a string is, −1 to 1: the lowest is the leftmost. */
static double place_of(const GuitarPatch* patch, uint32_t string) {
  const double last = patch->n_strings - 1.0;
  const double place = last > 0.0 ? 1.0 - 2.0 * string / last : 0.0;
  return fmin(fmax(patch->width * place, -1.0), 1.0);
}

void guitar_mixer_init(GuitarMixer* mixer, double rate_hz) {
  *mixer = (GuitarMixer){.noise_make = noise_make(rate_hz)};
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    mixer->gain[s] = 1.0;
  }
}

void guitar_mixer_rest(GuitarMixer* mixer) {
  memset(mixer->noises, 0, sizeof(mixer->noises));
}

void guitar_mixer_scrape(
    GuitarMixer* mixer, uint32_t string, uint64_t seed, double hardness, double amplitude) {
  noise_scrape(&mixer->noises[string], seed, hardness, amplitude);
}

void guitar_mixer_choke(GuitarMixer* mixer, uint32_t string) {
  noise_choke(&mixer->noises[string]);
}

/* As loud in any place. */
static void pan(GuitarMixer* mixer, const GuitarPatch* patch, uint32_t voice, uint32_t n_frames) {
  const uint32_t string = voice % GUITAR_STRINGS;
  const double place = place_of(patch, string);
  const double gain = mixer->gain[string];
  line_to(&mixer->pans[voice][0], gain * sqrt(1.0 - place), n_frames);
  line_to(&mixer->pans[voice][1], gain * sqrt(1.0 + place), n_frames);
}

void guitar_mixer_set(GuitarMixer* mixer, const GuitarPatch* patch, uint32_t n_frames) {
  line_to(&mixer->level, patch->level, n_frames);
  for (int p = 0; p < GUITAR_PICKUPS; ++p) {
    line_to(&mixer->gains[p], patch->pickups[p].gain, n_frames);
  }
  for (uint32_t v = 0; v < GUITAR_VOICES; ++v) {
    pan(mixer, patch, v, n_frames);
  }
}

void guitar_mixer_set_gain(
    GuitarMixer* mixer, const GuitarPatch* patch, uint32_t string, double gain, uint32_t n_frames) {
  if (gain != mixer->gain[string]) {
    mixer->gain[string] = gain;
    pan(mixer, patch, string, n_frames);
    pan(mixer, patch, string + GUITAR_STRINGS, n_frames);
  }
}

static void fill_gains(GuitarMixer* mixer, uint32_t n_frames) {
  for (int p = 0; p < GUITAR_PICKUPS; ++p) {
    Line* const gain = &mixer->gains[p];
    mixer->now.is_read[p] = gain->value != 0.0 || gain->n_left > 0;
    line_fill(gain, n_frames, mixer->now.gain[p]);
  }
}

static void add(Line* gain, const float* from, uint32_t n_frames, float* to) {
  if (gain->n_left > 0) {
    for (uint32_t n = 0; n < n_frames; ++n) {
      to[n] += (float)line_next(gain) * from[n];
    }
  } else {
    const float still = (float)gain->value;
    for (uint32_t n = 0; n < n_frames; ++n) {
      to[n] += still * from[n];
    }
  }
}

/* `noise` is heard with it; NULL: none. */
static void run_string(GuitarMixer* mixer,
                       GuitarString* string,
                       GuitarString* tail,
                       Noise* noise,
                       Line pans[2],
                       uint32_t n_frames) {
  const bool is_noisy = noise && noise->is_active;
  const bool is_heard = string->voice.is_awake || tail->voice.is_awake || is_noisy;
  if (is_heard) {
    memset(mixer->own, 0, n_frames * sizeof(float));
  }
  guitar_string_run(string, &mixer->now, n_frames, mixer->own, NULL);
  guitar_string_run(tail, &mixer->now, n_frames, mixer->own, NULL);
  if (is_heard && !finite_all(mixer->own, n_frames)) {
    voice_mend(&string->voice);
    voice_mend(&tail->voice);
    memset(mixer->own, 0, n_frames * sizeof(float));
  }
  if (is_noisy) {
    noise_add(noise, &mixer->noise_make, n_frames, 1, (float* const[]){mixer->own});
  }
  for (int side = 0; side < 2; ++side) {
    if (is_heard) {
      add(&pans[side], mixer->own, n_frames, mixer->sides[side]);
    } else if (pans[side].n_left > 0) {
      line_fill(&pans[side], n_frames, mixer->own); /* It moves all the same. */
    }
  }
}

/* As many as can be mixed at a time. */
static void run_some(GuitarMixer* mixer,
                     GuitarString* strings,
                     GuitarString* tails,
                     uint32_t n_frames,
                     float* left,
                     float* right) {
  memset(mixer->sides[0], 0, n_frames * sizeof(float));
  memset(mixer->sides[1], 0, n_frames * sizeof(float));
  fill_gains(mixer, n_frames);
  for (uint32_t w = 0; w < GUITAR_VOICES; ++w) {
    Noise* const noise = w < GUITAR_STRINGS ? &mixer->noises[w] : NULL;
    run_string(mixer, &strings[w], &tails[w], noise, mixer->pans[w], n_frames);
  }
  line_fill(&mixer->level, n_frames, mixer->own);
  for (uint32_t n = 0; n < n_frames; ++n) {
    left[n] = mixer->own[n] * mixer->sides[0][n];
    right[n] = mixer->own[n] * mixer->sides[1][n];
  }
}

void guitar_mixer_run(GuitarMixer* mixer,
                      GuitarString* strings,
                      GuitarString* tails,
                      uint32_t n_frames,
                      float* left,
                      float* right) {
  for (uint32_t done = 0; done < n_frames;) {
    const uint32_t rest = n_frames - done;
    const uint32_t n = rest < GUITAR_MIX_FRAMES ? rest : GUITAR_MIX_FRAMES;
    run_some(mixer, strings, tails, n, left + done, right + done);
    done += n;
  }
}

#include "core/guitar/guitar_mixer.h"

#include "core/base/finite.h"
#include "core/base/maths.h"

#include <math.h>
#include <string.h>

/* What brings what is heard of a body to the loudness of the pickups. */
static const double BODY_GAIN = 3.2;

/* How far to the right a string is, −1 to 1: the lowest is the leftmost. */
static double place_of(const GuitarPatch* patch, uint32_t string) {
  const double last = patch->n_strings - 1.0;
  const double place = last > 0.0 ? 1.0 - 2.0 * string / last : 0.0;
  return fmin(fmax(patch->width * place, -1.0), 1.0);
}

void guitar_mixer_init(GuitarMixer* mixer, double rate_hz) {
  memset(mixer, 0, sizeof(*mixer));
  mixer->rate_hz = rate_hz;
  mixer->noise_make = noise_make(rate_hz);
  radiator_init(&mixer->radiator);
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    mixer->gain[s] = 1.0;
  }
}

void guitar_mixer_rest(GuitarMixer* mixer) {
  memset(mixer->noises, 0, sizeof(mixer->noises));
  radiator_rest(&mixer->radiator);
}

void guitar_mixer_take_body(GuitarMixer* mixer, const Body* body, uint32_t n_frames) {
  radiator_take_file(&mixer->radiator, body);
  mixer->n_fade = n_frames;
}

void guitar_mixer_knock(GuitarMixer* mixer, uint32_t string, double hardness, double amplitude) {
  const double gain = BODY_GAIN * mixer->level.value * mixer->ways[string][GUITAR_TO_BODY].value;
  radiator_play(&mixer->radiator, mixer->rate_hz, hardness, mixer->body.knock * gain * amplitude);
}

void guitar_mixer_scrape(
    GuitarMixer* mixer, uint32_t string, uint64_t seed, double hardness, double amplitude) {
  noise_scrape(&mixer->noises[string], seed, hardness, amplitude);
}

void guitar_mixer_choke(GuitarMixer* mixer, uint32_t string) {
  noise_choke(&mixer->noises[string]);
}

/* As loud in any place; and the body has no sides. */
static void pan(GuitarMixer* mixer, const GuitarPatch* patch, uint32_t voice, uint32_t n_frames) {
  const uint32_t string = voice % GUITAR_STRINGS;
  const double place = place_of(patch, string);
  const double gain = mixer->gain[string];
  line_to(&mixer->ways[voice][GUITAR_TO_LEFT], gain * sqrt(1.0 - place), n_frames);
  line_to(&mixer->ways[voice][GUITAR_TO_RIGHT], gain * sqrt(1.0 + place), n_frames);
  line_to(&mixer->ways[voice][GUITAR_TO_BODY], gain, n_frames);
}

void guitar_mixer_set(GuitarMixer* mixer, const GuitarPatch* patch, uint32_t n_frames) {
  mixer->body = patch->body;
  mixer->n_fade = n_frames;
  radiator_set(&mixer->radiator, &mixer->body, mixer->rate_hz, n_frames);
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

/* What nothing is heard with moves all the same. */
static void pass(Line* gain, uint32_t n_frames) {
  for (uint32_t n = 0; n < n_frames && gain->n_left > 0; ++n) {
    (void)line_next(gain);
  }
}

/* `pull` is what pulls at the body; NULL: there is none. */
static void clear(GuitarMixer* mixer, float* pull, uint32_t n_frames) {
  memset(mixer->own, 0, n_frames * sizeof(float));
  if (pull) {
    memset(pull, 0, n_frames * sizeof(float));
  }
}

/* What a string reads and pulls by, and what is left of it; what is not a number is heard by
 * nobody. */
static void run_pair(
    GuitarMixer* mixer, GuitarString* string, GuitarString* tail, float* pull, uint32_t n_frames) {
  const bool is_heard = guitar_string_is_heard(string) || guitar_string_is_heard(tail);
  guitar_string_run(string, &mixer->now, n_frames, mixer->own, pull);
  guitar_string_run(tail, &mixer->now, n_frames, mixer->own, pull);
  if (is_heard && !(finite_all(mixer->own, n_frames) && (!pull || finite_all(pull, n_frames)))) {
    guitar_string_mend(string);
    guitar_string_mend(tail);
    clear(mixer, pull, n_frames);
  }
}

/* `noise` is heard with it, and pulls as well; NULL: none. */
static void run_string(GuitarMixer* mixer,
                       GuitarString* string,
                       GuitarString* tail,
                       Noise* noise,
                       Line ways[GUITAR_WAYS],
                       uint32_t n_frames) {
  float* const pull = radiator_is_on(&mixer->radiator) ? mixer->pull : NULL;
  const float* const from[GUITAR_WAYS] = {mixer->own, mixer->own, pull};
  const bool is_noisy = noise && noise->is_active;
  const bool is_heard = guitar_string_is_heard(string) || guitar_string_is_heard(tail) || is_noisy;
  if (is_heard) {
    clear(mixer, pull, n_frames);
  }
  run_pair(mixer, string, tail, pull, n_frames);
  if (is_noisy) {
    noise_add(noise, &mixer->noise_make, n_frames, pull ? 2 : 1,
              (float* const[]){mixer->own, pull});
  }
  for (int way = 0; way < GUITAR_WAYS; ++way) {
    if (is_heard && from[way]) {
      add(&ways[way], from[way], n_frames, mixer->sums[way]);
    } else {
      pass(&ways[way], n_frames);
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
  for (int way = 0; way < GUITAR_WAYS; ++way) {
    memset(mixer->sums[way], 0, n_frames * sizeof(float));
  }
  fill_gains(mixer, n_frames);
  for (uint32_t w = 0; w < GUITAR_VOICES; ++w) {
    Noise* const noise = w < GUITAR_STRINGS ? &mixer->noises[w] : NULL;
    run_string(mixer, &strings[w], &tails[w], noise, mixer->ways[w], n_frames);
  }
  line_fill(&mixer->level, n_frames, mixer->own);
  for (uint32_t n = 0; n < n_frames; ++n) {
    left[n] = mixer->own[n] * mixer->sums[GUITAR_TO_LEFT][n];
    right[n] = mixer->own[n] * mixer->sums[GUITAR_TO_RIGHT][n];
    mixer->sums[GUITAR_TO_BODY][n] *= (float)BODY_GAIN * mixer->own[n];
  }
  radiator_run(&mixer->radiator, mixer->sums[GUITAR_TO_BODY], n_frames, left, right);
}

void guitar_mixer_run(GuitarMixer* mixer,
                      GuitarString* strings,
                      GuitarString* tails,
                      uint32_t n_frames,
                      float* left,
                      float* right) {
  for (uint32_t done = 0; done < n_frames;) {
    radiator_set(&mixer->radiator, &mixer->body, mixer->rate_hz, mixer->n_fade);
    const uint32_t most = least(GUITAR_MIX_FRAMES, radiator_stretch(&mixer->radiator));
    const uint32_t n = least(n_frames - done, most);
    run_some(mixer, strings, tails, n, left + done, right + done);
    done += n;
  }
}

#include "core/guitar/guitar.h"

#include "core/base/aligned.h"
#include "core/base/chance.h"
#include "core/base/maths.h"
#include "core/guitar/guitar_mixer.h"
#include "core/guitar/guitar_string.h"

#include <math.h>
#include <string.h>

/* A finger that falls or pulls off, against a pluck of the same force. */
static const double HAMMER_GAIN = 0.4;
static const double HAMMER_HARDNESS = 0.4;

/* What is heard of a pluck, of its amplitude. */
static const double NOISE_GAIN = 1.2;

/* The strings beside the others: an octave higher but for the highest third, and a little sharp, so
 * that they beat [semitones]. */
static const double COURSE_DETUNE = 0.03;

struct Guitar {
  double rate_hz;
  uint32_t n_gesture;
  GuitarPatch patch; /* With the palm's weight in it */
  double palm;       /* The patch's */
  double weight;     /* What guitar_palm() adds */
  GuitarString strings[GUITAR_VOICES];
  GuitarString tails[GUITAR_VOICES]; /* What they did before they were plucked again */
  void* memory;                      /* Of all strings; owned */
  GuitarMixer mixer;
  uint32_t n_noises; /* That were made, heard or not, since all was still */

  /* What each key has on each channel, against equal temperament [semitones] */
  double detuning[PERFORMANCE_CHANNELS][PERFORMANCE_KEYS];
};

/* In frames, no shorter than a gesture. */
static uint32_t frames_of(const Guitar* guitar, double time_s) {
  const double frames = round(time_s * guitar->rate_hz);
  return (uint32_t)clamp(frames, guitar->n_gesture, (double)INT32_MAX);
}

/* A string and the one beside it: `side` 0 and 1. */
static GuitarString* string_of(Guitar* guitar, uint32_t string, int side) {
  return &guitar->strings[string + (side ? GUITAR_STRINGS : 0)];
}

static GuitarString* tail_of(Guitar* guitar, const GuitarString* string) {
  return &guitar->tails[string - guitar->strings];
}

static bool has(const Guitar* guitar, uint32_t string) {
  return string < guitar->patch.n_strings;
}

static double beside(const GuitarPatch* patch, uint32_t string) {
  return (3 * string < patch->n_strings ? 0.0 : 12.0) + COURSE_DETUNE;
}

static void set_palm(Guitar* guitar) {
  guitar->patch.palm = fmin(1.0, guitar->palm + guitar->weight);
}

/* Of a note, which may lie between keys or beyond them. */
static double detuning_at(const Guitar* guitar, uint32_t channel, double note) {
  const double* const keys = guitar->detuning[channel];
  const double inside = clamp(note, 0.0, PERFORMANCE_KEYS - 1.0);
  const uint32_t below = least((uint32_t)inside, PERFORMANCE_KEYS - 2);
  const double share = inside - below;
  return keys[below] + share * (keys[below + 1] - keys[below]);
}

/* Tune a string as its key is, and say how far from there a fret is, in semitones. */
static double stop_at(const Guitar* guitar, uint32_t string, GuitarString* s, double fret) {
  const double nut = guitar->patch.open[string] + guitar->patch.capo;
  s->detuning = detuning_at(guitar, s->channel, nut);
  s->fret = fret;
  return fret + (detuning_at(guitar, s->channel, nut + fret) - s->detuning);
}

/* Put a string where its fret is now. */
static void tune(Guitar* guitar, uint32_t string, GuitarString* s, uint32_t n_frames) {
  const double before = s->detuning;
  const double stop = stop_at(guitar, string, s, s->fret);
  if (stop != guitar_string_fretted(s)) {
    guitar_string_slide(s, stop, n_frames);
  } else if (s->detuning != before) {
    guitar_string_follow(s, n_frames);
  }
}

static void follow_all(Guitar* guitar, uint32_t n_frames) {
  for (uint32_t w = 0; w < GUITAR_VOICES; ++w) {
    guitar_string_follow(&guitar->strings[w], n_frames);
  }
}

double guitar_force(uint32_t velocity) {
  const double share = velocity / 127.0;
  return share * share;
}

double guitar_hardness(double hardness, double force) {
  return clamp(pluck_played(hardness, pluck_softness(sqrt(fabs(force)))), 0.0, 1.0);
}

Guitar* guitar_new(double rate_hz) {
  Guitar* const guitar =
      isfinite(rate_hz) && rate_hz > 0.0 ? aligned_new(_Alignof(Guitar), sizeof(Guitar)) : NULL;
  if (!guitar) {
    return NULL;
  }
  memset(guitar, 0, sizeof(*guitar));
  const size_t size = chain_size(GUITAR_MAX_MASSES);
  guitar->rate_hz = rate_hz;
  guitar->n_gesture = voice_gesture_frames(rate_hz);
  guitar->memory = aligned_new(CHAIN_ALIGNMENT, 2 * GUITAR_VOICES * size);
  if (!guitar->memory) {
    guitar_free(guitar);
    return NULL;
  }
  memset(guitar->memory, 0, 2 * GUITAR_VOICES * size);
  for (uint32_t w = 0; w < GUITAR_VOICES; ++w) {
    char* const memory = (char*)guitar->memory + 2 * w * size;
    guitar_string_init(&guitar->strings[w], &guitar->patch, rate_hz, w, memory);
    guitar_string_init(&guitar->tails[w], &guitar->patch, rate_hz, w, memory + size);
  }
  guitar_mixer_init(&guitar->mixer, rate_hz);
  return guitar;
}

void guitar_free(Guitar* guitar) {
  if (guitar) {
    aligned_free(guitar->memory);
    aligned_free(guitar);
  }
}

double guitar_rate_hz(const Guitar* guitar) {
  return guitar->rate_hz;
}

void guitar_reset(Guitar* guitar) {
  for (uint32_t w = 0; w < GUITAR_VOICES; ++w) {
    guitar_string_reset(&guitar->strings[w]);
    guitar_string_reset(&guitar->tails[w]);
    tune(guitar, w % GUITAR_STRINGS, &guitar->strings[w], 0);
  }
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    guitar_mixer_set_gain(&guitar->mixer, &guitar->patch, s, 1.0, 0);
  }
  guitar_mixer_rest(&guitar->mixer);
  guitar->n_noises = 0;
  guitar->weight = 0.0;
  set_palm(guitar);
}

void guitar_set_patch(Guitar* guitar, const GuitarPatch* patch, uint32_t n_frames) {
  const uint32_t n_glide =
      n_frames > 0 && n_frames < guitar->n_gesture ? guitar->n_gesture : n_frames;
  const GuitarPatch before = guitar->patch;
  guitar->patch = *patch;
  guitar->palm = patch->palm;
  set_palm(guitar);
  guitar_mixer_set(&guitar->mixer, &guitar->patch, n_glide);
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    string_of(guitar, s, 0)->open = patch->open[s];
    string_of(guitar, s, 1)->open = patch->open[s] + beside(patch, s);
    const bool is_moved = patch->open[s] != before.open[s] || patch->capo != before.capo;
    for (int side = 0; side < 2; ++side) {
      if (is_moved) {
        tune(guitar, s, string_of(guitar, s, side), n_glide);
      }
      if (!has(guitar, s)) {
        guitar_string_damp(string_of(guitar, s, side), GUITAR_CHOKED, 0);
      }
    }
  }
  follow_all(guitar, n_glide);
}

void guitar_set_body(Guitar* guitar, const Body* body) {
  guitar_mixer_take_body(&guitar->mixer, body, guitar->n_gesture);
}

/* What a key without a pitch has is between those of its neighbours that have one. */
static void fill_gaps(double detuning[PERFORMANCE_KEYS]) {
  uint32_t last = PERFORMANCE_KEYS;
  for (uint32_t key = 0; key <= PERFORMANCE_KEYS; ++key) {
    const bool is_end = key == PERFORMANCE_KEYS;
    if (!is_end && isnan(detuning[key])) {
      continue;
    }
    const uint32_t first = last == PERFORMANCE_KEYS ? 0 : last + 1;
    for (uint32_t gap = first; gap < key; ++gap) {
      const double below = last == PERFORMANCE_KEYS ? is_end ? 0.0 : detuning[key] : detuning[last];
      const double above = is_end ? below : detuning[key];
      const double share = (double)(gap + 1 - first) / (double)(key + 1 - first);
      detuning[gap] = below + share * (above - below);
    }
    last = key;
  }
}

void guitar_set_scale(Guitar* guitar,
                      uint32_t channel,
                      const double semitones[PERFORMANCE_KEYS],
                      bool is_live) {
  double* const detuning = guitar->detuning[channel];
  for (uint32_t key = 0; key < PERFORMANCE_KEYS; ++key) {
    detuning[key] = semitones[key] - ((double)key - 69.0);
  }
  fill_gaps(detuning);
  for (uint32_t w = 0; w < GUITAR_VOICES; ++w) {
    GuitarString* const s = &guitar->strings[w];
    if (s->channel == channel && (is_live || !s->voice.is_awake)) {
      tune(guitar, w % GUITAR_STRINGS, s, guitar->n_gesture);
    }
  }
}

void guitar_follow_channel(Guitar* guitar, uint32_t string, uint32_t channel) {
  for (int side = 0; has(guitar, string) && side < 2; ++side) {
    string_of(guitar, string, side)->channel = channel;
  }
}

static bool is_still(const Guitar* guitar) {
  bool is_still = true;
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    is_still = is_still && !guitar_is_awake(guitar, s);
  }
  return is_still;
}

/* A finger is heard, whichever way it goes. */
static void make_noise(Guitar* guitar, uint32_t string, double hardness, double force) {
  const double amplitude = NOISE_GAIN * guitar->patch.noise * fabs(force);
  guitar->n_noises = is_still(guitar) ? 0 : guitar->n_noises + 1;
  if (has(guitar, string) && amplitude > 0.0) {
    guitar_mixer_scrape(&guitar->mixer, string, chance_bits(string, guitar->n_noises), hardness,
                        GUITAR_NOTE_PEAK * amplitude);
  }
}

/* The hand is in the wood as well. */
static void knock(Guitar* guitar, uint32_t string, double hardness, double force) {
  if (has(guitar, string)) {
    guitar_mixer_knock(&guitar->mixer, string, hardness, GUITAR_NOTE_PEAK * fabs(force));
  }
}

void guitar_pluck(Guitar* guitar, uint32_t string, GuitarPluck pluck) {
  const GuitarPatch* const patch = &guitar->patch;
  const double place = isnan(pluck.place) ? patch->pluck : pluck.place;
  const bool is_usual = isnan(pluck.hardness);
  const double hardness = is_usual ? guitar_hardness(patch->hardness, pluck.force) : pluck.hardness;
  make_noise(guitar, string, hardness, pluck.force);
  knock(guitar, string, hardness, pluck.force);
  for (int side = 0; has(guitar, string) && side < 2; ++side) {
    GuitarString* const s = string_of(guitar, string, side);
    const double share = side ? guitar->patch.course : 1.0;
    if (share > 0.0 || s->voice.is_awake) {
      const Pluck own = {
          .place = guitar_string_place(s, place),
          .hardness = is_usual ? patch->hardness : pluck.hardness,
          .amplitude = GUITAR_NOTE_PEAK * share * pluck.force,
          .softness = is_usual ? pluck_softness(sqrt(fabs(pluck.force))) : 0.0,
      };
      guitar_string_leave(s, tail_of(guitar, s));
      guitar_string_pluck(s, own);
    }
  }
}

void guitar_fret(Guitar* guitar, uint32_t string, double fret) {
  guitar_slide(guitar, string, fret, 0.0);
}

void guitar_hammer(Guitar* guitar, uint32_t string, double fret, double force) {
  make_noise(guitar, string, HAMMER_HARDNESS, HAMMER_GAIN * force);
  knock(guitar, string, HAMMER_HARDNESS, HAMMER_GAIN * force);
  for (int side = 0; has(guitar, string) && side < 2; ++side) {
    GuitarString* const s = string_of(guitar, string, side);
    const double share = side ? guitar->patch.course : 1.0;
    const double stop = stop_at(guitar, string, s, fret);
    const double frets = guitar_string_fretted(s) - stop;
    guitar_string_slide(s, stop, guitar->n_gesture);
    if (share > 0.0 || s->voice.is_awake) {
      const Pluck own = {
          .place = fmin(exp2(-fmax(frets, 0.0) / 12.0), GUITAR_FARTHEST),
          .hardness = HAMMER_HARDNESS,
          .amplitude = GUITAR_NOTE_PEAK * HAMMER_GAIN * share * force,
      };
      guitar_string_pluck(s, own);
    }
  }
}

void guitar_slide(Guitar* guitar, uint32_t string, double fret, double time_s) {
  for (int side = 0; has(guitar, string) && side < 2; ++side) {
    GuitarString* const s = string_of(guitar, string, side);
    guitar_string_slide(s, stop_at(guitar, string, s, fret), frames_of(guitar, time_s));
  }
}

void guitar_bend(Guitar* guitar, uint32_t string, double semitones, double time_s) {
  for (int side = 0; has(guitar, string) && side < 2; ++side) {
    guitar_string_bend(string_of(guitar, string, side), semitones, frames_of(guitar, time_s));
  }
}

void guitar_vibrato(Guitar* guitar, uint32_t string, double depth, double rate_hz) {
  for (int side = 0; has(guitar, string) && side < 2; ++side) {
    guitar_string_vibrato(string_of(guitar, string, side), depth, rate_hz / guitar->rate_hz);
  }
}

void guitar_damp(Guitar* guitar, uint32_t string, double time_s) {
  for (int side = 0; has(guitar, string) && side < 2; ++side) {
    guitar_string_damp(string_of(guitar, string, side), GUITAR_DAMPED,
                       isinf(time_s) ? 0 : frames_of(guitar, time_s));
  }
}

void guitar_let_ring(Guitar* guitar, uint32_t string) {
  for (int side = 0; has(guitar, string) && side < 2; ++side) {
    guitar_string_damp(string_of(guitar, string, side), GUITAR_RINGING, 0);
  }
}

void guitar_touch(Guitar* guitar, uint32_t string, double place, double time_s) {
  for (int side = 0; has(guitar, string) && side < 2; ++side) {
    guitar_string_touch(string_of(guitar, string, side), place, frames_of(guitar, time_s));
  }
}

void guitar_palm(Guitar* guitar, double weight) {
  guitar->weight = weight;
  set_palm(guitar);
  follow_all(guitar, guitar->n_gesture);
}

void guitar_choke(Guitar* guitar) {
  for (uint32_t w = 0; w < GUITAR_VOICES; ++w) {
    guitar_string_damp(&guitar->strings[w], GUITAR_CHOKED, 0);
    guitar_string_untouch(&guitar->strings[w]);
  }
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    guitar_mixer_choke(&guitar->mixer, s);
  }
  radiator_choke(&guitar->mixer.radiator);
}

/* The body of strings that are choked, all of them, is so too. */
static void choke_body(Guitar* guitar) {
  bool is_heard = false;
  for (uint32_t w = 0; w < GUITAR_VOICES; ++w) {
    const Voice* const voice = &guitar->strings[w].voice;
    is_heard = is_heard || (voice->is_awake && !voice->is_choked);
  }
  if (!is_heard) {
    radiator_choke(&guitar->mixer.radiator);
  }
}

void guitar_choke_string(Guitar* guitar, uint32_t string) {
  if (string < GUITAR_STRINGS) {
    guitar_mixer_choke(&guitar->mixer, string);
  }
  for (int side = 0; string < GUITAR_STRINGS && side < 2; ++side) {
    GuitarString* const s = string_of(guitar, string, side);
    guitar_string_damp(s, GUITAR_CHOKED, 0);
    guitar_string_untouch(s);
  }
  choke_body(guitar);
}

void guitar_set_gain(Guitar* guitar, uint32_t string, double gain) {
  if (string < GUITAR_STRINGS) {
    guitar_mixer_set_gain(&guitar->mixer, &guitar->patch, string, gain,
                          guitar_is_awake(guitar, string) ? guitar->n_gesture : 0);
  }
}

bool guitar_is_awake(const Guitar* guitar, uint32_t string) {
  return has(guitar, string) && (guitar->strings[string].voice.is_awake ||
                                 guitar->strings[string + GUITAR_STRINGS].voice.is_awake);
}

double guitar_fretted(const Guitar* guitar, uint32_t string) {
  return has(guitar, string) ? guitar_string_fretted(&guitar->strings[string]) : 0.0;
}

VoiceReport guitar_report(const Guitar* guitar) {
  VoiceReport report = {.headroom = 1.0};
  for (uint32_t w = 0; w < GUITAR_VOICES; ++w) {
    voice_report(&guitar->strings[w].voice, &report);
    voice_report(&guitar->tails[w].voice, &report);
  }
  return report;
}

void guitar_run(Guitar* guitar, uint32_t n_frames, float* left, float* right) {
  guitar_mixer_run(&guitar->mixer, guitar->strings, guitar->tails, n_frames, left, right);
}

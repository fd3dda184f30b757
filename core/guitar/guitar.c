#include "core/guitar/guitar.h"

#include "core/base/aligned.h"
#include "core/base/maths.h"
#include "core/guitar/guitar_mixer.h"
#include "core/guitar/guitar_string.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A finger that falls or pulls off, against a pluck of the same force. */
static const double HAMMER_GAIN = 0.4;
static const double HAMMER_HARDNESS = 0.4;

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
  const double harder = PLUCK_HARDER * (sqrt(fabs(force)) - PLUCK_USUAL_FORCE);
  return clamp(hardness + harder, 0.0, 1.0);
}

Guitar* guitar_new(double rate_hz) {
  Guitar* const guitar = isfinite(rate_hz) && rate_hz > 0.0 ? calloc(1, sizeof(Guitar)) : NULL;
  if (!guitar) {
    return NULL;
  }
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
  guitar_mixer_init(&guitar->mixer);
  return guitar;
}

void guitar_free(Guitar* guitar) {
  if (guitar) {
    aligned_free(guitar->memory);
    free(guitar);
  }
}

double guitar_rate_hz(const Guitar* guitar) {
  return guitar->rate_hz;
}

void guitar_reset(Guitar* guitar) {
  for (uint32_t w = 0; w < GUITAR_VOICES; ++w) {
    guitar_string_reset(&guitar->strings[w]);
    guitar_string_reset(&guitar->tails[w]);
  }
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    guitar_mixer_set_gain(&guitar->mixer, &guitar->patch, s, 1.0, 0);
  }
  guitar->weight = 0.0;
  set_palm(guitar);
}

void guitar_set_patch(Guitar* guitar, const GuitarPatch* patch, uint32_t n_frames) {
  const uint32_t n_glide =
      n_frames > 0 && n_frames < guitar->n_gesture ? guitar->n_gesture : n_frames;
  guitar->patch = *patch;
  guitar->palm = patch->palm;
  set_palm(guitar);
  guitar_mixer_set(&guitar->mixer, &guitar->patch, n_glide);
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    string_of(guitar, s, 0)->open = patch->open[s];
    string_of(guitar, s, 1)->open = patch->open[s] + beside(patch, s);
    for (int side = 0; !has(guitar, s) && side < 2; ++side) {
      guitar_string_damp(string_of(guitar, s, side), GUITAR_CHOKED, 0);
    }
  }
  follow_all(guitar, n_glide);
}

void guitar_pluck(Guitar* guitar, uint32_t string, GuitarPluck pluck) {
  const GuitarPatch* const patch = &guitar->patch;
  const double place = isnan(pluck.place) ? patch->pluck : pluck.place;
  for (int side = 0; has(guitar, string) && side < 2; ++side) {
    GuitarString* const s = string_of(guitar, string, side);
    const double share = side ? guitar->patch.course : 1.0;
    if (share > 0.0 || s->voice.is_awake) {
      const Pluck own = {
          .place = guitar_string_place(s, place),
          .hardness = isnan(pluck.hardness) ? guitar_hardness(patch->hardness, pluck.force)
                                            : pluck.hardness,
          .amplitude = GUITAR_NOTE_PEAK * share * pluck.force,
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
  for (int side = 0; has(guitar, string) && side < 2; ++side) {
    GuitarString* const s = string_of(guitar, string, side);
    const double share = side ? guitar->patch.course : 1.0;
    const double frets = guitar_string_fretted(s) - fret;
    guitar_string_slide(s, fret, guitar->n_gesture);
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
    guitar_string_slide(string_of(guitar, string, side), fret, frames_of(guitar, time_s));
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
}

void guitar_choke_string(Guitar* guitar, uint32_t string) {
  for (int side = 0; string < GUITAR_STRINGS && side < 2; ++side) {
    GuitarString* const s = string_of(guitar, string, side);
    guitar_string_damp(s, GUITAR_CHOKED, 0);
    guitar_string_untouch(s);
  }
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

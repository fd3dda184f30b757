#include "core/guitar/guitar_string.h"

#include "core/excite/finger.h"
#include "core/guitar/guitar_tone.h"

#include <math.h>

/* Time in which a choked string has died away far enough for another to take its place [s]. */
static const double LEFT_S = 5.0 * VOICE_CHOKE_S;

static uint32_t least(uint32_t a, uint32_t b) {
  return a < b ? a : b;
}

/* A pitch that cannot be had chokes it at the one that it has. */
static void retune(GuitarString* string, const GuitarPatch* patch, uint32_t n_glide) {
  Voice* const voice = &string->voice;
  TuningTarget target = guitar_tone(string, patch);
  if (voice->is_awake && !voice_retune(voice, &target, n_glide)) {
    string->damper = GUITAR_CHOKED;
    target = guitar_tone(string, patch);
    target.tone.f0_hz = voice->f0_hz;
    if (!voice_retune(voice, &target, n_glide)) {
      voice_sleep(voice);
    }
  }
  voice_choke(voice, string->damper == GUITAR_CHOKED);
}

/* Masses between the bridge and where it will be stopped. */
static uint32_t masses_wanted(const GuitarString* string, const GuitarPatch* patch) {
  return guitar_string_masses(string->n_open, guitar_tone_frets(patch, string->motion.fret.goal));
}

/* What becomes shorter has fewer masses from the beginning of its way on. */
static void shorten(GuitarString* string, const GuitarPatch* patch) {
  const uint32_t n_masses = masses_wanted(string, patch);
  if (string->voice.is_awake && n_masses < string->voice.chain.n_masses) {
    const TuningTarget target = guitar_tone(string, patch);
    voice_mesh(&string->voice, &target, n_masses);
  }
}

/* And what becomes longer has more at its end. */
static void lengthen(GuitarString* string, const GuitarPatch* patch) {
  if (string->voice.is_awake && string->voice.chain.n_masses < masses_wanted(string, patch)) {
    const TuningTarget target = guitar_tone(string, patch);
    const uint32_t n_masses = tuning_max_masses(&target, masses_wanted(string, patch));
    if (n_masses > string->voice.chain.n_masses) {
      voice_mesh(&string->voice, &target, n_masses);
    }
  }
}

/* What comes in the middle of a piece finds the motion where it is, not at the end of the piece. */
static void halt(GuitarString* string) {
  if (string->is_moving && string->n_piece > 0) {
    string->motion = string->begun;
    guitar_motion_go(&string->motion, string->n_piece - string->n_until_piece);
  }
  string->n_piece = 0;
}

/* Something in its motion has changed: its pieces begin now. */
static void start(GuitarString* string, const GuitarPatch* patch) {
  shorten(string, patch);
  string->is_moving = true;
  string->n_until_piece = 0;
  string->n_fade = string->n_gesture;
}

/* The next piece of its motion, or after the last the masses that it has room for. */
static void begin_piece(GuitarString* string, const GuitarPatch* patch) {
  string->n_piece = 0;
  if (guitar_motion_is_still(&string->motion)) {
    string->is_moving = false;
    lengthen(string, patch);
    retune(string, patch, string->n_gesture);
  } else {
    string->begun = string->motion;
    string->n_piece = guitar_motion_piece(&string->motion);
    string->n_until_piece = string->n_piece;
    guitar_motion_go(&string->motion, string->n_piece);
    retune(string, patch, string->n_until_piece);
  }
}

static void places_of(const GuitarString* string, const GuitarPatch* patch, double* places) {
  for (int p = 0; p < GUITAR_PICKUPS; ++p) {
    places[p] = guitar_string_place(string, patch, patch->pickups[p].place);
  }
}

/* From rest, with the masses of the open string that are not stopped. */
static bool restring(GuitarString* string, const GuitarPatch* patch) {
  const TuningTarget open = guitar_tone_open(string, patch);
  const uint32_t n_open =
      tuning_max_masses(&open, least(patch->string.max_masses, string->voice.capacity));
  double places[GUITAR_PICKUPS];
  string->n_open = n_open > 0 ? n_open : 1;
  const TuningTarget target = guitar_tone(string, patch);
  places_of(string, patch, places);
  guitar_reading_set(&string->reading, places);
  return voice_string(&string->voice, &target, masses_wanted(string, patch));
}

/* Plucked at the beginning of a gesture, it is heard at its end: on the way the square of its
 * amplitude times its frequency stays as it is. */
static double gesture_gain(const GuitarString* string) {
  const GuitarLine* const fret = &string->motion.fret;
  return fret->n_left <= string->n_gesture ? exp2((fret->goal - fret->value) / 24.0) : 1.0;
}

void guitar_string_init(GuitarString* string, double rate_hz, uint32_t phase, void* memory) {
  *string = (GuitarString){.n_gesture = voice_gesture_frames(rate_hz)};
  voice_init(&string->voice, rate_hz, phase, memory, GUITAR_MAX_MASSES);
  string->n_fade = string->n_gesture;
}

void guitar_string_reset(GuitarString* string) {
  voice_sleep(&string->voice);
  voice_choke(&string->voice, false);
  string->motion = (GuitarMotion){0};
  ramp_init(&string->touch, 0.0f);
  string->damper = GUITAR_RINGING;
  string->n_damped = 0;
  string->n_touched = 0;
  string->is_moving = false;
}

uint32_t guitar_string_masses(uint32_t n_open, double frets) {
  return (uint32_t)fmax(1.0, round((n_open + 1.0) * exp2(-frets / 12.0)) - 1.0);
}

double guitar_string_place(const GuitarString* string, const GuitarPatch* patch, double place) {
  const double frets = guitar_tone_frets(patch, string->motion.fret.goal);
  return fmin(place * exp2(frets / 12.0), GUITAR_FARTHEST);
}

void guitar_string_follow(GuitarString* string, const GuitarPatch* patch, uint32_t n_glide) {
  string->n_fade = n_glide > string->n_gesture ? n_glide : string->n_gesture;
  if (string->voice.is_awake && guitar_motion_is_still(&string->motion)) {
    shorten(string, patch);
    retune(string, patch, string->n_fade);
    string->is_moving = true;
    string->n_piece = 0;
    string->n_until_piece = string->n_fade;
  }
}

void guitar_string_slide(GuitarString* string,
                         const GuitarPatch* patch,
                         double fret,
                         uint32_t n_frames) {
  const bool is_at_once = !string->voice.is_awake && n_frames <= string->n_gesture;
  halt(string);
  guitar_line_to(&string->motion.fret, fret, is_at_once ? 0 : n_frames);
  start(string, patch);
}

void guitar_string_bend(GuitarString* string,
                        const GuitarPatch* patch,
                        double semitones,
                        uint32_t n_frames) {
  const bool is_at_once = !string->voice.is_awake && n_frames <= string->n_gesture;
  halt(string);
  guitar_line_to(&string->motion.bend, semitones, is_at_once ? 0 : n_frames);
  start(string, patch);
}

void guitar_string_vibrato(GuitarString* string,
                           const GuitarPatch* patch,
                           double depth,
                           double rate) {
  halt(string);
  guitar_line_to(&string->motion.depth, depth, string->n_gesture);
  string->motion.rate = rate;
  start(string, patch);
}

void guitar_string_leave(GuitarString* string, GuitarString* rest, const GuitarPatch* patch) {
  const bool is_taken = rest->voice.is_awake && rest->voice.n_choked < LEFT_S * rest->voice.rate_hz;
  if (!string->voice.is_awake || is_taken) {
    return;
  }
  Voice idle = rest->voice;
  GuitarLine* const fret = &string->motion.fret;
  voice_sleep(&idle);
  halt(string);
  *rest = *string;
  string->voice = idle;
  guitar_line_to(&rest->motion.fret, fret->value, 0);
  rest->n_touched = 0;
  ramp_init(&rest->touch, 0.0f);
  rest->damper = GUITAR_RINGING;
  guitar_string_damp(rest, patch, GUITAR_CHOKED, 0);
  if (fret->n_left <= string->n_gesture) {
    guitar_line_to(fret, fret->goal, 0);
  }
}

void guitar_string_pluck(GuitarString* string, const GuitarPatch* patch, Pluck pluck) {
  if (string->damper != GUITAR_RINGING) {
    guitar_string_damp(string, patch, GUITAR_RINGING, 0);
  }
  if (string->voice.is_awake || restring(string, patch)) {
    pluck.amplitude *= gesture_gain(string);
    voice_pluck(&string->voice, pluck);
  }
}

void guitar_string_damp(GuitarString* string,
                        const GuitarPatch* patch,
                        GuitarDamper damper,
                        uint32_t n_frames) {
  if (damper == GUITAR_DAMPED && string->damper == GUITAR_CHOKED) {
    return; /* A finger more keeps nothing ringing, nor does it when it lifts. */
  }
  string->damper = damper;
  string->n_damped = n_frames;
  voice_choke(&string->voice, damper == GUITAR_CHOKED);
  guitar_string_follow(string, patch, string->n_gesture);
}

void guitar_string_touch(GuitarString* string, double place, uint32_t n_frames) {
  string->touched = place;
  string->n_touched = n_frames;
  ramp_to(&string->touch, 1.0f, string->n_gesture);
}

void guitar_string_untouch(GuitarString* string) {
  string->n_touched = least(string->n_touched, string->n_gesture);
}

/* The finger comes in a gesture, and goes in one. */
static void touch(GuitarString* string) {
  const float coming = ramp_next(&string->touch);
  const double going = fmin(1.0, (double)string->n_touched / string->n_gesture);
  if (string->voice.is_awake) {
    finger_act(&string->voice.chain, string->touched, going * (double)coming);
  }
  if (--string->n_touched == 0) {
    ramp_init(&string->touch, 0.0f);
  }
}

/* Frames until something happens to it. */
static uint32_t stretch(const GuitarString* string) {
  uint32_t n = guitar_reading_stretch(&string->reading);
  n = string->voice.is_awake ? least(n, voice_stretch(&string->voice)) : n;
  n = string->is_moving ? least(n, string->n_until_piece) : n;
  n = string->n_damped > 0 ? least(n, string->n_damped) : n;
  return string->n_touched > 0 ? 1 : n;
}

static void pass(GuitarString* string, const GuitarPatch* patch, uint32_t n_frames) {
  string->n_until_piece -= string->is_moving ? n_frames : 0;
  if (string->n_touched > 0) {
    touch(string);
  }
  if (string->voice.is_awake) {
    voice_pass(&string->voice, n_frames);
  }
  if (string->n_damped > 0) {
    string->n_damped -= n_frames;
    if (string->n_damped == 0) {
      guitar_string_damp(string, patch, GUITAR_RINGING, 0);
    }
  }
}

void guitar_string_run(GuitarString* string,
                       const GuitarPatch* patch,
                       const GuitarGains* gains,
                       uint32_t n_frames,
                       float* out) {
  for (uint32_t done = 0; done < n_frames;) {
    if (string->is_moving && string->n_until_piece == 0) {
      begin_piece(string, patch);
    }
    if (string->voice.is_awake && string->reading.fade.n_left == 0) {
      double places[GUITAR_PICKUPS];
      places_of(string, patch, places);
      guitar_reading_move(&string->reading, places, string->n_fade);
    }
    const uint32_t n = least(n_frames - done, stretch(string));
    if (string->voice.is_awake) {
      guitar_reading_run(&string->reading, &string->voice.chain, gains, done, n, out + done);
    }
    pass(string, patch, n);
    done += n;
  }
}

#include "core/harp/harp_string.h"

#include "core/harp/harp_balance.h"
#include "core/harp/harp_target.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* A hammer's mass, as a share of the string's. */
static const double HAMMER_MASS = 0.25;

/* As far from the nearer wall as hammers and bows go, of the length. */
static const double FARTHEST_STRIKE = 0.47;
static const double FARTHEST_BOW = 0.15;

/* How long a bow takes to come to its speed, and to be lifted [s]. */
static const double BOW_ATTACK_S = 0.04;
static const double BOW_RELEASE_S = 0.03;

/* Vibrato that full pressure asks for [semitones]. */
static const double PRESSED_VIBRATO = 0.5;

static uint32_t least(uint32_t a, uint32_t b) {
  return a < b ? a : b;
}

bool harp_string_is_touched(const HarpString* string) {
  return string->hammer.is_active || string->bow.is_active;
}

/* What is at it sees that something else has moved it. */
static void look(HarpString* string) {
  if (string->hammer.is_active) {
    hammer_look(&string->hammer, &string->voice.chain);
  }
  if (string->bow.is_active) {
    bow_look(&string->bow, &string->voice.chain);
  }
}

/* Nothing is left at a string that sleeps. */
static void leave(HarpString* string) {
  string->hammer.is_active = false;
  string->bow.is_active = false;
  string->ear.is_active = false;
}

/* A pluck gives a ringing string the masses back that a bend took. */
static void mesh_for_pluck(HarpString* string, const HarpPatch* patch) {
  if (string->voice.chain.n_masses < string->n_strung) {
    const TuningTarget target = harp_target(string, patch, harp_string_pitch_hz(string, patch));
    const uint32_t n_masses = tuning_max_masses(&target, string->n_strung);
    if (n_masses > string->voice.chain.n_masses) {
      voice_mesh(&string->voice, &target, n_masses);
    }
  }
}

double harp_string_pitch_hz(const HarpString* string, const HarpPatch* patch) {
  return patch->string.tuning_hz * exp2((string->semitones + string->touch.bend) / 12.0);
}

void harp_string_init(
    HarpString* string, double rate_hz, uint32_t key, void* memory, uint32_t capacity) {
  *string = (HarpString){.key = key, .semitones = (double)key - 69.0, .touch = HARP_TOUCH_NONE};
  voice_init(&string->voice, rate_hz, key, memory, capacity);
}

void harp_string_rest(HarpString* string) {
  voice_sleep(&string->voice);
  leave(string);
  string->touch = HARP_TOUCH_NONE;
  string->vibrato = (Vibrato){0};
  string->tie = (Tie){0};
  string->lift = 0.0;
  string->has_acted = false;
  string->channel = 0;
  string->holders = 0;
  string->is_caught = false;
  string->is_let_go = false;
  string->leaned_on = 0.0;
}

static double pressure_of(const HarpString* string) {
  return fmax(string->touch.pressure, string->leaned_on);
}

static double vibrato_of(const HarpString* string) {
  const double pressed = string->bow.is_active ? 0.0 : PRESSED_VIBRATO * pressure_of(string);
  return string->touch.vibrato + pressed;
}

/* Bring it to where it is to be after `n_glide` frames. */
static bool glide(HarpString* string, const HarpPatch* patch, uint32_t n_glide) {
  const double swing = exp2(vibrato_semitones(&string->vibrato) / 12.0);
  const double f0_hz = swing * harp_string_pitch_hz(string, patch);
  const TuningTarget wanted = harp_target(string, patch, f0_hz);
  const TuningTarget target = intonation_retune(&string->ear, &wanted, n_glide);
  const bool is_had = tie_retune(&string->tie, string->bridge, &string->voice, &target,
                                 harp_target_hold(string, patch), n_glide);
  string->voice.f0_hz = is_had ? f0_hz : string->voice.f0_hz;
  return is_had;
}

static bool restring(HarpString* string, const HarpPatch* patch, uint32_t n_glide) {
  voice_choke(&string->voice, false);
  const TuningTarget target = harp_target(string, patch, harp_string_pitch_hz(string, patch));
  const bool is_strung = voice_string(&string->voice, &target, patch->string.max_masses);
  string->n_strung = is_strung ? string->voice.chain.n_masses : 0;
  string->vibrato = (Vibrato){0};
  string->tie = (Tie){0};
  if (is_strung && harp_target_hold(string, patch).lever > 0.0) {
    glide(string, patch, 0);
    tie_renew(&string->tie, n_glide);
  }
  return is_strung;
}

/* The same, where it hangs on the way, and with its last pitch if the new one cannot be had. */
static void glide_or_choke(HarpString* string, const HarpPatch* patch, uint32_t n_glide) {
  Voice* const voice = &string->voice;
  if (harp_string_is_touched(string)) {
    voice_feed(voice);
  }
  if (!glide(string, patch, n_glide)) {
    voice_choke(voice, true);
    const TuningTarget target = harp_target(string, patch, voice->f0_hz);
    if (!tie_retune(&string->tie, string->bridge, voice, &target, harp_target_hold(string, patch),
                    n_glide)) {
      voice_sleep(voice);
    }
  }
  if (!voice->is_awake || voice->is_choked) {
    leave(string);
  }
  look(string);
}

/* The vibrato's next piece ends after `n_frames`. */
static void swing(HarpString* string, const HarpPatch* patch, uint32_t n_frames) {
  vibrato_go(&string->vibrato, patch->vibrato_hz / string->voice.rate_hz, n_frames);
  string->n_swing = n_frames;
}

static void lean(HarpString* string, uint32_t n_glide) {
  if (string->bow.is_active) {
    bow_swell(&string->bow, string->touch.breath * (1.0 + pressure_of(string)), n_glide);
  }
}

/* A vibrato is not stretched by slow changes. */
void harp_string_retune(HarpString* string, const HarpPatch* patch, uint32_t n_glide) {
  if (!string->voice.is_awake || string->voice.is_choked) {
    return;
  }
  const uint32_t n_gesture = voice_gesture_frames(string->voice.rate_hz);
  const double depth = vibrato_of(string);
  if (depth != string->vibrato.goal) {
    vibrato_to(&string->vibrato, depth, n_gesture);
  }
  if (!vibrato_is_still(&string->vibrato)) {
    n_glide = least(n_glide, n_gesture);
    swing(string, patch, n_glide > 0 ? n_glide : 1);
  }
  lean(string, n_glide);
  glide_or_choke(string, patch, n_glide);
}

void harp_string_choke(HarpString* string, const HarpPatch* patch, uint32_t n_glide) {
  if (string->voice.is_awake) {
    voice_choke(&string->voice, true);
    string->vibrato = (Vibrato){0};
    glide_or_choke(string, patch, n_glide);
  }
}

/* In the middle both walls throw a hammer's wave back at once, and what comes of it hangs on every
 * mass; and far from the walls a string under a bow is all too ready to slip twice a period. */
static double place_for(Exciter exciter, double wanted) {
  const double from_wall = fmin(wanted, 1.0 - wanted);
  const double most = exciter == EXCITER_STRIKE ? FARTHEST_STRIKE
                      : exciter == EXCITER_BOW  ? FARTHEST_BOW
                                                : 0.5;
  const double at = fmin(from_wall, most);
  return wanted > 0.5 ? 1.0 - at : at;
}

static void excite(HarpString* string, const HarpPatch* patch, Pluck pluck) {
  const Chain* const chain = &string->voice.chain;
  const double rate_hz = string->voice.rate_hz;
  const double angle1 = 2.0 * PI * string->voice.f0_hz / rate_hz;
  const HarpBalance balance = {harp_target(string, patch, string->voice.f0_hz), chain->n_masses,
                               string->key, HAMMER_MASS};
  pluck.place = place_for(patch->exciter, pluck.place);
  pluck.amplitude *= harp_balance_gain(patch, &balance, pluck);
  switch (patch->exciter) {
  case EXCITER_PLUCK:
    voice_pluck(&string->voice, pluck);
    look(string);
    break;
  case EXCITER_STRIKE: {
    const Strike strike = {pluck.place, pluck.hardness, HAMMER_MASS, pluck.amplitude};
    hammer_throw(&string->hammer, chain, strike, angle1, rate_hz);
    voice_feed(&string->voice);
    break;
  }
  case EXCITER_BOW: {
    const Stroke stroke = {pluck.place, pluck.hardness, pluck.amplitude, BOW_ATTACK_S,
                           BOW_RELEASE_S};
    bow_start(&string->bow, chain, stroke, angle1, rate_hz);
    if (!string->ear.is_active) {
      const TuningTarget target = harp_target(string, patch, string->voice.f0_hz);
      intonation_start(&string->ear, &target);
    }
    voice_feed(&string->voice);
    break;
  }
  }
}

void harp_string_play(HarpString* string, const HarpPatch* patch, Pluck pluck, uint32_t n_glide) {
  string->lift = 1.0;
  if (string->voice.is_awake) {
    voice_choke(&string->voice, false);
    mesh_for_pluck(string, patch);
    harp_string_retune(string, patch, n_glide);
  } else if (!restring(string, patch, n_glide)) {
    return;
  }
  if (string->voice.is_awake && !string->voice.is_choked) {
    excite(string, patch, pluck);
    lean(string, 0);
    if (vibrato_of(string) != string->vibrato.goal) {
      harp_string_retune(string, patch, n_glide);
    }
  }
}

void harp_string_lift(HarpString* string) {
  if (string->bow.is_active) {
    bow_lift(&string->bow);
    intonation_leave(&string->ear, &string->voice.chain,
                     voice_gesture_frames(string->voice.rate_hz));
  }
}

bool harp_string_wake(HarpString* string, const HarpPatch* patch, uint32_t n_glide) {
  if (!restring(string, patch, n_glide)) {
    return false;
  }
  if (vibrato_of(string) != string->vibrato.goal) {
    harp_string_retune(string, patch, n_glide);
  }
  return true;
}

bool harp_string_act(HarpString* string) {
  Chain* const chain = &string->voice.chain;
  const uint32_t n_gliding = chain->n_gliding;
  const double change = chain->change.k1;
  if (!harp_string_is_touched(string)) {
    return false;
  }
  hammer_act(&string->hammer, chain);
  bow_act(&string->bow, chain);
  intonation_hear(&string->ear, chain, string->bow.before);
  string->has_acted = true;
  if (chain->n_gliding != n_gliding || chain->change.k1 != change) {
    tie_follow(&string->tie, chain);
    return true;
  }
  return !harp_string_is_touched(string);
}

uint32_t harp_string_stretch(const HarpString* string) {
  const uint32_t n_wire = voice_stretch(&string->voice);
  return vibrato_is_still(&string->vibrato) ? n_wire : least(n_wire, string->n_swing);
}

void harp_string_pass(HarpString* string, const HarpPatch* patch, uint32_t n_frames) {
  Voice* const voice = &string->voice;
  if (string->has_acted && (voice->n_until_look == n_frames || !harp_string_is_touched(string))) {
    voice_feed(voice);
    voice->n_until_look += n_frames - 1; /* From now on, whenever it was told last */
  }
  string->has_acted = false;
  voice_pass(voice, n_frames);
  if (!vibrato_is_still(&string->vibrato)) {
    string->n_swing -= n_frames;
    if (string->n_swing == 0 && voice->is_awake) {
      swing(string, patch, VIBRATO_PIECE_FRAMES);
      glide_or_choke(string, patch, VIBRATO_PIECE_FRAMES);
    }
  }
}

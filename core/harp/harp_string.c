#include "core/harp/harp_string.h"

#include "core/base/maths.h"
#include "core/harp/harp_balance.h"

/* A hammer's mass, as a share of the string's. */
static const double HAMMER_MASS = 0.25;

/* As far from the nearer wall as hammers go, of the length. */
static const double FARTHEST_STRIKE = 0.47;

/* How long a bow takes to come to its speed, and to be lifted [s]. */
static const double BOW_ATTACK_S = 0.04;
static const double BOW_RELEASE_S = 0.03;

/* A low E that is plucked hard moves so much less than what tension is told for. */
static const double TENSION = TENSION_AMPLITUDE * TENSION_AMPLITUDE / (0.8 * 0.8);

/* How much less a soft hand presses it. */
static const double BOW_SOFTER = 0.19;

/* How the channel's brightness moves the loss between the masses: towards a tenth of it, or up, on
 * a scale of octaves, to its fourth root. */
static const double BRIGHTEST_LOSS = 0.1;
static const double DARKEST_LOSS = 0.75;
static const double LEAST_DARK_LOSS = 1e-5;

double harp_string_pitch_hz(const HarpString* string) {
  const double semitones = string->semitones + string->touch.bend + 0.01 * string->cents;
  return string_patch_pitch_hz(&string->patch->string, semitones);
}

/* What is left of the loss between the masses when the channel makes the string brighter, or
 * darker. */
static double loss_of(const HarpString* string, double loss) {
  const double brightness = string->touch.brightness;
  if (brightness >= 0.0) {
    return loss * pow(BRIGHTEST_LOSS, brightness);
  }
  return pow(fmax(loss, LEAST_DARK_LOSS), 1.0 + DARKEST_LOSS * brightness);
}

static double damper_of(const HarpString* string, double semitones, double open_s) {
  const double release_s = string_patch_release_s(&string->patch->string, semitones);
  const double shut_s = fmin(open_s, release_s);
  return string->lift < 1.0 ? shut_s * pow(open_s / shut_s, string->lift) : 0.0;
}

/* A string that is tuned higher than its key's usual pitch pulls no more than one made for it. */
static BridgeHold hold_of(const HarpString* string, double f0_hz) {
  const double resonance = string->patch->resonance;
  const double mass = bridge_mass(440.0 * exp2(((double)string->key - 69.0) / 12.0));
  const double lever = resonance * resonance * string->lift;
  const Bridge* const bridge = string->voice.bridge; /* What follows a string has none. */
  const bool is_held = resonance > 0.0 && bridge && !bridge->is_leaving;
  return is_held ? (BridgeHold){mass, lever * sqrt(fmin(1.0, bridge_mass(f0_hz) / mass))}
                 : (BridgeHold){0};
}

/* What it is to be at a pitch.  Its damper, lifted in part, takes it by the same share of the way
 * on a scale of octaves of τ.  The lever is the square of the resonance, so that half of it leaves
 * the pitch of what is heard, and a damper takes it as it takes the string's motion. */
static VoiceAim aim_at(const HarpString* string, double f0_hz) {
  const double semitones = (double)string->key - 69.0;
  TuningTarget open =
      string_patch_target(&string->patch->string, string->voice.rate_hz, semitones, f0_hz);
  open.tone.tau_s *= string->decay;
  open.loss = loss_of(string, open.loss);
  return (VoiceAim){open, damper_of(string, semitones, open.tone.tau_s), hold_of(string, f0_hz),
                    TENSION * string->patch->string.tension};
}

static double pressure_of(const HarpString* string) {
  return fmax(string->touch.pressure, string->leaned_on);
}

static double vibrato_of(const HarpString* string) {
  const double pressed =
      string->voice.bow.is_active ? 0.0 : VOICE_PRESSED_VIBRATO * pressure_of(string);
  return string->touch.vibrato + pressed;
}

/* Bring it to where it is to be after `n_glide` frames. */
static void glide(HarpString* string, uint32_t n_glide) {
  const double swing = exp2(motion_swing(&string->voice.motion) / 12.0);
  const VoiceAim aim = aim_at(string, swing * harp_string_pitch_hz(string));
  voice_aim(&string->voice, &aim, n_glide);
}

/* The vibrato's next piece ends after `n_frames`. */
static void swing(HarpString* string, uint32_t n_frames) {
  voice_vibrato_rate(&string->voice, string->patch->vibrato_hz / string->voice.rate_hz);
  voice_begin_piece(&string->voice, n_frames);
}

static void begin_piece(void* string) {
  Voice* const voice = &((HarpString*)string)->voice;
  if (voice->is_awake && motion_swings(&voice->motion)) {
    swing(string, MOTION_PIECE_FRAMES);
    glide(string, MOTION_PIECE_FRAMES);
  } else {
    voice_end_pieces(voice);
  }
}

void harp_string_init(HarpString* string,
                      const HarpPatch* patch,
                      double rate_hz,
                      uint32_t key,
                      void* memory,
                      uint32_t capacity,
                      const Bridge* bridge) {
  *string = (HarpString){
      .patch = patch,
      .key = key,
      .semitones = (double)key - 69.0,
      .touch = HARP_TOUCH_NONE,
      .decay = 1.0,
  };
  const VoiceOwner owner = {begin_piece, string};
  voice_init(&string->voice, rate_hz, key, memory, capacity, owner, bridge);
}

void harp_string_rest(HarpString* string) {
  voice_reset(&string->voice);
  string->touch = HARP_TOUCH_NONE;
  string->lift = 0.0;
  string->holders = 0;
  string->channel = 0;
  string->lender = 0;
  string->is_caught = false;
  string->is_let_go = false;
  string->leaned_on = 0.0;
}

static bool restring(HarpString* string, uint32_t n_tie) {
  const VoiceAim aim = aim_at(string, harp_string_pitch_hz(string));
  voice_still(&string->voice);
  return voice_string(&string->voice, &aim, string->patch->string.max_masses, n_tie);
}

static void lean(HarpString* string, uint32_t n_glide) {
  voice_swell_bow(&string->voice, string->touch.breath * (1.0 + pressure_of(string)), n_glide);
}

/* A vibrato is not stretched by slow changes. */
void harp_string_retune(HarpString* string, uint32_t n_glide) {
  Voice* const voice = &string->voice;
  if (!voice->is_awake || voice->is_choked) {
    return;
  }
  voice_halt(voice);
  const double depth = vibrato_of(string);
  if (depth != voice->motion.depth.goal) {
    voice_vibrato(voice, depth);
  }
  if (motion_swings(&voice->motion)) {
    n_glide = least(n_glide, voice->n_gesture);
    swing(string, n_glide > 0 ? n_glide : 1);
  }
  lean(string, n_glide);
  glide(string, n_glide);
}

void harp_string_choke(HarpString* string, uint32_t n_glide) {
  if (string->voice.is_awake) {
    voice_choke(&string->voice, true);
    voice_still(&string->voice);
    glide(string, n_glide);
  }
}

/* In the middle both walls throw a hammer's wave back at once, and what comes of it hangs on every
 * mass. */
static double place_for(Exciter exciter, double wanted) {
  const double from_wall = fmin(wanted, 1.0 - wanted);
  const double at = exciter == EXCITER_STRIKE ? fmin(from_wall, FARTHEST_STRIKE) : from_wall;
  return wanted > 0.5 ? 1.0 - at : at;
}

/* What plays it, by a hand of some softness, is as hard, or is pressed as hard: of a finger the
 * string's masses tell. */
static double hardness_for(Exciter exciter, const Pluck* pluck) {
  switch (exciter) {
  case EXCITER_STRIKE:
    return hammer_hardness(pluck->hardness, pluck->softness);
  case EXCITER_BOW:
    return clamp(pluck->hardness - BOW_SOFTER * pluck->softness, 0.0, 1.0);
  case EXCITER_PLUCK:
    break;
  }
  return pluck->hardness;
}

static void excite(HarpString* string, Pluck pluck) {
  const HarpPatch* const patch = string->patch;
  Voice* const voice = &string->voice;
  const TuningTarget target = aim_at(string, voice->f0_hz).open;
  pluck.place = place_for(patch->exciter, pluck.place);
  pluck.hardness = hardness_for(patch->exciter, &pluck);
  switch (patch->exciter) {
  case EXCITER_PLUCK:
    voice_pluck(voice, pluck);
    break;
  case EXCITER_STRIKE:
    voice_strike(voice, (Strike){pluck.place, pluck.hardness, HAMMER_MASS, pluck.amplitude});
    break;
  case EXCITER_BOW:
    voice_bow(voice,
              (Stroke){pluck.place, pluck.hardness, pluck.amplitude, BOW_ATTACK_S, BOW_RELEASE_S},
              &target);
    break;
  }
}

/* While it rings it has the masses back that a bend took. */
static void wake_or_renew(HarpString* string, uint32_t n_glide) {
  Voice* const voice = &string->voice;
  if (!voice->is_awake) {
    (void)restring(string, n_glide);
    return;
  }
  voice_choke(voice, false);
  const VoiceAim aim = aim_at(string, harp_string_pitch_hz(string));
  voice_lengthen(voice, &aim, voice->n_strung);
  harp_string_retune(string, n_glide);
}

bool harp_string_ready(HarpString* string, uint32_t n_glide) {
  string->lift = 1.0;
  wake_or_renew(string, n_glide);
  return string->voice.is_awake && !string->voice.is_choked;
}

double
harp_string_gain(const HarpString* string, const HarpMember members[HARP_MEMBERS], Pluck pluck) {
  const Voice* const voice = &string->voice;
  const HarpBalance balance = {aim_at(string, voice->f0_hz).open, voice->chain.n_masses,
                               string->key, HAMMER_MASS, members};
  pluck.place = place_for(string->patch->exciter, pluck.place);
  pluck.hardness = hardness_for(string->patch->exciter, &pluck);
  return harp_balance_gain(string->patch, &balance, pluck);
}

void harp_string_play(HarpString* string, Pluck pluck, uint32_t n_glide) {
  excite(string, pluck);
  lean(string, 0);
  if (vibrato_of(string) != string->voice.motion.depth.goal) {
    harp_string_retune(string, n_glide);
  }
}

void harp_string_lift(HarpString* string) {
  voice_lift_bow(&string->voice);
}

bool harp_string_wake(HarpString* string, uint32_t n_glide) {
  if (!restring(string, n_glide)) {
    return false;
  }
  if (vibrato_of(string) != string->voice.motion.depth.goal) {
    harp_string_retune(string, n_glide);
  }
  return true;
}

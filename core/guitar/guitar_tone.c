#include "core/guitar/guitar_tone.h"

#include <math.h>

double guitar_tone_frets(const GuitarPatch* patch, double fret) {
  return fmax(patch->capo + fret, 0.0);
}

/* What a note is to sound like without a hand on the string. */
static TuningTarget free_target(const GuitarString* string, double note, double f0_hz) {
  return string_patch_target(&string->patch->string, string->voice.rate_hz, note - 69.0, f0_hz);
}

static double pitch_hz(const GuitarString* string, double note) {
  return string_patch_pitch_hz(&string->patch->string, note - 69.0);
}

TuningTarget guitar_tone_open(const GuitarString* string) {
  return free_target(string, string->open, pitch_hz(string, string->open));
}

/* The palm dulls it, too. */
static TuningTarget under_palm(const GuitarPatch* patch, TuningTarget target) {
  const double palm_per_s = GUITAR_PALM_PER_S * patch->palm * patch->palm;
  const double tau_s = 1.0 / (1.0 / target.tone.tau_s + palm_per_s);
  return palm_per_s > 0.0 ? tuning_damped(target, tau_s, GUITAR_PALM_LOSS) : target;
}

/* The pitch where a mass is stopped and nothing else is done: that of the open string's springs. */
static double uncorrected_hz(const GuitarString* string) {
  const TuningTarget open = guitar_tone_open(string);
  const double frets = guitar_tone_frets(string->patch, string->voice.motion.slide.value);
  StringCoefs coefs = {0};
  if (tuning_solve(&open, string->n_open, &coefs)) {
    return open.tone.f0_hz;
  }
  const Pole first = tuning_mode(coefs, guitar_string_masses(string->n_open, frets), 1);
  return pole_tone(open.rate_hz, first).f0_hz;
}

VoiceAim guitar_tone(const GuitarString* string) {
  const GuitarPatch* const patch = string->patch;
  const VoiceMotion* const motion = &string->voice.motion;
  const double note = string->open + patch->capo + motion->slide.value;
  const double f0_hz = patch->is_uncorrected ? uncorrected_hz(string) : pitch_hz(string, note);
  const double bent_hz = f0_hz * exp2(motion_bend(motion) / 12.0);
  return (VoiceAim){
      .open = under_palm(patch, free_target(string, note, bent_hz)),
      .damper_s = string->damper == GUITAR_DAMPED ? patch->string.release_s : 0.0,
  };
}

#include "core/guitar/guitar_tone.h"

#include <math.h>

double guitar_tone_frets(const GuitarPatch* patch, double fret) {
  return fmax(patch->capo + fret, 0.0);
}

/* What a note is to sound like without a hand on the string. */
static TuningTarget
free_target(const GuitarString* string, const GuitarPatch* patch, double note, double f0_hz) {
  return string_patch_target(&patch->string, string->voice.rate_hz, note - 69.0, f0_hz);
}

static double pitch_hz(const GuitarPatch* patch, double note) {
  return string_patch_pitch_hz(&patch->string, note - 69.0);
}

TuningTarget guitar_tone_open(const GuitarString* string, const GuitarPatch* patch) {
  return free_target(string, patch, string->open, pitch_hz(patch, string->open));
}

/* What damps it acts from outside; the palm dulls it too. */
static TuningTarget
damped_target(const GuitarString* string, const GuitarPatch* patch, TuningTarget target) {
  const double palm_per_s = GUITAR_PALM_PER_S * patch->palm * patch->palm;
  if (palm_per_s > 0.0) {
    const double tau_s = 1.0 / (1.0 / target.tone.tau_s + palm_per_s);
    target = tuning_damped(target, tau_s, GUITAR_PALM_LOSS);
  }
  if (string->damper != GUITAR_RINGING) {
    const double hand_s = string->damper == GUITAR_CHOKED ? VOICE_CHOKE_S : patch->string.release_s;
    target = tuning_damped(target, fmin(target.tone.tau_s, hand_s), 0.0);
  }
  return target;
}

/* The pitch where a mass is stopped and nothing else is done: that of the open string's springs. */
static double uncorrected_hz(const GuitarString* string, const GuitarPatch* patch) {
  const TuningTarget open = guitar_tone_open(string, patch);
  const double frets = guitar_tone_frets(patch, string->motion.fret.value);
  StringCoefs coefs = {0};
  if (tuning_solve(&open, string->n_open, &coefs)) {
    return open.tone.f0_hz;
  }
  const Pole first = tuning_mode(coefs, guitar_string_masses(string->n_open, frets), 1);
  return pole_tone(open.rate_hz, first).f0_hz;
}

TuningTarget guitar_tone(const GuitarString* string, const GuitarPatch* patch) {
  const double note = string->open + patch->capo + string->motion.fret.value;
  const double f0_hz =
      patch->is_uncorrected ? uncorrected_hz(string, patch) : pitch_hz(patch, note);
  const double bent_hz = f0_hz * exp2(guitar_motion_bend(&string->motion) / 12.0);
  return damped_target(string, patch, free_target(string, patch, note, bent_hz));
}

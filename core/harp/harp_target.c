#include "core/harp/harp_target.h"

#include <math.h>

/* How the channel's brightness moves the loss between the masses: towards a tenth of it, or up, on
 * a scale of octaves, to its fourth root. */
static const double BRIGHTEST_LOSS = 0.1;
static const double DARKEST_LOSS = 0.75;
static const double LEAST_DARK_LOSS = 1e-5;

/* What is between the masses when the channel makes the string brighter, or darker. */
static double loss_of(const HarpString* string, const HarpPatch* patch) {
  const double brightness = string->touch.brightness;
  if (brightness >= 0.0) {
    return patch->string.loss * pow(BRIGHTEST_LOSS, brightness);
  }
  return pow(fmax(patch->string.loss, LEAST_DARK_LOSS), 1.0 + DARKEST_LOSS * brightness);
}

TuningTarget harp_target(const HarpString* string, const HarpPatch* patch, double f0_hz) {
  const double semitones = (double)string->key - 69.0;
  TuningTarget open = string_patch_target(&patch->string, string->voice.rate_hz, semitones, f0_hz);
  open.loss = loss_of(string, patch);
  const double open_s = open.tone.tau_s;
  if (string->voice.is_choked) {
    return tuning_damped(open, fmin(open_s, VOICE_CHOKE_S), 0.0);
  }
  const double shut_s = fmin(open_s, patch->string.release_s);
  const double tau_s = shut_s * pow(open_s / shut_s, string->lift);
  return string->lift < 1.0 ? tuning_damped(open, fmin(open_s, tau_s), 0.0) : open;
}

BridgeHold harp_target_hold(const HarpString* string, const HarpPatch* patch) {
  const double f0_hz = 440.0 * exp2(((double)string->key - 69.0) / 12.0);
  const bool is_tied = string->bridge && !string->voice.is_choked && patch->resonance > 0.0;
  return (BridgeHold){is_tied ? bridge_mass(f0_hz) : 0.0,
                      is_tied ? patch->resonance * patch->resonance * string->lift : 0.0};
}

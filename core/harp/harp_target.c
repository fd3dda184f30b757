#include "core/harp/harp_target.h"

#include <math.h>

/* How the channel's brightness moves the loss between the masses: towards a tenth of it, or up, on
 * a scale of octaves, to its fourth root. */
static const double BRIGHTEST_LOSS = 0.1;
static const double DARKEST_LOSS = 0.75;
static const double LEAST_DARK_LOSS = 1e-5;

/* What is between the masses when the channel makes the string brighter, or darker. */
static double loss_of(const HarpString* string) {
  const double loss = string->patch->string.loss;
  const double brightness = string->touch.brightness;
  if (brightness >= 0.0) {
    return loss * pow(BRIGHTEST_LOSS, brightness);
  }
  return pow(fmax(loss, LEAST_DARK_LOSS), 1.0 + DARKEST_LOSS * brightness);
}

static double damper_of(const HarpString* string, double open_s) {
  const double shut_s = fmin(open_s, string->patch->string.release_s);
  return string->lift < 1.0 ? shut_s * pow(open_s / shut_s, string->lift) : 0.0;
}

static BridgeHold hold_of(const HarpString* string) {
  const double resonance = string->patch->resonance;
  const double f0_hz = 440.0 * exp2(((double)string->key - 69.0) / 12.0);
  return resonance > 0.0 ? (BridgeHold){bridge_mass(f0_hz), resonance * resonance * string->lift}
                         : (BridgeHold){0};
}

VoiceAim harp_target(const HarpString* string, double f0_hz) {
  const double semitones = (double)string->key - 69.0;
  TuningTarget open =
      string_patch_target(&string->patch->string, string->voice.rate_hz, semitones, f0_hz);
  open.loss = loss_of(string);
  return (VoiceAim){open, damper_of(string, open.tone.tau_s), hold_of(string)};
}

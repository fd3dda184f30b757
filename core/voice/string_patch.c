#include "core/voice/string_patch.h"

#include <math.h>

/* How far tracking takes what it is set to: to the ends of what can be set outright, beyond which
 * there is nothing to hear. */
static const double MOST_LOSS = 1.0;
static const double MOST_INHARMONICITY = 0.1;
static const double LEAST_RELEASE_S = 0.005;

/* What grows by `tracking` octaves in an octave of pitch; what is beyond `most` at A4 stays there.
 */
static double grown(double value, double tracking, double semitones, double most) {
  return fmin(value * exp2(tracking * (semitones / 12.0)), fmax(value, most));
}

bool string_patch_rings_alike(const StringPatch* a, const StringPatch* b) {
  return a->damping_per_s == b->damping_per_s && a->tracking == b->tracking && a->loss == b->loss &&
         a->loss_tracking == b->loss_tracking && a->inharmonicity == b->inharmonicity &&
         a->inharmonicity_tracking == b->inharmonicity_tracking && a->partials == b->partials &&
         a->release_s == b->release_s && a->release_tracking == b->release_tracking &&
         a->tension == b->tension && a->tuning_hz == b->tuning_hz;
}

double string_patch_pitch_hz(const StringPatch* patch, double semitones) {
  return patch->tuning_hz * exp2(semitones / 12.0);
}

TuningTarget
string_patch_target(const StringPatch* patch, double rate_hz, double semitones, double f0_hz) {
  const double octaves = semitones / 12.0;
  return (TuningTarget){
      .rate_hz = rate_hz,
      .tone = {f0_hz, 1.0 / (patch->damping_per_s * exp2(patch->tracking * octaves))},
      .loss = grown(patch->loss, patch->loss_tracking, semitones, MOST_LOSS),
      .inharmonicity =
          grown(patch->inharmonicity, patch->inharmonicity_tracking, semitones, MOST_INHARMONICITY),
      .partials = patch->partials,
  };
}

double string_patch_release_s(const StringPatch* patch, double semitones) {
  const double tracked_s = patch->release_s * exp2(-patch->release_tracking * (semitones / 12.0));
  return fmax(tracked_s, fmin(patch->release_s, LEAST_RELEASE_S));
}

#include "core/voice/string_patch.h"

#include <math.h>

bool string_patch_rings_alike(const StringPatch* a, const StringPatch* b) {
  return a->damping_per_s == b->damping_per_s && a->tracking == b->tracking && a->loss == b->loss &&
         a->inharmonicity == b->inharmonicity && a->partials == b->partials &&
         a->release_s == b->release_s && a->tuning_hz == b->tuning_hz;
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
      .loss = patch->loss,
      .inharmonicity = patch->inharmonicity,
      .partials = patch->partials,
  };
}

#include "core/harp_string.h"

#include <math.h>

/* What a damper adds acts from outside. */
static TuningTarget
target_of(const HarpString* string, const Patch* patch, double f0_hz, Damper damper) {
  const double octaves = ((double)string->key - 69.0) / 12.0;
  const double open_s = 1.0 / (patch->damping_per_s * exp2(patch->tracking * octaves));
  const TuningTarget open = {
      .rate_hz = string->wire.rate_hz,
      .tone = {.f0_hz = f0_hz, .tau_s = open_s},
      .loss = patch->loss,
      .inharmonicity = patch->inharmonicity,
      .partials = patch->partials,
  };
  const double hand_s = damper == DAMPER_CHOKING ? WIRE_CHOKE_S : patch->release_s;
  return damper == DAMPER_OFF ? open : tuning_damped(open, fmin(open_s, hand_s), 0.0);
}

/* A pluck gives a ringing string the masses back that a bend took. */
static void mesh_for_pluck(HarpString* string, const Patch* patch, double f0_hz) {
  if (string->wire.chain.n_masses < string->n_strung) {
    const TuningTarget target = target_of(string, patch, f0_hz, DAMPER_OFF);
    const uint32_t n_masses = tuning_max_masses(&target, string->n_strung);
    if (n_masses > string->wire.chain.n_masses) {
      wire_mesh(&string->wire, &target, n_masses);
    }
  }
}

static bool restring(HarpString* string, const Patch* patch, double f0_hz) {
  const TuningTarget target = target_of(string, patch, f0_hz, DAMPER_OFF);
  const bool is_strung = wire_string(&string->wire, &target, patch->max_masses);
  string->damper = DAMPER_OFF;
  string->n_strung = is_strung ? string->wire.chain.n_masses : 0;
  return is_strung;
}

double harp_string_pitch_hz(const HarpString* string, const Patch* patch, double bend_semitones) {
  return patch->tuning_hz * exp2((string->semitones + bend_semitones) / 12.0);
}

void harp_string_init(
    HarpString* string, double rate_hz, uint32_t key, void* memory, uint32_t capacity) {
  *string = (HarpString){.key = key, .semitones = (double)key - 69.0};
  wire_init(&string->wire, rate_hz, key, memory, capacity);
}

void harp_string_retune(HarpString* string,
                        const Patch* patch,
                        double bend_semitones,
                        Damper damper,
                        uint32_t n_glide) {
  Wire* const wire = &string->wire;
  const double f0_hz = harp_string_pitch_hz(string, patch, bend_semitones);
  TuningTarget target = target_of(string, patch, f0_hz, damper);
  if (!wire_retune(wire, &target, n_glide)) {
    damper = DAMPER_CHOKING;
    target = target_of(string, patch, wire->f0_hz, damper);
    if (!wire_retune(wire, &target, n_glide)) {
      wire_sleep(wire);
      return;
    }
  }
  wire_choke(wire, damper == DAMPER_CHOKING);
  string->damper = damper;
}

void harp_string_pluck(
    HarpString* string, const Patch* patch, double bend_semitones, Pluck pluck, uint32_t n_glide) {
  const double f0_hz = harp_string_pitch_hz(string, patch, bend_semitones);
  if (string->wire.is_awake) {
    mesh_for_pluck(string, patch, f0_hz);
    harp_string_retune(string, patch, bend_semitones, DAMPER_OFF, n_glide);
  } else if (!restring(string, patch, f0_hz)) {
    return;
  }
  if (string->wire.is_awake && string->damper == DAMPER_OFF) {
    wire_pluck(&string->wire, pluck);
  }
}

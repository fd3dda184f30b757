#include "core/harp_string.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* A hammer's mass, as a share of the string's. */
static const double HAMMER_MASS = 0.25;

/* What strikes and bows are made stronger by, as each sense hears them, to be as loud as plucks. */
static const double strike_gains[] = {
    [SENSE_DISPLACEMENT] = 1.5, [SENSE_VELOCITY] = 3.0, [SENSE_FORCE] = 3.1};
static const double bow_gains[] = {
    [SENSE_DISPLACEMENT] = 1.2, [SENSE_VELOCITY] = 0.9, [SENSE_FORCE] = 0.85};

/* How long a bow takes to come to its speed, and to be lifted [s]. */
static const double BOW_ATTACK_S = 0.04;
static const double BOW_RELEASE_S = 0.03;

static bool is_touched(const HarpString* string) {
  return string->hammer.is_active || string->bow.is_active;
}

/* What is at it sees that something else has moved it. */
static void look(HarpString* string) {
  if (string->hammer.is_active) {
    hammer_look(&string->hammer, &string->wire.chain);
  }
  if (string->bow.is_active) {
    bow_look(&string->bow, &string->wire.chain);
  }
}

/* Nothing is left at a string that sleeps. */
static void leave(HarpString* string) {
  string->hammer.is_active = false;
  string->bow.is_active = false;
}

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
  if (is_touched(string)) {
    wire_feed(wire);
  }
  if (!wire_retune(wire, &target, n_glide)) {
    damper = DAMPER_CHOKING;
    target = target_of(string, patch, wire->f0_hz, damper);
    if (!wire_retune(wire, &target, n_glide)) {
      wire_sleep(wire);
      leave(string);
      return;
    }
  }
  wire_choke(wire, damper == DAMPER_CHOKING);
  string->damper = damper;
  if (damper == DAMPER_CHOKING) {
    leave(string);
  }
  look(string);
}

void harp_string_rest(HarpString* string) {
  wire_sleep(&string->wire);
  leave(string);
}

static void excite(HarpString* string, const Patch* patch, Pluck pluck) {
  const Chain* const chain = &string->wire.chain;
  const double rate_hz = string->wire.rate_hz;
  const double angle1 = 2.0 * PI * string->wire.f0_hz / rate_hz;
  switch (patch->exciter) {
  case EXCITER_PLUCK:
    wire_pluck(&string->wire, pluck);
    look(string);
    break;
  case EXCITER_STRIKE: {
    const Strike strike = {pluck.place, pluck.hardness, HAMMER_MASS,
                           strike_gains[patch->sense] * pluck.amplitude};
    hammer_throw(&string->hammer, chain, strike, angle1, rate_hz);
    wire_feed(&string->wire);
    break;
  }
  case EXCITER_BOW: {
    const Stroke stroke = {pluck.place, pluck.hardness, bow_gains[patch->sense] * pluck.amplitude,
                           BOW_ATTACK_S, BOW_RELEASE_S};
    bow_start(&string->bow, chain, stroke, angle1, rate_hz);
    wire_feed(&string->wire);
    break;
  }
  }
}

void harp_string_play(
    HarpString* string, const Patch* patch, double bend_semitones, Pluck pluck, uint32_t n_glide) {
  const double f0_hz = harp_string_pitch_hz(string, patch, bend_semitones);
  if (string->wire.is_awake) {
    mesh_for_pluck(string, patch, f0_hz);
    harp_string_retune(string, patch, bend_semitones, DAMPER_OFF, n_glide);
  } else if (!restring(string, patch, f0_hz)) {
    return;
  }
  if (string->wire.is_awake && string->damper == DAMPER_OFF) {
    excite(string, patch, pluck);
  }
}

void harp_string_lift(HarpString* string) {
  if (string->bow.is_active) {
    bow_lift(&string->bow);
  }
}

uint32_t harp_string_stretch(const HarpString* string) {
  return is_touched(string) ? 1 : wire_stretch(&string->wire);
}

void harp_string_pass(HarpString* string, uint32_t n_frames) {
  Wire* const wire = &string->wire;
  if (is_touched(string)) {
    hammer_act(&string->hammer, &wire->chain);
    bow_act(&string->bow, &wire->chain);
    if (wire->n_until_look == n_frames || !is_touched(string)) {
      wire_feed(wire);
    }
  }
  wire_pass(wire, n_frames);
}

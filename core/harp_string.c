#include "core/harp_string.h"

#include "core/remesh.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* Amplitude, of the loudest, at which a string has died away. */
static const double SILENCE = 1e-6;

/* Amplitude at which it has in any case, should it have been fast to die before it was looked at.
 */
static const double STILLNESS = 1e-20;

/* Bending, in units of k1, below which a string has given way so far that its upper modes fold
 * back; fewer masses are better then. */
static const double MOST_GIVEN_WAY = -0.126;

/* How often a string is looked at for whether it has died away and what numbers suit it [frames];
 * and by how much the first time differs from key to key, after a pluck and after a glide, so that
 * those touched together are not all looked at together. */
enum { DOZE_FRAMES = 1024, DOZE_PLACES = 16, PLUCK_SPREAD = 64, GLIDE_SPREAD = 8 };

/* τ of a string that is choked [s]; and when it is let go, should one of its upper modes be slow to
 * give in. */
static const double CHOKE_S = 0.005;
static const double CHOKED_S = 0.1;

/*
  Tension that swings in time with a string feeds it, as a swing is fed, stable as each step of it
  is.  So it is let have this many times the motion that its plucks gave it, which is what a bend of
  four octaves at the worst moment would give, and no more.
*/
static const double MOST_FED = 4.0;

static double decay_s(const Patch* patch, uint32_t key) {
  return 1.0 / (patch->damping_per_s * exp2(patch->tracking * ((double)key - 69.0) / 12.0));
}

/*
  A damper acts from outside: it adds to the fundamental's damping, but what sits between the masses
  stays as it was. So the share of loss falls by as much as the damping g = 1 − exp(−2h/τ) rises.
*/
static TuningTarget
target_of(const HarpString* string, const Patch* patch, double f0_hz, Damper damper) {
  const double open_s = decay_s(patch, string->key);
  const double hand_s = damper == DAMPER_CHOKING ? CHOKE_S : patch->release_s;
  const double tau_s = damper == DAMPER_OFF ? open_s : fmin(open_s, hand_s);
  const double steps = string->rate_hz;
  return (TuningTarget){
      .rate_hz = string->rate_hz,
      .tone = {.f0_hz = f0_hz, .tau_s = tau_s},
      .loss = patch->loss * (expm1(-2.0 / (open_s * steps)) / expm1(-2.0 / (tau_s * steps))),
      .inharmonicity = patch->inharmonicity,
      .partials = patch->partials,
  };
}

/* Its amplitude times √ω, which a slow change of pitch leaves alone. */
static double motion_of(const HarpString* string) {
  const double a1 = tuning_mode(string->chain.now, string->chain.n_masses, 1).a;
  return chain_amplitude(&string->chain, a1) * sqrt(sqrt(a1));
}

/* Take back what moving coefficients fed it beyond what may be. */
static void hold_back(HarpString* string) {
  const double most = MOST_FED * string->given;
  const double motion = motion_of(string);
  if (motion > most) {
    const float kept = (float)(most / motion);
    for (uint32_t i = 0; i < string->chain.n_masses; ++i) {
      chain_place(&string->chain, i, kept * chain_position(&string->chain, i),
                  kept * chain_velocity(&string->chain, i));
    }
  }
}

/* What moving coefficients fed it is not taken for a pluck's. */
static void note_pluck(HarpString* string, double before) {
  const double after = motion_of(string);
  string->given = before > string->given ? string->given * (after / before) : after;
}

/* Remember what the coefficients were made for. */
static void note_design(HarpString* string, double f0_hz, StringCoefs coefs) {
  string->f0_hz = f0_hz;
  string->a1 = tuning_mode(coefs, string->chain.n_masses, 1).a;
  string->headroom = tuning_headroom(coefs, string->chain.n_masses);
}

/* String it anew from rest; false if it cannot sound at this pitch. */
static bool restring(HarpString* string, const Patch* patch, double f0_hz) {
  const TuningTarget target = target_of(string, patch, f0_hz, DAMPER_OFF);
  const uint32_t limit =
      patch->max_masses < string->capacity ? patch->max_masses : string->capacity;
  const uint32_t n_masses = tuning_max_masses(&target, limit);
  StringCoefs coefs = {0};
  if (n_masses == 0 || tuning_solve(&target, n_masses, &coefs)) {
    return false;
  }
  chain_init(&string->chain, string->kernel, string->memory, n_masses);
  chain_set(&string->chain, coefs);
  string->given = 0.0;
  note_design(string, f0_hz, coefs);
  string->is_awake = true;
  string->damper = DAMPER_OFF;
  string->loudest = 0.0;
  string->n_strung = n_masses;
  string->n_until_doze = PLUCK_SPREAD * (1 + string->key % DOZE_PLACES);
  return true;
}

double harp_string_pitch_hz(const Patch* patch, uint32_t key, double bend_semitones) {
  return patch->tuning_hz * exp2(((double)key - 69.0 + bend_semitones) / 12.0);
}

/* No patch has a string of more: loss, stiffness and true partials all add to its load. */
uint32_t harp_string_capacity(double rate_hz, uint32_t key, double lowest_hz) {
  const TuningTarget lightest = {
      .rate_hz = rate_hz,
      .tone = {.f0_hz = lowest_hz * exp2(((double)key - 69.0) / 12.0), .tau_s = HUGE_VAL},
  };
  return tuning_max_masses(&lightest, CHAIN_MAX_MASSES);
}

void harp_string_init(
    HarpString* string, double rate_hz, uint32_t key, void* memory, uint32_t capacity) {
  *string = (HarpString){.kernel = chain_kernel(0),
                         .memory = memory,
                         .capacity = capacity,
                         .key = key,
                         .rate_hz = rate_hz};
}

void harp_string_sleep(HarpString* string) {
  if (string->is_awake) {
    chain_rest(&string->chain);
    string->is_awake = false;
    string->loudest = 0.0;
  }
}

/* The same motion on another number of masses, at the pitch and decay that it has now. */
static bool mesh_anew(HarpString* string, const TuningTarget* target, uint32_t n_masses) {
  Chain* const chain = &string->chain;
  const Pole now = tuning_mode(chain->now, chain->n_masses, 1);
  TuningTarget kept = *target;
  StringCoefs coefs = {0};
  kept.tone = pole_tone(string->rate_hz, now);
  if (n_masses == 0 || tuning_fit(&kept, n_masses, &coefs)) {
    return false;
  }
  remesh(chain, n_masses);
  chain_set(chain, coefs);
  return true;
}

/* A pluck gives a ringing string the masses back that a bend took. */
static void mesh_for_pluck(HarpString* string, const Patch* patch, double f0_hz) {
  if (string->chain.n_masses < string->n_strung) {
    const TuningTarget target = target_of(string, patch, f0_hz, DAMPER_OFF);
    const uint32_t n_masses = tuning_max_masses(&target, string->n_strung);
    if (n_masses > string->chain.n_masses) {
      mesh_anew(string, &target, n_masses);
    }
  }
}

/* Coefficients for the masses that it has, or if they would give way too far, for fewer. */
static bool fit(HarpString* string, const TuningTarget* target, StringCoefs* coefs) {
  const uint32_t n_masses = string->chain.n_masses;
  if (!tuning_fit(target, n_masses, coefs) && coefs->k2 > MOST_GIVEN_WAY * coefs->k1) {
    return true;
  }
  const uint32_t fewer = tuning_max_masses(target, n_masses);
  if (fewer < n_masses && mesh_anew(string, target, fewer)) {
    return !tuning_fit(target, fewer, coefs);
  }
  return !tuning_fit(target, n_masses, coefs);
}

void harp_string_retune(HarpString* string,
                        const Patch* patch,
                        double bend_semitones,
                        Damper damper,
                        uint32_t n_glide) {
  double f0_hz = harp_string_pitch_hz(patch, string->key, bend_semitones);
  TuningTarget target = target_of(string, patch, f0_hz, damper);
  StringCoefs coefs = {0};
  hold_back(string);
  if (!fit(string, &target, &coefs)) {
    f0_hz = string->f0_hz;
    damper = DAMPER_CHOKING;
    target = target_of(string, patch, f0_hz, damper);
    if (!fit(string, &target, &coefs)) {
      harp_string_sleep(string);
      return;
    }
  }
  string->n_choked = damper == string->damper ? string->n_choked : 0;
  string->damper = damper;
  note_design(string, f0_hz, coefs);
  chain_glide(&string->chain, coefs, n_glide);
  const uint32_t n_settled = n_glide + GLIDE_SPREAD * (1 + string->key % DOZE_PLACES);
  string->n_until_doze = n_settled < string->n_until_doze ? n_settled : string->n_until_doze;
}

void harp_string_pluck(
    HarpString* string, const Patch* patch, double bend_semitones, Pluck pluck, uint32_t n_glide) {
  const double f0_hz = harp_string_pitch_hz(patch, string->key, bend_semitones);
  if (string->is_awake) {
    mesh_for_pluck(string, patch, f0_hz);
    harp_string_retune(string, patch, bend_semitones, DAMPER_OFF, n_glide);
  } else if (!restring(string, patch, f0_hz)) {
    return;
  }
  if (string->is_awake && string->damper == DAMPER_OFF) {
    const double before = motion_of(string);
    exciter_pluck(&string->chain, pluck, 2.0 * PI * string->f0_hz / string->rate_hz);
    chain_settle(&string->chain);
    string->loudest = 0.0;
    note_pluck(string, before);
  }
}

static bool is_choked(const HarpString* string) {
  return string->damper == DAMPER_CHOKING && string->n_choked >= CHOKED_S * string->rate_hz;
}

static void doze(HarpString* string) {
  string->loudest = fmax(string->loudest, chain_amplitude(&string->chain, HUGE_VAL));
  const double silence = fmax(SILENCE * string->loudest, STILLNESS);
  if (is_choked(string) || chain_amplitude(&string->chain, string->a1) < silence) {
    harp_string_sleep(string);
  } else {
    chain_settle(&string->chain);
  }
  string->n_until_doze = DOZE_FRAMES;
}

uint32_t harp_string_stretch(const HarpString* string) {
  return string->n_until_doze;
}

void harp_string_pass(HarpString* string, uint32_t n_frames) {
  string->n_until_doze -= n_frames;
  string->n_choked += string->damper == DAMPER_CHOKING ? n_frames : 0;
  if (string->n_until_doze == 0) {
    doze(string);
  }
}

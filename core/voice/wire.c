#include "core/voice/wire.h"

#include "core/string/remesh.h"

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
 * and by how much the first time differs from phase to phase, after it is strung and after a glide,
 * so that those touched together are not all looked at together. */
enum { LOOK_FRAMES = 1024, N_PHASES = 16, STRING_SPREAD = 64, GLIDE_SPREAD = 8 };

/* When a choked string is let go, should one of its upper modes be slow to give in [s]. */
static const double CHOKED_S = 0.1;

/*
  Tension that swings in time with a string feeds it, as a swing is fed, stable as each step of it
  is.  So it is let have this many times the motion that its plucks gave it, which is what a bend of
  four octaves at the worst moment would give, and no more.
*/
static const double MOST_FED = 4.0;

/* Its amplitude times √ω, which a slow change of pitch leaves alone. */
static double motion_of(const Wire* wire) {
  const double a1 = tuning_mode(wire->chain.now, wire->chain.n_masses, 1).a;
  return chain_amplitude(&wire->chain, a1) * sqrt(sqrt(a1));
}

/* Take back what moving coefficients fed it beyond what may be. */
static void hold_back(Wire* wire) {
  const double most = MOST_FED * fmax(wire->given, wire->lent);
  const double motion = motion_of(wire);
  if (motion > most) {
    const float kept = (float)(most / motion);
    for (uint32_t i = 0; i < wire->chain.n_masses; ++i) {
      chain_place(&wire->chain, i, kept * chain_position(&wire->chain, i),
                  kept * chain_velocity(&wire->chain, i));
    }
  }
}

/* What moving coefficients fed it is not taken for a pluck's, and what others lent it not for its
 * own. */
static void note_pluck(Wire* wire, double before) {
  const double after = motion_of(wire);
  const double given = before > wire->given ? wire->given * (after / before) : after;
  wire->given = wire->lent > 0.0 ? fmax(given, wire->given + after - before) : given;
}

/* Remember what the coefficients were made for. */
static void note_design(Wire* wire, double f0_hz, StringCoefs coefs) {
  wire->f0_hz = f0_hz;
  wire->a1 = tuning_mode(coefs, wire->chain.n_masses, 1).a;
  wire->headroom = tuning_headroom(coefs, wire->chain.n_masses);
}

static uint32_t least(uint32_t a, uint32_t b) {
  return a < b ? a : b;
}

/* Coefficients for the masses that it has, or if they would give way too far, for fewer. */
static bool fit(Wire* wire, const TuningTarget* target, StringCoefs* coefs) {
  const uint32_t n_masses = wire->chain.n_masses;
  if (!tuning_fit(target, n_masses, coefs) && coefs->k2 > MOST_GIVEN_WAY * coefs->k1) {
    return true;
  }
  const uint32_t fewer = tuning_max_masses(target, n_masses);
  if (fewer > 0 && fewer < n_masses && wire_mesh(wire, target, fewer)) {
    return !tuning_fit(target, fewer, coefs);
  }
  return !tuning_fit(target, n_masses, coefs);
}

static bool is_let_go(const Wire* wire) {
  return wire->is_choked && wire->n_choked >= CHOKED_S * wire->rate_hz;
}

static void look(Wire* wire) {
  wire->loudest = fmax(wire->loudest, chain_amplitude(&wire->chain, HUGE_VAL));
  const double silence = fmax(SILENCE * wire->loudest, STILLNESS);
  const bool is_silent = !wire->is_kept && chain_amplitude(&wire->chain, wire->a1) < silence;
  if (is_let_go(wire) || is_silent) {
    wire_sleep(wire);
  } else {
    chain_settle(&wire->chain);
  }
  wire->n_until_look = LOOK_FRAMES;
}

uint32_t wire_gesture_frames(double rate_hz) {
  return (uint32_t)fmax(WIRE_GESTURE_FRAMES, round(WIRE_GESTURE_S * rate_hz));
}

void wire_init(Wire* wire, double rate_hz, uint32_t phase, void* memory, uint32_t capacity) {
  *wire = (Wire){.kernel = chain_kernel(0),
                 .memory = memory,
                 .capacity = capacity,
                 .phase = phase % N_PHASES,
                 .rate_hz = rate_hz};
}

void wire_sleep(Wire* wire) {
  if (wire->is_awake) {
    chain_rest(&wire->chain);
    wire->is_awake = false;
    wire->loudest = 0.0;
  }
}

bool wire_string(Wire* wire, const TuningTarget* target, uint32_t limit) {
  const uint32_t n_masses = tuning_max_masses(target, least(limit, wire->capacity));
  StringCoefs coefs = {0};
  wire_sleep(wire);
  if (n_masses == 0 || tuning_solve(target, n_masses, &coefs)) {
    return false;
  }
  chain_init(&wire->chain, wire->kernel, wire->memory, n_masses);
  chain_set(&wire->chain, coefs);
  note_design(wire, target->tone.f0_hz, coefs);
  wire->given = 0.0;
  wire->lent = 0.0;
  wire->is_kept = false;
  wire->loudest = 0.0;
  wire->n_choked = 0;
  wire->is_choked = false;
  wire->is_awake = true;
  wire->n_until_look = STRING_SPREAD * (1 + wire->phase);
  return true;
}

bool wire_retune(Wire* wire, const TuningTarget* target, uint32_t n_glide) {
  StringCoefs coefs = {0};
  hold_back(wire);
  if (!fit(wire, target, &coefs)) {
    return false;
  }
  note_design(wire, target->tone.f0_hz, coefs);
  chain_glide(&wire->chain, coefs, n_glide);
  wire->n_until_look = least(wire->n_until_look, n_glide + GLIDE_SPREAD * (1 + wire->phase));
  return true;
}

bool wire_mesh(Wire* wire, const TuningTarget* target, uint32_t n_masses) {
  Chain* const chain = &wire->chain;
  TuningTarget kept = *target;
  StringCoefs coefs = {0};
  kept.tone = pole_tone(wire->rate_hz, tuning_mode(chain->now, chain->n_masses, 1));
  if (tuning_fit(&kept, n_masses, &coefs)) {
    return false;
  }
  remesh(chain, n_masses);
  chain_set(chain, coefs);
  return true;
}

void wire_pluck(Wire* wire, Pluck pluck) {
  const double before = motion_of(wire);
  exciter_pluck(&wire->chain, pluck, 2.0 * PI * wire->f0_hz / wire->rate_hz);
  chain_settle(&wire->chain);
  wire->loudest = 0.0;
  note_pluck(wire, before);
}

void wire_feed(Wire* wire) {
  wire->given = fmax(wire->given, motion_of(wire));
  wire->n_until_look = LOOK_FRAMES;
}

void wire_choke(Wire* wire, bool is_choked) {
  wire->n_choked = is_choked == wire->is_choked ? wire->n_choked : 0;
  wire->is_choked = is_choked;
}

uint32_t wire_stretch(const Wire* wire) {
  return least(chain_stretch(&wire->chain), wire->n_until_look);
}

void wire_pass(Wire* wire, uint32_t n_frames) {
  wire->n_until_look -= n_frames;
  wire->n_choked += wire->is_choked ? n_frames : 0;
  if (wire->n_until_look == 0) {
    look(wire);
  }
}

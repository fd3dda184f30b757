#include "core/voice/voice.h"

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
static double motion_of(const Voice* voice) {
  const double a1 = tuning_mode(voice->chain.now, voice->chain.n_masses, 1).a;
  return chain_amplitude(&voice->chain, a1) * sqrt(sqrt(a1));
}

/* Take back what moving coefficients fed it beyond what may be. */
static void hold_back(Voice* voice) {
  const double most = MOST_FED * fmax(voice->given, voice->lent);
  const double motion = motion_of(voice);
  if (motion > most) {
    const float kept = (float)(most / motion);
    for (uint32_t i = 0; i < voice->chain.n_masses; ++i) {
      chain_place(&voice->chain, i, kept * chain_position(&voice->chain, i),
                  kept * chain_velocity(&voice->chain, i));
    }
  }
}

/* What moving coefficients fed it is not taken for a pluck's, and what others lent it not for its
 * own. */
static void note_pluck(Voice* voice, double before) {
  const double after = motion_of(voice);
  const double given = before > voice->given ? voice->given * (after / before) : after;
  voice->given = voice->lent > 0.0 ? fmax(given, voice->given + after - before) : given;
}

/* Remember what the coefficients were made for. */
static void note_design(Voice* voice, double f0_hz, StringCoefs coefs) {
  voice->f0_hz = f0_hz;
  voice->a1 = tuning_mode(coefs, voice->chain.n_masses, 1).a;
  voice->headroom = tuning_headroom(coefs, voice->chain.n_masses);
}

static uint32_t least(uint32_t a, uint32_t b) {
  return a < b ? a : b;
}

/* Coefficients for the masses that it has, or if they would give way too far, for fewer. */
static bool fit(Voice* voice, const TuningTarget* target, StringCoefs* coefs) {
  const uint32_t n_masses = voice->chain.n_masses;
  if (!tuning_fit(target, n_masses, coefs) && coefs->k2 > MOST_GIVEN_WAY * coefs->k1) {
    return true;
  }
  const uint32_t fewer = tuning_max_masses(target, n_masses);
  if (fewer > 0 && fewer < n_masses && voice_mesh(voice, target, fewer)) {
    return !tuning_fit(target, fewer, coefs);
  }
  return !tuning_fit(target, n_masses, coefs);
}

static bool is_let_go(const Voice* voice) {
  return voice->is_choked && voice->n_choked >= CHOKED_S * voice->rate_hz;
}

static void look(Voice* voice) {
  voice->loudest = fmax(voice->loudest, chain_amplitude(&voice->chain, HUGE_VAL));
  const double silence = fmax(SILENCE * voice->loudest, STILLNESS);
  const bool is_silent = !voice->is_kept && chain_amplitude(&voice->chain, voice->a1) < silence;
  if (is_let_go(voice) || is_silent) {
    voice_sleep(voice);
  } else {
    chain_settle(&voice->chain);
  }
  voice->n_until_look = LOOK_FRAMES;
}

uint32_t voice_gesture_frames(double rate_hz) {
  return (uint32_t)fmax(VOICE_GESTURE_FRAMES, round(VOICE_GESTURE_S * rate_hz));
}

void voice_init(Voice* voice, double rate_hz, uint32_t phase, void* memory, uint32_t capacity) {
  *voice = (Voice){.kernel = chain_kernel(0),
                   .memory = memory,
                   .capacity = capacity,
                   .phase = phase % N_PHASES,
                   .rate_hz = rate_hz};
}

void voice_sleep(Voice* voice) {
  if (voice->is_awake) {
    chain_rest(&voice->chain);
    voice->is_awake = false;
    voice->loudest = 0.0;
  }
}

bool voice_string(Voice* voice, const TuningTarget* target, uint32_t limit) {
  const uint32_t n_masses = tuning_max_masses(target, least(limit, voice->capacity));
  StringCoefs coefs = {0};
  voice_sleep(voice);
  if (n_masses == 0 || tuning_solve(target, n_masses, &coefs)) {
    return false;
  }
  chain_init(&voice->chain, voice->kernel, voice->memory, n_masses);
  chain_set(&voice->chain, coefs);
  note_design(voice, target->tone.f0_hz, coefs);
  voice->given = 0.0;
  voice->lent = 0.0;
  voice->is_kept = false;
  voice->loudest = 0.0;
  voice->n_choked = 0;
  voice->is_choked = false;
  voice->is_awake = true;
  voice->n_until_look = STRING_SPREAD * (1 + voice->phase);
  return true;
}

bool voice_retune(Voice* voice, const TuningTarget* target, uint32_t n_glide) {
  StringCoefs coefs = {0};
  hold_back(voice);
  if (!fit(voice, target, &coefs)) {
    return false;
  }
  note_design(voice, target->tone.f0_hz, coefs);
  chain_glide(&voice->chain, coefs, n_glide);
  voice->n_until_look = least(voice->n_until_look, n_glide + GLIDE_SPREAD * (1 + voice->phase));
  return true;
}

bool voice_mesh(Voice* voice, const TuningTarget* target, uint32_t n_masses) {
  Chain* const chain = &voice->chain;
  TuningTarget kept = *target;
  StringCoefs coefs = {0};
  kept.tone = pole_tone(voice->rate_hz, tuning_mode(chain->now, chain->n_masses, 1));
  if (tuning_fit(&kept, n_masses, &coefs)) {
    return false;
  }
  remesh(chain, n_masses);
  chain_set(chain, coefs);
  return true;
}

void voice_pluck(Voice* voice, Pluck pluck) {
  const double before = motion_of(voice);
  pluck_add(&voice->chain, pluck, 2.0 * PI * voice->f0_hz / voice->rate_hz);
  chain_settle(&voice->chain);
  voice->loudest = 0.0;
  note_pluck(voice, before);
}

void voice_feed(Voice* voice) {
  voice->given = fmax(voice->given, motion_of(voice));
  voice->n_until_look = LOOK_FRAMES;
}

void voice_choke(Voice* voice, bool is_choked) {
  voice->n_choked = is_choked == voice->is_choked ? voice->n_choked : 0;
  voice->is_choked = is_choked;
}

uint32_t voice_stretch(const Voice* voice) {
  return least(chain_stretch(&voice->chain), voice->n_until_look);
}

void voice_pass(Voice* voice, uint32_t n_frames) {
  voice->n_until_look -= n_frames;
  voice->n_choked += voice->is_choked ? n_frames : 0;
  if (voice->n_until_look == 0) {
    look(voice);
  }
}

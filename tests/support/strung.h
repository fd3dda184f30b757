/** What the tests of exciters share: strings anywhere in the range of the instruments, and their
 * energy in double. */
#ifndef HOOKE_TESTS_SUPPORT_STRUNG_H
#define HOOKE_TESTS_SUPPORT_STRUNG_H

#include "core/string/chain.h"
#include "tests/support/energy.h"
#include "tests/support/random.h"

/** A string and how fast it turns. */
typedef struct {
  Chain chain;
  double rate_hz;
  double f0_hz;
  double angle1; /**< 2πF/rate */
} Strung;

/** The rates that are tested at, in order. */
enum { STRUNG_N_RATES = 5 };
double strung_rate_hz(uint32_t i);

/** Pitch of a key, A4 at 440 Hz. */
double strung_pitch_hz(uint32_t key);

/** String `target` in `memory` (32 · CHAIN_MAX_MASSES bytes) with as many masses as it can have up
 * to `limit`, in floats or doubles. */
void strung_up(
    Strung* strung, void* memory, const TuningTarget* target, uint32_t limit, ChainNumbers numbers);

/** The string of a key, with true partials and little loss between its masses, in floats. */
void strung_key(
    Strung* strung, void* memory, uint32_t key, double rate_hz, uint32_t limit, double tau_s);

/** One anywhere: any key, rate and partials, τ and loss short or long, one mass to the limit. */
void strung_up_anywhere(Strung* strung, void* memory, Random* random, ChainNumbers numbers);

/** Step it once, and read it at mass `i`. */
float strung_step(Strung* strung, uint32_t i);

/** What it does, in all the digits that it has. */
void strung_read(const Strung* strung, Motion* motion);

/** ½ uᵀu + ½ xᵀK (x − u) of a motion: what ¼ uᵀZu more than H is. */
double strung_energy(const Motion* motion, StringCoefs coefs);

/** What the dampers took in a step between two motions: ½ (u' + u)ᵀ Z u. */
double strung_lost(const Motion* before, const Motion* after, StringCoefs coefs);

/** Amplitude of the fundamental. */
double strung_fundamental(const Strung* strung);

#endif

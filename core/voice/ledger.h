/**
   The books of a voice: what it was given, and whether it has more.

   Energies are compared as the square of the amplitude that the fundamental would have with all of
   them, which a bent clock (core/string/chain.h) leaves alone:

       4 E/((N + 1) a (1 − a/4)),   E that of chain_energy(), a the fundamental's.

   What plucks, hammers and bows give is the work of their own forces.  It dies with what rings.
   What rings in time with the gestures that feed it does not die; then as the slowest mode does.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_VOICE_LEDGER_H
#define HOOKE_CORE_VOICE_LEDGER_H

#include "core/string/chain.h"

#include <stdint.h>

/** Zero is that of a string to which nothing was given. */
typedef struct {
  double work;       /**< All that was done on it, less what was taken, as chain_energy() */
  double given;      /**< What is left of that, as a square */
  double lent;       /**< What other strings may have given it, as a square; HUGE_VAL: not known */
  uint32_t n_unseen; /**< Frames since these were last seen to */
} Ledger;

/** The square of the amplitude that a chain's fundamental would have with all of its energy. */
double ledger_square(const Chain* chain);

/** Work was done on the chain; less than 0: it was taken. */
void ledger_credit(Ledger* ledger, const Chain* chain, double work);

/** Others may have given it so much, as a square. */
void ledger_lend(Ledger* ledger, double square);

/**
   Bring the books up to now.

   @return The share of the chain's energy that it may keep, LEDGER_LEAST_KEPT to 1: at most 1.5 dB
   more than what was given or lent, for what is no bend changes that of its partials
*/
double ledger_settle(Ledger* ledger, const Chain* chain);

/** The least that is left of its energy at a time. */
#define LEDGER_LEAST_KEPT 1e-6

#endif

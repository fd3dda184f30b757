/**
   What sets a string in motion by pulling it aside and letting it go.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_EXCITE_PLUCK_H
#define HOOKE_CORE_EXCITE_PLUCK_H

#include "core/string/chain.h"

#include <stdint.h>

/** What full brightness does to hardness. */
#define PLUCK_BRIGHTER 0.4

/** Hardness that the softest hand comes to, whatever it plays with. */
#define PLUCK_SOFT (-0.2)

/** Half the width of the softest finger and of the hardest pick, as fractions of the length, and
 * the least [masses]: a narrower raised cosine would pull at the mode that masses cannot carry. */
#define PLUCK_SOFTEST 0.3
#define PLUCK_HARDEST 0.005
#define PLUCK_NARROWEST 2.0

/** A pluck; where, with what, and how far. */
typedef struct {
  double place;     /**< Fraction of the length, 0 to 1; kept off the walls by one mass */
  double hardness;  /**< 0: a wide, soft finger; 1: a narrow, hard pick */
  double amplitude; /**< The fundamental is to be 4/π of it in the middle, in units of output; less
                       than 0: pulled the other way */
  double
      softness; /**< Of the hand, see pluck_softness(); 0: it plays with what it has as that is */
} Pluck;

/**
   How soft a hand plays: 1 − (force/0.75)^0.75.  It takes hardness h to h + softness (PLUCK_SOFT −
   h), from where the string's masses would not tell it from what is harder; so the softest notes
   are duller at the bridge, beside the level, by 6 dB and more than the hardest.

   @param force  Share of the full force, as a velocity is of 127, 0 to 1
   @return 1, very soft, to −0.24
*/
double pluck_softness(double force);

/** What a hand of some softness makes of hardness: PLUCK_SOFT to 1. */
double pluck_played(double hardness, double softness);

/** Half the width of what plucks [masses], at least PLUCK_NARROWEST. */
double pluck_width(const Pluck* pluck, uint32_t n_masses);

/**
   Pull a string aside and let it go: what it has is added to, and what is added begins at rest.

   A finger pulls with a force f that is spread over its width by a raised cosine, never narrower
   than the masses can carry, and the string gives way until its own springs hold that, K x = f.  So
   partial k of a narrow finger's is sin(kπp)/k², and a wide one's falls faster.  At rest means that
   the centred velocity u − ½ K x is nought, so that x is the amplitude of each partial.

   The force is such that the fundamental's amplitude is 4/π · amplitude · sin(π place), at any
   number of masses and any rate; but for what the finger's width takes from it, at most 0.5 dB
   where no wall is near.  The string is then 2π place (1 − place) times the amplitude aside.

   The positions jump: who reads the string sees to it that nothing steps, see core/voice/onset.h.

   @return What it adds to the energy of the chain, see chain_energy()
*/
double pluck_pull(Chain* chain, Pluck pluck);

#endif

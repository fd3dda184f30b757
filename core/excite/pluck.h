/**
   What sets a string in motion by pulling it aside and letting it go.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_EXCITE_PLUCK_H
#define HOOKE_CORE_EXCITE_PLUCK_H

#include "core/string/chain.h"

/** How much harder than a pluck of the usual force the hardest one is, of 0 to 1: forces as
 * velocities are, of 1; and what full brightness does to hardness. */
#define PLUCK_HARDER 0.25
#define PLUCK_USUAL_FORCE 0.75
#define PLUCK_BRIGHTER 0.4

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
} Pluck;

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

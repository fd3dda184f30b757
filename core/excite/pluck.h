/**
   What sets a string in motion.

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
 * the least [masses]: a narrower raised cosine would excite the mode that masses cannot carry. */
#define PLUCK_SOFTEST 0.3
#define PLUCK_HARDEST 0.005
#define PLUCK_NARROWEST 2.0

/** A pluck; where, with what, and how far. */
typedef struct {
  double place;    /**< Fraction of the length, 0 to 1; kept off the walls by one mass */
  double hardness; /**< 0: a wide, soft finger; 1: a narrow, hard pick */
  double
      amplitude; /**< Largest displacement of the ideal string that it gives, in units of output */
} Pluck;

/**
   Pluck a chain: momentum is added to whatever motion it has.

   A string pulled aside to a point and let go moves, at a pickup of velocity, as a string pushed at
   that point does at a pickup of displacement.  So the pluck is given as a push, spread over the
   finger's width by a raised cosine that is never narrower than the masses can carry, and no
   position jumps: there is no step in the output that is not the string's own.  Its sum makes the
   fundamental's amplitude 4/π · amplitude · sin(π place) in its middle, as for the ideal string, at
   any number of masses and any rate.

   @param angle1  The fundamental's digital angular frequency 2πF/rate [rad per sample], 0 to π
   @return What it adds to the energy of the chain, see chain_energy()
*/
double pluck_add(Chain* chain, Pluck pluck, double angle1);

#endif

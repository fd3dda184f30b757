/**
   A hammer with a felt that is thrown at a string, bounces, and flies away.

   It acts between the steps of one frame (core/excite/contact.h), and what it and the string
   exchange in a step is solved for (core/excite/felt.h): with M, X, U its mass, position and scaled
   velocity, c = X − eᵀx and E the string's energy,

       E + ½ M U² + ½ (φ(c) + φ(c a step ago))

   is the same after the step but for what the felt and the string lose; so no hammer, however
   light, hard or fast, makes a string grow.  That is exact while others who act on the string in
   the same frames do not share a mass with it, and while it is told of all else that moves the
   string, see hammer_notice().

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_EXCITE_HAMMER_H
#define HOOKE_CORE_EXCITE_HAMMER_H

#include "core/excite/felt.h"
#include "core/string/chain.h"

#include <stdbool.h>
#include <stdint.h>

/** The longest that a hammer stays, and then takes to be drawn away [s]. */
#define HAMMER_MOST_S 0.1
#define HAMMER_LEAVING_S 0.005

/** Hardness that the softest hand comes to, whatever it strikes with. */
#define HAMMER_SOFT (-0.55)

/** A strike as it is wanted. */
typedef struct {
  double place;    /**< Fraction of the length, 0 to 1; kept off the walls by one mass */
  double hardness; /**< 0: a soft, long strike, to 1: a hard, short one; HAMMER_SOFT: the softest */
  double mass;     /**< Of the hammer, as a fraction of the string's, 0.02 to 1 */
  double amplitude; /**< As loud as a Pluck of it, in units of output, > 0 */
} Strike;

/** A hammer as it is. */
typedef struct {
  double place;    /**< As of a Strike */
  double mass;     /**< As a fraction of the string's, that is of N + 1 masses; > 0 */
  Felt felt;       /**< Its stiffness is per mass of the whole string: K = (N + 1) stiffness */
  double velocity; /**< Scaled, with which it is thrown */
} HammerMake;

/** A hammer at work; zero is none. */
typedef struct {
  HammerMake make;
  double position; /**< X */
  double velocity; /**< U, per step */
  double now;      /**< Compression, c */
  double before;   /**< Compression a step ago */
  double force;    /**< f in the last step, ≥ 0, in h²/m */
  double work;     /**< What it gave to the string in the last step, f eᵀ(u' + u)/2 */
  double hold;     /**< Share of the felt's stiffness that is left, 1 until its time is over */
  double fall;     /**< What it then loses a step */
  double far;      /**< Position behind which the string cannot reach it */
  uint32_t n_left; /**< Steps until its time is over */
  bool is_active;  /**< Whether it is to act */
} Hammer;

/** What a hand of some softness (core/excite/pluck.h) makes of hardness: HAMMER_SOFT to 1.  So the
 * softest notes are duller, beside the level, by 10 dB and more than the hardest. */
double hammer_hardness(double hardness, double softness);

/**
   Throw a hammer at a string, from just before it.

   Its speed is found in a rehearsal (core/excite/rehearsal.h) on a string at rest, such that the
   fundamental is that of pluck_pull() with the same amplitude: within 3 dB for masses from 0.1
   to 0.6 at places up to 0.3 from a wall.  In the middle both walls throw the wave back at once,
   and it may take a light, hard hammer's blow back again; heavier ones, which strike several times,
   and lighter ones may be a few dB softer.

   @param angle1  The fundamental's digital angular frequency 2πF/rate [rad per sample], 0 to π
*/
void hammer_throw(Hammer* hammer, const Chain* chain, Strike strike, double angle1, double rate_hz);

/** Throw a hammer that is made in a certain way. */
void hammer_start(Hammer* hammer, const Chain* chain, HammerMake make, double rate_hz);

/** See the string anew: call it before the next step when anything but its steps, other hammers or
 * bows has moved it.  Where that would have pressed the felt the hammer gives way. */
void hammer_notice(Hammer* hammer, const Chain* chain);

/**
   Let the hammer act for one step; call it after every step of one frame.  While it does not touch
   the string it only looks at it.

   @return false once it has left and the string cannot reach it; from then on it does nothing
*/
bool hammer_act(Hammer* hammer, Chain* chain);

#endif

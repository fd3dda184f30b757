/**
   What an exciter gives to each mode of a string at rest, in closed form but for the hammer's.

   A mode k swings as X_k sin(kπx) sin(ω_k n), and X_k² is what this room tells:

   - a pluck pulls the string aside with a force over a finger's width (core/excite/pluck.h), which
   gives way to each mode by 1/a_k; the transform of its raised cosine, cut off at the walls as it
   may be, has a closed form in the cosines of its two edges; of few masses, those under it are
   summed one by one;
   - a strike's is the spectrum of a hammer's rehearsal (core/excite/rehearsal.h), which falls on as
   it last did where that has no more masses;
   - under a bow it moves as Helmholtz's does, from frame to frame, X_k sin ω_k sin(ω_k/2) = 8/π² A
   sin ω_1 sin(ω_1/2), but where the bow is at a node of the mode, and but for what the mode loses
   in a round, which makes the corner that goes round rounder.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_EXCITE_SPECTRUM_H
#define HOOKE_CORE_EXCITE_SPECTRUM_H

#include "core/excite/exciter.h"
#include "core/excite/hammer.h"
#include "core/excite/pluck.h"
#include "core/excite/rehearsal.h"
#include "core/string/pole.h"

#include <stdint.h>

/** So few plucked masses are summed one by one. */
enum { SPECTRUM_FEW = 48 };

/** Make one by a function below; amplitudes are for a pluck, strike or stroke of amplitude 1. */
typedef struct {
  Exciter exciter;
  double angles[2]; /**< Mode k is told the cosines of k times these, see spectrum_square() */
  double push;      /**< What a pluck at one point would pull mode k with, X_k a_k; what a strike
                       pushes the first with, X_1 sin ω_1; or X_1 of a bow */
  double width;     /**< Half of the finger's, in radians of the fundamental's shape */
  double edges[2]; /**< Cosine of the finger's own phase at each edge, −1 where no wall cuts it */
  double angle1;   /**< The fundamental's digital angular frequency [rad per sample] */
  uint32_t
      n_shares; /**< Partials that its rehearsal is believed of; or all, of few plucked masses */
  double shares[SPECTRUM_FEW]; /**< Their push squared: of the first's; or of `push` */
  double last;                 /**< The mean of the last of them, from which the rest go on */
  double fall;                 /**< What it changes by from a partial to the next, ≤ 1 */
} Spectrum;

/**
   Of a pluck.

   @param n_masses  N ≥ 1
   @param angle1    2πF/rate [rad per sample], 0 to π
*/
Spectrum spectrum_of_pluck(uint32_t n_masses, Pluck pluck, double angle1);

/** Of a strike, whose amplitude matters: louder ones are brighter. */
Spectrum spectrum_of_strike(uint32_t n_masses, Strike strike, double angle1);

/** Of a bow, once it is drawn in full. */
Spectrum spectrum_of_bow(double place, double angle1);

/**
   X_k².

   @param k        1 to N
   @param mode     Mode k of the string, 0 < a < 4
   @param cosines  cos(k angles[0]) and cos(k angles[1])
*/
double spectrum_square(const Spectrum* spectrum, uint32_t k, Pole mode, const double cosines[2]);

#endif

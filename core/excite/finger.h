/**
   A finger that rests lightly on a string: a damper at one place.

   It takes what a damper of the string's own impedance would take, which is the most that one can,
   and partials that have a node there ring on.  As a force in the next step it would have to be
   weak, or the string would grow.  So it acts between the steps, on what the scheme's energy says
   is moving there: with y = x − u/2 and B = I − Z/2 − K/4 that energy is

       H = ½ uᵀB u + ½ yᵀK y,

   and with e the place, laid on the four masses about it, so that partials with a node
   between two masses do not drive the others,

       u ← u − θ e (eᵀB u)/(eᵀB e),   y as it was,

   takes from it for any 0 ≤ θ ≤ 2, whatever the string does.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_EXCITE_FINGER_H
#define HOOKE_CORE_EXCITE_FINGER_H

#include "core/string/chain.h"

/**
   Let the finger act for one step; call it after every step of one frame.

   @param place   Fraction of the length, 0 to 1
   @param weight  0: no finger, to 1: one of twice the string's impedance
   @return What it takes from H, ≥ 0
*/
double finger_act(Chain* chain, double place, double weight);

#endif

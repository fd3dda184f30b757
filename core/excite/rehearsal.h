/**
   How fast a hammer is to be thrown.

   What a strike does to a string depends on the hammer's mass, its felt and the place, and not in
   proportion to its speed.  So it is tried first on a small string: of the same masses, but at most
   a few, at rest, flexible, undamped, and stepped no more often than they need, with which the
   hammer is made alike in all that does not depend on the number of masses or the rate: mass as a
   share of the string's, time as a share of the period.  A few tries find the speed.

   Thread: any; real-time safe: the longest takes some tens of microseconds.
*/
#ifndef HOOKE_CORE_EXCITE_REHEARSAL_H
#define HOOKE_CORE_EXCITE_REHEARSAL_H

#include "core/excite/hammer.h"

/** Partials that a string of enough masses is rehearsed with. */
enum { REHEARSAL_PARTIALS = 20 };

/**
   Make the hammer for a strike.

   The felt's stiffness is a matter of the strike's hardness, in terms of the string's mass and
   period.  A louder strike presses it further, where it is stiffer, and so is shorter and brighter;
   less so than if the felt were the same for the softest and the loudest, whose strikes would then
   differ a hundredfold in their length.

   @param n_masses  Of the string that is to be struck, ≥ 1
   @param angle1    Its fundamental's digital angular frequency [rad per sample], 0 to π
*/
HammerMake rehearsal_make(uint32_t n_masses, Strike wanted, double angle1);

/**
   Find what a strike pushes each mode by, squared, of the first's.

   @param[out] shares  As many as are returned
   @return How many modes there are: n_masses or REHEARSAL_PARTIALS, if that is less
*/
uint32_t rehearsal_spectrum(uint32_t n_masses,
                            Strike wanted,
                            double angle1,
                            double shares[REHEARSAL_PARTIALS]);

#endif

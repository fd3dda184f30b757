/**
   The one point of a string that a hammer or a bow touches, for what acts between the steps of one
   frame.

   A force f within a step, in h²/m, at the place e (weights in a straight line between the masses
   beside it) makes of the free step's (x*, u*)

       u' = u* + e f,   x' = x* + e f,

   and its work on the scheme's energy, ½ uᵀu + ½ xᵀK (x − u), is f eᵀ(u' + u)/2, u being the
   velocity before the step: half of what the place has moved in two.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_EXCITE_CONTACT_H
#define HOOKE_CORE_EXCITE_CONTACT_H

#include "core/string/chain.h"

/** e of a place; masses count from 0. */
typedef struct {
  uint32_t mass[2];
  double weight[2];
  double square; /**< eᵀe: what a force of 1 adds to the place's own velocity */
} Contact;

/** The place at a fraction of the length, 0 to 1; kept off the walls by one mass. */
Contact contact_at(const Chain* chain, double place);

/** eᵀe of two places. */
double contact_overlap(const Contact* a, const Contact* b);

/** eᵀx. */
double contact_position(const Chain* chain, const Contact* contact);

/** eᵀu. */
double contact_velocity(const Chain* chain, const Contact* contact);

/** Add e f to positions and velocities. */
void contact_push(Chain* chain, const Contact* contact, double force);

#endif

/**
   The motion of a string of one number of masses, moved onto another.

   A bend may take a string to a pitch that its masses cannot hold: the shape is then moved onto
   fewer, and onto more again when there is room.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_STRING_REMESH_H
#define HOOKE_CORE_STRING_REMESH_H

#include "core/string/chain.h"

#include <stdint.h>

enum { REMESH_REACH = 8 };

/**
   Give a chain `n_masses` instead, its shape and velocity kept, but for what the fewer masses
   cannot carry.  Positions are interpolated with a windowed sinc of REMESH_REACH zero crossings to
   a side, and mirrored, upside down, in the walls.  The coefficients are the caller's to set: they
   are 0 after.  Reads 2 REMESH_REACH masses for each of the more.

   @param n_masses  1 to as many as the chain's memory holds
*/
void remesh(Chain* chain, uint32_t n_masses);

#endif

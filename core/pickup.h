/**
   Where a string is read.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_PICKUP_H
#define HOOKE_CORE_PICKUP_H

#include "core/chain.h"

/**
   The tap that reads a string at `place`, in a straight line between the two masses beside it; the
   walls read 0.

   @param n_masses  N ≥ 1; mass i (from 1) is at place i/(N + 1)
   @param place     Fraction of the length, 0 to 1
*/
ChainTap pickup_tap(uint32_t n_masses, double place);

#endif

/**
   A little noise for links before they are rounded to fixed point.

   The error of a rounded number repeats itself as the number does, and a wave on a string passes
   every link: where all partials are in step, so are the errors, and in a few seconds they carry
   the fundamental's energy away.  A number that had something evenly spread between −1/2 and 1/2
   added is rounded right in the mean, and its errors forget each other.

   The table has such numbers for CHAIN_MAX_LANES lanes.  Each lane has every value (i + 1/2)/256 −
   1/2 once in CHAIN_DITHER_PERIOD places, in an order of its own, and then all again, so that a
   string may begin anywhere in the first period.

   Thread: any; a constant.
*/
#ifndef HOOKE_CORE_STRING_CHAIN_DITHER_H
#define HOOKE_CORE_STRING_CHAIN_DITHER_H

#include "core/string/chain_kernel.h"

enum {
  CHAIN_DITHER_PERIOD = 256,
  CHAIN_DITHER_PLACES = 512, /**< Two periods, for a string may begin at the end of the first */
};

/** [place][lane]; aligned to CHAIN_ALIGNMENT. */
extern const float chain_dither[CHAIN_DITHER_PLACES][CHAIN_MAX_LANES];

#endif

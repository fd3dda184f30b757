/**
   Numbers by chance that can be had again: each is a function of a seed and its place in a row, and
   nothing is kept, so that what is asked in another order, or on another machine, is the same.

   The n-th number of SplitMix64 of Steele, Lea and Flood, begun where a hash of the seed says.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_BASE_CHANCE_H
#define HOOKE_CORE_BASE_CHANCE_H

#include <stdint.h>

/** 64 bits, the `n`-th of a seed's row.  They are a seed, too: of a row of rows. */
uint64_t chance_bits(uint64_t seed, uint64_t n);

/** The same as a number from −1 to below 1, evenly. */
double chance_even(uint64_t seed, uint64_t n);

#endif

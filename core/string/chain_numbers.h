/**
   What a chain's masses are kept in: where they lie in memory, and how they pass from one kind of
   numbers to another.  For core/string/chain.c, and core/excite/contact.c, which must not round to
   floats.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_STRING_CHAIN_NUMBERS_H
#define HOOKE_CORE_STRING_CHAIN_NUMBERS_H

#include "core/string/chain.h"

#include <stddef.h>
#include <stdint.h>

/** Bytes that hold `n_masses` in any numbers. */
size_t chain_numbers_size(uint32_t n_masses);

/** Lay the masses, at rest, in floats. */
void chain_numbers_lay(Chain* chain);

/** Where mass `i` is among the numbers of the cells: its position; one vector on, its velocity. */
size_t chain_numbers_offset(const Chain* chain, uint32_t i);

/** Position of mass `i`. */
double chain_numbers_position(const Chain* chain, uint32_t i);

/** Scaled velocity of mass `i`. */
double chain_numbers_velocity(const Chain* chain, uint32_t i);

/** Positions and scaled velocities of all masses. */
void chain_numbers_read(const Chain* chain, double* x, double* u);

/** Add to those of all masses; not in fixed point. */
void chain_numbers_add(Chain* chain, const double* x, const double* u);

/** Put mass `i` at position `x` with scaled velocity `u`; not in fixed point. */
void chain_numbers_place(Chain* chain, uint32_t i, double x, double u);

/** Sums over the masses in true units. */
ChainSums chain_numbers_sum(const Chain* chain);

/** Leave fixed point, which only a string can have that nothing touches. */
void chain_numbers_touch(Chain* chain);

#endif

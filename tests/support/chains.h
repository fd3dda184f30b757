/** What the tests of chains share: sizes, scenes, and a look at the numbers themselves. */
#ifndef HOOKE_TESTS_SUPPORT_CHAINS_H
#define HOOKE_TESTS_SUPPORT_CHAINS_H

#include "core/string/chain.h"
#include "tests/support/random.h"

#include <stddef.h>
#include <stdint.h>

/** Enough for the largest string, with what lies around it. */
enum { CHAINS_MOST_BYTES = 32 * CHAIN_MAX_MASSES };

/** Every way in which masses can fill the lanes, and the largest strings. */
enum { CHAINS_N_SMALL = 70, CHAINS_N_SIZES = CHAINS_N_SMALL + 8 };
uint32_t chains_size(uint32_t i);

/** A string near its limit that needs just these loops. */
StringCoefs chains_coefs(ChainDamping damping, ChainElasticity elasticity);

/** `coefs`, each rounded to float. */
StringCoefs chains_rounded(StringCoefs coefs);

/** The coefficients as the chain's loop has them while it stands still. */
StringCoefs chains_seen(const Chain* chain);

/** Numbers in the chain's cells, masses or not. */
size_t chains_n_numbers(const Chain* chain);

/** One of them, as it is. */
double chains_number(const Chain* chain, size_t m);

/** The numbers of all masses, as they are: in CHAIN_FIXED whole, and without the gain. */
void chains_read(const Chain* chain, double* x, double* u);

/** Place every mass at random, up to 1, with a velocity up to 1. */
void chains_place_noise(Chain* chain, Random* random);

/**
   Make a chain of `n` masses in `memory` that moves at random, the same for every kernel.

   Whole numbers have little air, see chain_fixed_design(), and no undamped string: there it is one
   with air that pretends, for there is a loop.
*/
void chains_start(Chain* chain,
                  const ChainKernel* kernel,
                  void* memory,
                  ChainNumbers numbers,
                  ChainDamping damping,
                  ChainElasticity elasticity,
                  uint32_t n);

/** Step it; nobody listens. */
void chains_run(Chain* chain, uint32_t n_frames);

/** The largest |x|. */
double chains_largest(const double* x, uint32_t n);

/** The largest |x − y|. */
double chains_distance(const double* x, const double* y, uint32_t n);

#endif

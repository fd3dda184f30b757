/**
   The ways to make a string, and how far each errs, in closed form: what `hooke bench survey`
   compares.

   Every mode of the uniform string is one mass, so each way has its poles exactly: those of
   core/string/pole.h for the chain, of a 2 × 2 matrix (tools/bench/bench_step.h) for the other
   schemes, and the very numbers of its phasors for the bank of modes.  The poles are those of the
   coefficients that a loop really has, rounded to its precision.

   The string that is wanted is a TuningTarget; how true its partials are is up to the way.

   Thread: any; allocates nothing.
*/
#ifndef HOOKE_TOOLS_BENCH_BENCH_WAY_H
#define HOOKE_TOOLS_BENCH_BENCH_WAY_H

#include "core/analysis/network_schemes.h"
#include "core/string/chain_kernel.h"
#include "core/string/tuning.h"

#include <stdbool.h>
#include <stdint.h>

/** What steps the string; X(name, text). */
#define BENCH_KIND_LIST(X)                                                                         \
  X(CHAIN, "chain")     /* core/string/chain: symplectic Euler, along the string */                \
  X(NETWORK, "network") /* core/analysis/network_schemes: link by link, in doubles */              \
  X(BANK, "bank")       /* tools/bench/bench_bank.h: its modes, without a string */

#define BENCH_KIND_ENUM(name, text) BENCH_##name,
typedef enum { BENCH_KIND_LIST(BENCH_KIND_ENUM) BENCH_N_KINDS } BenchKind;
#undef BENCH_KIND_ENUM

/** A way to make a string. */
typedef struct {
  BenchKind kind;
  NetworkScheme scheme; /**< NETWORK_SYMPLECTIC but for a network */
  Partials partials;    /**< PARTIALS_LUMPED but for a chain */
  ChainNumbers numbers; /**< CHAIN_DOUBLE but for a chain */
  bool is_corrected; /**< Solved for what is heard; else a = (ω0 h)², g = 2h/τ as if nothing were
                          warped */
} BenchWay;

/** How many there are: the chain in 3 numbers and 3 partials, and as the paper finds it; 5 schemes,
 * corrected or not; the bank. */
enum { BENCH_N_WAYS = 3 * 3 + 1 + 2 * NETWORK_SCHEME_COUNT + 1 };

/** Way `i` of BENCH_N_WAYS. */
BenchWay bench_way_at(unsigned i);

/** Partials that are compared, and what one counts for that is missing or further out [cents]. */
enum { BENCH_N_PARTIALS = 20 };
#define BENCH_MISSING_CENTS 1200.0

/**
   The coefficients of `n_masses`, not yet rounded; of a bank nothing.

   @return false where the way has none: an error of the scheme that no damper can correct
*/
bool bench_way_coefs(BenchWay way, TuningTarget wanted, uint32_t n_masses, StringCoefs* coefs);

/** The same, as loops of floats and of fixed point have them. */
StringCoefs bench_way_rounded(StringCoefs coefs);

/** The k-th partial of the ideal or stiff string [Hz], k f1 √((1 + B k²)/(1 + B)). */
double bench_way_ideal_hz(TuningTarget wanted, uint32_t k);

/**
   What is heard of mode `k`, 1 ≤ k ≤ n_masses.

   @return false where the way has no such string; see bench_way_coefs()
*/
bool bench_way_tone(BenchWay way, TuningTarget wanted, uint32_t n_masses, uint32_t k, Tone* tone);

/** Whether no mode grows. */
bool bench_way_is_stable(BenchWay way, TuningTarget wanted, uint32_t n_masses);

/** The largest stable number of masses, or the number of modes below Nyquist, at most 1024.  The
 * ways that are never or always stable are given what the chain can have. */
uint32_t bench_way_max_masses(BenchWay way, TuningTarget wanted);

/** From the ideal string's partial k to the one that is heard [cents]; NAN if there is none. */
double bench_way_partial_cents(BenchWay way, TuningTarget wanted, uint32_t n_masses, uint32_t k);

/** Which loop steps such a string: the same for two that take the same time at as many masses. */
unsigned bench_way_loop(BenchWay way, StringCoefs coefs);

/** The error of the fundamental's τ [%], without its sign. */
double bench_way_decay_percent(BenchWay way, TuningTarget wanted, uint32_t n_masses);

/** The root of the mean square of bench_way_partial_cents() over the first BENCH_N_PARTIALS that
 * the ideal string has below Nyquist; each at most BENCH_MISSING_CENTS, which the missing count
 * for. */
double bench_way_partials_cents(BenchWay way, TuningTarget wanted, uint32_t n_masses);

#endif

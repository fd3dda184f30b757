/**
   What a string costs and how far it errs: the ways to make one, and their errors in closed form.

   Every mode of the uniform string is one mass, so each way has its poles exactly: those of
   core/string/pole.h for the chain, of a 2 × 2 matrix (tools/bench/bench_step.h) for the other
   schemes, and the very numbers of its phasors for the bank of modes.  The poles are those of the
   coefficients that a loop really has, rounded to its precision.

   Thread: any; allocates nothing.
*/
#ifndef HOOKE_TOOLS_BENCH_BENCH_WAY_H
#define HOOKE_TOOLS_BENCH_BENCH_WAY_H

#include "core/analysis/network_schemes.h"
#include "core/string/chain_kernel.h"
#include "core/string/tuning.h"

#include <stdbool.h>
#include <stdint.h>

/** What steps the string. */
typedef enum {
  BENCH_CHAIN,   /**< core/string/chain: symplectic Euler, along the string */
  BENCH_NETWORK, /**< core/analysis/network_schemes: link by link, in doubles */
  BENCH_BANK,    /**< tools/bench/bench_bank.h: its modes, without a string */
  BENCH_N_KINDS
} BenchKind;

/** A way to make a string. */
typedef struct {
  BenchKind kind;
  NetworkScheme scheme; /**< NETWORK_SYMPLECTIC but for a network */
  Partials partials;    /**< PARTIALS_LUMPED but for a chain */
  ChainNumbers numbers; /**< CHAIN_DOUBLE for a network */
  bool is_corrected; /**< Solved for what is heard; else a = (ω0 h)², g = 2h/τ as if nothing were
                          warped */
} BenchWay;

/** How many there are: the chain in 3 numbers (whole ones first), 3 partials, corrected or not; 5
 * schemes, corrected or not; the bank in floats and doubles. */
enum { BENCH_N_WAYS = 3 * 3 * 2 + 2 * NETWORK_SCHEME_COUNT + 2 };

/** Method `i` of BENCH_N_WAYS. */
BenchWay bench_way_at(unsigned i);

/** A method in words: "chain, True, whole" and the like. */
enum { TRADE_NAME_SIZE = 64 };
void bench_way_name(BenchWay method, char name[TRADE_NAME_SIZE]);

/** The string that is asked for. */
typedef struct {
  double f0_hz;
  double tau_s;         /**< Of the fundamental */
  double inharmonicity; /**< B */
  double loss;          /**< Share of the fundamental's damping that sits between the masses */
  double rate_hz;
} TradeString;

/** Partials that are compared, and what one counts for that is missing or further out [cents]. */
enum { TRADE_N_PARTIALS = 20 };
#define TRADE_MISSING_CENTS 1200.0

/** The string as core/string/tuning.h is asked for it. */
TuningTarget bench_way_target(BenchWay method, TradeString string);

/**
   The coefficients of `n_masses`, not yet rounded; of a bank nothing.

   @return false where the method has none: an error of the scheme that no damper can correct
*/
bool bench_way_coefs(BenchWay method, TradeString string, uint32_t n_masses, StringCoefs* coefs);

/** The k-th partial of the ideal or stiff string [Hz], k f1 √((1 + B k²)/(1 + B)). */
double bench_way_ideal_hz(TradeString string, uint32_t k);

/**
   What is heard of mode `k`, 1 ≤ k ≤ n_masses.

   @return false where the method has no such string; see bench_way_coefs()
*/
bool bench_way_tone(BenchWay method, TradeString string, uint32_t n_masses, uint32_t k, Tone* tone);

/** Whether no mode grows. */
bool bench_way_is_stable(BenchWay method, TradeString string, uint32_t n_masses);

/** The largest stable number of masses, or the number of modes below Nyquist, at most 1024.  The
 * methods that are never or always stable are given what the chain can have. */
uint32_t bench_way_max_masses(BenchWay method, TradeString string);

/** From the ideal string's partial k to the one that is heard [cents]; NAN if there is none. */
double bench_way_partial_cents(BenchWay method, TradeString string, uint32_t n_masses, uint32_t k);

/** Up to which partial of the ideal string, one after the other, none is missing or further out
 * than `cents`; 0: not even the first. */
uint32_t bench_way_true_up_to(BenchWay method, TradeString string, uint32_t n_masses, double cents);

/** Which loop steps such a string: the same for two that take the same time at as many masses. */
unsigned bench_way_loop(BenchWay method, StringCoefs coefs);

/** The fundamental's pitch error [cents], without its sign. */
double bench_way_pitch_error(BenchWay method, TradeString string, uint32_t n_masses);

/** The error of the fundamental's τ [%], without its sign. */
double bench_way_decay_error(BenchWay method, TradeString string, uint32_t n_masses);

/** The root of the mean square of bench_way_partial_cents() over the first TRADE_N_PARTIALS that
 * the ideal string has below Nyquist; each at most TRADE_MISSING_CENTS, which the missing count
 * for. */
double bench_way_partials_error(BenchWay method, TradeString string, uint32_t n_masses);

#endif

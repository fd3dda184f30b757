/**
   The bridge: a place on a body (core/bank/body.h), or on one mass with a spring and a damper, that
   the far ends of many strings pull at, so that a string which nobody plays answers one that is
   played, and that all answer the body.

   String j has N masses, the one that is nearest to the bridge being its last, e, and pulls at it
   by its last link.  With a lever ρ, 0 to 1, between the two, p = ρ k1 and a mass of the string's
   that is r = q/(N + 1) of 1 kg (q: the whole string's), one step of the whole is, all from the
   state before it,

       u_j ← (the string's own step) + e p_j y,
       f = Σ_j r_j p_j eᵀx_j − y Σ_j s_j,
       w_i ← w_i + f/M_i − a_i y_i − g_i w_i ;   y_i ← y_i + w_i ;   y = Σ_i y_i.

   y is the bridge's displacement times the lever, y_i what mode i of the body has in it and w_i how
   fast that goes, a_i, g_i and M_i [kg] what the mode is.  At ρ = 0 there is no bridge.

   Spring.  s is what the string adds to the bridge's springs.  A taut string pulls its ends back,
   high ones so much that the body would be another for each of them that begins or ends to sound.
   So that pull is taken to be part of it: with C = eᵀK⁻¹e, how far a pull of 1 displaces the last
   mass,

       s = r p² C,

   and the body with its strings at rest is as stiff as alone, whichever they are.

   Stability.  The matrix of all springs, each string's weighed by its r, is a sum of parts, one a
   string, with Schur complement s − r p² C = 0, and the body's own: so it is positive where the
   strings' are.  At the other end, 4 − 2Z − K, completing the squares of all strings and then of
   the modes leaves

       1 − B Σ_j load_j,   load = s + r p² eᵀ(4 − 2Z − K)⁻¹e,   B = Σ_i 1/(M_i (4 − 2g_i − a_i)),

   so the whole is stable iff each string is and that is not negative: bridge_headroom().  Both hold
   of every mixture of two that are stable, so p, s and the coefficients may glide from one to the
   other in straight lines.

   Pitch.  With D(z) = z − 2 + 1/z + a + g (1 − 1/z), modes k of the string, φ_k² = (2/(N + 1))
   sin²(kπ/(N + 1)) and S(z) = Σ_i 1/(M_i D_i(z)) of the body, a pole of the two is where

       D_1(z) = ε(z) = r p² φ_1² / (1/S(z) + s − r p² Σ_{k ≥ 2} φ_k²/D_k(z)),

   that is a1 + g1 (1 − 1/z) = ε − z + 2 − 1/z, which gives a1 and g1 for the z that is wanted.

   Wolves.  Where a mode of the body is at the string's pitch and the two exchange their motion
   faster than the mode loses it, there is no string at that pitch: they are two poles to both sides
   of it, and no a1 and g1 bring one back.  So a string near a mode has as short a lever as leaves
   it the pole: there the body moves, with all its modes and in squares, a quarter as much as the
   string at the most, r p² φ_1² Σ_i 1/(M_i |D_i|²) ≤ 1/4, and ε is a tenth of a1 at the most.

   Thread: any.  All of this room is real-time safe and allocates nothing; what sums over modes
   takes a time that grows with the masses.
*/
#ifndef HOOKE_CORE_VOICE_BRIDGE_H
#define HOOKE_CORE_VOICE_BRIDGE_H

#include "core/bank/body.h"
#include "core/string/tuning.h"

#include <stdbool.h>
#include <stdint.h>

/**
   The most that one string may take of the stability limit, load B; with 160 of them a fifth of it
   is left.  What would take more, which is a string so near half the rate that it has a mass or
   two, has a shorter lever.
*/
#define BRIDGE_MOST_LOAD 0.005

/** The bridge and how it moves; zero does not move. */
typedef struct {
  Bank bank;       /**< The modes of what it is on */
  double y;        /**< Displacement, times the lever */
  double give;     /**< B */
  bool is_leaving; /**< It will be on something else once no string is tied: none may be */
} Bridge;

/** How a string is tied to the bridge; zero is not at all. */
typedef struct {
  double weight; /**< r: a mass of the string's [kg] */
  double pull;   /**< p: on the last mass, for y = 1 */
  double spring; /**< s: what it adds to the bridge's spring */
  double load;   /**< What it takes of the stability limit, over B */
} BridgeTie;

/** What makes a tie. */
typedef struct {
  double mass;  /**< q: the whole string's [kg], ≥ 0 */
  double lever; /**< ρ, 0 to 1 */
} BridgeHold;

/** The bridge of a harp without a body, at rest: 1 kg at 60 Hz, half the critical damping; at rates
 * below 960 Hz, a sixteenth of the rate.  `rate_hz` > 0 [Hz]. */
void bridge_init(Bridge* bridge, double rate_hz);

/** A bridge on a body, at rest; one that moves nowhere where the body has no mode. */
void bridge_init_on(Bridge* bridge, const Body* body, BodyShape shape, double rate_hz);

/** Bring it to rest. */
void bridge_rest(Bridge* bridge);

/**
   q of a string, by the pitch that it is made for: heavy strings are low.

       q = 0.01/((1 + f0/110 Hz) (1 + (f0/1500 Hz)²)),

   which makes high and low strings answer about as fast, some 0.1 of the motion in a second at
   ρ = 1/2; but the highest less, as a steady pull of theirs, a bow's, moves the bridge by q f0.
*/
double bridge_mass(double f0_hz);

/** The tie of a stable string of `n_masses` with `coefs`; it takes at most BRIDGE_MOST_LOAD. */
BridgeTie bridge_tie(const Bridge* bridge, StringCoefs coefs, uint32_t n_masses, BridgeHold hold);

/**
   What is left of the whole's stability limit, 1 − B Σ load.  The whole is stable iff each string
   is and this is not negative.

   @param load  Of all strings that are tied
*/
double bridge_headroom(const Bridge* bridge, double load);

/** What the bridge does to a string's fundamental; zero is not known. */
typedef struct {
  double pitch;   /**< What to ask of the string, over what is wanted */
  double damping; /**< The same of g */
} BridgeShift;

/**
   The target to be asked of a string alone, tuning_fit(), for it to have the pitch and decay of
   `target` once it is tied to the bridge and no other string moves.

   What the bridge takes from the fundamental is left out of the dampers to the ground, down to half
   of what they were: partials have the same of those, but the bridge takes less from them.  Where
   it takes more, the pitch is still exact, and the string dies sooner than was asked.

   @param n_masses       Those that the string will have, ≥ 1
   @param[in,out] hold   How it is to be tied; with a shorter lever where a mode of the body at its
   pitch would else make a wolf of it
   @param[in,out] shift  What it was the last time, for that saves time where it moves little; what
   it is now
   @return `target` as it was where `hold` is none, or the target cannot be had
*/
TuningTarget bridge_correct(const Bridge* bridge,
                            TuningTarget target,
                            uint32_t n_masses,
                            BridgeHold* hold,
                            BridgeShift* shift);

/**
   One step, after those of the strings.

   @param force   Σ r p eᵀx, the strings' last masses being where they were before their step
   @param spring  Σ s
*/
void bridge_step(Bridge* bridge, double force, double spring);

#endif

/**
   The bridge: one mass on a spring and a damper that the far ends of many strings pull at, so that
   a string which nobody plays answers one that is played.

   String j has N masses, the one that is nearest to the bridge being its last, e, and pulls at it
   by its last link.  With a lever ρ, 0 to 1, between the two, p = ρ k1 and a mass of the string's
   that is r = q/(N + 1) of the bridge's (q: the whole string's), one step of the whole is, all from
   the state before it,

       u_j ← (the string's own step) + e p_j y,
       w ← w + Σ_j r_j p_j eᵀx_j − (a + Σ_j s_j) y − g w ;   y ← y + w.

   y is the bridge's displacement times the lever, w its scaled velocity, a and g those of the bare
   bridge (core/string/pole.h).  At ρ = 0 there is no bridge.

   Spring.  s is what the string adds to the bridge's spring.  A taut string pulls its ends back,
   high ones so much that the bridge would be another for each of them that begins or ends to sound.
   So that pull is taken to be part of a: with C = eᵀK⁻¹e, how far a pull of 1 displaces the last
   mass,

       s = r p² C,

   and the bridge with its strings at rest has the same stiffness a, whichever they are.

   Stability.  The matrix of all springs, each string's weighed by its r, is a sum of parts, one a
   string, with Schur complement s − r p² C = 0, and the bridge's own a: so it is positive where the
   strings' are.  At the other end, 4 − 2Z − K, the complement of the whole is

       4 − a − 2g − Σ_j load_j,   load = s + r p² eᵀ(4 − 2Z − K)⁻¹e,

   so the whole is stable iff each string is and that is not negative: bridge_headroom().  Both hold
   of every mixture of two that are stable, so p, s and the coefficients may glide from one to the
   other in straight lines.

   Pitch.  With D(z) = z − 2 + 1/z + a + g (1 − 1/z), modes k of the string, φ_k² = (2/(N + 1))
   sin²(kπ/(N + 1)) and D_b that of the bridge with one string's spring, a pole of the two is where

       D_1(z) = ε(z) = r p² φ_1² / (D_b(z) − r p² Σ_{k ≥ 2} φ_k²/D_k(z)),

   that is a1 + g1 (1 − 1/z) = ε − z + 2 − 1/z, which gives a1 and g1 for the z that is wanted.

   Thread: any.  All of this room is real-time safe and allocates nothing; what sums over modes
   takes a time that grows with the masses.
*/
#ifndef HOOKE_CORE_VOICE_BRIDGE_H
#define HOOKE_CORE_VOICE_BRIDGE_H

#include "core/string/tuning.h"

#include <stdint.h>

/**
   The most that one string may take of the bridge's stability limit; with 128 of them a tenth of
   the limit is left at any rate.  What would take more, which is a string so near half the rate
   that it has a mass or two, has a shorter lever.
*/
#define BRIDGE_MOST_LOAD 0.02

/** The bridge and how it moves; zero is a free mass at rest. */
typedef struct {
  Pole bare; /**< Without strings */
  double y;  /**< Displacement, times the lever */
  double w;  /**< Scaled velocity h dy/dt */
} Bridge;

/** How a string is tied to the bridge; zero is not at all. */
typedef struct {
  double weight; /**< r: a mass of the string's over the bridge's */
  double pull;   /**< p: on the last mass, for y = 1 */
  double spring; /**< s: what it adds to the bridge's spring */
  double load;   /**< What it takes of the stability limit */
} BridgeTie;

/** What makes a tie. */
typedef struct {
  double mass;  /**< q: the whole string's, over the bridge's, ≥ 0 */
  double lever; /**< ρ, 0 to 1 */
} BridgeHold;

/** The bridge of the harp at rest: 60 Hz, half the critical damping; at rates below 960 Hz, a
 * sixteenth of the rate.  `rate_hz` > 0 [Hz]. */
Bridge bridge_at(double rate_hz);

/**
   q of a string, by the pitch that it is made for: heavy strings are low.

       q = 0.01/((1 + f0/110 Hz) (1 + (f0/1500 Hz)²)),

   which makes high and low strings answer about as fast, some 0.1 of the motion in a second at
   ρ = 1/2; but the highest less, as a steady pull of theirs, a bow's, moves the bridge by q f0.
*/
double bridge_mass(double f0_hz);

/** The tie of a stable string of `n_masses` with `coefs`; its load is at most BRIDGE_MOST_LOAD. */
BridgeTie bridge_tie(StringCoefs coefs, uint32_t n_masses, BridgeHold hold);

/**
   What is left of the whole's stability limit, as tuning_headroom(): 1 − (a + 2g + Σ load)/4.  The
   whole is stable iff each string is and this is not negative.

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
   @param[in,out] shift  What it was the last time, for that saves time where it moves little; what
   it is now
   @return `target` as it was where `hold` is none, or the target cannot be had
*/
TuningTarget bridge_correct(const Bridge* bridge,
                            TuningTarget target,
                            uint32_t n_masses,
                            BridgeHold hold,
                            BridgeShift* shift);

/**
   One step, after those of the strings.

   @param force   Σ r p eᵀx, the strings' last masses being where they were before their step
   @param spring  Σ s
*/
static inline void bridge_step(Bridge* bridge, double force, double spring) {
  bridge->w += force - (bridge->bare.a + spring) * bridge->y - bridge->bare.g * bridge->w;
  bridge->y += bridge->w;
}

#endif

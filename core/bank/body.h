/**
   A body: the modes that a wooden box, a board or a skin has where the strings pull at it.

   A mode k is at F_k, loses 1/Q_k of itself, has the mass M_k where the strings are, and gives what
   it speeds up by to the air on the left and on the right by the weights l_k and r_k.  With a force
   f at the bridge,

       q̈_k + (2π F_k/Q_k) q̇_k + (2π F_k)² q_k = f/M_k,   heard: Σ_k l_k q̈_k and Σ_k r_k q̈_k.

   A body is made once, off the audio thread, and then only read: while Hooke is built
   (presets/bodies/), or from a file.

   Thread: any.
*/
#ifndef HOOKE_CORE_BANK_BODY_H
#define HOOKE_CORE_BANK_BODY_H

#include "core/bank/bank.h"

#include <complex.h>
#include <stdint.h>

enum {
  BODY_MAX_MODES = BANK_MAX_MODES,
  BODY_BANDS = 36, /**< Thirds of octaves that its loudness is known in */
};

/** The middle of the first of those bands [Hz]; band i is at BODY_LOWEST_HZ · 2^(i/3). */
#define BODY_LOWEST_HZ 10.0

/** The mean gain of every body, in power, over thirds of octaves from 80 Hz to 5 kHz. */
#define BODY_POWER 1.0

typedef struct {
  double f0_hz;        /**< F [Hz], > 0 */
  double q;            /**< Q, > 0.5 */
  double mass_kg;      /**< M [kg], > 0 */
  double radiation[2]; /**< l and r [kg: heard is dimensionless for a force of 1 N], as body_level()
                          leaves them */
} BodyMode;

typedef struct {
  uint32_t n_modes;
  BodyMode modes[BODY_MAX_MODES]; /**< The lowest first */
  double power[BODY_BANDS];       /**< Mean over each band of (|left/f|² + |right/f|²)/2 */
} Body;

/** The most that a shipped mode has on one side alone, of what it has on both: so nothing is lost
 * where both sides are added, and no partial is far louder on one. */
#define BODY_APART 0.2

/** How a player changes a body. */
typedef struct {
  double size;    /**< All its frequencies are divided by it, > 0 */
  double damping; /**< All its losses are multiplied by it, > 0 */
} BodyShape;

/** Bring what is heard of a mode on both sides within BODY_APART; what it has on both stays. */
void body_narrow(BodyMode* mode);

/** What a mode gives to a third of an octave in power, beside others: the square of its peak, times
 * how wide that is beside its frequency. */
double body_strength(const BodyMode* mode);

/** Keep the `n_modes` that are the strongest, in their order; what is heard of them is as loud as
 * it was. */
void body_keep(Body* body, uint32_t n_modes);

/** Make the gain of all modes together BODY_POWER by a factor of their radiation, and fill in
 * `power`. A body that radiates nothing is left as it is, with no power. */
void body_level(Body* body);

/** left/f and right/f at one frequency [Hz], of what goes as exp(+2πi hz t).  Real-time safe. */
void body_gain(const Body* body, BodyShape shape, double hz, double complex gain[2]);

/** (|left/f|² + |right/f|²)/2 at one frequency [Hz].  Real-time safe. */
double body_gain_square(const Body* body, BodyShape shape, double hz);

/** The same, as the mean over the third of an octave around it, of a body of a shape: in a straight
 * line between the bands that are known.  Real-time safe, and takes no longer for more modes. */
double body_power(const Body* body, BodyShape shape, double hz);

/**
   Put the modes of a body that are below BODY_HIGHEST of the rate into a bank, at rest.

   Their frequency and decay are exact at this rate; in is 1 kg/M.  A mode that is stepped peaks
   higher, by tan(θ/2)/(θ/2 √(1 − g)) with θ = 2π F/rate, which is taken from what is heard of it:
   so a third of an octave is as loud at every rate, within 0.1 dB up to a tenth of it and half a dB
   up to 0.4 of it.

   Real-time safe.
*/
void body_bank(const Body* body, BodyShape shape, double rate_hz, Bank* bank);

/** Of the rate: modes above are left out. */
#define BODY_HIGHEST 0.45

#endif

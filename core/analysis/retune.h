/**
   Tuning a network: Algorithm 1 of [MQ09] for any masses, springs and dampers.

   Every stiffness is multiplied by one factor and every damping by another, so that the network
   keeps its shape, until a chosen mode, as it is heard once it is stepped, has the pitch and the
   decay that are wanted.  Its pole is to be z = exp(−h/τ + j 2πF h), so with w = (z − 1)/h the two
   factors p and q are to make

       w² M + w (q Z + h p K) + p K   singular  (core/analysis/modes.h).

   Where damping is proportional the mode is one mass, and pole_solve() gives both in closed form.
   Elsewhere they are followed from there while the decay that is asked for grows from none to 1/τ:
   a shape y by inverse iteration, then p and q, linear in

       w² yᵀMy + w (q yᵀZy + h p yᵀKy) + p yᵀKy = 0,

   two real equations, and so in turn until neither moves.  A mode that is overdamped in the network
   as it is given is no obstacle: dampers are only multiplied.

   Thread: any.  Allocates; calls LAPACK; is not real-time safe.
*/
#ifndef HOOKE_CORE_ANALYSIS_RETUNE_H
#define HOOKE_CORE_ANALYSIS_RETUNE_H

#include "core/analysis/network.h"
#include "core/base/status.h"
#include "core/string/pole.h"

#include <stdint.h>

/** What is to be done to a network; see network_scale(). */
typedef struct {
  double stiffness_factor; /**< p, for every spring, > 0 */
  double damping_factor;   /**< q, for every damper, ≥ 0 */
} Retuning;

/**
   Find the factors which make a network sound as `tone`.

   @param network   Checked; not changed
   @param rate_hz   Steps per second [Hz], > 0
   @param tone      0 < F < rate/2 [Hz]; τ > 0 [s], INFINITY for no damping
   @param k         Which mode, from 1, in order of natural frequency without dampers; 0: the
                    lowest that is not of 0 Hz
   @param[out] out  Untouched on failure
   @return STATUS_OK: the mode has the tone and the network is stable; STATUS_BAD_ARGUMENT;
   STATUS_FREE (the mode is of 0 Hz, whatever its springs); STATUS_NO_SUCH_MODE; STATUS_UNREACHABLE
   (F at or above rate/2; or τ is finite and no factor damps the mode that much); STATUS_UNSTABLE
   (another mode would grow); STATUS_ILL_SCALED, STATUS_NO_CONVERGENCE, STATUS_NO_MEMORY
*/
Status retune_solve(const Network* network, double rate_hz, Tone tone, uint32_t k, Retuning* out);

#endif

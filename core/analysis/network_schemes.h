/**
   Other ways to step a network, for comparison with network_step().

   With h = `step_s` and F(x) the forces of springs and from outside:

   - FORWARD Euler (order 1): x and v both from the old ones.  Of an undamped mass the energy grows
     by 1 + ω²h² a step.
   - SYMPLECTIC Euler (order 1): network_step().
   - BACKWARD Euler (order 1): v from the new x and v, (M + h Z + h² K) v' = M v + h F(x), solved by
     conjugate gradients link by link; then x' = x + h v'.  Always stable; energy falls by as much.
   - LEAPFROG (order 2): half of the dampers, half a kick by F, all of the drift, half a kick, half
     of the dampers in the opposite order.  Each damper by itself is solved exactly: the difference
     of its ends' velocities dies as exp(−Z (1/m_i + 1/m_j) t) and their momentum stays, so no
   damper is ever too strong, and the limit of stability is that of the springs alone, ω h < 2.
   - FOURTH (order 4): three leapfrogs of w h, (1 − 2w) h and w h, w = 1/(2 − 2^⅓) ([FR90], [Y90]).
     The middle one, of −1.70 h, goes back in time, where dampers push: exactly, so that damping is
     of order 4 too, but v is blown up by exp(1.70 γh) between, which costs digits and at length all
     of them: it is for γh up to about 1.  It is stable for ω h < 1.57.

   [FR90] E. Forest and R. D. Ruth, "Fourth-order symplectic integration", 1990.
   [Y90] H. Yoshida, "Construction of higher order symplectic integrators", 1990.

   Thread: as core/analysis/network.
*/
#ifndef HOOKE_CORE_ANALYSIS_NETWORK_SCHEMES_H
#define HOOKE_CORE_ANALYSIS_NETWORK_SCHEMES_H

#include "core/analysis/network.h"
#include "core/base/status.h"

/** X(name, text, order). */
#define NETWORK_SCHEME_LIST(X)                                                                     \
  X(FORWARD, "forward Euler", 1)                                                                   \
  X(SYMPLECTIC, "symplectic Euler", 1)                                                             \
  X(BACKWARD, "backward Euler", 1)                                                                 \
  X(LEAPFROG, "leapfrog", 2)                                                                       \
  X(FOURTH, "fourth-order leapfrog", 4)

#define NETWORK_SCHEME_ENUM(name, text, order) NETWORK_##name,
typedef enum { NETWORK_SCHEME_LIST(NETWORK_SCHEME_ENUM) NETWORK_SCHEME_COUNT } NetworkScheme;
#undef NETWORK_SCHEME_ENUM

/** A scheme in words; never NULL. */
const char* network_scheme_text(NetworkScheme scheme);

/** The power of h with which its error over a given time falls; 0 for none. */
int network_scheme_order(NetworkScheme scheme);

/** Allocate what network_step_by() needs for a checked network; STATUS_OK or STATUS_NO_MEMORY. */
Status network_prepare(Network* network);

/**
   Step a checked and prepared network once by `step_s` [s].

   @return STATUS_OK; STATUS_NO_CONVERGENCE (backward Euler of a badly scaled network: the step is
   then as near as it came).  Does not allocate.
*/
Status network_step_by(Network* network, NetworkScheme scheme, double step_s);

#endif

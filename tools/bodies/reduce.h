/**
   From a network of masses and springs to the modes that are left of it where strings pull at it
   and it is heard (core/analysis/shapes.h).

   With φ_b = Σ φ_k(p) w_p over the places of the bridge, a mode has

       M_k = 1/φ_b²,   1/Q_k = 1/Q(F_k) + c_k/ω_k,   l_k, r_k = Σ_i A_i φ_k(i) (cos κ_i ± sin
   κ_i)/φ_b

   over all masses that move air, A_i the area of each.  κ_i is how much earlier or later what it
   sends comes to a listener at 30° aside and 30° above, on the left or on the right, than
   that of the middle does, in radians at the mode's frequency.  So boards give more to the air as
   their waves grow faster than the air's, and what is not even from left to right is not heard
   alike on both sides.

   Modes of the same frequency are one, that which strings pull at.  What is not heard, 120 dB below
   the loudest, is left out, and what hangs free, below REDUCE_LEAST_HZ,
   or lies above REDUCE_MOST_HZ; of more modes than a body
   has room for, the strongest are kept, those with the largest  (l² + r²) Q/M².

   Thread: any.  Takes memory; calls LAPACK.
*/
#ifndef HOOKE_TOOLS_BODIES_REDUCE_H
#define HOOKE_TOOLS_BODIES_REDUCE_H

#include "core/bank/body.h"
#include "core/base/status.h"
#include "tools/formats/scene.h"

/** What is slower is no mode but drift, and what is faster is nobody's to hear [Hz]. */
#define REDUCE_LEAST_HZ 1.0
#define REDUCE_MOST_HZ 20000.0

/** What became of a network's modes. */
typedef struct {
  uint32_t n_masses;
  uint32_t n_heard; /**< Modes, with those by chance, before the weakest were left out */
  double lost;      /**< Share of (l² + r²) Q/M² that went with these */
} Reduction;

/** All modes of a scene read for a body that are heard, the lowest first, as loud as they are
    [m² times the gains], for `modes` to be freed.
    @return STATUS_OK; STATUS_EMPTY where none is heard; or as shapes_solve() */
Status reduce_modes(const Scene* scene, BodyMode** modes, uint32_t* n_modes);

/**
   The body of a scene read for a body, leveled.

   @param[out] body       Untouched on failure
   @param[out] reduction  NULL if not wanted
   @return As reduce_modes()
*/
Status reduce_scene(const Scene* scene, Body* body, Reduction* reduction);

#endif

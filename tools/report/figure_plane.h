/**
   What the pictures of planes need beside core/string/pole: its borders by natural frequency and
   damping.

   All is dimensionless, and angles are in radians per sample.  Thread: any; allocates nothing.
*/
#ifndef HOOKE_TOOLS_REPORT_FIGURE_PLANE_H
#define HOOKE_TOOLS_REPORT_FIGURE_PLANE_H

#include "core/string/pole.h"

/** The borders between the motions, as g over w = ω0 h, 0 ≤ w ≤ 2. */
typedef enum {
  FIGURE_BORDER_VIBRATES, /**< g = w (2 − w): complex poles below it, [MQ09] (27) */
  FIGURE_BORDER_TURNS,    /**< g = 2 − w²: the larger pole is left of 0 above it, [MQ09] (34) */
  FIGURE_BORDER_LIMIT     /**< g = 2 − w²/2: stable up to it, [MQ09] (33) */
} FigureBorder;

double figure_plane_border(FigureBorder border, double w);

/** σ_d h = ln|z|, the digital damping, [MQ09] (40). */
double figure_plane_damping(Pole pole);

/** μh of the mass with γh = 1 whose two poles both vanish, found by asking where they turn past
 * π/2. */
double figure_plane_singular_mu(void);

#endif

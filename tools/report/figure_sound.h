/**
   What is heard: the two experiments of [MQ09] section 3.9, and the string of its Table 1.

   Thread: any; allocates only where it says so.
*/
#ifndef HOOKE_TOOLS_REPORT_FIGURE_SOUND_H
#define HOOKE_TOOLS_REPORT_FIGURE_SOUND_H

#include "core/base/status.h"
#include "core/string/pole.h"
#include "tools/report/figure_scheme.h"

#include <stdint.h>

/** The oscillator of section 3.9. */
#define FIGURE_RING_RATE_HZ 1000.0
#define FIGURE_RING_F0_HZ 125.0 /**< ω0/2π [Hz] */
#define FIGURE_RING_GAMMA 50.0  /**< [1/s] */

/** The string of Table 1. */
#define FIGURE_STRING_RATE_HZ 6000.0
#define FIGURE_STRING_F0_HZ 440.0
#define FIGURE_STRING_TAU_S 1.0
#define FIGURE_STRING_MASSES 5

/** One mass as section 3.9 has it. */
Pole figure_sound_ring(void);

/** The oscillator that sounds as section 3.9's would if time were not cut into steps: σ = −γ/2,
 * μ = √(ω0² − σ²). */
Pole figure_sound_retuned(void);

/** Its eigenvalues σ ± jμ. */
typedef struct {
  double sigma; /**< [1/s] */
  double mu;    /**< [rad/s] */
} FigureEigenvalue;

FigureEigenvalue figure_sound_eigenvalue(void);

/**
   Where a mass is at step n, in closed form: x[n] = Re(C zⁿ), with C from the discrete start.
   Between two steps it is the curve through them.

   @param pole   With complex poles
   @param start  State at n = 0
   @return [m]
*/
double figure_sound_discrete(Pole pole, FigureState start, double n);

/** The same for the mass of section 3.9, with C from the continuous start x(0) = 1 m, x'(0) = 0:
 * C = 1 + jσ/μ.  The scheme does not start so. @return [m] */
double figure_sound_continuous_start(double n);

/** The start from which a mass moves as Re(zⁿ): x = 1, and the velocity that leads to Re z. */
FigureState figure_sound_cosine_start(Pole pole);

/** A segment of the string of Table 1, tuned so that its fundamental is heard right.  Its k and Z
 * are a and g times the rate, squared and plain, for masses of 1 kg. */
Pole figure_sound_tuned(void);

/** The same string with the fundamental's eigenvalue at −1/τ ± j2πF, as if nothing were warped. */
Pole figure_sound_untuned(void);

/** Partial k, 1 ≤ k ≤ FIGURE_STRING_MASSES, of a string of such segments. */
Tone figure_sound_partial(Pole segment, uint32_t k);

/** |Σ x[n] exp(−j2πFn/rate)| over `n_frames` frames. */
double figure_sound_level(const double* x, uint32_t n_frames, double rate_hz, double f_hz);

#endif

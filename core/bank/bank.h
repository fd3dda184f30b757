/**
   A bank of modes: what is left of a network of masses, springs and dampers that forces act on at
   one place and that is heard at two.

   Each mode is one mass of its own (core/string/pole.h), with the numbers a and g that its pole has
   at this rate, exactly.  A force f moves them all, and what is heard is how fast each of them
   speeds up:

       d_k = i_k f − a_k x_k − g_k u_k,   u_k ← u_k + d_k,   x_k ← x_k + u_k,
       left += l_k d_k,   right += r_k d_k.

   The place itself, by which it pulls back at what pulls it, is at Σ x_k.

   The samples depend neither on how the frames are cut into calls nor on the processor: the kernels
   differ in speed alone.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_BANK_BANK_H
#define HOOKE_CORE_BANK_BANK_H

#include "core/bank/bank_kernel.h"
#include "core/string/pole.h"

#include <stdint.h>

enum { BANK_MAX_MODES = 256 };

/** One mode as it is added. */
typedef struct {
  Pole pole;
  double in;     /**< i: what a force of 1 speeds it up by */
  double out[2]; /**< l and r */
} BankMode;

/** Zero is one without modes, which is silent.  On the heap it takes aligned_new(). */
typedef struct {
  const BankKernel* kernel; /**< Which steps it; NULL where there are no modes */
  uint32_t n_modes;         /**< A multiple of BANK_LANES; those beyond what was added are zeros */
  uint32_t n_added;
  _Alignas(BANK_ALIGNMENT) double a[BANK_MAX_MODES];
  _Alignas(BANK_ALIGNMENT) double g[BANK_MAX_MODES];
  _Alignas(BANK_ALIGNMENT) double in[BANK_MAX_MODES];
  _Alignas(BANK_ALIGNMENT) double out[2][BANK_MAX_MODES];
  _Alignas(BANK_ALIGNMENT) double x[BANK_MAX_MODES];
  _Alignas(BANK_ALIGNMENT) double u[BANK_MAX_MODES];
} Bank;

/** No modes. */
void bank_clear(Bank* bank);

/** Add a mode, at rest; one more than BANK_MAX_MODES is left out. */
void bank_add(Bank* bank, BankMode mode);

/** Bring all modes to rest. */
void bank_rest(Bank* bank);

/** The largest |x_k| and |u_k| of any mode. */
double bank_level(const Bank* bank);

/** Step `n_frames` times, by `force[n]` in each, and add what is heard to `left` and `right`, which
 * overlap neither with `force` nor with each other. */
void bank_run(Bank* bank, const float* force, uint32_t n_frames, float* left, float* right);

/** Step once, by `force`, heard by nobody.  @return Where the place is then, Σ x_k */
double bank_push(Bank* bank, double force);

#endif

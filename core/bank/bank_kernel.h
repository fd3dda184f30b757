/**
   The loops of core/bank/bank.h, one set for each kind of processor, from one source
   (core/bank/bank_loop.h).  All give the same bits.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_BANK_BANK_KERNEL_H
#define HOOKE_CORE_BANK_BANK_KERNEL_H

#include <stdint.h>

enum {
  BANK_LANES = 8,      /**< Modes that are stepped together: their number is rounded up to it */
  BANK_ALIGNMENT = 64, /**< Of the numbers of modes [bytes] */
};

/** Modes for a loop to step; see Bank. */
typedef struct {
  uint32_t n_groups; /**< Of BANK_LANES modes each, > 0 */
  const double* a;
  const double* g;
  const double* in;
  const double* left;
  const double* right;
  double* x; /**< Written */
  double* u; /**< Written */
} BankWork;

/** What one kind of processor has. */
typedef struct {
  const char* name;
  /** As bank_run() and bank_push(). */
  void (*run)(
      const BankWork* work, const float* force, uint32_t n_frames, float* left, float* right);
  double (*push)(const BankWork* work, double force);
} BankKernel;

/** Vectors of 16 bytes: what every processor that has vectors has. */
extern const BankKernel bank_kernel_double2;

#ifdef HOOKE_AVX2
/** Vectors of 32 bytes; only where the processor has AVX2 and FMA. */
extern const BankKernel bank_kernel_double4;
#endif

#ifdef HOOKE_AVX512
/** Vectors of 64 bytes; only where the processor has FMA and AVX-512 F, DQ, VL and BW. */
extern const BankKernel bank_kernel_double8;
#endif

/** The `i`-th kernel that this processor can run, the best first; NULL past the last. */
const BankKernel* bank_kernel(uint32_t i);

#endif

/* The loops for vectors of 32 bytes.  This file is compiled for AVX2 and FMA. */
#define BANK_LOOP_LANES 4
#define BANK_LOOP_NAME bank_kernel_double4
#define BANK_LOOP_TEXT "AVX2 and FMA"

#include "core/bank/bank_loop.h"

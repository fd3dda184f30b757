/* The loops for vectors of 64 bytes.  This file is compiled for AVX-512 F, DQ, VL and BW. */
#define BANK_LOOP_LANES 8
#define BANK_LOOP_NAME bank_kernel_double8
#define BANK_LOOP_TEXT "AVX-512"

#include "core/bank/bank_loop.h"

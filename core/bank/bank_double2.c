/* The loops for vectors of 16 bytes. */
#define BANK_LOOP_LANES 2
#define BANK_LOOP_NAME bank_kernel_double2
#define BANK_LOOP_TEXT "plain"

#include "core/bank/bank_loop.h"

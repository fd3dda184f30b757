/**
   The order in which a network's masses are eliminated, and what that fills.

   Eliminating a mass joins all that it is linked to.  By the rule of the least degree the next one
   is always one of the least linked: trees fill nothing at all, and a hub to which all is tied
   comes last.

   Part of core/analysis/modes.
*/
#ifndef HOOKE_CORE_ANALYSIS_MODES_ORDER_H
#define HOOKE_CORE_ANALYSIS_MODES_ORDER_H

#include "core/analysis/modes_frame.h"
#include "core/base/status.h"

#include <stddef.h>
#include <stdint.h>

/** The order, and where the Cholesky factor of any matrix of the network's links is not zero. */
typedef struct {
  uint32_t n;
  uint32_t* place; /**< Of each mass in the order, n */
  size_t* start;   /**< Of each column in `row`, n + 1 */
  uint32_t* row;   /**< Of each column its places, rising from the diagonal's on */
} Order;

/** @return STATUS_OK, or STATUS_NO_MEMORY with nothing to be cleared */
Status order_init(Order* order, const Frame* frame);
void order_clear(Order* order);

#endif

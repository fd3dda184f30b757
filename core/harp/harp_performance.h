/** The harp as core/play/performance.h has instruments.  It knows no seats. */
#ifndef HOOKE_CORE_HARP_HARP_PERFORMANCE_H
#define HOOKE_CORE_HARP_HARP_PERFORMANCE_H

#include "core/harp/harp.h"
#include "core/play/performance.h"

Performance harp_performance(Harp* harp);

#endif

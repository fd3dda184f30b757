/** What a plugin costs, as a share of one core that nothing else runs on. */
#ifndef HOOKE_TESTS_SUPPORT_SPEED_H
#define HOOKE_TESTS_SUPPORT_SPEED_H

#include "tools/host/host.h"

/** Skip the test where it is built with a sanitizer, whose checks are not what the plugin costs. */
void speed_skip_where_sanitized(void);

/** How much longer than by itself anything may take here: 1, or what HOOKE_SLOWDOWN says, which is
    set where something watches every instruction. */
double speed_slowdown(void);

/**
   The plugin's run() alone, without the host around it, as a share of a core: the median of many
   short runs.

   Machines are noisy, and who shares a core with others has its clock but not all of its
   arithmetic; so the time of a run counts by as much of the peak as there was at that moment.

   @param block     Frames in a run, at most the host's
   @param n_blocks  Runs that are measured together
*/
double speed_usual_share(Host* host, double rate_hz, uint32_t block, int n_blocks);

#endif

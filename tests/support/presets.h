/** What a preset says, as a host reads it. */
#ifndef HOOKE_TESTS_SUPPORT_PRESETS_H
#define HOOKE_TESTS_SUPPORT_PRESETS_H

#include "tools/host/host.h"

#include <stdint.h>

/**
   Load the `k`-th preset into a host at its defaults, and fail the test unless it has a label of
   its own and a comment, each port that it sets is a control input and then has the value that it
   says, in range and whole where it must be, it sets something that is not the default, and it
   leaves the instrument enabled.

   @return The sum of 2^index over the ports that it sets
*/
uint64_t presets_check(Host* host, uint32_t k);

/** Fail the test unless there are at least `n` presets and all pass presets_check() and set the
 * same ports, or the sound of one would depend on the one before it. */
void presets_check_all(Host* (*open)(void), uint32_t n);

/** Fail the test unless each preset is in one bank, and no two banks have the same label. */
void presets_check_banks(Host* host);

#endif

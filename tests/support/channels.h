/** Strings of the harp that hands play, for the tests: what they are to be once all is still. */
#ifndef HOOKE_TESTS_SUPPORT_CHANNELS_H
#define HOOKE_TESTS_SUPPORT_CHANNELS_H

#include "core/harp/harp.h"

#include <stdint.h>

/** τ of a damped string [s]. */
#define CHANNELS_RELEASE_S 0.05

enum { CHANNELS_RATE = 48000 };

/** The defaults, with that release. */
HarpPatch channels_patch(void);

/** A harp with it at CHANNELS_RATE, for harp_free(). */
Harp* channels_harp(void);

/** τ of a key's open string [s]. */
double channels_open_s(uint32_t key);

/** Fail the test unless a string has the pitch of its key with a bend, by its coefficients, once a
 * gesture is over. */
void channels_check_pitch(Harp* harp, const HarpString* string, double bend);

/** The same of its decay [s]. */
void channels_check_decay(Harp* harp, const HarpString* string, double tau_s);

#endif

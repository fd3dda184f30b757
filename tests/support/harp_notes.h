/** Strings of the harp that hands play, for the tests: what they are to be once all is still. */
#ifndef HOOKE_TESTS_SUPPORT_HARP_NOTES_H
#define HOOKE_TESTS_SUPPORT_HARP_NOTES_H

#include "core/harp/harp.h"

#include <stdint.h>

/** τ of a damped string [s]. */
#define HARP_NOTES_RELEASE_S 0.05

enum { HARP_NOTES_RATE = 48000 };

/** The defaults, with that release. */
HarpPatch harp_notes_patch(void);

/** A harp with it at HARP_NOTES_RATE, for harp_free(). */
Harp* harp_notes_harp(void);

/** τ of a key's open string [s]. */
double harp_notes_open_s(uint32_t key);

/** Fail the test unless a string has the pitch of its key with a bend, by its coefficients, once a
 * gesture is over. */
void harp_notes_check_pitch(Harp* harp, const HarpString* string, double bend);

/** The same of its decay [s]. */
void harp_notes_check_decay(Harp* harp, const HarpString* string, double tau_s);

#endif

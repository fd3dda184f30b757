/** Guitars for the tests: how they are set, played and heard. */
#ifndef HOOKE_TESTS_SUPPORT_GUITARS_H
#define HOOKE_TESTS_SUPPORT_GUITARS_H

#include "core/guitar/guitar.h"

#include "tests/support/random.h"

/** The six strings as the ports have them, one pickup read, in the middle. */
GuitarPatch guitars_patch(void);

/** A guitar at rest with a patch; the test fails if there is none. */
Guitar* guitars_new(double rate_hz, const GuitarPatch* patch);

/** Pluck with the patch's place and hardness. */
void guitars_pluck(Guitar* guitar, uint32_t string, double force);

/** Run it and keep the left side; NULL: neither. */
void guitars_run(Guitar* guitar, uint32_t n_frames, float* left);

/** Pitch [Hz] and decay [s] of a string stopped at a fret from the capo, as the headers say. */
Tone guitars_tone(const GuitarPatch* patch, uint32_t string, double fret);

/** Do anything that can be done to a guitar, with any values, now and then out of their range. */
void guitars_storm(Guitar* guitar, Random* random);

#endif

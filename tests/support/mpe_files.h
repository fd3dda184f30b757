/** The MIDI files in tests/mpe, played by Hooke Strings in a host and by `hooke render`.  What
 * cannot be done here fails the test. */
#ifndef HOOKE_TESTS_SUPPORT_MPE_FILES_H
#define HOOKE_TESTS_SUPPORT_MPE_FILES_H

#include "tests/support/strings_host.h"

enum { MPE_RATE = 48000, MPE_BLOCK = 480 };

/** A host with both pickups in one place, at MPE_RATE, for host_free(). */
Host* mpe_open(void);

/** What `name`.mid sounds like from rest, with the host's ports as they are, for sound_free(). */
Sound mpe_play(Host* host, const char* name, double seconds, uint32_t block);

/** What `hooke render` writes of it, with the ports of mpe_open(). */
Sound mpe_render(const char* name);

/** Measure from a moment, without the gesture and some periods at first, to another [s]. */
ToneError mpe_measure(const Sound* sound, double from_s, double to_s, Tone asked);

#endif

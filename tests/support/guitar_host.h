/** Hooke Guitar in a host, and beside it the guitar and the guitarist themselves, for the tests
 * that hold the one against the other.  Messages are those of tests/support/strings_host.h.  What
 * cannot be done here fails the test. */
#ifndef HOOKE_TESTS_SUPPORT_GUITAR_HOST_H
#define HOOKE_TESTS_SUPPORT_GUITAR_HOST_H

#include "core/guitar/guitar_event.h"
#include "core/guitar/guitarist.h"
#include "tests/support/strings_host.h"

#define GUITAR_URI "urn:hooke:guitar"

/** The plugin at its defaults, for host_free(). */
Host* guitar_open(double rate_hz, uint32_t max_block);

/** One pickup near the middle, plucks too, and no width: the fundamental is easily measured. */
void guitar_set_plain(Host* host);

/** Queue an event of a script. */
void guitar_send(Host* host, size_t frame, GuitarEvent event);

/** What the ports say, by the manual, of a plugin whose ports are in range. */
GuitarPatch guitar_patch_of(const Host* host);
GuitaristHow guitar_how_of(const Host* host);

/** A guitar of our own with its guitarist. */
typedef struct {
  Guitar* guitar;
  Guitarist* guitarist;
} Duo;

/** Of the patch that the ports say, for duo_free(). */
Duo duo_new(const Host* host, double rate_hz);
void duo_free(Duo* duo);

/** Run it from frame `from` to frame `to` of a sound. */
void duo_run(const Duo* duo, Sound* sound, size_t from, size_t to);

#endif

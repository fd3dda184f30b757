/** Both plugins in a host, for claims that hold of either. */
#ifndef HOOKE_TESTS_SUPPORT_PLUGINS_H
#define HOOKE_TESTS_SUPPORT_PLUGINS_H

#include "tests/support/strings_host.h"

#include <stdbool.h>

enum { PLUGINS_RATE = 48000, PLUGINS_BLOCK = 256, N_PLUGINS = 2 };

/** Hooke Strings or Hooke Guitar at its defaults, for host_free(). */
Host* plugins_open(int plugin);

/** A sound of some blocks with two notes that begin at once and in its middle, as it is now. */
Sound plugins_play(Host* host);

/** Fail unless both hosts sound the same from now on, and are heard. */
void plugins_assert_same(Host* a, Host* b);

#endif

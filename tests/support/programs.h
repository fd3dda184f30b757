/** Both plugins in a host, for tests of program changes. */
#ifndef HOOKE_TESTS_SUPPORT_PROGRAMS_H
#define HOOKE_TESTS_SUPPORT_PROGRAMS_H

#include "tests/support/presets.h"
#include "tests/support/strings_host.h"

#include <stddef.h>
#include <stdint.h>

enum { PROGRAMS_RATE = 48000, PROGRAMS_BLOCK = 256, PROGRAMS_PLUGINS = 2 };

/** Hooke Strings or Hooke Guitar at its defaults, for host_free(). */
Host* programs_open(int plugin);

/** Queue a program change on a channel. */
void programs_change(Host* host, size_t frame, unsigned channel, uint32_t program);

/** Queue a bank, by both controllers, and a program change. */
void programs_select(Host* host, size_t frame, PresetPlace place);

/** The preset of a label, which must be there. */
PresetPlace programs_place(Host* host, const char* label);

/** A sound of some blocks with two notes that begin at once and in its middle, as it is now. */
Sound programs_play(Host* host);

/** Fail unless both hosts sound the same from now on, and are heard. */
void programs_assert_same(Host* a, Host* b);

/** And unless they do not. */
void programs_assert_other(Host* a, Host* b);

/** A host whose ports say what a preset does, Koto or Banjo, and one that was told so by a program
 * change; both have run a block. */
typedef struct {
  Host* preset;
  Host* program;
  PresetPlace place;
} ProgramPair;

ProgramPair programs_open_pair(int plugin);
void programs_close_pair(ProgramPair pair);

/** Run a block of both. */
void programs_run(ProgramPair pair);

/** Set a port of both. */
void programs_set(ProgramPair pair, const char* symbol, double value);

/** Run a block of both, and fail unless they then sound the same. */
void programs_assert_pair(ProgramPair pair);

#endif

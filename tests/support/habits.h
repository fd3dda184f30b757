/** What hosts do to either plugin, for the tests of that.  What cannot be done here fails the test.
 */
#ifndef HOOKE_TESTS_SUPPORT_HABITS_H
#define HOOKE_TESTS_SUPPORT_HABITS_H

#include "tests/support/plugins.h"

enum { HABITS_FRAMES = 40 * PLUGINS_BLOCK };

/** Queue a short piece with notes and a bend. */
void habits_play(Host* host);

/** The piece as it sounds from a host that has no habits, for sound_free(). */
Sound habits_alone(int plugin);

/** Fail unless it sounds so from this one, which is freed. */
void habits_assert_alike(int plugin, Host* host);

/** Run a block with a note of key 60, at 100, on its first frame, from a sequence whose address
 * only four divides. */
void habits_run_at_odd_places(Host* host, float* left, float* right);

/** Restore two states in turn, some hundred times, while another thread runs the plugin, and fail
 * unless each is there when it is saved; the second is restored last. */
void habits_restore_while_it_runs(Host* host, LilvState* const states[2]);

/** A host that has loaded a session, whose state is these statements of Turtle, and run a block,
 * for host_free(). */
Host* habits_open_session(int plugin, HostWork mode, const char* statements);

/** Run a block of both, bring both to rest, fail unless they sound the same, and free them. */
void habits_assert_same(Host* a, Host* b);

#endif

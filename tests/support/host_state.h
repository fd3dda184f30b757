/** States of a hosted plugin: saved, put back, and written as Turtle. */
#ifndef HOOKE_TESTS_SUPPORT_HOST_STATE_H
#define HOOKE_TESTS_SUPPORT_HOST_STATE_H

#include "tools/host/host.h"

/** @return A snapshot of control inputs and the plugin's own state, for lilv_state_free(); NULL on
 * failure. */
LilvState* host_save_state(Host* host);

/** Put a snapshot back without a worker, as a session load does. */
void host_restore_state(Host* host, const LilvState* state);

/** Put a snapshot back with the worker offered, as a choice of preset does. */
void host_restore_preset(Host* host, const LilvState* state);

/** @return `state` as Turtle, to be freed with lilv_free(); NULL on failure. */
char* host_state_to_string(Host* host, const LilvState* state);

/** @return The state written in `turtle`, for lilv_state_free(); NULL on failure. */
LilvState* host_state_from_string(Host* host, const char* turtle);

/** Save the present state as a bundle in `dir`, made if need be, files of the state with it.
 * @return false on failure. */
bool host_save_state_dir(Host* host, const char* dir);

/** @return The state saved in `dir`, for lilv_state_free(); NULL on failure. */
LilvState* host_load_state_dir(Host* host, const char* dir);

#endif

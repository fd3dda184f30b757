#define _POSIX_C_SOURCE 200809L

#include "tools/host/host_impl.h"

#include <lv2/atom/atom.h>
#include <stdio.h>
#include <string.h>

static const char STATE_FILE[] = "state.ttl";

static const void* get_value(const char* symbol, void* user_data, uint32_t* size, uint32_t* type) {
  Host* const host = (Host*)user_data;
  const HostPort* const port = host_find_port(host, symbol, HOST_PORT_CONTROL);
  *size = port ? sizeof(float) : 0;
  *type = port ? host_map(host, LV2_ATOM__Float) : 0;
  return port ? &port->value : NULL;
}

static bool
read_number(Host* host, const void* value, uint32_t size, uint32_t type, float* number) {
  double d = 0.0;
  int64_t l = 0;
  int32_t i = 0;
  if (type == host_map(host, LV2_ATOM__Float) && size == sizeof(*number)) {
    memcpy(number, value, size);
  } else if (type == host_map(host, LV2_ATOM__Double) && size == sizeof(d)) {
    memcpy(&d, value, size);
    *number = (float)d;
  } else if (type == host_map(host, LV2_ATOM__Long) && size == sizeof(l)) {
    memcpy(&l, value, size);
    *number = (float)l;
  } else if ((type == host_map(host, LV2_ATOM__Int) || type == host_map(host, LV2_ATOM__Bool)) &&
             size == sizeof(i)) {
    memcpy(&i, value, size);
    *number = (float)i;
  } else {
    return false;
  }
  return true;
}

static void
set_value(const char* symbol, void* user_data, const void* value, uint32_t size, uint32_t type) {
  Host* const host = (Host*)user_data;
  HostPort* const port = host_find_port(host, symbol, HOST_PORT_CONTROL);
  float number = 0.0F;
  if (port && port->is_input && read_number(host, value, size, type, &number)) {
    port->value = number;
  }
}

static LilvState* save_to(Host* host, const char* dir) {
  LilvState* const state =
      lilv_state_new_from_instance(host->plugin, host->instance, &host->features.map, dir, dir, dir,
                                   dir, get_value, host, 0, host->features.session);
  if (!state) {
    (void)host_fail(host, "state not saved");
  }
  return state;
}

LilvState* host_save_state(Host* host) {
  return save_to(host, NULL);
}

void host_restore_state(Host* host, const LilvState* state) {
  lilv_state_restore(state, host->instance, set_value, host, 0, host->features.session);
}

void host_restore_preset(Host* host, const LilvState* state) {
  lilv_state_restore(state, host->instance, set_value, host, 0, host->features.preset);
}

char* host_state_to_string(Host* host, const LilvState* state) {
  char* const turtle = lilv_state_to_string(host->world, &host->features.map, &host->features.unmap,
                                            state, "urn:hooke:state", NULL);
  if (!turtle) {
    (void)host_fail(host, "state not written");
  }
  return turtle;
}

LilvState* host_state_from_string(Host* host, const char* turtle) {
  LilvState* const state = lilv_state_new_from_string(host->world, &host->features.map, turtle);
  if (!state) {
    (void)host_fail(host, "state not readable");
  }
  return state;
}

bool host_save_state_dir(Host* host, const char* dir) {
  LilvState* const state = save_to(host, dir);
  if (!state) {
    return false;
  }
  const int status = lilv_state_save(host->world, &host->features.map, &host->features.unmap, state,
                                     NULL, dir, STATE_FILE);
  lilv_state_free(state);
  return !status || host_fail(host, "%s: state not saved", dir);
}

LilvState* host_load_state_dir(Host* host, const char* dir) {
  char path[4096];
  const int length = snprintf(path, sizeof(path), "%s/%s", dir, STATE_FILE);
  if (length < 0 || (size_t)length >= sizeof(path)) {
    (void)host_fail(host, "%s: path too long", dir);
    return NULL;
  }
  LilvState* const state = lilv_state_new_from_file(host->world, &host->features.map, NULL, path);
  if (!state) {
    (void)host_fail(host, "%s: no state found", path);
  }
  return state;
}

#include "tests/support/host_state.h"
#include "tests/support/host_inside.h"

#include <lv2/atom/atom.h>
#include <lv2/state/state.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char STATE_FILE[] = "state.ttl";

/* What the host offers of that kind, or nothing. */
static void* offered(Host* host, const char* uri) {
  for (const LV2_Feature* const* feature = host_features(host); *feature; ++feature) {
    if (!strcmp((*feature)->URI, uri)) {
      return (*feature)->data;
    }
  }
  return NULL;
}

/* The value is copied before the next one is asked for. */
static const void* get_value(const char* symbol, void* user_data, uint32_t* size, uint32_t* type) {
  static float value;
  Host* const host = (Host*)user_data;
  value = host_get(host, symbol);
  *size = isnan(value) ? 0 : sizeof(value);
  *type = isnan(value) ? 0 : host_map(host, LV2_ATOM__Float);
  return isnan(value) ? NULL : &value;
}

/* Without the worker, as when a session is saved. */
static LilvState* save_to(Host* host, const char* dir) {
  LV2_URID_Map* const map = (LV2_URID_Map*)offered(host, LV2_URID__map);
  const LV2_Feature map_feature = {LV2_URID__map, map};
  const LV2_Feature restore_feature = {LV2_STATE__threadSafeRestore, NULL};
  const LV2_Feature* const features[] = {&map_feature, &restore_feature, NULL};
  return lilv_state_new_from_instance(host_plugin(host), host_instance(host), map, dir, dir, dir,
                                      dir, get_value, host, 0, features);
}

LilvState* host_save_state(Host* host) {
  return save_to(host, NULL);
}

void host_restore_state(Host* host, const LilvState* state) {
  host_restore(host, state, false);
}

void host_restore_preset(Host* host, const LilvState* state) {
  host_restore(host, state, true);
}

char* host_state_to_string(Host* host, const LilvState* state) {
  return lilv_state_to_string(host_world(host), (LV2_URID_Map*)offered(host, LV2_URID__map),
                              (LV2_URID_Unmap*)offered(host, LV2_URID__unmap), state,
                              "urn:hooke:state", NULL);
}

LilvState* host_state_from_string(Host* host, const char* turtle) {
  return lilv_state_new_from_string(host_world(host), (LV2_URID_Map*)offered(host, LV2_URID__map),
                                    turtle);
}

bool host_save_state_dir(Host* host, const char* dir) {
  LilvState* const state = save_to(host, dir);
  const int status =
      state ? lilv_state_save(host_world(host), (LV2_URID_Map*)offered(host, LV2_URID__map),
                              (LV2_URID_Unmap*)offered(host, LV2_URID__unmap), state, NULL, dir,
                              STATE_FILE)
            : 1;
  lilv_state_free(state);
  return !status;
}

LilvState* host_load_state_dir(Host* host, const char* dir) {
  char path[4096];
  const int length = snprintf(path, sizeof(path), "%s/%s", dir, STATE_FILE);
  return length < 0 || (size_t)length >= sizeof(path)
             ? NULL
             : lilv_state_new_from_file(host_world(host),
                                        (LV2_URID_Map*)offered(host, LV2_URID__map), NULL, path);
}

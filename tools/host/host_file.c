#include "tools/host/host_impl.h"

#include <lv2/atom/forge.h>
#include <lv2/patch/patch.h>
#include <string.h>

enum { MOST_BYTES = 8192, ROOM = 512 };

static bool has_parameter(Host* host, const char* uri) {
  LilvNode* const writable = lilv_new_uri(host->world, LV2_PATCH__writable);
  LilvNode* const parameter = lilv_new_uri(host->world, uri);
  const bool has =
      writable && parameter &&
      lilv_world_ask(host->world, lilv_plugin_get_uri(host->plugin), writable, parameter);
  lilv_node_free(parameter);
  lilv_node_free(writable);
  return has;
}

static const LV2_Atom* write_set(Host* host, const char* uri, const char* path, uint8_t* message) {
  LV2_Atom_Forge forge;
  LV2_Atom_Forge_Frame frame;
  lv2_atom_forge_init(&forge, &host->map);
  lv2_atom_forge_set_buffer(&forge, message, MOST_BYTES);
  lv2_atom_forge_object(&forge, &frame, 0, host_map(host, LV2_PATCH__Set));
  lv2_atom_forge_key(&forge, host_map(host, LV2_PATCH__property));
  lv2_atom_forge_urid(&forge, host_map(host, uri));
  lv2_atom_forge_key(&forge, host_map(host, LV2_PATCH__value));
  lv2_atom_forge_path(&forge, path, (uint32_t)strlen(path));
  lv2_atom_forge_pop(&forge, &frame);
  return (const LV2_Atom*)(const void*)message;
}

bool host_set_file(Host* host, const char* parameter_uri, const char* path) {
  _Alignas(8) uint8_t message[MOST_BYTES];
  if (!has_parameter(host, parameter_uri)) {
    return host_fail(host, "plugin has no parameter <%s>", parameter_uri);
  }
  if (strlen(path) > MOST_BYTES - ROOM) {
    return host_fail(host, "path of %zu bytes is too long", strlen(path));
  }
  const LV2_Atom* const set = write_set(host, parameter_uri, path, message);
  return host_queue(host, 0, host_map(host, LV2_ATOM__Object), set + 1, set->size, true) &&
         host_run(host, 0);
}

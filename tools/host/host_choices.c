#define _POSIX_C_SOURCE 200809L

#include "tools/host/host_impl.h"

#include <lv2/units/units.h>
#include <stdlib.h>
#include <string.h>

/* The symbols of the units that LV2 itself names are elsewhere: here those that are not what comes
 * last in their URI. */
static const char* symbol_of(const char* uri) {
  static const char* const known[][2] = {{LV2_UNITS__hz, "Hz"},
                                         {LV2_UNITS__khz, "kHz"},
                                         {LV2_UNITS__db, "dB"},
                                         {LV2_UNITS__pc, "%"},
                                         {LV2_UNITS__midiNote, "MIDI note"},
                                         {LV2_UNITS__cent, "cents"},
                                         {LV2_UNITS__coef, ""},
                                         {LV2_UNITS__semitone12TET, "semitones"},
                                         {LV2_UNITS__degree, "°"}};
  for (size_t i = 0; i < sizeof(known) / sizeof(known[0]); ++i) {
    if (!strcmp(known[i][0], uri)) {
      return known[i][1];
    }
  }
  const char* const hash = strrchr(uri, '#');
  return hash ? hash + 1 : "";
}

static char* read_unit(Host* host, const LilvPort* port) {
  LilvNode* const unit_of = lilv_new_uri(host->world, LV2_UNITS__unit);
  LilvNode* const has_symbol = lilv_new_uri(host->world, LV2_UNITS__symbol);
  LilvNode* const unit = lilv_port_get(host->plugin, port, unit_of);
  LilvNode* const symbol = unit ? lilv_world_get(host->world, unit, has_symbol, NULL) : NULL;
  const char* const text = symbol                           ? lilv_node_as_string(symbol)
                           : unit && lilv_node_is_uri(unit) ? symbol_of(lilv_node_as_uri(unit))
                                                            : "";
  char* const copy = strdup(text);
  lilv_node_free(symbol);
  lilv_node_free(unit);
  lilv_node_free(has_symbol);
  lilv_node_free(unit_of);
  return copy;
}

static int compare_choices(const void* a, const void* b) {
  const float left = ((const HostChoice*)a)->value;
  const float right = ((const HostChoice*)b)->value;
  return (left > right) - (left < right);
}

static bool read_points(HostPort* self, const LilvScalePoints* points) {
  self->choices = calloc(lilv_scale_points_size(points) + 1, sizeof(HostChoice));
  LILV_FOREACH(scale_points, i, points) {
    const LilvScalePoint* const point = lilv_scale_points_get(points, i);
    const LilvNode* const value = lilv_scale_point_get_value(point);
    const char* const label =
        self->choices ? lilv_node_as_string(lilv_scale_point_get_label(point)) : NULL;
    if (label && (lilv_node_is_float(value) || lilv_node_is_int(value))) {
      const HostChoice choice = {strdup(label), lilv_node_as_float(value)};
      if (!choice.label) {
        return false;
      }
      self->choices[self->n_choices++] = choice;
    }
  }
  if (self->n_choices > 1) {
    qsort(self->choices, self->n_choices, sizeof(HostChoice), compare_choices);
  }
  return self->choices;
}

bool host_read_choices(Host* host, HostPort* self, const LilvPort* port) {
  LilvScalePoints* const points = lilv_port_get_scale_points(host->plugin, port);
  self->unit = read_unit(host, port);
  const bool is_ok = self->unit && read_points(self, points);
  lilv_scale_points_free(points);
  return is_ok;
}

void host_clear_choices(HostPort* self) {
  for (uint32_t i = 0; i < self->n_choices; ++i) {
    free(self->choices[i].label);
  }
  free(self->choices);
  free(self->unit);
}

const char* host_unit(const Host* host, const char* symbol) {
  const HostPort* const port = host_find_port(host, symbol, HOST_PORT_CONTROL);
  return port ? port->unit : "";
}

const HostChoice* host_choices(const Host* host, const char* symbol, uint32_t* n_choices) {
  const HostPort* const port = host_find_port(host, symbol, HOST_PORT_CONTROL);
  *n_choices = port ? port->n_choices : 0;
  return port ? port->choices : NULL;
}

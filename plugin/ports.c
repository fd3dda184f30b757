#include "plugin/ports.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

typedef struct {
  uint32_t index;
  float minimum, maximum, default_value;
} Range;

#define PORT_RANGE(name, symbol, index, minimum, maximum, default_value)                           \
  {index, minimum, maximum, default_value},
static const Range ranges[] = {CONTROL_PORTS(PORT_RANGE)};
#undef PORT_RANGE

static float read_one(const float* port, const Range* range) {
  if (!port || isnan(*port)) {
    return range->default_value;
  }
  return fminf(fmaxf(*port, range->minimum), range->maximum);
}

Controls ports_read(void* const ports[N_PORTS]) {
  Controls controls = {{0}};
  for (size_t i = 0; i < sizeof(ranges) / sizeof(ranges[0]); ++i) {
    const uint32_t index = ranges[i].index;
    controls.value[index] = read_one((const float*)ports[index], &ranges[i]);
  }
  return controls;
}

_Bool ports_are_same(const Controls* a, const Controls* b) {
  return !memcmp(a, b, sizeof(Controls));
}

Patch ports_patch(const Controls* controls) {
  const float* const v = controls->value;
  return (Patch){
      .level = pow(10.0, (double)v[PORT_LEVEL] / 20.0),
      .damping_per_s = (double)v[PORT_DAMPING],
      .tracking = (double)v[PORT_TRACKING],
      /* At its minimum there is nothing between the masses, and at that of stiffness the string is
       * perfectly flexible: what is not there is not computed. */
      .loss = v[PORT_LOSS] > 1e-5f ? (double)v[PORT_LOSS] : 0.0,
      .inharmonicity = v[PORT_STIFFNESS] > 1e-6f ? (double)v[PORT_STIFFNESS] : 0.0,
      .partials = (Partials)(v[PORT_PARTIALS] + 0.5f),
      .pickup = (double)v[PORT_PICKUP],
      .spread = (double)v[PORT_SPREAD],
      .pluck = (double)v[PORT_PLUCK],
      .hardness = (double)v[PORT_HARDNESS],
      .release_s = (double)v[PORT_RELEASE],
      .tuning_hz = (double)v[PORT_TUNING],
      .max_masses = (uint32_t)(v[PORT_MASSES] + 0.5f),
  };
}

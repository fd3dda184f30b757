#include "plugin/ports.h"

#include <math.h>
#include <string.h>

static float read_one(const float* port, const PortRange* range) {
  if (!port || isnan(*port)) {
    return range->default_value;
  }
  return fminf(fmaxf(*port, range->minimum), range->maximum);
}

Controls ports_read(void* const ports[PORTS_MAX], const PortRange ranges[], uint32_t n_ranges) {
  Controls controls = {{0}};
  for (uint32_t i = 0; i < n_ranges; ++i) {
    const uint32_t index = ranges[i].index;
    controls.value[index] = read_one((const float*)ports[index], &ranges[i]);
  }
  return controls;
}

bool ports_are_same(const Controls* a, const Controls* b) {
  /* Bits, so that a NaN is like itself. */
  /* NOLINTNEXTLINE(bugprone-suspicious-memory-comparison,cert-exp42-c,cert-flp37-c) */
  return !memcmp(a, b, sizeof(Controls));
}

double ports_gain(float level_db) {
  return pow(10.0, (double)level_db / 20.0);
}

double ports_above(float value, float minimum) {
  return value > minimum ? (double)value : 0.0;
}

uint32_t ports_whole(float value) {
  return (uint32_t)(value + 0.5f);
}

#include "plugin/strings_ports.h"

static const PortRange ranges[] = {STRINGS_CONTROL_PORTS(PORT_RANGE)};

Controls strings_ports_read(void* const ports[PORTS_MAX]) {
  return ports_read(ports, ranges, sizeof(ranges) / sizeof(ranges[0]));
}

Patch strings_ports_patch(const Controls* controls) {
  const float* const v = controls->value;
  return (Patch){
      .level = ports_gain(v[STRINGS_PORT_LEVEL]),
      .damping_per_s = (double)v[STRINGS_PORT_DAMPING],
      .tracking = (double)v[STRINGS_PORT_TRACKING],
      /* At its minimum there is nothing between the masses, and at that of stiffness the string is
       * perfectly flexible. */
      .loss = ports_above(v[STRINGS_PORT_LOSS], 1e-5f),
      .inharmonicity = ports_above(v[STRINGS_PORT_STIFFNESS], 1e-6f),
      .partials = (Partials)ports_whole(v[STRINGS_PORT_PARTIALS]),
      .pickup = (double)v[STRINGS_PORT_PICKUP],
      .spread = (double)v[STRINGS_PORT_SPREAD],
      .pickup_type = (PickupType)(v[STRINGS_PORT_SENSE] + 0.5f),
      .exciter = (Exciter)(v[STRINGS_PORT_EXCITER] + 0.5f),
      .pluck = (double)v[STRINGS_PORT_PLUCK],
      .hardness = (double)v[STRINGS_PORT_HARDNESS],
      .release_s = (double)v[STRINGS_PORT_RELEASE],
      .tuning_hz = (double)v[STRINGS_PORT_TUNING],
      .resonance = (double)v[STRINGS_PORT_RESONANCE],
      .vibrato_hz = (double)v[STRINGS_PORT_VIBRATO_RATE],
      .max_masses = ports_whole(v[STRINGS_PORT_MASSES]),
  };
}

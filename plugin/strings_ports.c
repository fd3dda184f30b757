#include "plugin/strings_ports.h"

#include <stddef.h>

static const PortRange ranges[] = {STRINGS_CONTROL_PORTS(PORT_RANGE)};

Controls strings_ports_read(void* const ports[PORTS_MAX]) {
  return ports_read(ports, ranges, sizeof(ranges) / sizeof(ranges[0]));
}

HarpPatch strings_ports_patch(const Controls* controls) {
  const float* const v = controls->value;
  return (HarpPatch){
      /* At its minimum there is nothing between the masses, and at that of stiffness the string is
       * perfectly flexible. */
      .string =
          {
              .damping_per_s = (double)v[STRINGS_PORT_DAMPING],
              .tracking = (double)v[STRINGS_PORT_TRACKING],
              .loss = ports_above(v[STRINGS_PORT_LOSS], 1e-5f),
              .loss_tracking = (double)v[STRINGS_PORT_LOSS_TRACKING],
              .inharmonicity = ports_above(v[STRINGS_PORT_STIFFNESS], 1e-6f),
              .inharmonicity_tracking = (double)v[STRINGS_PORT_STIFFNESS_TRACKING],
              .partials = (Partials)ports_whole(v[STRINGS_PORT_PARTIALS]),
              .release_s = (double)v[STRINGS_PORT_RELEASE],
              .release_tracking = (double)v[STRINGS_PORT_RELEASE_TRACKING],
              .tension = (double)v[STRINGS_PORT_TENSION],
              .tuning_hz = (double)v[STRINGS_PORT_TUNING],
              .max_masses = ports_whole(v[STRINGS_PORT_MASSES]),
          },
      .level = ports_gain(v[STRINGS_PORT_LEVEL]),
      .pickup_type = (PickupType)ports_whole(v[STRINGS_PORT_SENSE]),
      .pickup = (double)v[STRINGS_PORT_PICKUP],
      .spread = (double)v[STRINGS_PORT_SPREAD],
      .exciter = (Exciter)ports_whole(v[STRINGS_PORT_EXCITER]),
      .pluck = (double)v[STRINGS_PORT_PLUCK],
      .hardness = (double)v[STRINGS_PORT_HARDNESS],
      .resonance = (double)v[STRINGS_PORT_RESONANCE],
      .vibrato_hz = (double)v[STRINGS_PORT_VIBRATO_RATE],
      .noise = (double)v[STRINGS_PORT_NOISE],
      .variation = {(double)v[STRINGS_PORT_VARIATION], ports_whole(v[STRINGS_PORT_TAKE])},
      .unisons = ports_whole(v[STRINGS_PORT_UNISONS]),
      .unison_detune = (double)v[STRINGS_PORT_UNISON_DETUNE],
      .second = (double)v[STRINGS_PORT_SECOND],
      .second_detune = (double)v[STRINGS_PORT_SECOND_DETUNE],
      .second_decay = (double)v[STRINGS_PORT_SECOND_DECAY],
      .body = {(BodiesChoice)ports_whole(v[STRINGS_PORT_BODY]),
               (double)v[STRINGS_PORT_BODY_MIX],
               {(double)v[STRINGS_PORT_BODY_SIZE], (double)v[STRINGS_PORT_BODY_DAMPING]},
               (double)v[STRINGS_PORT_KNOCK]},
  };
}

HarpPatch strings_ports_usual(void) {
  void* const none[PORTS_MAX] = {NULL};
  const Controls controls = strings_ports_read(none);
  return strings_ports_patch(&controls);
}

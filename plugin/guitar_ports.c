#include "plugin/guitar_ports.h"

#include <stddef.h>

static const PortRange ranges[] = {GUITAR_CONTROL_PORTS(PORT_RANGE)};

/* Those of the guitarist and the host. */
static const uint32_t not_in_patch[] = {
    PORT_ENABLED,       PORT_FREEWHEEL,       GUITAR_PORT_STRUM,     GUITAR_PORT_MODE,
    GUITAR_PORT_LEGATO, GUITAR_PORT_HARMONIC, GUITAR_PORT_VARIATION, GUITAR_PORT_TAKE};

static Controls in_patch(const Controls* controls) {
  Controls kept = *controls;
  for (uint32_t i = 0; i < sizeof(not_in_patch) / sizeof(not_in_patch[0]); ++i) {
    kept.value[not_in_patch[i]] = 0.0f;
  }
  return kept;
}

static StringPatch string_patch(const float* v) {
  return (StringPatch){
      .damping_per_s = (double)v[GUITAR_PORT_DAMPING],
      .tracking = (double)v[GUITAR_PORT_TRACKING],
      .loss = ports_above(v[GUITAR_PORT_LOSS], 1e-5f),
      .loss_tracking = (double)v[GUITAR_PORT_LOSS_TRACKING],
      .inharmonicity = ports_above(v[GUITAR_PORT_STIFFNESS], 1e-6f),
      .inharmonicity_tracking = (double)v[GUITAR_PORT_STIFFNESS_TRACKING],
      .partials = (Partials)ports_whole(v[GUITAR_PORT_PARTIALS]),
      .release_s = (double)v[GUITAR_PORT_RELEASE],
      .release_tracking = (double)v[GUITAR_PORT_RELEASE_TRACKING],
      .tension = (double)v[GUITAR_PORT_TENSION],
      .tuning_hz = (double)v[GUITAR_PORT_TUNING],
      .max_masses = ports_whole(v[GUITAR_PORT_MASSES]),
  };
}

Controls guitar_ports_read(void* const ports[PORTS_MAX]) {
  return ports_read(ports, ranges, sizeof(ranges) / sizeof(ranges[0]));
}

GuitarPatch guitar_ports_patch(const Controls* controls) {
  const float* const v = controls->value;
  const double blend = (double)v[GUITAR_PORT_BLEND];
  GuitarPatch patch = {
      .string = string_patch(v),
      .level = ports_gain(v[GUITAR_PORT_LEVEL]),
      .pluck = (double)v[GUITAR_PORT_PLUCK],
      .hardness = (double)v[GUITAR_PORT_HARDNESS],
      .pickups = {{(double)v[GUITAR_PORT_PICKUP], 1.0 - blend},
                  {(double)v[GUITAR_PORT_PICKUP2], blend}},
      .n_strings = GUITAR_PORT_STRINGS,
      .capo = ports_whole(v[GUITAR_PORT_CAPO]),
      .palm = (double)v[GUITAR_PORT_PALM],
      .course = (double)v[GUITAR_PORT_COURSE],
      .noise = (double)v[GUITAR_PORT_NOISE],
      .width = (double)v[GUITAR_PORT_WIDTH],
      .body = {(BodiesChoice)ports_whole(v[GUITAR_PORT_BODY]),
               (double)v[GUITAR_PORT_BODY_MIX],
               {(double)v[GUITAR_PORT_BODY_SIZE], (double)v[GUITAR_PORT_BODY_DAMPING]},
               (double)v[GUITAR_PORT_KNOCK]},
  };
  for (uint32_t i = 0; i < GUITAR_PORT_STRINGS; ++i) {
    patch.open[i] = ports_whole(v[GUITAR_PORT_STRING1 + i]);
  }
  return patch;
}

GuitarPatch guitar_ports_usual(void) {
  void* const none[PORTS_MAX] = {NULL};
  const Controls controls = guitar_ports_read(none);
  return guitar_ports_patch(&controls);
}

GuitaristHow guitar_ports_how(const Controls* controls) {
  const float* const v = controls->value;
  return (GuitaristHow){
      .has_channels = ports_whole(v[GUITAR_PORT_MODE]) == 1,
      .strum_s = (double)v[GUITAR_PORT_STRUM] / 1000.0,
      .legato = ports_whole(v[GUITAR_PORT_LEGATO]),
      .harmonic = ports_whole(v[GUITAR_PORT_HARMONIC]),
      .variation = {(double)v[GUITAR_PORT_VARIATION], ports_whole(v[GUITAR_PORT_TAKE])},
  };
}

bool guitar_ports_are_same_patch(const Controls* a, const Controls* b) {
  const Controls of_a = in_patch(a);
  const Controls of_b = in_patch(b);
  return ports_are_same(&of_a, &of_b);
}

#include "tests/support/settings.h"

#include "plugin/strings_ports.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>

typedef struct {
  const char* symbol;
  double minimum, maximum, default_value;
} Range;

#define SETTING_RANGE(name, symbol, index, minimum, maximum, default_value)                        \
  [index] = {#symbol, (double)(minimum), (double)(maximum), (double)(default_value)},
static const Range ranges[STRINGS_N_PORTS] = {STRINGS_CONTROL_PORTS(SETTING_RANGE)};
#undef SETTING_RANGE

static const Range* range_of(SettingName name) {
  static const uint32_t ports[N_SETTINGS] = {
      [SETTING_DAMPING] = STRINGS_PORT_DAMPING,
      [SETTING_TRACKING] = STRINGS_PORT_TRACKING,
      [SETTING_LOSS] = STRINGS_PORT_LOSS,
      [SETTING_STIFFNESS] = STRINGS_PORT_STIFFNESS,
      [SETTING_MASSES] = STRINGS_PORT_MASSES,
      [SETTING_TUNING] = STRINGS_PORT_TUNING,
      [SETTING_PARTIALS] = STRINGS_PORT_PARTIALS,
      [SETTING_RELEASE] = STRINGS_PORT_RELEASE,
      [SETTING_PLUCK] = STRINGS_PORT_PLUCK,
      [SETTING_HARDNESS] = STRINGS_PORT_HARDNESS,
      [SETTING_LOSS_TRACKING] = STRINGS_PORT_LOSS_TRACKING,
      [SETTING_STIFFNESS_TRACKING] = STRINGS_PORT_STIFFNESS_TRACKING,
      [SETTING_RELEASE_TRACKING] = STRINGS_PORT_RELEASE_TRACKING,
      [SETTING_TENSION] = STRINGS_PORT_TENSION,
  };
  return &ranges[ports[name]];
}

const char* settings_symbol(SettingName name) {
  return range_of(name)->symbol;
}

Setting settings_default(void) {
  Setting setting;
  for (SettingName name = 0; name < N_SETTINGS; ++name) {
    setting.value[name] = range_of(name)->default_value;
  }
  return setting;
}

double settings_on_way(SettingName name, double way) {
  const Range* const range = range_of(name);
  const bool spans_decades = range->minimum > 0.0 && range->maximum >= 10.0 * range->minimum;
  const double value = spans_decades ? range->minimum * pow(range->maximum / range->minimum, way)
                                     : range->minimum + (range->maximum - range->minimum) * way;
  return fmin(fmax(value, range->minimum), range->maximum);
}

Setting settings_random(Random* random) {
  Setting setting;
  for (SettingName name = 0; name < N_SETTINGS; ++name) {
    const uint32_t choice = random_below(random, 6);
    const double way = choice < 2 ? choice : random_between(random, 0.0, 1.0);
    setting.value[name] = settings_on_way(name, way);
  }
  return setting;
}

HarpPatch settings_patch(const Setting* setting) {
  const double* const v = setting->value;
  const bool is_lossless = v[SETTING_LOSS] <= ranges[STRINGS_PORT_LOSS].minimum;
  const bool is_flexible = v[SETTING_STIFFNESS] <= ranges[STRINGS_PORT_STIFFNESS].minimum;
  return (HarpPatch){
      .level = 1.0,
      .string.damping_per_s = v[SETTING_DAMPING],
      .string.tracking = v[SETTING_TRACKING],
      .string.loss = is_lossless ? 0.0 : v[SETTING_LOSS],
      .string.loss_tracking = v[SETTING_LOSS_TRACKING],
      .string.inharmonicity = is_flexible ? 0.0 : v[SETTING_STIFFNESS],
      .string.inharmonicity_tracking = v[SETTING_STIFFNESS_TRACKING],
      .string.partials = (Partials)lround(v[SETTING_PARTIALS]),
      .pickup = ranges[STRINGS_PORT_PICKUP].default_value,
      .spread = ranges[STRINGS_PORT_SPREAD].default_value,
      .pluck = v[SETTING_PLUCK],
      .hardness = v[SETTING_HARDNESS],
      .string.release_s = v[SETTING_RELEASE],
      .string.release_tracking = v[SETTING_RELEASE_TRACKING],
      .string.tension = v[SETTING_TENSION],
      .string.tuning_hz = v[SETTING_TUNING],
      .string.max_masses = (uint32_t)lround(v[SETTING_MASSES]),
      .unisons = 1,
      .second_decay = 1.0,
  };
}

Tone settings_tone(const Setting* setting, uint32_t key, double bend_semitones) {
  const double octaves = ((double)key - 69.0) / 12.0;
  const double* const v = setting->value;
  return (Tone){
      .f0_hz = v[SETTING_TUNING] * exp2(octaves + bend_semitones / 12.0),
      .tau_s = 1.0 / (v[SETTING_DAMPING] * exp2(v[SETTING_TRACKING] * octaves)),
  };
}

void settings_print(const Setting* setting) {
  for (SettingName name = 0; name < N_SETTINGS; ++name) {
    print_message("%s %.9g  ", settings_symbol(name), setting->value[name]);
  }
  print_message("\n");
}

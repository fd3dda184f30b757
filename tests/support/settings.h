/** Settings of Hooke Strings: the whole space that its ports span. */
#ifndef HOOKE_TESTS_SUPPORT_SETTINGS_H
#define HOOKE_TESTS_SUPPORT_SETTINGS_H

#include "core/harp/harp_patch.h"

#include "tests/support/random.h"

#include <stdint.h>

/** Values of the ports that the motion of a string depends on, in the ports' units. */
typedef enum {
  SETTING_DAMPING,
  SETTING_TRACKING,
  SETTING_LOSS,
  SETTING_STIFFNESS,
  SETTING_MASSES,
  SETTING_TUNING,
  SETTING_PARTIALS,
  SETTING_RELEASE,
  SETTING_PLUCK,
  SETTING_HARDNESS,
  SETTING_LOSS_TRACKING,
  SETTING_STIFFNESS_TRACKING,
  SETTING_RELEASE_TRACKING,
  SETTING_TENSION,
  N_SETTINGS
} SettingName;

typedef struct {
  double value[N_SETTINGS];
} Setting;

/** Symbol of a port. */
const char* settings_symbol(SettingName name);

/** All ports at their defaults. */
Setting settings_default(void);

/** The way of a port from its minimum, 0, to its maximum, 1: in the logarithm where it spans
 * decades. */
double settings_on_way(SettingName name, double way);

/** Anywhere, each port with one chance in three at an end. */
Setting settings_random(Random* random);

/** As the manual says what the ports mean. */
HarpPatch settings_patch(const Setting* setting);

/** Pitch [Hz] and decay [s] of an open string, as the manual says. */
Tone settings_tone(const Setting* setting, uint32_t key, double bend_semitones);

/** Print it on one line. */
void settings_print(const Setting* setting);

#endif

/** The plugins of the bundle: one file each, in one shared object. */
#ifndef HOOKE_PLUGIN_BUNDLE_H
#define HOOKE_PLUGIN_BUNDLE_H

#include <lv2/core/lv2.h>

extern const LV2_Descriptor strings_descriptor;
extern const LV2_Descriptor guitar_descriptor;

#endif

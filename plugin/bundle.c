#include "plugin/bundle.h"

#include <stddef.h>

/* Hosts go by the URI, but some remember an index: append. */
static const LV2_Descriptor* const descriptors[] = {&strings_descriptor, &guitar_descriptor};

LV2_SYMBOL_EXPORT const LV2_Descriptor* lv2_descriptor(uint32_t index) {
  return index < sizeof(descriptors) / sizeof(descriptors[0]) ? descriptors[index] : NULL;
}

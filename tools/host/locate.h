/**
   Where this program finds the plugins that came with it.
*/
#ifndef HOOKE_TOOLS_HOST_LOCATE_H
#define HOOKE_TOOLS_HOST_LOCATE_H

#include <stdbool.h>
#include <stddef.h>

/**
   Find the bundle hooke.lv2 beside the program, or else where it was installed (HOOKE_LV2DIR).

   @param[out] path  Its directory; untouched on failure
   @param size       Room in `path` [bytes]
   @return false if LV2_PATH is set, which has the say then, or neither is there.
*/
bool locate_bundle(char* path, size_t size);

#endif

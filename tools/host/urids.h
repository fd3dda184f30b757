/**
   URIs as small numbers: the host side of the LV2 URID extension.

   One thread at a time: the offline host has no other.
*/
#ifndef HOOKE_TOOLS_HOST_URIDS_H
#define HOOKE_TOOLS_HOST_URIDS_H

#include <lv2/urid/urid.h>
#include <stddef.h>
#include <stdint.h>

/** Every URI seen so far; all zero is a valid, empty table. */
typedef struct {
  char** uris;     ///< uris[id - 1] is the URI numbered id
  uint32_t n_uris; ///< URIs stored
  size_t capacity; ///< URIs there is room for
} Urids;

/** @return The number of `uri`, from 1 up, the same for the same text; 0 when memory is out. */
LV2_URID urids_map(Urids* urids, const char* uri);

/** @return The URI numbered `urid`, valid until urids_clear(), or NULL if there is none. */
const char* urids_unmap(const Urids* urids, LV2_URID urid);

/** Free the table and leave an empty one. */
void urids_clear(Urids* urids);

#endif

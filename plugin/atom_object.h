/**
   The properties of an atom:Object, read from memory of any alignment and checked against its end.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_PLUGIN_ATOM_OBJECT_H
#define HOOKE_PLUGIN_ATOM_OBJECT_H

#include <lv2/urid/urid.h>

#include <stdbool.h>
#include <stdint.h>

/** A property, its value where it lies. */
typedef struct {
  LV2_URID key;
  LV2_URID type;
  uint32_t size;
  const uint8_t* value;
} Property;

/** What class an object's body of `n_bytes` says that it has; 0 if it is cut short. */
LV2_URID atom_object_class(const uint8_t* body, uint32_t n_bytes);

/** Find the first property `key`.  @return false if the object has none that is whole */
bool atom_object_find(const uint8_t* body, uint32_t n_bytes, LV2_URID key, Property* property);

#endif

#include "plugin/atom_object.h"

#include <lv2/atom/atom.h>

#include <string.h>

/* The property `*offset` bytes into the body, and the offset of the next. */
static bool next(const uint8_t* body, uint32_t n_bytes, uint32_t* offset, Property* property) {
  LV2_Atom_Property_Body head;
  if (*offset > n_bytes || n_bytes - *offset < sizeof(head)) {
    return false;
  }
  memcpy(&head, body + *offset, sizeof(head));
  const uint32_t value_at = *offset + (uint32_t)sizeof(head);
  if (head.value.size > n_bytes - value_at) {
    return false;
  }
  *property = (Property){head.key, head.value.type, head.value.size, body + value_at};
  *offset = value_at + ((head.value.size + 7u) & ~7u);
  return true;
}

LV2_URID atom_object_class(const uint8_t* body, uint32_t n_bytes) {
  LV2_Atom_Object_Body head = {0, 0};
  if (n_bytes >= sizeof(head)) {
    memcpy(&head, body, sizeof(head));
  }
  return head.otype;
}

bool atom_object_find(const uint8_t* body, uint32_t n_bytes, LV2_URID key, Property* property) {
  uint32_t offset = (uint32_t)sizeof(LV2_Atom_Object_Body);
  while (next(body, n_bytes, &offset, property)) {
    if (property->key == key) {
      return true;
    }
  }
  return false;
}

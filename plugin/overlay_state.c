#define _POSIX_C_SOURCE 200809L

#include "plugin/overlay_state.h"

#include <stddef.h>
#include <string.h>

LV2_State_Status overlay_state_save(Overlay* overlay,
                                    const OverlayUrids* urids,
                                    LV2_State_Store_Function store,
                                    LV2_State_Handle handle) {
  char text[OVERLAY_TEXT_SIZE];
  const uint32_t length = overlay_write(overlay, text);
  if (!length) {
    return LV2_STATE_SUCCESS;
  }
  return store(handle, urids->overlay, text, length + 1, urids->atom_String,
               LV2_STATE_IS_POD | LV2_STATE_IS_PORTABLE);
}

LV2_State_Status overlay_state_restore(Overlay* overlay,
                                       const OverlayUrids* urids,
                                       const ProgramTable* programs,
                                       LV2_State_Retrieve_Function retrieve,
                                       LV2_State_Handle handle) {
  char text[OVERLAY_TEXT_SIZE] = "";
  size_t size = 0;
  uint32_t type = 0;
  uint32_t flags = 0;
  const char* const stored = retrieve(handle, urids->overlay, &size, &type, &flags);
  const bool is_text = stored && type == urids->atom_String && size <= sizeof(text);
  if (is_text) {
    memcpy(text, stored, strnlen(stored, size));
    text[sizeof(text) - 1] = '\0';
  }
  const bool is_read = overlay_read(overlay, text, programs->n_ports, programs->ports);
  return is_read && (is_text || !stored) ? LV2_STATE_SUCCESS : LV2_STATE_ERR_BAD_TYPE;
}

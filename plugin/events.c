#include "plugin/events.h"

#include <string.h>

/* All is copied out before it is read, for hosts align it to four bytes at best. */
bool events_next(const void* sequence, LV2_URID type, uint32_t* offset, Event* event) {
  LV2_Atom atom = {0, 0};
  if (sequence) {
    memcpy(&atom, sequence, sizeof(atom));
  }
  if (!sequence || atom.type != type || atom.size < sizeof(LV2_Atom_Sequence_Body)) {
    return false;
  }
  const uint32_t n_bytes = atom.size - (uint32_t)sizeof(LV2_Atom_Sequence_Body);
  const uint8_t* const bytes = (const uint8_t*)sequence + sizeof(LV2_Atom_Sequence) + *offset;
  LV2_Atom_Event head;
  if (*offset + sizeof(head) > n_bytes) {
    return false;
  }
  memcpy(&head, bytes, sizeof(head));
  if (head.body.size > n_bytes - *offset - sizeof(head)) {
    return false;
  }
  *event = (Event){
      .frame = head.time.frames,
      .type = head.body.type,
      .size = head.body.size,
      .body = bytes + sizeof(head),
  };
  const uint32_t padded = (head.body.size + 7u) & ~7u;
  *offset += (uint32_t)sizeof(head) + padded;
  return true;
}

uint32_t events_frame(const Event* event, uint32_t done, uint32_t n_frames) {
  if (event->frame <= (int64_t)done) {
    return done;
  }
  return event->frame < (int64_t)n_frames ? (uint32_t)event->frame : n_frames;
}

uint32_t events_write_none(LV2_Atom_Sequence* notify, LV2_URID type) {
  const uint32_t room = notify ? notify->atom.size : 0;
  if (room >= sizeof(LV2_Atom_Sequence_Body)) {
    notify->body.unit = 0;
    notify->body.pad = 0;
    notify->atom.size = sizeof(LV2_Atom_Sequence_Body);
    notify->atom.type = type;
  } else if (notify) {
    notify->atom.size = 0;
    notify->atom.type = 0;
  }
  return room;
}

bool events_append(LV2_Atom_Sequence* notify, uint32_t room, const LV2_Atom* atom) {
  const LV2_Atom_Event head = {.body = *atom};
  const uint32_t used = notify ? notify->atom.size : 0;
  const uint64_t padded = ((uint64_t)atom->size + 7u) & ~UINT64_C(7);
  if (used < sizeof(LV2_Atom_Sequence_Body) || used + sizeof(head) + padded > room) {
    return false;
  }
  uint8_t* const end = (uint8_t*)notify + sizeof(LV2_Atom) + used;
  memcpy(end, &head, sizeof(head));
  memcpy(end + sizeof(head), atom + 1, atom->size);
  memset(end + sizeof(head) + atom->size, 0, (size_t)(padded - atom->size));
  notify->atom.size = (uint32_t)(used + sizeof(head) + padded);
  return true;
}

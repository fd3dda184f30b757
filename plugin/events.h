/**
   The events of a block, read from where the host put them.

   Thread: audio; real-time safe.
*/
#ifndef HOOKE_PLUGIN_EVENTS_H
#define HOOKE_PLUGIN_EVENTS_H

#include <lv2/atom/atom.h>
#include <lv2/urid/urid.h>

#include <stdbool.h>
#include <stdint.h>

/** An event of the control port, copied out. */
typedef struct {
  int64_t frame;
  uint32_t type;
  uint32_t size;
  const uint8_t* body; /**< Of any alignment */
} Event;

/**
   The event `*offset` bytes into a sequence's events, and the offset of the next.

   @param sequence  An LV2_Atom_Sequence of any alignment; may be NULL, of another type or cut short
   @param type      URID of atom:Sequence
   @return false when they are over
*/
bool events_next(const void* sequence, LV2_URID type, uint32_t* offset, Event* event);

/** When it is played: one that comes late or out of order at once, at frame `done`, one past the
 * end at the end. */
uint32_t events_frame(const Event* event, uint32_t done, uint32_t n_frames);

/** Make the host's buffer an empty sequence; its word on its room gives way.  NULL is ignored.
 * @return Bytes that it has room for behind the atom header */
uint32_t events_write_none(LV2_Atom_Sequence* notify, LV2_URID type);

/** Add an atom at frame 0 to a sequence that events_write_none() has made.
 * @param room  Bytes behind its atom header
 * @return false, and nothing written, if it has no room or is NULL */
bool events_append(LV2_Atom_Sequence* notify, uint32_t room, const LV2_Atom* atom);

#endif

/**
   Events on their way to a plugin: a queue in frame order, written block by block as an atom
   sequence.
*/
#ifndef HOOKE_TOOLS_HOST_HOST_EVENTS_H
#define HOOKE_TOOLS_HOST_HOST_EVENTS_H

#include "tools/formats/bytes.h"

#include <lv2/atom/atom.h>
#include <lv2/urid/urid.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** One waiting event. */
typedef struct {
  int64_t frame;  ///< From the start of the next run
  LV2_URID type;  ///< What the body is
  uint32_t size;  ///< Bytes of body
  size_t body_at; ///< Where the body is in HostEvents.bodies
  bool is_raw;    ///< Goes out with the next run, whatever its frame
} HostQueued;

/** The queue; all zero is a valid, empty one. */
typedef struct {
  HostQueued* queued;
  size_t n_queued;
  size_t capacity;
  Bytes bodies;
} HostEvents;

/**
   Queue an event.

   @param frame   From the start of the next run [frames]
   @param is_raw  false: put behind all events that are not later, and kept while it lies beyond the
   block. true: put last, and sent with the next run though its frame be negative, unordered or too
   late.
   @return false when memory is out; then nothing is queued.
*/
bool host_events_push(
    HostEvents* events, int64_t frame, LV2_URID type, const void* body, uint32_t size, bool is_raw);

/** @return Bytes that the sequence for a run of `n_frames` takes, its atom header included. */
size_t host_events_size(const HostEvents* events, uint32_t n_frames);

/**
   Write the events of a run of `n_frames` as a sequence in frames.

   @param[out] sequence  Room for host_events_size() bytes
   @param type           URID of atom:Sequence
*/
void host_events_write(const HostEvents* events,
                       uint32_t n_frames,
                       LV2_URID type,
                       LV2_Atom_Sequence* sequence);

/** Forget the events that a run of `n_frames` had, and bring the others nearer by as much. */
void host_events_advance(HostEvents* events, uint32_t n_frames);

/** Free the queue and leave an empty one. */
void host_events_clear(HostEvents* events);

#endif

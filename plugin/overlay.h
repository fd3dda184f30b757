/**
   Values that a program change has laid over control inputs, which belong to the host: each holds
   until the host moves its port.

   The overlay is the audio thread's.  A state is saved and restored from another thread, and may be
   while the audio thread runs; each side writes a record of its own that the other reads, and
   neither waits for the other.

   Hosts bring back their ports in their own time and with their own rounding: an overlay that was
   restored outlasts the host's moving a port to about where it was when the state was saved.
*/
#ifndef HOOKE_PLUGIN_OVERLAY_H
#define HOOKE_PLUGIN_OVERLAY_H

#include "plugin/ports.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

enum {
  OVERLAY_FIELDS = 3, /**< Words that say what lies over a port */
  OVERLAY_WORDS = 1 + PORTS_MAX * OVERLAY_FIELDS,
  OVERLAY_TEXT_SIZE = PORTS_MAX * 24 + 1 /**< Room for an overlay as text [bytes] */
};

/** What lies over a port. */
typedef struct {
  bool is_on;
  bool is_unread;  /**< Whether `input` is not known yet */
  bool is_awaited; /**< Whether the host may yet bring the port back to `before` */
  float value;     /**< What the port counts as */
  float input;     /**< What the port held when it was last read */
  float before;    /**< What it held when the state was saved */
} OverlaidPort;

/** A record that one thread writes and others read; all zero is a valid empty one. */
typedef struct {
  atomic_uint n_writes; /**< Twice; odd: it is being written */
  atomic_uint words[OVERLAY_WORDS];
} OverlayRecord;

/** All zero is a valid overlay of nothing. */
typedef struct {
  /* Of the audio thread */
  OverlaidPort ports[PORTS_MAX];
  unsigned n_taken; /**< Which record of what was restored is in it */

  /* Of both */
  OverlayRecord played;   /**< What the audio thread has; its first word is `n_taken` */
  OverlayRecord restored; /**< What a state has said last */
} Overlay;

/* Of the audio thread; real-time safe */

/** Take what was restored, if there is something new. */
void overlay_take(Overlay* overlay);

/** Copy what ports are connected to, with values in the place of ports that they lie over; where
 * the host has moved a port, the overlay ends.  A port that is not connected has not been moved. */
void overlay_apply(Overlay* overlay, void* const ports[PORTS_MAX], void* over[PORTS_MAX]);

/**
   Lay values over ports; not over one that holds its value already.

   @param ports    What all ports are connected to
   @param indices  `n_ports` control inputs
   @param values   And what they are to count as
*/
void overlay_put(Overlay* overlay,
                 void* const ports[PORTS_MAX],
                 uint32_t n_ports,
                 const uint32_t indices[],
                 const float values[]);

/* Of one other thread at a time, also while the audio thread runs */

/** Write the overlay as text, as exact as floats are and of no locale.  @return Its length, 0:
 * there is none */
uint32_t overlay_write(Overlay* overlay, char text[OVERLAY_TEXT_SIZE]);

/**
   Replace the overlay by one that was written.

   @param indices  `n_ports` control inputs, and no other may be named
   @return false if the text is none that was written; then nothing lies over any port
*/
bool overlay_read(Overlay* overlay, const char* text, uint32_t n_ports, const uint32_t indices[]);

#endif

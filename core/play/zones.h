/**
   Which MIDI channels follow another: the zones of MIDI Polyphonic Expression.

   The lower zone is led by channel 0 (as counted here), and its members are those above it; the
   upper one is led by channel 15, and its members are those below.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_PLAY_ZONES_H
#define HOOKE_CORE_PLAY_ZONES_H

#include <stdbool.h>
#include <stdint.h>

enum {
  ZONES_CHANNELS = 16,
  ZONES_LOWER = 0,  /**< Channel that leads the lower zone */
  ZONES_UPPER = 15, /**< And the upper one */
  ZONES_MOST_MEMBERS = 15
};

/** How many members each zone has; with none it does not exist.  Zero is a valid state: no zone. */
typedef struct {
  uint32_t n_lower;
  uint32_t n_upper;
} Zones;

/**
   Give a zone `n_members`; the other one loses the channels that this one takes, and is gone when
   it has no member left.

   @param leader     ZONES_LOWER or ZONES_UPPER
   @param n_members  0 (no such zone) to ZONES_MOST_MEMBERS
*/
void zones_set(Zones* zones, uint32_t leader, uint32_t n_members);

/** Whether `channel` is in the zone of `leader`, or leads it. */
bool zones_has(const Zones* zones, uint32_t leader, uint32_t channel);

/** Whom `channel` follows: its zone's leader, or itself if it leads or is in no zone. */
uint32_t zones_leader(const Zones* zones, uint32_t channel);

/** A member's place among those of its zone, counted from its leader, 0 to 14; ZONES_CHANNELS for a
 * leader, and for one in no zone its own number. */
uint32_t zones_seat(const Zones* zones, uint32_t channel);

/** Whether `channel` is in the same place in both. */
bool zones_agree(const Zones* a, const Zones* b, uint32_t channel);

#endif

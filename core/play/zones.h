/**
   Which of the 16 MIDI channels play for themselves: the zones of MIDI Polyphonic Expression.

   The lower zone is led by channel 0 (as counted here), and its members are those above it; the
   upper one is led by channel 15, and its members are those below.  Each channel of a zone is a
   hand.  The channels in no zone are one hand together, which has the number of the first of them;
   so without zones all channels are hand 0.

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

/** The hand that `channel` is, or is part of. */
uint32_t zones_hand(const Zones* zones, uint32_t channel);

/** The hand whose gestures `hand` follows beside its own: its zone's leader, or itself if it leads
 * or is in no zone. */
uint32_t zones_leader(const Zones* zones, uint32_t hand);

/** Whether `channel` is in the same place in both. */
bool zones_agree(const Zones* a, const Zones* b, uint32_t channel);

#endif

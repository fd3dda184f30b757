/**
   What MIDI has said to a channel so far, and what it comes to.

   A channel in a zone follows its leader beside what it is told itself; one in none is its own
   leader.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_PLAY_CHANNEL_H
#define HOOKE_CORE_PLAY_CHANNEL_H

#include "core/play/performance.h"

#include <stdbool.h>
#include <stdint.h>

/** Some of the 128 keys. */
typedef struct {
  uint64_t half[2];
} ChannelKeys;

/** All that is remembered of a channel. */
typedef struct {
  double wheel;         /**< −1 to 1 */
  uint32_t range_cents; /**< Of the wheel; this and the next two as core/play/rpn.h counts */
  uint32_t fine;
  uint32_t coarse;
  double pressure;   /**< Of all keys, 0 to 1 */
  double brightness; /**< −1 to 1 */
  double vibrato;    /**< Depth [semitones] */
  double breath;     /**< 0 to 1 */
  double softness;   /**< 0 to 1 */
  double lift;       /**< Of the dampers, 0 to 1 */
  double volume;     /**< This and expression: gains, 0 to 1 */
  double expression;
  bool is_sostenuto;
  bool has_played;     /**< Since it last let go */
  ChannelKeys down;    /**< Keys that are down */
  ChannelKeys pressed; /**< Keys that are pressed each for itself */
  uint32_t parameter;  /**< That data entry is for, see core/play/rpn.h */
} Channel;

/** A channel that has heard nothing. */
void channel_reset(Channel* channel, uint32_t range_cents);

/** What reset controllers says: wheel, vibrato, pressure and pedals at rest, breath and expression
 * full, and no parameter chosen.  The wheel's range, both tunings, brightness and volume stay, and
 * so do keys that are down or pressed. */
void channel_reset_controllers(Channel* channel);

/** Data entry for a registered parameter; one that no channel has is ignored. */
void channel_enter(Channel* channel, uint32_t parameter, uint32_t controller, uint32_t value);

/**
   What a gesture comes to.

   A leader's wheel and tunings are added to a member's wheel, and so is its brightness, to −1 to 1
   in all; of pressures the harder one counts; all else is the leader's.

   @param leader  Of `channel`, or that itself
*/
double channel_gesture(const Channel* leader, const Channel* channel, Gesture gesture);

/** Put `key` in or take it out. */
static inline void channel_keys_put(ChannelKeys* keys, uint32_t key, bool is_in) {
  const uint64_t bit = UINT64_C(1) << (key & 63);
  uint64_t* const half = &keys->half[key >> 6];
  *half = is_in ? *half | bit : *half & ~bit;
}

static inline bool channel_keys_have(const ChannelKeys* keys, uint32_t key) {
  return keys->half[key >> 6] >> (key & 63) & 1;
}

static inline bool channel_keys_are_none(const ChannelKeys* keys) {
  return !(keys->half[0] | keys->half[1]);
}

#endif

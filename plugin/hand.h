/**
   What MIDI has said to a hand so far, and what it comes to.

   A hand in a zone follows its leader beside what it is told itself; one in none is its own leader.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_PLUGIN_HAND_H
#define HOOKE_PLUGIN_HAND_H

#include <stdbool.h>
#include <stdint.h>

/** Some of the 128 keys. */
typedef struct {
  uint64_t half[2];
} HandKeys;

/** All that is remembered of a hand. */
typedef struct {
  double wheel;         /**< −1 to 1 */
  uint32_t range_cents; /**< Of the wheel; this and the next two as core/play/rpn.h counts */
  uint32_t fine;
  uint32_t coarse;
  double pressure;   /**< Of all keys, 0 to 1 */
  double brightness; /**< −1 to 1 */
  double vibrato;    /**< Depth [semitones] */
  double breath;     /**< 0 to 1 */
  double lift;       /**< Of the dampers, 0 to 1 */
  double softness;   /**< 0 to 1 */
  bool is_sostenuto;
  bool has_played;  /**< Since it last let go */
  HandKeys down;    /**< Keys that are down */
  HandKeys pressed; /**< Keys that are pressed each for itself */
} Hand;

/** A hand that has heard nothing. */
void hand_reset(Hand* hand, uint32_t range_cents);

/** What reset controllers says: wheel, vibrato, pressure and pedals at rest, and breath full.  The
 * wheel's range, both tunings and brightness stay, and so do keys that are down or pressed. */
void hand_reset_controllers(Hand* hand);

/** Data entry for a registered parameter; one that no hand has is ignored. */
void hand_enter(Hand* hand, uint32_t parameter, uint32_t controller, uint32_t value);

/** By how much it is bent and tuned [semitones]: a leader's wheel and tuning count for all that
 * follow. */
double hand_bend(const Hand* leader, const Hand* hand);

/** How hard it presses all its keys, 0 to 1: as the harder of both. */
double hand_pressure(const Hand* leader, const Hand* hand);

/** How bright it is, −1 to 1: the sum of both. */
double hand_brightness(const Hand* leader, const Hand* hand);

/** Put `key` in or take it out. */
void hand_keys_put(HandKeys* keys, uint32_t key, bool is_in);

bool hand_keys_have(const HandKeys* keys, uint32_t key);

bool hand_keys_are_none(const HandKeys* keys);

#endif

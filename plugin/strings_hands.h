/**
   The hands that play the harp, and what each hears of its zone's leader.

   What is said to a leader is told to the harp of all hands that follow it, see core/play/zones.h.

   Thread: audio; real-time safe.
*/
#ifndef HOOKE_PLUGIN_STRINGS_HANDS_H
#define HOOKE_PLUGIN_STRINGS_HANDS_H

#include "core/harp/harp.h"
#include "core/play/zones.h"
#include "plugin/hand.h"

#include <stdbool.h>
#include <stdint.h>

/** All hands; use them through the functions below. */
typedef struct {
  Harp* harp;
  Zones zones;
  Hand hands[ZONES_CHANNELS];
} StringsHands;

/** No zone, and nothing said to any hand; the harp is not told. */
void strings_hands_reset(StringsHands* all);

/**
   Set up a zone, or none, as zones_set().

   Hands of the zone and all that other channels make up than before put their keys up and start
   with nothing said to them; members have a wheel of ±48 semitones, all others of ±2.
*/
void strings_hands_set_zone(StringsHands* all, uint32_t leader, uint32_t n_members);

/** Whether `hand` follows another, and so has no word in what is its zone's. */
bool strings_hands_is_member(const StringsHands* all, uint32_t hand);

/** Whether what is said to `leader` is said to `hand` too. */
bool strings_hands_follows(const StringsHands* all, uint32_t hand, uint32_t leader);

/* What a hand does; see core/harp/harp.h for the numbers.  A member whose keys are all up lets go
   of what it has played as soon as it plays again, or its wheel, pressure or brightness moves: that
   may be for the next note. */

void strings_hands_note_on(StringsHands* all, uint32_t hand, uint32_t key, uint32_t velocity);
void strings_hands_note_off(StringsHands* all, uint32_t hand, uint32_t key);
void strings_hands_turn_wheel(StringsHands* all, uint32_t hand, double wheel);
void strings_hands_press(StringsHands* all, uint32_t hand, double pressure);
void strings_hands_brighten(StringsHands* all, uint32_t hand, double brightness);

/** Data entry for a registered parameter, one of the first three; a range is that of all members of
 * a zone. */
void strings_hands_enter(
    StringsHands* all, uint32_t hand, uint32_t parameter, uint32_t controller, uint32_t value);

/* What a leader does, or a hand that follows none, for all that follow it. */

void strings_hands_vibrate(StringsHands* all, uint32_t hand, double semitones);
void strings_hands_breathe(StringsHands* all, uint32_t hand, double breath);
void strings_hands_lift(StringsHands* all, uint32_t hand, double lift);
void strings_hands_sostenuto(StringsHands* all, uint32_t hand, bool is_down);
void strings_hands_soften(StringsHands* all, uint32_t hand, double softness);
void strings_hands_all_notes_off(StringsHands* all, uint32_t hand);

/** As hand_reset_controllers(), of all that follow. */
void strings_hands_reset_controllers(StringsHands* all, uint32_t hand);

/** Press one key of the leader's own. */
void strings_hands_press_key(StringsHands* all, uint32_t hand, uint32_t key, double pressure);

/** All sound off: of all hands; keys and pedals are up. */
void strings_hands_silence(StringsHands* all);

#endif

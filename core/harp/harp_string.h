/**
   One string of the harp: the key it belongs to, its damper, what it is played with, and what the
   channel that played it does to it since.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_HARP_HARP_STRING_H
#define HOOKE_CORE_HARP_HARP_STRING_H

#include "core/harp/harp_members.h"
#include "core/harp/harp_patch.h"
#include "core/voice/voice.h"

#include <stdbool.h>
#include <stdint.h>

/** What a channel does to a string that it has played. */
typedef struct {
  double bend;       /**< [semitones] */
  double vibrato;    /**< To the sharp side [semitones], 0 to 1 */
  double brightness; /**< −1, dark, to 1, bright; 0: as the patch has it */
  double pressure;   /**< 0 to 1: leans on the bow, or else adds to the vibrato */
  double breath;     /**< Share of the bow's strength, 0 to 1 */
} HarpTouch;

/** A channel that does nothing. */
#define HARP_TOUCH_NONE ((HarpTouch){.breath = 1.0})

/** Zero is a string that is asleep and has no memory. */
typedef struct HarpString {
  Voice voice;
  const HarpPatch* patch; /**< The harp's */
  uint32_t key;           /**< MIDI note number */
  double semitones;       /**< Its pitch above A4 [semitones]; NAN: it has none, and is silent */
  double lift;     /**< Of its damper: 0, it lies on the string, to 1, it does not touch it */
  HarpTouch touch; /**< Set it before harp_string_ready() or harp_string_retune() */
  double cents;    /**< How far from its pitch it lies; set it as the touch */
  double decay;    /**< τ over that of its key; so too */

  /* Its group, see core/harp/harp_group.h, whose these are */
  struct HarpString* followers; /**< The others of its group; NULL: it has none, and is alone */
  HarpGroup group;              /**< What it was played as last */
  bool is_followed;             /**< Any of those may be awake */

  /* Who plays it; the harp's */
  uint32_t holders; /**< The channels that hold its key down, a bit each */
  uint32_t channel; /**< The channel that played it last */
  uint32_t lender;  /**< 1 + the channel with whose gain it is heard while it rings; 0: `channel` */
  bool is_caught;   /**< Its damper is held up by the sostenuto pedal */
  bool is_let_go;   /**< It follows the channel no more */
  double leaned_on; /**< Pressure of its key alone, 0 to 1 */
} HarpString;

/** The pitch of a string [Hz], bent as its channel bends it but for the vibrato, and as far off as
 * it lies. */
double harp_string_pitch_hz(const HarpString* string);

/**
   Lay a string at rest over `memory`, chain_size(capacity) bytes, aligned to CHAIN_ALIGNMENT; it
   has the pitch of its key in equal temperament, and never more masses than `capacity`.

   @param patch   What it is played with and strung as, the caller's
   @param bridge  What the patch's resonance ties it to; NULL: nothing
*/
void harp_string_init(HarpString* string,
                      const HarpPatch* patch,
                      double rate_hz,
                      uint32_t key,
                      void* memory,
                      uint32_t capacity,
                      const Bridge* bridge);

/** Silence it at once, with nothing at it and nobody playing it. */
void harp_string_rest(HarpString* string);

/**
   Make a string ready to be played: its damper lifts.  From rest it is strung anew, with the
   largest stable number of masses up to the patch's; while it rings the coefficients take `n_glide`
   frames, and if a bend has left it few of its masses it has them again.

   @return false, and it is not to be played, if its pitch is at or above Nyquist
*/
bool harp_string_ready(HarpString* string, uint32_t n_glide);

/**
   What a pluck is to be multiplied by, see harp_balance_gain().

   @param string   One that is ready, the first of the members
   @param members  What is played with it
*/
double
harp_string_gain(const HarpString* string, const HarpMember members[HARP_MEMBERS], Pluck pluck);

/**
   Play a string that is ready with the patch's exciter; the motion adds to its own.

   @param pluck  As loud as a strike or a bow is to be; its hardness is the hammer's, or the bow's
   pressure
*/
void harp_string_play(HarpString* string, Pluck pluck, uint32_t n_glide);

/** Lift the bow, if there is one. */
void harp_string_lift(HarpString* string);

/** Bring a ringing string to the patch, its touch and its damper's `lift` in `n_glide` frames, see
 * voice_aim().  One that is choked, or asleep, is left alone. */
void harp_string_retune(HarpString* string, uint32_t n_glide);

/** Choke it: it is gone in a moment. */
void harp_string_choke(HarpString* string, uint32_t n_glide);

/** Wake it, at rest, for the bridge to move; it is tied in `n_glide` frames.  False if it cannot
 * sound. */
bool harp_string_wake(HarpString* string, uint32_t n_glide);

#endif

/**
   A string that is strung, plucked, retuned while it rings, and put to sleep: what the strings of
   all instruments have in common.

   It keeps its motion through every change, has at most a certain multiple of the motion that its
   plucks gave it, and costs nothing once it has died away.  What happens to it in its own time
   depends on nothing but when it was plucked and retuned, so not on how its frames are cut into
   calls.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_VOICE_VOICE_H
#define HOOKE_CORE_VOICE_VOICE_H

#include "core/excite/pluck.h"
#include "core/string/chain.h"
#include "core/string/tuning.h"

#include <stdbool.h>
#include <stdint.h>

/** τ of a string that a hand chokes [s]. */
#define VOICE_CHOKE_S 0.005

/** What a player's gesture takes [s], and the fewest frames: a string must have the time to follow
 * it, whatever the rate, or gestures would pump it. */
#define VOICE_GESTURE_S 0.004
enum { VOICE_GESTURE_FRAMES = 192 };

/** Zero is one that is asleep and has no memory. */
typedef struct {
  Chain chain;
  const ChainKernel* kernel; /**< What steps it */
  void* memory;              /**< Memory for `capacity` masses, the caller's */
  uint32_t capacity;         /**< Most masses it can have */
  uint32_t phase;            /**< Strings of different phases are not looked at together */
  double rate_hz;            /**< Steps per second [Hz] */
  double given;              /**< Motion that its plucks gave it: √ω times an amplitude */
  double lent;               /**< The same, that other strings may have given it */
  double f0_hz;              /**< Pitch it has or is gliding to [Hz] */
  double a1;                 /**< (ω0 h)² of its fundamental */
  double headroom;           /**< Of its coefficients, see tuning_headroom() */
  double loudest;            /**< Largest displacement seen since it was last plucked */
  uint32_t n_choked;         /**< Frames in which it has been choked */
  uint32_t n_until_look;     /**< Frames until it is next looked at, see voice_pass() */
  bool is_awake;             /**< Whether it moves */
  bool is_kept;              /**< Something else moves it: it is not put to sleep */
  bool is_choked; /**< Whether it is to be let go soon, however slow its upper modes are */
} Voice;

/** Frames that a gesture takes at a rate. */
uint32_t voice_gesture_frames(double rate_hz);

/** Lay a voice at rest over `memory`, chain_size(capacity) bytes, aligned to CHAIN_ALIGNMENT. */
void voice_init(Voice* voice, double rate_hz, uint32_t phase, void* memory, uint32_t capacity);

/** Silence a voice and set all its masses to exact zeros. */
void voice_sleep(Voice* voice);

/**
   String it anew, at rest, with the largest stable number of masses up to `limit` and its capacity.

   @return false, and it sleeps, if it cannot sound at this pitch
*/
bool voice_string(Voice* voice, const TuningTarget* target, uint32_t limit);

/**
   Bring a voice that is awake to `target` in `n_glide` frames, its motion kept.  Where that would
   pass its limit stiffness and true partials give way (tuning_fit()); where they would have to by
   far, the motion is moved onto fewer masses (core/string/remesh.h).

   @return false, and it goes on as it was, if the pitch cannot be had
*/
bool voice_retune(Voice* voice, const TuningTarget* target, uint32_t n_glide);

/**
   Move the motion of a voice that is awake onto `n_masses`, at the pitch and decay that it has now;
   all else is as `target` says.

   @param n_masses  1 to the capacity
   @return false, and nothing done, if they cannot hold it
*/
bool voice_mesh(Voice* voice, const TuningTarget* target, uint32_t n_masses);

/** Add a pluck to the motion of a voice that is awake. */
void voice_pluck(Voice* voice, Pluck pluck);

/** What moves a voice that is awake is given to it as a pluck would give it, and it is not looked
 * at for a while: call it now and then while something plays on it. */
void voice_feed(Voice* voice);

/** Say whether it is choked, see VOICE_CHOKE_S. */
void voice_choke(Voice* voice, bool is_choked);

/** Frames that it can be run in one go, before voice_pass() must be told. */
uint32_t voice_stretch(const Voice* voice);

/**
   After `n_frames`, at most its stretch: when it is due, put the voice to sleep if it has died away
   to −120 dB of its loudest, or has been choked for a while; else see that its numbers suit it.
*/
void voice_pass(Voice* voice, uint32_t n_frames);

#endif

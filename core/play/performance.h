/**
   What players do to an instrument, whichever it is: the seam between MIDI and what sounds.

   Each of the 16 channels is a player of its own, whose gestures act on its own notes alone.  An
   instrument implements a PerformanceKind, one table for all of its instances, and says in its
   own header what it makes of each gesture.

   Thread: what is called, as the instrument; real-time safe.
*/
#ifndef HOOKE_CORE_PLAY_PERFORMANCE_H
#define HOOKE_CORE_PLAY_PERFORMANCE_H

#include <stdbool.h>
#include <stdint.h>

enum { PERFORMANCE_CHANNELS = 16, PERFORMANCE_KEYS = 128 };

/** What a player does to all notes of a channel, and the value that goes with it; at first all are
 * 0, but breath and gain 1. */
typedef enum {
  GESTURE_BEND,       /**< By how much, tunings with it [semitones] */
  GESTURE_PRESSURE,   /**< On all keys, 0 to 1 */
  GESTURE_BRIGHTNESS, /**< −1, dark, to 1, bright */
  GESTURE_VIBRATO,    /**< Its depth [semitones], ≥ 0 */
  GESTURE_BREATH,     /**< 0 to 1 */
  GESTURE_SOFTNESS,   /**< Of the soft pedal, 0 to 1 */
  GESTURE_SOSTENUTO,  /**< 1: its pedal is down and holds the keys that are down now; 0: it is up */
  GESTURE_DAMPER,     /**< How far the sustain pedal lifts what damps keys that are up, 0 to 1 */
  GESTURE_GAIN,       /**< ≥ 0 */
  N_GESTURES
} Gesture;

/** What an instrument does when it is played.  Channels are less than PERFORMANCE_CHANNELS, and
 * keys than PERFORMANCE_KEYS. */
typedef struct {
  /** `velocity` 1 to 127. */
  void (*note_on)(void* instrument, uint32_t channel, uint32_t key, uint32_t velocity);
  void (*note_off)(void* instrument, uint32_t channel, uint32_t key);
  void (*gesture)(void* instrument, uint32_t channel, Gesture gesture, double value);

  /** Press one key that is down, 0 to 1. */
  void (*press_key)(void* instrument, uint32_t channel, uint32_t key, double pressure);

  /** What the channel has played and whose keys are up keeps its touch: bend, pressure, brightness,
   * vibrato, breath and gain.  Only the pedals go on acting on it. */
  void (*let_go)(void* instrument, uint32_t channel);

  /** All keys of the channel up; pedals hold what they hold. */
  void (*all_notes_off)(void* instrument, uint32_t channel);

  /** All keys and pedals of the channel up, and what it plays silent in a moment. */
  void (*all_sound_off)(void* instrument, uint32_t channel);

  /** The channel has a place among equals, from 0 on, or more than any instrument has: its own
   * number at first, and in a zone that among the members.  NULL: it does not matter. */
  void (*seat)(void* instrument, uint32_t channel, uint32_t seat);

  /** The channel's keys have these pitches above A4 [semitones], NAN: none, from the next notes on,
   * and `is_live`: what it plays already moves there too.  At first they have `key − 69`. */
  void (*tune)(void* instrument,
               uint32_t channel,
               const double semitones[PERFORMANCE_KEYS],
               bool is_live);
} PerformanceKind;

/** An instrument, and how it is played. */
typedef struct {
  const PerformanceKind* kind;
  void* instrument;
} Performance;

#endif

/**
   A string for every key of the MIDI range, with its damper, the pedal and the wheel.

   No string is ever stolen.  A string that has died away is at rest in exact zeros and costs
   nothing.  The samples do not depend on how the frames are cut into calls of harp_run().

   Thread: harp_new() and harp_free() anywhere but the audio thread; all else is real-time safe, one
   thread at a time.
*/
#ifndef HOOKE_CORE_HARP_H
#define HOOKE_CORE_HARP_H

#include "core/harp_pickups.h"
#include "core/harp_string.h"
#include "core/patch.h"
#include "core/ramp.h"

#include <stdbool.h>
#include <stdint.h>

enum {
  HARP_KEYS = 128,
  HARP_MIX_FRAMES = 256, /**< Frames that are mixed at a time */
};

/** Largest displacement of one string plucked with full velocity, at level 1. */
#define HARP_NOTE_PEAK 0.25

/** What the player's hands and feet are doing with a key. */
typedef struct {
  bool is_down; /**< The key is down */
  bool is_held; /**< It is up, but was down when the pedal was */
} HarpKey;

/** What is sounding. */
typedef struct {
  uint32_t n_strings; /**< Strings awake */
  uint32_t n_masses;  /**< Their masses */
  double headroom; /**< The smallest of their stability margins, see tuning_headroom(); 1 if none is
                      awake */
} HarpReport;

/** The harp; use it through the functions below. */
typedef struct {
  double rate_hz;
  uint32_t n_gesture; /**< Frames that a player's gesture takes to act */
  Patch patch;
  double bend_semitones;
  bool is_pedal_down;
  Ramp level;
  HarpPickups pickups;
  uint32_t n_fade; /**< Frames that the next fade will take */
  HarpKey keys[HARP_KEYS];
  HarpString strings[HARP_KEYS];
  void* memory;                 /**< Memory of all strings; owned */
  HarpString* awake[HARP_KEYS]; /**< The strings awake, while they are run */
  ChainPart parts[HARP_KEYS];   /**< Their chains, and where they are read */
  bool is_bowed;                /**< Whether a note has been bowed since all was still */
  double rest[2];               /**< What stands still on each side, once one has */
  HarpReading reading;          /**< How they were read last */
  float before[CHAIN_MAX_TAPS]; /**< The last sample of each tap, where it is differentiated */
  float mix[CHAIN_MAX_TAPS][HARP_MIX_FRAMES];
} Harp;

/**
   Make a harp at rest.

   @param rate_hz  Frames per second [Hz], > 0
   @return NULL if there is no memory or the rate is no rate; else the caller's, to harp_free()
*/
Harp* harp_new(double rate_hz);

/** Free a harp; NULL is ignored. */
void harp_free(Harp* harp);

/** Bring all strings to rest at once; keys and pedal up, wheel in its middle. */
void harp_reset(Harp* harp);

/** Take a new patch; what rings gets there in `n_frames`, and no faster than by a gesture (0: at
   once).  How and where it is plucked, and the most masses, hold from the next pluck on. */
void harp_set_patch(Harp* harp, const Patch* patch, uint32_t n_frames);

/**
   Tune the keys anew; what rings glides there by a gesture.

   A key then has tuning_hz · 2^((semitones + bend) / 12).  Damping and its tracking stay with the
   key.  Every string has memory for CHAIN_MAX_MASSES, so that a scale takes none of its masses from
   it, however low.  A key without a pitch is silent: what rings there is choked.

   @param semitones  Of every key above A4, in any order; NAN: it has no pitch.  `key − 69` is equal
   temperament, as after harp_new()
*/
void harp_set_scale(Harp* harp, const double semitones[HARP_KEYS]);

/** Key down: pluck its string.  `velocity` 1 to 127, loudness as its square; harder plucks are a
 * little brighter. */
void harp_note_on(Harp* harp, uint32_t key, uint32_t velocity);

/** Key up: the damper falls, unless the pedal is down. */
void harp_note_off(Harp* harp, uint32_t key);

/** Move the pedal; up, it lets all dampers fall whose keys are up. */
void harp_pedal(Harp* harp, bool is_down);

/** Bend all strings; what rings keeps exact pitch once it is there. */
void harp_bend(Harp* harp, double semitones);

/** All keys up. */
void harp_all_notes_off(Harp* harp);

/** All keys and the pedal up, and every string silent in a few hundredths of a second. */
void harp_all_sound_off(Harp* harp);

/** Run `n_frames` and write them to `left` and `right`. */
void harp_run(Harp* harp, uint32_t n_frames, float* left, float* right);

/** What is sounding now. */
HarpReport harp_report(const Harp* harp);

#endif

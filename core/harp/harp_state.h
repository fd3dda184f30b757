/** What a harp is made of: for the rooms of core/harp/harp.h alone. */
#ifndef HOOKE_CORE_HARP_HARP_STATE_H
#define HOOKE_CORE_HARP_HARP_STATE_H

#include "core/base/line.h"
#include "core/excite/noise.h"
#include "core/harp/harp_group.h"
#include "core/harp/harp_patch.h"
#include "core/harp/harp_stereo.h"
#include "core/harp/harp_string.h"
#include "core/string/chain.h"
#include "core/voice/bridge.h"
#include "core/voice/onset.h"
#include "core/voice/radiator.h"

#include <stdbool.h>
#include <stdint.h>

enum {
  HARP_KEYS = 128,
  HARP_CHANNELS = 16,
  HARP_SPARES = 32,               /**< Strings for keys that more than one channel holds */
  HARP_BUSES = 1 + HARP_CHANNELS, /**< What channels of gain 1 play, and what each other one does */
  HARP_STRINGS = HARP_KEYS + HARP_SPARES,
  HARP_VOICES = HARP_STRINGS * HARP_MEMBERS, /**< Those, and all that follow them */
  HARP_MIX_FRAMES = HARP_STEREO_FRAMES,      /**< Frames that are mixed at a time */
};

/** A channel that plays, and the pedals under it. */
typedef struct {
  HarpTouch touch;
  Line gain;         /**< Of all that it has played */
  double lift;       /**< Of the dampers of keys that are up: 0 to 1 */
  double softness;   /**< Of the soft pedal, 0 to 1 */
  bool is_sostenuto; /**< The sostenuto pedal is down */
} HarpChannel;

enum {
  HARP_BRIDGE_FRAMES = 64,
  HARP_BRIDGE_STRINGS = HARP_STRINGS,
  HARP_BRIDGE_WAKES = 2, /**< Strings that wake at a time */
  HARP_BRIDGE_LOWEST = 21,
  HARP_BRIDGE_HIGHEST = 108 /**< Keys whose strings wake */
};

/** Strings that are stepped by one call. */
typedef struct {
  ChainLoop loop;
  uint32_t bus; /**< Where they are heard */
  uint32_t first;
  uint32_t n;
  double pulled[CHAIN_MAX_TAPS]; /**< What their taps read of the last pull, for y = 1 */
} HarpBridgeBatch;

/** Where the last mass of a string is, and what the tie makes of it. */
typedef struct {
  float* f;      /**< Its position, where it is in floats */
  double* d;     /**< Where it is in doubles */
  size_t to_u;   /**< From there to its velocity */
  double give;   /**< r p */
  double pull;   /**< p */
  double spring; /**< s */
} HarpBridgeEnd;

/** Zero moves nothing. */
typedef struct {
  Bridge bridge;
  RadiatorBody on;       /**< What it is on */
  uint32_t n_tied;       /**< Strings that are tied: the first of those that are run */
  uint32_t n_until_grid; /**< Frames until the next place of the grid */
  uint32_t next_key;     /**< Which is asked next whether it is to wake */
  double loudest;        /**< Of the strings that are tied, since there are any */
  double level;          /**< How far the bridge moves of late */
  bool is_gliding;       /**< Whether a tie is */
  bool is_touched[HARP_BRIDGE_STRINGS]; /**< Those that something acts on after every frame */
  double spring;                        /**< Σ s while none is */
  uint32_t n_batches;
  HarpBridgeBatch batches[HARP_BRIDGE_STRINGS];
  ChainWork works[HARP_BRIDGE_STRINGS];
  HarpBridgeEnd ends[HARP_BRIDGE_STRINGS];
} HarpBridge;

/** The harp; use it through the functions below. */
typedef struct Harp {
  double rate_hz;
  uint32_t n_gesture; /**< Frames that a player's gesture takes to act */
  HarpPatch patch;
  HarpChannel channels[HARP_CHANNELS];
  double scales[HARP_CHANNELS][HARP_KEYS]; /**< Pitches of each channel's keys above A4
                                              [semitones]; NAN: none */
  Line level;
  uint32_t n_notes; /**< That have been played since all was still */
  Pickups pickups;
  uint32_t n_fade;                                    /**< Frames that the next fade will take */
  HarpString strings[HARP_STRINGS];                   /**< Of every key, and then of spares */
  HarpString followers[HARP_STRINGS][HARP_FOLLOWERS]; /**< Of each of them */
  bool is_followed;                                   /**< Any of those may be awake */
  void* memory;                                       /**< Memory of all strings; owned */
  HarpString* awake[HARP_VOICES];                     /**< The strings awake, while they are run */
  uint8_t buses[HARP_VOICES];                         /**< Where each of them is heard */
  ChainPart parts[HARP_VOICES];                       /**< Their chains, and where they are read */
  HarpBridge bridge;
  HarpStereo stereo;
  Radiator radiator;
  NoiseMake noise_make;
  Noise noises[HARP_CHANNELS]; /**< What fingers and hammers of each make themselves */
  bool is_bowed;               /**< Whether a note has been bowed since all was still */
  double dc;                   /**< What stands still, once a note has been bowed */
  Reading reading;             /**< How they were read last */
  uint32_t apart;              /**< The channels that had a bus of their own then, a bit each */
  float before[HARP_BUSES][CHAIN_MAX_TAPS]; /**< The last sample of each tap, where it is
                                               differentiated */
  Onset onsets[HARP_BUSES][CHAIN_MAX_TAPS]; /**< What hides that strings were pulled aside */
  Pole onset;                               /**< How that goes */
  PickupType onset_type;                    /**< What was read when there was something to hide */
  float mix[HARP_BUSES][CHAIN_MAX_TAPS][HARP_MIX_FRAMES];
} Harp;

#endif

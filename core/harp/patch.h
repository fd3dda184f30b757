/** What the player sets: the whole contract between the panel and the sound. */
#ifndef HOOKE_CORE_HARP_PATCH_H
#define HOOKE_CORE_HARP_PATCH_H

#include "core/string/tuning.h"

#include <stdint.h>

/** What sets a string in motion. */
typedef enum {
  EXCITER_PLUCK,  /**< A finger or a pick */
  EXCITER_STRIKE, /**< A hammer with a felt */
  EXCITER_BOW     /**< A bow, as long as the key is down */
} Exciter;

/** What pickups hear of a string; about as loud in all. */
typedef enum {
  PICKUP_DISPLACEMENT, /**< How far it is from rest */
  PICKUP_VELOCITY, /**< How fast it moves, as a magnet with a coil does: brighter by 6 dB an octave
                    */
  PICKUP_FORCE     /**< How it pulls at the bridge, as a piezo does; wherever the pickup is */
} PickupType;

/** Every value must be in its range and a number: who fills a patch in clamps it. */
typedef struct {
  double level;         /**< Gain, ≥ 0 */
  double damping_per_s; /**< 1/τ of the fundamental at A4 [1/s], > 0 */
  double tracking;      /**< Damping of a key is damping · 2^(tracking (note − 69)/12) */
  double loss; /**< Share of the fundamental's damping that sits between the masses, 0 to 1 */
  double inharmonicity;   /**< B, ≥ 0; 0: perfectly flexible */
  Partials partials;      /**< How true strings are to the ideal one */
  PickupType pickup_type; /**< What pickups hear */
  double pickup;          /**< Where strings are read, fraction of the length, 0 to 1 */
  double spread; /**< Between the left and the right pickup, fraction of the length, 0 to 0.5; past
                    an end, folded back */
  Exciter exciter;  /**< What strings are played with */
  double pluck;     /**< Where strings are plucked, struck or bowed, fraction of the length, 0 to 1;
                       hammers keep off the middle, and bows near the walls */
  double hardness;  /**< Of what plucks or strikes, or pressure of the bow, 0 to 1 */
  double release_s; /**< τ once the key is up [s], > 0; a damper never makes a string ring longer */
  double tuning_hz;    /**< A4 [Hz], > 0 */
  double resonance;    /**< How much the bridge that all strings share moves, 0 to 1 */
  double vibrato_hz;   /**< How fast a vibrato is [Hz], > 0 */
  uint32_t max_masses; /**< Most masses of a string, ≥ 1 */
} Patch;

#endif

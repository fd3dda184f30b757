/** What the player of a harp sets: the whole contract between the panel and the sound. */
#ifndef HOOKE_CORE_HARP_HARP_PATCH_H
#define HOOKE_CORE_HARP_HARP_PATCH_H

#include "core/bank/bodies.h"
#include "core/excite/exciter.h"
#include "core/excite/variation.h"
#include "core/voice/pickups.h"
#include "core/voice/string_patch.h"

/** Every value must be in its range and a number: who fills a patch in clamps it. */
typedef struct {
  StringPatch string;     /**< Of every string */
  double level;           /**< Gain, ≥ 0 */
  PickupType pickup_type; /**< What pickups hear */
  double pickup;          /**< Where strings are read, fraction of the length, 0 to 1 */
  double spread;          /**< How unlike left and right are, 0 to 0.5: core/harp/harp_stereo.h */
  Exciter exciter;        /**< What strings are played with */
  double pluck;     /**< Where strings are plucked, struck or bowed, fraction of the length, 0 to 1;
                       hammers keep off the middle, and bows near the walls */
  double hardness;  /**< Of what plucks or strikes, or pressure of the bow, 0 to 1 */
  double resonance; /**< How much the bridge that all strings share moves, 0 to 1 */
  double vibrato_hz;    /**< How fast a vibrato is [Hz], > 0 */
  double noise;         /**< How loud what plucks or strikes is itself, 0 to 1; bows are not */
  Variation variation;  /**< How notes differ, bowed ones in place, pressure and level */
  uint32_t unisons;     /**< Strings of a key, 1 to 3 */
  double unison_detune; /**< Between the outermost of them [cents], ≥ 0 */
  double second;        /**< Amplitude of a string's second direction over the first's, 0 to 1 */
  double second_detune; /**< From the first direction to the second [cents], ≥ 0 */
  double second_decay;  /**< τ of the second direction over the first's, > 0 */
  BodyPatch body;       /**< What radiates, and what the bridge is on */
  const Body* radiates; /**< What that chooses, seen to by the harp itself; NULL: none */
} HarpPatch;

#endif

/** What the player of a harp sets: the whole contract between the panel and the sound. */
#ifndef HOOKE_CORE_HARP_HARP_PATCH_H
#define HOOKE_CORE_HARP_HARP_PATCH_H

#include "core/excite/exciter.h"
#include "core/voice/pickups.h"
#include "core/voice/string_patch.h"

/** Every value must be in its range and a number: who fills a patch in clamps it. */
typedef struct {
  StringPatch string;     /**< Of every string */
  double level;           /**< Gain, ≥ 0 */
  PickupType pickup_type; /**< What pickups hear */
  double pickup;          /**< Where strings are read, fraction of the length, 0 to 1 */
  double spread; /**< Between the left and the right pickup, fraction of the length, 0 to 0.5; past
                    an end, folded back */
  Exciter exciter;  /**< What strings are played with */
  double pluck;     /**< Where strings are plucked, struck or bowed, fraction of the length, 0 to 1;
                       hammers keep off the middle, and bows near the walls */
  double hardness;  /**< Of what plucks or strikes, or pressure of the bow, 0 to 1 */
  double resonance; /**< How much the bridge that all strings share moves, 0 to 1 */
  double vibrato_hz;    /**< How fast a vibrato is [Hz], > 0 */
  uint32_t unisons;     /**< Strings of a key, 1 to 3 */
  double unison_detune; /**< Between the outermost of them [cents], ≥ 0 */
  double second;        /**< Amplitude of a string's second direction over the first's, 0 to 1 */
  double second_detune; /**< From the first direction to the second [cents], ≥ 0 */
  double second_decay;  /**< τ of the second direction over the first's, > 0 */
} HarpPatch;

/** Where the patch hears strings on the left and on the right: alike where it has no spread.  A
 * place beyond an end folds back, so that a wide pair near a wall has no silent side. */
void harp_patch_pickups(const HarpPatch* patch, Pickup places[PICKUPS]);

#endif

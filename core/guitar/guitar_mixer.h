/**
   The way from the strings of the guitar to its two outputs: gains of the pickups, the place of
   each string between left and right, the level, and the body beside them, all of them without
   steps.

   The body is pulled by what the strings pull at the bridge (a pulled string by sin(kπp)/k in its
   partial k), and by what fingers and picks are heard of themselves; it has no sides, and the level
   comes before it.  Without one nothing is read at the bridge.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_GUITAR_GUITAR_MIXER_H
#define HOOKE_CORE_GUITAR_GUITAR_MIXER_H

#include "core/base/line.h"
#include "core/excite/noise.h"
#include "core/guitar/guitar_patch.h"
#include "core/guitar/guitar_string.h"
#include "core/voice/radiator.h"

#include <stdint.h>

enum { GUITAR_VOICES = 2 * GUITAR_STRINGS /**< The strings, and then those beside them */ };

/** Where a string goes. */
enum { GUITAR_TO_LEFT, GUITAR_TO_RIGHT, GUITAR_TO_BODY, GUITAR_WAYS };

/** Zero is silent. */
typedef struct {
  Radiator radiator;
  BodyPatch body;
  uint32_t n_fade; /**< Frames in which the body fades to another */
  double rate_hz;
  double gain[GUITAR_STRINGS]; /**< Of each string, beside the level */
  Line level;
  Line gains[GUITAR_PICKUPS];
  Line ways[GUITAR_VOICES][GUITAR_WAYS]; /**< Gains of each string to where it goes */
  NoiseMake noise_make;
  Noise noises[GUITAR_STRINGS]; /**< What plucks each string makes itself */
  GuitarGains now;              /**< Of the frames that are run */
  float own[GUITAR_MIX_FRAMES];
  float pull[GUITAR_MIX_FRAMES];
  float sums[GUITAR_WAYS][GUITAR_MIX_FRAMES];
} GuitarMixer;

/** Silent, with every string's gain 1.  @param rate_hz  Frames per second [Hz], > 0 */
void guitar_mixer_init(GuitarMixer* mixer, double rate_hz);

/** Silence all noises and the body at once. */
void guitar_mixer_rest(GuitarMixer* mixer);

/** Let what plucks a string be heard where that string is, see noise_scrape(). */
void guitar_mixer_scrape(
    GuitarMixer* mixer, uint32_t string, uint64_t seed, double hardness, double amplitude);

/** Choke that. */
void guitar_mixer_choke(GuitarMixer* mixer, uint32_t string);

/** Let BODIES_FILE be a body from now on, to which what is heard fades in `n_frames`; NULL: none.
 */
void guitar_mixer_take_body(GuitarMixer* mixer, const Body* body, uint32_t n_frames);

/** Let what plucks a string knock at the body, as hard as the patch says; see radiator_play(). */
void guitar_mixer_knock(GuitarMixer* mixer, uint32_t string, double hardness, double amplitude);

/** Go to what the patch says in `n_frames`. */
void guitar_mixer_set(GuitarMixer* mixer, const GuitarPatch* patch, uint32_t n_frames);

/** Bring one string, and the one beside it, to a gain in `n_frames`. */
void guitar_mixer_set_gain(
    GuitarMixer* mixer, const GuitarPatch* patch, uint32_t string, double gain, uint32_t n_frames);

/** Run all GUITAR_VOICES strings, and what is left of each, for `n_frames`, and write what is heard
 * to `left` and `right`. */
void guitar_mixer_run(GuitarMixer* mixer,
                      GuitarString* strings,
                      GuitarString* tails,
                      uint32_t n_frames,
                      float* left,
                      float* right);

#endif

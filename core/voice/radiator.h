/**
   What is heard of a body: the strings pull at its bridge, and it sounds beside them.

   It hears what strings do and does nothing to them.  Another body, or another shape of the same,
   does not come at once: the old one fades into the new.  What pushes the wood itself, a knock, is
   added to what the strings pull.  A body that has died away is at rest in exact zeros and costs
   nothing.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_VOICE_RADIATOR_H
#define HOOKE_CORE_VOICE_RADIATOR_H

#include "core/bank/bodies.h"
#include "core/base/line.h"

#include <stdbool.h>
#include <stdint.h>

enum {
  RADIATOR_FRAMES = 256, /**< Most at a time */
  RADIATOR_KNOCKS = 8,   /**< That act at the same time */
};

/** What is heard. */
typedef struct {
  const Body* body; /**< NULL: none */
  uint32_t version; /**< Of the file that it is from */
  BodyShape shape;
} RadiatorBody;

/** Whether both sound alike. */
bool radiator_body_is_same(const RadiatorBody* a, const RadiatorBody* b);

/** A push on the wood, a raised cosine of time. */
typedef struct {
  double force; /**< At its height, in the strings' units */
  double turn;  /**< Of its phase in a frame [rad] */
  double phase; /**< 0 to 2π; what is at 2π is over */
} Knock;

/** Zero is no body. */
typedef struct {
  Bank banks[2];    /**< What is heard, and what is left behind */
  bool is_awake[2]; /**< Whether it moves */
  bool was_pulled;  /**< By anything, since the last place of the grid */
  uint32_t n_until_grid;
  RadiatorBody now; /**< What is heard, or will be once the fade is over */
  bool is_choked;   /**< See radiator_choke() */
  Body file;        /**< For BODIES_FILE; no modes: none */
  uint32_t version; /**< How many of those there were */
  Line fade;        /**< From what is left behind to what is heard: 0 to 1 */
  Line strings;     /**< Gain of what comes in beside it */
  Line gain;        /**< Of the body */
  Knock knocks[RADIATOR_KNOCKS];
} Radiator;

/** No body, at rest. */
void radiator_init(Radiator* radiator);

/** Bring what is heard to rest. */
void radiator_rest(Radiator* radiator);

/** What BODIES_FILE is from now on, which is heard after the next radiator_set(); NULL: nothing. */
void radiator_take_file(Radiator* radiator, const Body* body);

/** What a patch chooses; NULL: no body.  It stays where it is until the next file. */
const Body* radiator_body(const Radiator* radiator, BodiesChoice choice);

/** What a patch makes of it. */
RadiatorBody radiator_wanted(const Radiator* radiator, const BodyPatch* patch);

/** Go to what is wanted in `n_frames`, 0: at once; while it fades to another body that one comes
 * first, to be asked for again. */
void radiator_set(Radiator* radiator, const BodyPatch* patch, double rate_hz, uint32_t n_frames);

/** Let a hand lie on the wood, so that it is silent as soon as what it hears, until strings are
 * played again; after the next radiator_set(). */
void radiator_choke(Radiator* radiator);

/** Frames until a fade ends; UINT32_MAX if there is none. */
uint32_t radiator_stretch(const Radiator* radiator);

/** Whether it is to be told what pulls. */
bool radiator_is_on(const Radiator* radiator);

/** Push the wood by `force` for `n_frames` ≥ 1 from the next frame on. */
void radiator_knock(Radiator* radiator, double force, uint32_t n_frames);

/** The same as what plays the strings does: a hard thing for a shorter time.
 * @param hardness   Of what plays, 0 to 1
 * @param amplitude  How hard it knocks, in a pluck's measure, ≥ 0; 0: not at all */
void radiator_play(Radiator* radiator, double rate_hz, double hardness, double amplitude);

/**
   Hear the body beside the strings.

   @param pull      What the strings pull by, n_frames ≤ RADIATOR_FRAMES
   @param n_frames  ≤ RADIATOR_FRAMES
   @param left      The strings; what is heard of both
   @param right     The same
*/
void radiator_run(
    Radiator* radiator, const float* pull, uint32_t n_frames, float* left, float* right);

#endif

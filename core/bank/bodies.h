/**
   The bodies that Hooke brings along: made from presets/bodies/ while it is built.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_BANK_BODIES_H
#define HOOKE_CORE_BANK_BODIES_H

#include "core/bank/body.h"

/** X(NAME, file, text): in the order of the plugins' ports, from 1 on. */
#define BODIES_LIST(X)                                                                             \
  X(GUITAR, "guitar", "Guitar")                                                                    \
  X(CLASSICAL_GUITAR, "classical-guitar", "Classical Guitar")                                      \
  X(VIOLIN, "violin", "Violin")                                                                    \
  X(CELLO, "cello", "Cello")                                                                       \
  X(UPRIGHT_BASS, "upright-bass", "Upright Bass")                                                  \
  X(HARP, "harp", "Harp")                                                                          \
  X(GRAND, "grand", "Grand Piano")                                                                 \
  X(UPRIGHT, "upright", "Upright Piano")                                                           \
  X(BANJO, "banjo", "Banjo")                                                                       \
  X(DULCIMER, "dulcimer", "Dulcimer")                                                              \
  X(KALIMBA, "kalimba", "Kalimba Board")

#define BODIES_ENUM(name, file, text) BODIES_##name,
/** What the ports `body` count. */
typedef enum { BODIES_NONE, BODIES_LIST(BODIES_ENUM) BODIES_FILE, BODIES_COUNT } BodiesChoice;
#undef BODIES_ENUM

_Static_assert(BODIES_FILE == 12, "sessions store it");

/** What the player of an instrument sets of its body. */
typedef struct {
  BodiesChoice choice;
  double mix;      /**< Power of the body in what is heard, beside the strings', 0 to 1 */
  BodyShape shape; /**< Its size and its damping */
  double knock;    /**< How hard what plays the strings pushes the body itself, 0 to 1 */
} BodyPatch;

/** A shipped body; NULL for BODIES_NONE and BODIES_FILE.  It lasts as long as the program. */
const Body* bodies_shipped(BodiesChoice choice);

#endif

/**
   How one note differs from the next: no hand does the same thing twice.

   What is different follows from the take, the key and how many notes there were before, and from
   nothing else; so what is played again from rest is the same again, and another take is another
   player's evening.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_EXCITE_VARIATION_H
#define HOOKE_CORE_EXCITE_VARIATION_H

#include "core/excite/pluck.h"

#include <stdint.h>

/** Most that a note differs by, to either side: of its distance from the nearer wall, in hardness,
 * and in level [dB]. */
#define VARIATION_PLACE 0.1
#define VARIATION_HARDNESS 0.08
#define VARIATION_LEVEL_DB 1.0

/** How notes differ; zero: they do not. */
typedef struct {
  double amount; /**< 0 to 1: of the most */
  uint32_t take; /**< Which of the ways to differ */
} Variation;

/**
   A note as it is played this time; place, hardness and amplitude are each evenly spread about what
   is asked, and the hand is as soft as it is.

   @param n_before  Notes before it, since all was still
   @param asked     Place and hardness 0 to 1; what plays it may be a hammer or a bow
   @return The same, bit by bit, if the amount is 0; the place and the hardness are 0 to 1
*/
Pluck variation_of(Variation variation, uint32_t key, uint32_t n_before, Pluck asked);

#endif

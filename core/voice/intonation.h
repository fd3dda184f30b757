/**
   Intonation: the finger that follows the ear.

   Friction has a word in the pitch of a bowed string: it is a little flat where the bow is pressed,
   and where a period has few frames slips fall into step with them.  So while it is bowed it is
   listened to.  The speed v of the string under the hair, brought down by the wanted pitch F and
   summed over whole periods,

       z = Σ v(n) exp(−2πi F n/rate),

   turns from one sum to the next by 2π (f − F) times the time between them; how its halves are
   turned against each other tells by how many whole turns.  The string is tuned
   against a share of that, in a straight line until the next sum, so what is left of the error
   falls to nothing in some sums.  It moves by at most INTONATION_MOST_CENTS.

   Where the pitch that is wanted moves, so does the F that is listened for; and while others move
   the string, for a bend or a vibrato, what is heard counts for the next that they do.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_VOICE_INTONATION_H
#define HOOKE_CORE_VOICE_INTONATION_H

#include "core/base/line.h"
#include "core/string/chain.h"
#include "core/string/tuning.h"

#include <stdbool.h>
#include <stdint.h>

/** The most that a string is moved, either way [cents]. */
#define INTONATION_MOST_CENTS 60.0

/** An ear and its finger; zero is none. */
typedef struct {
  TuningTarget target; /**< What is to be heard */
  double cents;        /**< How far above it the string is tuned */
  Line turn[2];        /**< exp(−2πi F/rate); it moves while others move the string */
  double now[2];       /**< exp(−2πi F n/rate) */
  double sum[2];       /**< z, so far */
  double half[2];      /**< z, of its first half */
  double before[2];    /**< z, of the last sum; 0: none */
  double due;          /**< Frame at which a sum ends; what is over counts for the next */
  double half_due;     /**< Frame at which half of it does; HUGE_VAL: none */
  uint32_t n_heard;    /**< Frames in the sum so far */
  bool is_active;
} Intonation;

/** Begin to listen to a string that is tuned to `target`. */
void intonation_start(Intonation* ear, const TuningTarget* target);

/**
   Another pitch, decay or stiffness is wanted, to which the string is brought in `n_glide` frames.

   @return `target`, moved by what the string is moved
*/
TuningTarget intonation_retune(Intonation* ear, const TuningTarget* target, uint32_t n_glide);

/** Hear the next frame's speed, and move the string when it is time and nobody else does.
 * @return Whether the chain has set out for other coefficients */
bool intonation_hear(Intonation* ear, Chain* chain, double speed);

/** Listen no more, and bring the string back to its own pitch in `n_glide` frames. */
void intonation_leave(Intonation* ear, Chain* chain, uint32_t n_glide);

#endif

/**
   Tension: a string that moves far is stretched by it, so it is sharp, and settles as it dies away.

   One of length L, tension T, section A and modulus E that moves with an amplitude a is sharp by

       Δf/f = 3 E A π² a² / (32 T L²),

   a being that of a fundamental with all of its energy (core/voice/ledger.h), for what stretches it
   is the mean of its slope's square.  Here E A/T is told by the cents at TENSION_AMPLITUDE; they
   grow with a² and are TENSION_MOST_CENTS at most.

   Its clock is bent by that (core/string/chain.h), which leaves the amplitude as it is: no energy
   comes of it, and what follows the amplitude cannot drive it.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_VOICE_TENSION_H
#define HOOKE_CORE_VOICE_TENSION_H

#include "core/string/chain.h"

#include <stdbool.h>
#include <stdint.h>

/** What the hardest pluck of a guitar's low E has, as the guitar comes. */
#define TENSION_AMPLITUDE 0.232

/** The most that it makes a string sharp by: a fret or two, beyond which none would hold, and a
 * part of what a bend may do in any case. */
#define TENSION_MOST_CENTS 200.0

/** Zero is a string that does not stretch. */
typedef struct {
  double cents;    /**< That it is sharp by at TENSION_AMPLITUDE, ≥ 0; 0: it does not stretch */
  double rise;     /**< How far above its pitch it is, or is gliding to be [cents] */
  uint32_t n_left; /**< Frames until the next piece of its way, while it is moving */
  bool is_free;    /**< It was plucked or struck, and no bow since: who bows listens */
  bool is_moving;  /**< Whether there is a next piece */
} Tension;

/** Look how the chain moves, and say how far above its pitch it is to be; one that `is_fed` goes on
 * moving, however little that is. */
void tension_see(Tension* tension, const Chain* chain, bool is_fed);

/** A frequency raised by that. */
double tension_raised_hz(const Tension* tension, double f0_hz);

#endif

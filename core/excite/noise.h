/**
   What is heard of a finger, a pick or a hammer itself, beside the string that it plays.

   All of it comes from a few strongly damped masses on springs.  A finger or a pick scrapes: it
   pushes some of them by chance, and less and less, a soft one dull ones for longer, a hard one
   bright ones for a moment.  A hammer knocks: it kicks two of them, and its felt scrapes a little.

   It is linear: what several notes make adds.  It depends on the frames since it began and on a
   seed, and not on how they are cut into calls.  Once all is below NOISE_FLOOR it is set to exact
   zeros, and costs nothing.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_EXCITE_NOISE_H
#define HOOKE_CORE_EXCITE_NOISE_H

#include "core/string/pole.h"

#include <stdbool.h>
#include <stdint.h>

/** What is no longer heard, in units of output. */
#define NOISE_FLOOR 1e-6

/** Peak of a scrape, in the mean, of the amplitude of what scrapes: 14 dB below a plucked note. */
#define NOISE_PEAK 0.2

enum {
  NOISE_SCRAPES = 3, /**< Masses that are scraped: dull, in the middle and bright */
  NOISE_KNOCKS = 2,  /**< And those that are kicked */
  NOISE_MASSES = NOISE_SCRAPES + NOISE_KNOCKS
};

/** The masses, as they are at a rate. */
typedef struct {
  Pole poles[NOISE_MASSES];
  double push[NOISE_MASSES];  /**< What a push of 1 is to be, for an output of 1 */
  double kept[NOISE_SCRAPES]; /**< Of a scrape, from frame to frame */
  double choked;              /**< The same of all that is choked */
} NoiseMake;

/** What is heard now; zero is silence. */
typedef struct {
  double scrape[NOISE_SCRAPES]; /**< How hard each is scraped, in units of output */
  double x[NOISE_MASSES];
  double u[NOISE_MASSES]; /**< Velocities, per frame */
  uint64_t seed;
  uint64_t n; /**< Frames since it began */
  bool is_active;
  bool is_choked;
} Noise;

/** The masses at a rate [Hz], > 0; those that would be too high for it are lower. */
NoiseMake noise_make(double rate_hz);

/**
   Scrape, as a pluck does.

   @param seed       Of its chance, if nothing is heard; else that goes on
   @param hardness   0: dull, some 15 ms long, to 1: bright, some 4 ms
   @param amplitude  Of the pluck, see Pluck; the scrape's peak is about NOISE_PEAK of it
*/
void noise_scrape(Noise* noise, uint64_t seed, double hardness, double amplitude);

/** Knock, as a strike does; the same of its hammer. */
void noise_knock(
    Noise* noise, const NoiseMake* make, uint64_t seed, double hardness, double amplitude);

/** Let it be gone in some thousandths of a second. */
void noise_choke(Noise* noise);

/** Run `n_frames` and add them to each of `n_outs` buffers.  What is not a number is silence. */
void noise_add(
    Noise* noise, const NoiseMake* make, uint32_t n_frames, uint32_t n_outs, float* const* outs);

#endif

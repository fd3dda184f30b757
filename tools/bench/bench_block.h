/**
   `hooke bench blocks`: the dearest block after a gesture, against those when nothing happens, and
   whether blocks grow dearer while the harp is played.

   The harp runs blocks of 64 frames at 48 kHz.  Machines are noisy, so the same music is played
   several times, and of each block the least time counts.
*/
#ifndef HOOKE_TOOLS_BENCH_BENCH_BLOCK_H
#define HOOKE_TOOLS_BENCH_BENCH_BLOCK_H

#include "tools/bench/bench_choice.h"

/** What is done in one block. */
typedef enum {
  BENCH_TEN_KEYS, /**< Ten keys go down at once, from silence */
  BENCH_PEDAL,    /**< The pedal lets the dampers fall on 88 strings */
  BENCH_BEND,     /**< 88 strings are bent by a semitone */
  BENCH_WHEEL,    /**< 88 strings are bent further in each of 16 blocks */
  BENCH_JUMP,     /**< Damping, stiffness, loss and pickup of 88 strings jump */
  BENCH_N_GESTURES
} BenchGesture;

/** What that cost. */
typedef struct {
  double steady_s;      /**< Mean of the same strings' blocks when nothing happens */
  double worst_s;       /**< The dearest block from the gesture on */
  uint32_t worst_block; /**< Which it was, the gesture's being 0 */
} BenchBlocks;

/**
   Measure a gesture.

   @param max_masses   Most masses of a string
   @param n_times      How often it is played
   @param[out] blocks  Untouched on failure
   @return false when memory is out
*/
bool bench_block_gesture(BenchGesture gesture,
                         uint32_t max_masses,
                         uint32_t n_times,
                         BenchBlocks* blocks);

/**
   Pluck 88 strings once a second.

   @param n_seconds     For which a harp is played before it is compared with one that begins
   @param[out] first_s  Mean of a block in the first second; untouched on failure
   @param[out] last_s   The same after that time
   @return false when memory is out
*/
bool bench_block_growth(uint32_t n_seconds, double* first_s, double* last_s);

/** Measure all and print. @return false when memory is out. */
bool bench_block(const BenchChoice* choice);

#endif

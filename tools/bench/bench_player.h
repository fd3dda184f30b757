/**
   A string made in one of the ways (tools/bench/bench_way.h) that is plucked and runs.

   Life: bench_player_new(), run and look, bench_player_free().  Thread: one at a time; running
   does not allocate.
*/
#ifndef HOOKE_TOOLS_BENCH_BENCH_PLAYER_H
#define HOOKE_TOOLS_BENCH_BENCH_PLAYER_H

#include "tools/bench/bench_way.h"

typedef struct BenchPlayer BenchPlayer;

/**
   A string of `n_masses`, plucked with a hard pick at 0.13 of its length.

   @return NULL: out of memory, or the way has no such string, or its numbers cannot hold it
*/
BenchPlayer* bench_player_new(BenchWay way, TuningTarget wanted, uint32_t n_masses);

/** NULL is fine. */
void bench_player_free(BenchPlayer* player);

/** Step it; `out` is overwritten with the displacement at a third of its length, or the sum of the
 * modes. */
void bench_player_run(BenchPlayer* player, uint32_t n_frames, float* out);

/** How far mode `k` is out and how fast it moves, in any units that stay the same. */
void bench_player_mode(const BenchPlayer* player, uint32_t k, double* x, double* u);

/**
   Play a tenth of a second of a chain in its numbers, and in doubles with the coefficients rounded
   as its numbers have them: what is different between the two is the noise of the numbers alone.

   @return How much quieter the difference is than the sound [dB], negative; −INFINITY if there is
   none; NAN if it cannot be had
*/
double bench_player_noise_db(BenchWay way, TuningTarget wanted, uint32_t n_masses);

#endif

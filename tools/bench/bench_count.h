/** `hooke bench --one`: one loop and nothing else, for who counts its instructions. */
#ifndef HOOKE_TOOLS_BENCH_BENCH_COUNT_H
#define HOOKE_TOOLS_BENCH_BENCH_COUNT_H

#include <stdbool.h>

/** Called before each, and does nothing: a place for a profiler to look for. */
void bench_count_mark(void);

/**
   Run what `what` says: "SCENE,NUMBERS,MASSES,FRAMES" with a scene as bench_scene_name() has it, or
   "awake,KEYS,FRAMES" or "asleep,KEYS,FRAMES" for a harp of which so many strings ring, or have
   rung.

   @return false if it says nothing, or a string cannot be in this scene in these numbers
*/
bool bench_count(const char* what);

#endif

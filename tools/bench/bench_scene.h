/**
   What a string is in, for `hooke bench`: every scene for which there is a loop, a string to step
   in it, and what a step needs.

   Thread: one at a time.
*/
#ifndef HOOKE_TOOLS_BENCH_BENCH_SCENE_H
#define HOOKE_TOOLS_BENCH_BENCH_SCENE_H

#include "core/string/chain.h"

#include <stdbool.h>
#include <stdint.h>

enum {
  BENCH_N_SCENES = 24,    /**< Those of a moving string have all dampers */
  BENCH_NAME_SIZE = 48,   /**< Of a scene's name, with its end */
  BENCH_RUN_FRAMES = 256, /**< Frames that are run in one go, as by the harp */
};

/** A scene. */
typedef struct {
  ChainDamping damping;
  ChainElasticity elasticity;
  bool is_moving;
  uint32_t n_taps; /**< 1 or 2 */
} BenchScene;

/** The `i`-th scene, i < BENCH_N_SCENES. */
BenchScene bench_scene_at(uint32_t i);

/** Write "ground-bending-still-2" or the like. */
void bench_scene_name(BenchScene scene, char name[BENCH_NAME_SIZE]);

/**
   Whether all of the words in `filter`, with - between them, are in the scene's name: "bending"
   and "moving-2" are filters.
*/
bool bench_scene_matches(BenchScene scene, const char* filter);

/** "float", "double" or "fixed". */
const char* bench_numbers_name(ChainNumbers numbers);

/** The numbers of that name; N_CHAIN_NUMBERS if there are none. */
ChainNumbers bench_numbers_named(const char* name);

/** Bytes in a vector of a kernel's. */
size_t bench_vector_bytes(const ChainKernel* kernel, ChainNumbers numbers);

/** Vector operations that a mass-step needs, see bench_scene.c; a kernel's vector holds several
 * masses, so it is a fraction. */
double bench_scene_need(const ChainKernel* kernel, ChainNumbers numbers, BenchScene scene);

/** The scene that a string is in. */
BenchScene bench_scene_of(const Chain* chain, uint32_t n_taps);

/** A string in a scene. */
typedef struct {
  const ChainKernel* kernel;
  ChainNumbers numbers;
  BenchScene scene;
  Chain chain;
  void* memory; /**< Owned */
} BenchString;

/** Make a string; NULL memory, and false, if there is none left. */
bool bench_string_init(BenchString* string,
                       const ChainKernel* kernel,
                       ChainNumbers numbers,
                       BenchScene scene,
                       uint32_t n_masses);

/** Free its memory. */
void bench_string_free(BenchString* string);

/**
   Bring the string into its scene, with a motion that stays for some millions of frames.

   @param n_frames  Frames for which it will stay there
   @return false if a string cannot be in this scene in these numbers
*/
bool bench_string_start(BenchString* string, uint32_t n_frames);

/** Step the string. */
void bench_string_run(BenchString* string, uint32_t n_frames);

#endif

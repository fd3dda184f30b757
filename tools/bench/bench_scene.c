#include "tools/bench/bench_scene.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

static const char* const dampings[N_CHAIN_DAMPINGS] = {
    [CHAIN_UNDAMPED] = "undamped", [CHAIN_GROUND] = "ground", [CHAIN_BETWEEN] = "between"};
static const char* const elasticities[N_CHAIN_ELASTICITIES] = {
    [CHAIN_FLEXIBLE] = "flexible",
    [CHAIN_BENDING] = "bending",
    [CHAIN_STRAIGHTENED] = "straightened",
};
static const char* const motions[2] = {"still", "moving"};
static const char* const all_numbers[N_CHAIN_NUMBERS] = {
    [CHAIN_FLOAT] = "float", [CHAIN_DOUBLE] = "double", [CHAIN_FIXED] = "fixed"};

/*
  What a mass-step needs, counted by hand from the step in core/string/chain.h, each difference
  being taken once and shared.  In fixed point each term of a link is turned into a float and the
  link back again, the first product has the dither added, and the air needs nothing, for it is in
  the gain.
*/
typedef struct {
  int additions;   /* And subtractions */
  int products;    /* Each added to what is there, but for the first one's in floats and doubles */
  int conversions; /* In fixed point */
} Need;

/* Δx, link − link before, u + pull, x + u;  k1 Δx;  Δx and the link. */
static const Need need_of_all = {4, 1, 2};
/* z0 u */
static const Need need_of_ground = {0, 1, 0};
/* Δu;  z1 Δu */
static const Need need_of_between = {1, 1, 1};
/* L x = Δx − Δx before, Δ(L x);  k2 Δ(L x) */
static const Need need_of_bending = {2, 1, 1};
/* L² x, Δ(L² x);  k3 Δ(L² x) */
static const Need need_of_straightened = {2, 1, 1};

static void add_need(Need* sum, Need need) {
  sum->additions += need.additions;
  sum->products += need.products;
  sum->conversions += need.conversions;
}

/* Where multiply-adds are to be had, with the wider vectors, one is one operation. */
static int count_of(Need need, bool is_fixed, bool has_multiply_add) {
  const int n_added = is_fixed ? need.products : need.products - 1;
  return need.additions + need.products + (is_fixed ? need.conversions : 0) +
         (has_multiply_add ? 0 : n_added);
}

BenchScene bench_scene_at(uint32_t i) {
  enum { STILL = N_CHAIN_DAMPINGS * N_CHAIN_ELASTICITIES };
  const uint32_t k = i / 2;
  const bool is_moving = k >= STILL;
  return (BenchScene){
      .damping = is_moving ? CHAIN_BETWEEN : (ChainDamping)(k / N_CHAIN_ELASTICITIES),
      .elasticity = (ChainElasticity)(k % N_CHAIN_ELASTICITIES),
      .is_moving = is_moving,
      .n_taps = 1 + i % 2,
  };
}

void bench_scene_name(BenchScene scene, char name[BENCH_NAME_SIZE]) {
  (void)snprintf(name, BENCH_NAME_SIZE, "%s-%s-%s-%u", dampings[scene.damping],
                 elasticities[scene.elasticity], motions[scene.is_moving], scene.n_taps);
}

static bool has_word(const char* name, const char* word, size_t length) {
  for (const char* at = name; *at; at += strcspn(at, "-"), at += *at == '-') {
    if (strcspn(at, "-") == length && !strncmp(at, word, length)) {
      return true;
    }
  }
  return false;
}

bool bench_scene_matches(BenchScene scene, const char* filter) {
  char name[BENCH_NAME_SIZE];
  bench_scene_name(scene, name);
  bool has_all = true;
  for (const char* at = filter; has_all && *at; at += strcspn(at, "-"), at += *at == '-') {
    has_all = has_word(name, at, strcspn(at, "-"));
  }
  return has_all;
}

const char* bench_numbers_name(ChainNumbers numbers) {
  return all_numbers[numbers];
}

ChainNumbers bench_numbers_named(const char* name) {
  int i = 0;
  while (i < N_CHAIN_NUMBERS && strcmp(all_numbers[i], name) != 0) {
    ++i;
  }
  return (ChainNumbers)i;
}

size_t bench_vector_bytes(const ChainKernel* kernel, ChainNumbers numbers) {
  return kernel->loops[numbers]->n_lanes * kernel->loops[numbers]->number_size;
}

double bench_scene_need(const ChainKernel* kernel, ChainNumbers numbers, BenchScene scene) {
  const bool is_fixed = numbers == CHAIN_FIXED;
  Need need = need_of_all;
  if (scene.damping != CHAIN_UNDAMPED && !is_fixed) {
    add_need(&need, need_of_ground);
  }
  if (scene.damping == CHAIN_BETWEEN) {
    add_need(&need, need_of_between);
  }
  if (scene.elasticity >= CHAIN_BENDING) {
    add_need(&need, need_of_bending);
  }
  if (scene.elasticity >= CHAIN_STRAIGHTENED) {
    add_need(&need, need_of_straightened);
  }
  const bool has_multiply_add = bench_vector_bytes(kernel, numbers) >= 32;
  return (double)count_of(need, is_fixed, has_multiply_add) / kernel->loops[numbers]->n_lanes;
}

BenchScene bench_scene_of(const Chain* chain, uint32_t n_taps) {
  const StringCoefs c = chain->now;
  const bool is_moving = chain->n_gliding > 0;
  return (BenchScene){
      .damping = is_moving || c.z1 != 0.0 ? CHAIN_BETWEEN
                 : c.z0 != 0.0            ? CHAIN_GROUND
                                          : CHAIN_UNDAMPED,
      .elasticity = c.k3 != 0.0   ? CHAIN_STRAIGHTENED
                    : c.k2 != 0.0 ? CHAIN_BENDING
                                  : CHAIN_FLEXIBLE,
      .is_moving = is_moving,
      .n_taps = n_taps,
  };
}

bool bench_string_init(BenchString* string,
                       const ChainKernel* kernel,
                       ChainNumbers numbers,
                       BenchScene scene,
                       uint32_t n_masses) {
  *string = (BenchString){.kernel = kernel, .numbers = numbers, .scene = scene};
  string->memory = aligned_alloc(CHAIN_ALIGNMENT, chain_size(n_masses));
  string->chain.n_masses = n_masses;
  return string->memory != NULL;
}

void bench_string_free(BenchString* string) {
  free(string->memory);
  string->memory = NULL;
}

static StringCoefs coefs_of(BenchScene scene) {
  return (StringCoefs){
      .k1 = 0.3,
      .k2 = scene.elasticity >= CHAIN_BENDING ? 0.05 : 0.0,
      .k3 = scene.elasticity >= CHAIN_STRAIGHTENED ? 0.01 : 0.0,
      .z0 = scene.damping != CHAIN_UNDAMPED ? 1e-6 : 0.0,
      .z1 = scene.damping == CHAIN_BETWEEN ? 1e-6 : 0.0,
  };
}

bool bench_string_start(BenchString* string, uint32_t n_frames) {
  Chain* const chain = &string->chain;
  const uint32_t n_masses = chain->n_masses;
  StringCoefs coefs = coefs_of(string->scene);
  chain_init(chain, string->kernel, string->memory, n_masses);
  chain_set(chain, coefs);
  for (uint32_t i = 0; i < n_masses; ++i) {
    const double place = (i + 1.0) / (n_masses + 1.0);
    chain_place(chain, i, (float)(0.1 * sin(PI * place) + 0.03 * sin(2.0 * PI * place)), 0.0f);
  }
  if (!chain_hold(chain, string->numbers)) {
    return false;
  }
  if (string->scene.is_moving) {
    coefs.k1 *= 0.9;
    chain_glide(chain, coefs, n_frames);
  }
  return chain->numbers == string->numbers &&
         chain->loops->loops[string->scene.damping][string->scene.elasticity]
                            [string->scene.is_moving][string->scene.n_taps];
}

void bench_string_run(BenchString* string, uint32_t n_frames) {
  const uint32_t n_masses = string->chain.n_masses;
  const ChainTap tap = {{n_masses / 3, n_masses / 3 + (n_masses > 3)}, {0.3f, 0.7f}, false};
  const ChainTap taps[2] = {tap, tap};
  float mix[2][BENCH_RUN_FRAMES] = {{0}};
  float* const out[2] = {mix[0], mix[1]};
  for (uint32_t done = 0; done < n_frames;) {
    const uint32_t left = n_frames - done;
    const uint32_t n = left < BENCH_RUN_FRAMES ? left : BENCH_RUN_FRAMES;
    chain_run(&string->chain, n, taps, string->scene.n_taps, out);
    done += n;
  }
}

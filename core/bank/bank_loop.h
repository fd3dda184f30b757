/**
   The source of all loops of banks: not a header to be included for its names, but the loops
   themselves.

   Before it is included, these say for what:
   BANK_LOOP_LANES  numbers in a vector: 2, 4 or 8
   BANK_LOOP_NAME   the kernel that it makes
   BANK_LOOP_TEXT   what that is called

   Glossary:  x  position;  u  scaled velocity h v;  a  of a mode's pole;  c = 1 − g, what is left
   of u in a step;  in  what a force of 1 speeds it up by;  l, r  what is heard of it on either
   side; lane  of a group of BANK_LANES modes;  part  a vector of such a group.

   What is heard of a frame, Σ l (u − u before), is how much Σ l u has grown, so that one difference
   does for all modes.

   No bit hangs on what the vectors are: a lane is summed group by group and its lanes by halves,
   and this is compiled without contraction, for there are processors without multiply-adds.
*/
#include "core/bank/bank_kernel.h"
#include "core/base/maths.h"

#include <stdbool.h>

#define INLINE static inline __attribute__((always_inline))

/* Loops over what is to be in registers; where memory is watched clang takes minutes to do that. */
#if defined(__clang__) && defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer)
#define UNROLLED
#else
#define UNROLLED _Pragma("clang loop unroll(full)")
#endif
#else
#define UNROLLED _Pragma("GCC unroll 4")
#endif

enum {
  PARTS = BANK_LANES / BANK_LOOP_LANES,
  PAIRS = BANK_LANES / 2,
  GROUPS = 4,  /* That are stepped in turn, for each waits for itself; registers hold no more */
  FRAMES = 64, /* Whose sums stay in the nearest cache */
};

typedef double Vector __attribute__((vector_size(BANK_LOOP_LANES * sizeof(double)), __may_alias__));

/* Two lanes, or two sums. */
typedef double Pair __attribute__((vector_size(2 * sizeof(double)), __may_alias__));

/* Σ l u and Σ r u of a frame, lane by lane. */
typedef struct {
  _Alignas(BANK_ALIGNMENT) double of[2][BANK_LANES];
} Sums;

/* A part of some modes. */
typedef struct {
  Vector x, u, a, c, in, l, r;
} Modes;

INLINE Vector load(const double* numbers) {
  return *(const Vector*)(const void*)numbers;
}

INLINE void store(double* numbers, Vector v) {
  *(Vector*)(void*)numbers = v;
}

INLINE Modes modes_at(const BankWork* work, uint32_t k) {
  return (Modes){
      .x = load(work->x + k),
      .u = load(work->u + k),
      .a = load(work->a + k),
      .c = 1.0 - load(work->g + k),
      .in = load(work->in + k),
      .l = load(work->left + k),
      .r = load(work->right + k),
  };
}

INLINE void store_modes(const BankWork* work, uint32_t k, const Modes* modes) {
  store(work->x + k, modes->x);
  store(work->u + k, modes->u);
}

INLINE void step(Modes* m, double force) {
  m->u = (m->c * m->u + m->in * force) - m->a * m->x;
  m->x += m->u;
}

/* The lanes of `part` of what all modes are heard by, with those of the groups before. */
INLINE void hear(const Modes* modes, int n_groups, uint32_t part, bool is_first, Sums* sums) {
  double* const left = sums->of[0] + part * BANK_LOOP_LANES;
  double* const right = sums->of[1] + part * BANK_LOOP_LANES;
  Vector l = modes[0].l * modes[0].u;
  Vector r = modes[0].r * modes[0].u;
  if (!is_first) {
    l += load(left);
    r += load(right);
  }
  UNROLLED
  for (int i = 1; i < n_groups; ++i) {
    l += modes[i].l * modes[i].u;
    r += modes[i].r * modes[i].u;
  }
  store(left, l);
  store(right, r);
}

/* Step a part of some groups through all frames. */
INLINE void run_groups(const BankWork* work,
                       uint32_t first,
                       int n_groups,
                       uint32_t part,
                       bool is_first,
                       const double* force,
                       uint32_t n_frames,
                       Sums* sums) {
  Modes modes[GROUPS];
  const uint32_t k = first * BANK_LANES + part * BANK_LOOP_LANES;
  UNROLLED
  for (int i = 0; i < n_groups; ++i) {
    modes[i] = modes_at(work, k + (uint32_t)i * BANK_LANES);
  }
  hear(modes, n_groups, part, is_first, &sums[0]);
  for (uint32_t n = 0; n < n_frames; ++n) {
    UNROLLED
    for (int i = 0; i < n_groups; ++i) {
      step(&modes[i], force[n]);
    }
    hear(modes, n_groups, part, is_first, &sums[n + 1]);
  }
  UNROLLED
  for (int i = 0; i < n_groups; ++i) {
    store_modes(work, k + (uint32_t)i * BANK_LANES, &modes[i]);
  }
}

INLINE void run_some(const BankWork* work,
                     uint32_t first,
                     uint32_t part,
                     bool is_first,
                     const double* force,
                     uint32_t n_frames,
                     Sums* sums) {
  switch (work->n_groups - first) {
  case 1:
    run_groups(work, first, 1, part, is_first, force, n_frames, sums);
    break;
  case 2:
    run_groups(work, first, 2, part, is_first, force, n_frames, sums);
    break;
  case 3:
    run_groups(work, first, 3, part, is_first, force, n_frames, sums);
    break;
  default:
    run_groups(work, first, GROUPS, part, is_first, force, n_frames, sums);
  }
}

/* The lanes of two kinds by halves, the upper on the lower, three times. */
INLINE Pair sum_of(const Pair one[PAIRS], const Pair other[PAIRS]) {
  const Pair a = (one[0] + one[2]) + (one[1] + one[3]);
  const Pair b = (other[0] + other[2]) + (other[1] + other[3]);
  return __builtin_shufflevector(a, b, 0, 2) + __builtin_shufflevector(a, b, 1, 3);
}

INLINE const Pair* pairs(const double* lanes) {
  return (const Pair*)(const void*)lanes;
}

/* What is heard of all frames, from the growth of the sums. */
INLINE void add_heard(const Sums* sums, uint32_t n_frames, float* left, float* right) {
  double of[2][FRAMES + 1];
  for (uint32_t n = 0; n <= n_frames; ++n) {
    const Pair both = sum_of(pairs(sums[n].of[0]), pairs(sums[n].of[1]));
    of[0][n] = both[0];
    of[1][n] = both[1];
  }
  for (uint32_t n = 0; n < n_frames; ++n) {
    left[n] += (float)(of[0][n + 1] - of[0][n]);
  }
  for (uint32_t n = 0; n < n_frames; ++n) {
    right[n] += (float)(of[1][n + 1] - of[1][n]);
  }
}

static void
run_short(const BankWork* work, const float* force, uint32_t n_frames, float* left, float* right) {
  double wide[FRAMES];
  Sums sums[FRAMES + 1];
  for (uint32_t n = 0; n < n_frames; ++n) {
    wide[n] = (double)force[n];
  }
  for (uint32_t part = 0; part < PARTS; ++part) {
    run_some(work, 0, part, true, wide, n_frames, sums);
    for (uint32_t group = GROUPS; group < work->n_groups; group += GROUPS) {
      run_some(work, group, part, false, wide, n_frames, sums);
    }
  }
  add_heard(sums, n_frames, left, right);
}

static void
run(const BankWork* work, const float* force, uint32_t n_frames, float* left, float* right) {
  for (uint32_t n = 0; n < n_frames; n += FRAMES) {
    run_short(work, force + n, least(FRAMES, n_frames - n), left + n, right + n);
  }
}

/* Two lanes of a vector. */
#define PAIR(parts, i)                                                                             \
  __builtin_shufflevector((parts)[2 * (i) / BANK_LOOP_LANES], (parts)[2 * (i) / BANK_LOOP_LANES],  \
                          2 * (i) % BANK_LOOP_LANES, 2 * (i) % BANK_LOOP_LANES + 1)

/* Of the work a copy, which no number that is stored can change. */
static double push(const BankWork* all_work, double force) {
  const BankWork work = *all_work;
  Vector sums[PARTS] = {{0}};
  for (uint32_t group = 0; group < work.n_groups; ++group) {
    UNROLLED
    for (uint32_t part = 0; part < PARTS; ++part) {
      const uint32_t k = group * BANK_LANES + part * BANK_LOOP_LANES;
      Modes modes = modes_at(&work, k);
      step(&modes, force);
      store_modes(&work, k, &modes);
      sums[part] += modes.x;
    }
  }
  const Pair all[PAIRS] = {PAIR(sums, 0), PAIR(sums, 1), PAIR(sums, 2), PAIR(sums, 3)};
  return sum_of(all, all)[0];
}
#undef PAIR

const BankKernel BANK_LOOP_NAME = {BANK_LOOP_TEXT, run, push};
#undef INLINE
#undef UNROLLED

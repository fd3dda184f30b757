#include "tests/loudness.h"

#include <math.h>

/* A block, and how far the blocks are apart [frames]. */
enum { BLOCK = 19200, HOP = 4800 };

/* Coefficients of a filter of second order; a0 is 1. */
typedef struct {
  double b0, b1, b2, a1, a2;
} Biquad;

typedef struct {
  double x1, x2, y1, y2;
} Memory;

/* The head, and then what is not heard below: those of the recommendation, for 48 kHz. */
static const Biquad head = {1.53512485958697, -2.69169618940638, 1.19839281085285,
                            -1.69065929318241, 0.73248077421585};
static const Biquad low = {1.0, -2.0, 1.0, -1.99004745483398, 0.99007225036621};

static double filter(const Biquad* f, Memory* m, double x) {
  const double y = f->b0 * x + f->b1 * m->x1 + f->b2 * m->x2 - f->a1 * m->y1 - f->a2 * m->y2;
  *m = (Memory){x, m->x1, y, m->y1};
  return y;
}

typedef struct {
  Memory head[2];
  Memory low[2];
} Ears;

static double power(Ears* ears, double left, double right) {
  const double sides[2] = {left, right};
  double sum = 0.0;
  for (int i = 0; i < 2; ++i) {
    const double heard = filter(&low, &ears->low[i], filter(&head, &ears->head[i], sides[i]));
    sum += heard * heard;
  }
  return sum;
}

double loudness_lufs(const float* left, const float* right, size_t n) {
  double hops[BLOCK / HOP] = {0};
  Ears ears = {0};
  double loudest = 0.0;
  for (size_t i = 0; i < n; ++i) {
    const size_t hop = i / HOP;
    if (i % HOP == 0) {
      hops[hop % (BLOCK / HOP)] = 0.0;
    }
    hops[hop % (BLOCK / HOP)] += power(&ears, (double)left[i], (double)right[i]);
    if (i % HOP == HOP - 1 || i + 1 == n) {
      double sum = 0.0;
      for (int k = 0; k < BLOCK / HOP; ++k) {
        sum += hops[k];
      }
      loudest = fmax(loudest, sum / BLOCK);
    }
  }
  return -0.691 + 10.0 * log10(loudest);
}

#include "tests/support/loudness.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* A block is so many hops, which are so long [s]. */
enum { HOPS = 4 };
static const double HOP_S = 0.1;

/* Coefficients of a filter of second order; a0 is 1. */
typedef struct {
  double b0, b1, b2, a1, a2;
} Biquad;

typedef struct {
  double x1, x2, y1, y2;
} Memory;

/* The head, and then what is not heard below. */
typedef struct {
  Biquad head, low;
} Ear;

/* Those of the recommendation, which are for 48 kHz. */
static const Ear standard = {
    {1.53512485958697, -2.69169618940638, 1.19839281085285, -1.69065929318241, 0.73248077421585},
    {1.0, -2.0, 1.0, -1.99004745483398, 0.99007225036621},
};

/* What the recommendation leaves in the second filter's numerator, which lifts all a little. */
static double low_lift(double rate_hz) {
  const double l = tan(PI * 38.13547087602444 / rate_hz);
  return 1.0 + l / 0.5003270373238773 + l * l;
}

/* Those for any rate, from what they are before they are made for one; the lift is that of 48 kHz.
 */
static Ear ear_for(double rate_hz) {
  const double high = 1.584864701130855;
  const double band = 1.258720930232562;
  const double k = tan(PI * 1681.974450955533 / rate_hz);
  const double kq = k / 0.7071752369554196;
  const double a = 1.0 + kq + k * k;
  const double l = tan(PI * 38.13547087602444 / rate_hz);
  const double lq = l / 0.5003270373238773;
  const double b = low_lift(rate_hz);
  const double lift = low_lift(48000.0) / b;
  return (Ear){
      .head = {(high + band * kq + k * k) / a, 2.0 * (k * k - high) / a,
               (high - band * kq + k * k) / a, 2.0 * (k * k - 1.0) / a, (1.0 - kq + k * k) / a},
      .low = {lift, -2.0 * lift, lift, 2.0 * (l * l - 1.0) / b, (1.0 - lq + l * l) / b},
  };
}

static double filter(const Biquad* f, Memory* m, double x) {
  const double y = f->b0 * x + f->b1 * m->x1 + f->b2 * m->x2 - f->a1 * m->y1 - f->a2 * m->y2;
  *m = (Memory){x, m->x1, y, m->y1};
  return y;
}

typedef struct {
  Memory head[2];
  Memory low[2];
} Ears;

static double power(const Ear* ear, Ears* ears, double left, double right) {
  const double sides[2] = {left, right};
  double sum = 0.0;
  for (int i = 0; i < 2; ++i) {
    const double inside = filter(&ear->head, &ears->head[i], sides[i]);
    const double heard = filter(&ear->low, &ears->low[i], inside);
    sum += heard * heard;
  }
  return sum;
}

static double lufs(const Ear* ear, const float* left, const float* right, size_t n, size_t hop) {
  double hops[HOPS] = {0};
  Ears ears = {0};
  double loudest = 0.0;
  for (size_t i = 0; i < n; ++i) {
    const size_t at = i / hop % HOPS;
    hops[at] = i % hop == 0 ? 0.0 : hops[at];
    hops[at] += power(ear, &ears, (double)left[i], (double)right[i]);
    if (i % hop == hop - 1 || i + 1 == n) {
      double sum = 0.0;
      for (int k = 0; k < HOPS; ++k) {
        sum += hops[k];
      }
      loudest = fmax(loudest, sum / ((double)hop * HOPS));
    }
  }
  return -0.691 + 10.0 * log10(loudest);
}

double loudness_lufs(const float* left, const float* right, size_t n) {
  return lufs(&standard, left, right, n, (size_t)(48000.0 * HOP_S));
}

double loudness_lufs_at(double rate_hz, const float* left, const float* right, size_t n) {
  const Ear ear = ear_for(rate_hz);
  return lufs(&ear, left, right, n, (size_t)(rate_hz * HOP_S));
}

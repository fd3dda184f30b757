#include "tests/support/measure.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;
static const double complex J = (double complex)I;

/* Of the Kaiser window: side lobes below −115 dB, the first null at √(1 + (β/π)²) = 5.2 bins. */
static const double BETA = 16.0;

/* Periods, of what lies between partials, in the shortest window: those 0.7 of it away are 5.6 bins
 * off. */
static const double LEAST_PERIODS = 8.0;
static const double MOST_PERIODS = 64.0;

/* Decay beyond which rounding noise may speak [τ]. */
static const double MOST_DECAY = 9.0;

/* A weighted straight line y = a + b x. */
typedef struct {
  double w, wx, wy, wxx, wxy;
} Line;

static void line_add(Line* line, double weight, double x, double y) {
  line->w += weight;
  line->wx += weight * x;
  line->wy += weight * y;
  line->wxx += weight * x * x;
  line->wxy += weight * x * y;
}

static double line_slope(const Line* line) {
  return (line->w * line->wxy - line->wx * line->wy) / (line->w * line->wxx - line->wx * line->wx);
}

static double bessel_i0(double x) {
  double term = 1.0;
  double sum = 1.0;
  for (int k = 1; term > 1e-18 * sum; ++k) {
    term *= (0.5 * x / k) * (0.5 * x / k);
    sum += term;
  }
  return sum;
}

static double kaiser(double t) {
  const double rest = 1.0 - t * t;
  return rest > 0.0 ? bessel_i0(BETA * sqrt(rest)) / bessel_i0(BETA) : 0.0;
}

/* The window on its carrier, e^{−jωn}. */
static double complex* make_probe(size_t length, double omega) {
  double complex* const probe = malloc(length * sizeof(*probe));
  for (size_t i = 0; probe && i < length; ++i) {
    probe[i] =
        kaiser(2.0 * ((double)i + 0.5) / (double)length - 1.0) * cexp(-J * omega * (double)i);
  }
  return probe;
}

static double complex
look(const float* samples, const double complex* probe, size_t length, size_t start, double omega) {
  double re = 0.0;
  double im = 0.0;
  for (size_t i = 0; i < length; ++i) {
    re += creal(probe[i]) * (double)samples[start + i];
    im += cimag(probe[i]) * (double)samples[start + i];
  }
  return (re + J * im) * cexp(-J * omega * (double)start);
}

double measure_cents(double f_hz, double reference_hz) {
  return 1200.0 * log2(f_hz / reference_hz);
}

bool measure_tone(const float* samples, size_t n, double rate_hz, Tone near, Tone* tone) {
  return measure_partial(samples, n, rate_hz, near, near.f0_hz, tone);
}

bool measure_partial(
    const float* samples, size_t n, double rate_hz, Tone near, double spacing_hz, Tone* tone) {
  const double period = rate_hz / spacing_hz;
  const size_t used = (size_t)fmin((double)n, MOST_DECAY * near.tau_s * rate_hz + 16.0 * period);
  const double wanted =
      fmin(fmax((double)used / 6.0, LEAST_PERIODS * period), MOST_PERIODS * period);
  const size_t length = (size_t)wanted;
  const size_t hop = length / 8 + 1;
  const double omega = 2.0 * PI * near.f0_hz / rate_hz;
  if ((double)used < 16.0 * period) {
    return false;
  }
  double complex* const probe = make_probe(length, omega);
  Line phase = {0};
  Line decay = {0};
  double complex before = 0.0;
  double angle = 0.0;
  for (size_t start = 0; probe && start + length <= used; start += hop) {
    const double complex here = look(samples, probe, length, start, omega);
    const double power = creal(here * conj(here));
    angle += start > 0 ? carg(here * conj(before)) : 0.0;
    line_add(&phase, power, (double)start, angle);
    line_add(&decay, power, (double)start, 0.5 * log(power));
    before = here;
  }
  free(probe);
  *tone = (Tone){
      .f0_hz = near.f0_hz + line_slope(&phase) * rate_hz / (2.0 * PI),
      .tau_s = -1.0 / (line_slope(&decay) * rate_hz),
  };
  return isfinite(tone->f0_hz) && isfinite(tone->tau_s);
}

double measure_near(const float* samples, size_t n, double rate_hz, double f_hz) {
  double complex sum = 0.0;
  for (size_t i = 0; i < n; ++i) {
    const double hann = 1.0 - cos(2.0 * PI * ((double)i + 0.5) / (double)n);
    const double angle = 2.0 * PI * f_hz * (double)i / rate_hz;
    sum += hann * (double)samples[i] * cexp(-J * angle);
  }
  return 2.0 * cabs(sum) / (double)n;
}

double measure_peak(const float* samples, size_t n) {
  double peak = 0.0;
  for (size_t i = 0; i < n; ++i) {
    if (!isfinite(samples[i])) {
      return (double)NAN;
    }
    peak = fmax(peak, fabs((double)samples[i]));
  }
  return peak;
}

double measure_rms(const float* samples, size_t n) {
  double sum = 0.0;
  for (size_t i = 0; i < n; ++i) {
    sum += (double)samples[i] * (double)samples[i];
  }
  return n > 0 ? sqrt(sum / (double)n) : 0.0;
}

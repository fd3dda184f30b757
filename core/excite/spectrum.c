#include "core/excite/spectrum.h"

#include "core/base/maths.h"
#include "core/excite/bow.h"

#include <math.h>

/* The finger of pluck_pull() is taken to be so much wider than it is: a mode of just its width has
 * a pole at both edges, and the narrowest is as wide as one of an odd number's. */
static const double WIDER = 1.0005;

/* Where a node of a mode begins to be one, s², and what a mode loses in a radian of the fundamental
 * when its corner is round: as bows at places from 0.05 to 0.2 are measured to do. */
static const double NODE = 0.01;
static const double ROUND = 0.06;

/* The rehearsed partials that are taken as they are, and those, of so many, whose means tell how
 * the rest go on: the last are too few masses' own. */
enum { REHEARSED = 16, EARLY = 5, LATE = 11, APART = LATE - EARLY };

/* What one edge of a finger adds to the transform at x = kπ width. */
static double edge(double x, double cosine) {
  const double pole = x * x - PI * PI;
  /* Both edges have the same pole, and cancel there. */
  return -1.0 / x - cosine * x / (fabs(pole) < 1e-4 ? 1e-4 : pole);
}

static double transform(const Spectrum* s, double k, const double cosines[2]) {
  const double x = k * s->width;
  return cosines[1] * edge(x, s->edges[1]) - cosines[0] * edge(x, s->edges[0]);
}

/* The mean of each mode's sine over the masses that are under the finger, squared. */
static uint32_t sum_few(uint32_t n_masses, double centre, double width, double* shares) {
  const double step = 1.0 / (n_masses + 1.0);
  double weights[SPECTRUM_FEW];
  double sum = 0.0;
  for (uint32_t i = 0; i < n_masses; ++i) {
    const double distance = ((i + 1.0) * step - centre) / width;
    weights[i] = fabs(distance) < 1.0 ? 1.0 + cos(PI * distance) : 0.0;
    sum += weights[i];
  }
  for (uint32_t k = 1; k <= n_masses; ++k) {
    const double twice = 2.0 * cos(PI * k * step);
    double before = 0.0;
    double sine = sin(PI * k * step);
    double push = 0.0;
    for (uint32_t i = 0; i < n_masses; ++i) {
      const double next = twice * sine - before;
      push += weights[i] * sine;
      before = sine;
      sine = next;
    }
    shares[k - 1] = push * push / (sum * sum);
  }
  return n_masses;
}

Spectrum spectrum_of_pluck(uint32_t n_masses, Pluck pluck, double angle1) {
  const double step = 1.0 / (n_masses + 1.0);
  const double width = WIDER * step * pluck_width(&pluck, n_masses);
  const double centre = fmin(fmax(pluck.place, step), 1.0 - step);
  const double from = fmax(-1.0, -centre / width);
  const double to = fmin(1.0, (1.0 - centre) / width);
  const double weight = to - from + (sin(PI * to) - sin(PI * from)) / PI;
  const double a1 = 2.0 - 2.0 * cos(angle1);
  Spectrum s = {
      .exciter = EXCITER_PLUCK,
      .angles = {PI * (centre + width * from), PI * (centre + width * to)},
      .push = 4.0 / PI * a1 / weight,
      .width = PI * width,
      .edges = {cos(PI * from), cos(PI * to)},
      .angle1 = angle1,
  };
  if (n_masses <= SPECTRUM_FEW) {
    s.push = 4.0 / PI * a1;
    s.n_shares = sum_few(n_masses, centre, width / WIDER, s.shares);
  }
  return s;
}

static double mean(const double* shares) {
  double sum = 0.0;
  for (int k = 0; k < APART; ++k) {
    sum += shares[k] / APART;
  }
  return sum;
}

Spectrum spectrum_of_strike(uint32_t n_masses, Strike strike, double angle1) {
  const Pluck pluck = {
      .place = strike.place, .hardness = strike.hardness, .amplitude = strike.amplitude};
  Spectrum s = spectrum_of_pluck(n_masses, pluck, angle1);
  const double cosines[] = {cos(s.angles[0]), cos(s.angles[1])};
  s.exciter = EXCITER_STRIKE;
  s.push *= sin(angle1) / (2.0 - 2.0 * cos(angle1));
  s.push *= s.n_shares > 0 ? sqrt(s.shares[0]) : transform(&s, 1.0, cosines);
  s.n_shares = rehearsal_spectrum(n_masses, strike, angle1, s.shares);
  if (s.n_shares > REHEARSED) {
    s.n_shares = REHEARSED;
    s.last = mean(&s.shares[LATE - 1]);
    s.fall = fmin(1.0, pow(s.last / mean(&s.shares[EARLY - 1]), 1.0 / APART));
  }
  return s;
}

Spectrum spectrum_of_bow(double place, double angle1) {
  const double at = bow_place(place, angle1);
  return (Spectrum){
      .exciter = EXCITER_BOW,
      .angles = {2.0 * PI * at, 0.0},
      .push = 8.0 / (PI * PI),
      .angle1 = angle1,
  };
}

/* `at` is s². */
static double bowed_square(const Spectrum* s, Pole mode, double at) {
  const double sine2 = mode.a * (1.0 - 0.25 * mode.a);
  const double first = s->push * sin(s->angle1) * sin(0.5 * s->angle1);
  const double lost = mode.g / (ROUND * s->angle1);
  return first * first / (sine2 * 0.25 * mode.a) * at / ((at + NODE) * (1.0 + lost * lost));
}

double spectrum_square(const Spectrum* s, uint32_t k, Pole mode, const double cosines[2]) {
  const double sine2 = mode.a * (1.0 - 0.25 * mode.a);
  switch (s->exciter) {
  case EXCITER_PLUCK: {
    const double pull = s->push / mode.a;
    if (k <= s->n_shares) {
      return pull * pull * s->shares[k - 1];
    }
    const double share = transform(s, k, cosines);
    return pull * pull * share * share;
  }
  case EXCITER_STRIKE: {
    const double share =
        k <= s->n_shares ? s->shares[k - 1] : s->last * pow(s->fall, k - 0.5 * (LATE + REHEARSED));
    return s->push * s->push * share / sine2;
  }
  case EXCITER_BOW:
    return bowed_square(s, mode, 0.5 - 0.5 * cosines[0]);
  }
  return 0.0;
}

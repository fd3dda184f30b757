#include "tools/report/figure_sound.h"

#include "core/string/tuning.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

Pole figure_sound_ring(void) {
  return pole_from_analog(FIGURE_RING_RATE_HZ, 2.0 * PI * FIGURE_RING_F0_HZ, FIGURE_RING_GAMMA);
}

FigureEigenvalue figure_sound_eigenvalue(void) {
  const double sigma = -0.5 * FIGURE_RING_GAMMA;
  const double omega0 = 2.0 * PI * FIGURE_RING_F0_HZ;
  return (FigureEigenvalue){.sigma = sigma, .mu = sqrt(omega0 * omega0 - sigma * sigma)};
}

Pole figure_sound_retuned(void) {
  const FigureEigenvalue s = figure_sound_eigenvalue();
  Pole pole = {0};
  (void)pole_solve(FIGURE_RING_RATE_HZ, (Tone){.f0_hz = s.mu / (2.0 * PI), .tau_s = -1.0 / s.sigma},
                   &pole);
  return pole;
}

/* Re((re + j im) zⁿ). */
static double turned(Pole pole, double re, double im, double n) {
  const double angle = pole_angle(pole) * n;
  return pow(pole_radius(pole), n) * (re * cos(angle) - im * sin(angle));
}

double figure_sound_discrete(Pole pole, FigureState start, double n) {
  const double next = start.x + start.u - pole.a * start.x - pole.g * start.u;
  const double r = pole_radius(pole);
  const double angle = pole_angle(pole);
  /* x[1] = Re(C z) = r (Re C cos θ − Im C sin θ). */
  return turned(pole, start.x, (start.x * cos(angle) - next / r) / sin(angle), n);
}

double figure_sound_continuous_start(double n) {
  /* x'(0) = Re(C s) = Re C σ − Im C μ = 0. */
  const FigureEigenvalue s = figure_sound_eigenvalue();
  return turned(figure_sound_ring(), 1.0, s.sigma / s.mu, n);
}

FigureState figure_sound_cosine_start(Pole pole) {
  const double next = pole_radius(pole) * cos(pole_angle(pole));
  return (FigureState){.x = 1.0, .u = (next - 1.0 + pole.a) / (1.0 - pole.g)};
}

Pole figure_sound_tuned(void) {
  const TuningTarget target = {.rate_hz = FIGURE_STRING_RATE_HZ,
                               .tone = {FIGURE_STRING_F0_HZ, FIGURE_STRING_TAU_S},
                               .loss = 1.0};
  StringCoefs coefs = {0};
  (void)tuning_solve(&target, FIGURE_STRING_MASSES, &coefs);
  return (Pole){.a = coefs.k1, .g = coefs.z1};
}

Pole figure_sound_untuned(void) {
  const double omega0 = hypot(2.0 * PI * FIGURE_STRING_F0_HZ, 1.0 / FIGURE_STRING_TAU_S);
  const Pole mode = pole_from_analog(FIGURE_STRING_RATE_HZ, omega0, 2.0 / FIGURE_STRING_TAU_S);
  const double lambda = tuning_lambda(FIGURE_STRING_MASSES, 1);
  return (Pole){.a = mode.a / lambda, .g = mode.g / lambda};
}

Tone figure_sound_partial(Pole segment, uint32_t k) {
  const StringCoefs coefs = {.k1 = segment.a, .z1 = segment.g};
  return pole_tone(FIGURE_STRING_RATE_HZ, tuning_mode(coefs, FIGURE_STRING_MASSES, k));
}

double figure_sound_level(const double* x, uint32_t n_frames, double rate_hz, double f_hz) {
  /* Horner from the last frame back: Σ x[n] wⁿ. */
  const double turn = 2.0 * PI * f_hz / rate_hz;
  const double c = cos(turn);
  const double s = -sin(turn);
  double re = 0.0;
  double im = 0.0;
  for (uint32_t n = n_frames; n-- > 0;) {
    const double old = re;
    re = old * c - im * s + x[n];
    im = old * s + im * c;
  }
  return hypot(re, im);
}

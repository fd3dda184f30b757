#include "tools/figure_plane.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

Pole figure_plane_mass(double sigma_h, double mu_h) {
  return pole_from_analog(1.0, hypot(sigma_h, mu_h), -2.0 * sigma_h);
}

double figure_plane_sigma(Pole pole) {
  return -0.5 * pole.g;
}

double figure_plane_mu(Pole pole) {
  return sqrt(pole.a - 0.25 * pole.g * pole.g);
}

double figure_plane_damping(Pole pole) {
  return -1.0 / pole_tone(1.0, pole).tau_s;
}

double figure_plane_border(FigureBorder border, double w) {
  switch (border) {
  case FIGURE_BORDER_VIBRATES:
    return w * (2.0 - w);
  case FIGURE_BORDER_TURNS:
    return 2.0 - w * w;
  case FIGURE_BORDER_LIMIT:
    break;
  }
  return 2.0 - 0.5 * w * w;
}

/* Whether the mass is on the side of the border where σ = 0 is. */
static bool is_before(FigureBorder border, Pole pole) {
  return border == FIGURE_BORDER_VIBRATES ? pole_is_complex(pole) : pole_angle(pole) < 0.5 * PI;
}

double figure_plane_corner(FigureBorder border, double mu_h) {
  double high = -1e-9;
  double low = border == FIGURE_BORDER_VIBRATES ? -0.5 : -0.8;
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (high + low);
    *(is_before(border, figure_plane_mass(middle, mu_h)) ? &high : &low) = middle;
  }
  return high;
}

double figure_plane_singular_mu(void) {
  double low = 0.1;
  double high = 1.2;
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    *(pole_angle(figure_plane_mass(-0.5, middle)) < 0.5 * PI ? &low : &high) = middle;
  }
  return low;
}

Pole figure_plane_tone(double angle, double damping) {
  Pole pole = {0};
  (void)pole_solve(1.0, (Tone){.f0_hz = angle / (2.0 * PI), .tau_s = -1.0 / damping}, &pole);
  return pole;
}

Pole figure_plane_real(double damping, bool is_at_pi, double g) {
  const double r = exp(damping);
  const double a = is_at_pi ? (1.0 + r) * (1.0 + r - g) / r : (1.0 - r) * (g - 1.0 + r) / r;
  return (Pole){.a = a, .g = g};
}

#include "tools/report/figure_plane.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

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

double figure_plane_damping(Pole pole) {
  return -1.0 / pole_tone(1.0, pole).tau_s;
}

double figure_plane_singular_mu(void) {
  double low = 0.1;
  double high = 1.2;
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    *(pole_angle(pole_from_eigenvalue(1.0, -0.5, middle)) < 0.5 * PI ? &low : &high) = middle;
  }
  return low;
}

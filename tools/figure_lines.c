#include "tools/figure_groups.h"
#include "tools/figure_plane.h"

#include <math.h>
#include <stdbool.h>

static const double PI = 3.14159265358979323846;

enum { N_LINE = 100 };

static void write_point(FILE* data, Pole pole) {
  const double mu = figure_plane_mu(pole);
  (void)fprintf(data, "%.5f %.5f\n", figure_plane_sigma(pole), mu > 0.0 ? mu : 0.0);
}

/* The frequency `eighth` π/8: where it starts, undamped, and onwards to all damping. */
static void write_frequency(FILE* data, int eighth) {
  const double angle = eighth * PI / 8.0;
  for (int i = 0; i <= N_LINE; ++i) {
    const double radius = 1.0 - 0.999 * i / N_LINE;
    write_point(data, figure_plane_tone(angle, fmin(log(radius), -1e-9)));
  }
  (void)fputc('\n', data);
}

static Status write_frequencies(FILE* data) {
  figure_block(data, "frequency: sigma h, mu h, a line for each pi/8");
  for (int eighth = 1; eighth < 8; ++eighth) {
    write_frequency(data, eighth);
  }
  figure_block(data, "border: of the masses that vibrate");
  for (int i = 0; i <= N_LINE; ++i) {
    const double w = 2.0 * i / N_LINE;
    write_point(data, (Pole){w * w, figure_plane_border(FIGURE_BORDER_VIBRATES, w)});
  }
  return STATUS_OK;
}

/* Real poles from `first` to `last` damping γh, dense at both ends. */
static void write_real(FILE* data, double damping, bool is_at_pi, double first, double last) {
  for (int i = 0; i <= N_LINE; ++i) {
    const double s = sin(0.5 * PI * i / N_LINE);
    write_point(data, figure_plane_real(damping, is_at_pi, first + (last - first) * s * s));
  }
}

/* A line of equal decay: real poles at z = r, up through the complex poles, real poles at −r.  The
 * real ones end where the two meet, g = 1 + r², or where they leave the picture, μ = 0. */
static void write_decay(FILE* data, double damping) {
  const double r = exp(damping);
  const double start = 1.0 - r * r;
  const double meet = 1.0 + r * r;
  const double creep = 2.0 * (1.0 - r) * (1.0 + sqrt(1.0 - r)) / r;
  const double flip = 2.0 * (1.0 + r) * (sqrt(1.0 + r) - 1.0) / r;
  write_real(data, damping, false, fmin(meet, creep), start);
  for (int i = 1; i < N_LINE / 4; ++i) {
    write_point(data, figure_plane_tone(PI * i / (N_LINE / 4.0), damping));
  }
  write_real(data, damping, true, start, fmin(meet, flip));
  (void)fputc('\n', data);
}

/* From μ = 0, where w = g/2 = 2√2 − 2, to the undamped. */
static void write_limit(FILE* data) {
  const double first = 2.0 * sqrt(2.0) - 2.0;
  for (int i = 0; i <= N_LINE; ++i) {
    const double w = first + (2.0 - first) * i * i / (N_LINE * N_LINE);
    write_point(data, (Pole){w * w, figure_plane_border(FIGURE_BORDER_LIMIT, w)});
  }
}

static Status write_decays(FILE* data) {
  static const double dampings[] = {-0.05, -0.1, -0.2, -0.3, -0.5, -0.8, -1.2};
  figure_block(data, "decay: sigma h, mu h, a line for each sigma_d h");
  for (unsigned i = 0; i < sizeof(dampings) / sizeof(dampings[0]); ++i) {
    write_decay(data, dampings[i]);
  }
  figure_block(data, "border: of the stable masses");
  write_limit(data);
  return STATUS_OK;
}

static const char frequencies_script[] =
    "set xlabel 'σ h  [per sample]'\n"
    "set ylabel 'μ h  [rad per sample]'\n"
    "set key at graph 0.015, graph 0.975 left Left reverse\n"
    "set label 1 'ω_d h =' at graph 1.015, first 2.15\n"
    "do for [k = 1:7] {\n"
    "  name = word('π/8 π/4 3π/8 π/2 5π/8 3π/4 7π/8', k)\n"
    "  set label k + 1 name at graph 1.015, first 2 * sin(k * pi / 16) font ',12'\n"
    "}\n"
    "set rmargin 11\n"
    "plot [-0.55:0][0:2.45] \\\n"
    "  data index 'border' with filledcurves closed fc rgb vibrates notitle, \\\n"
    "  data index 'frequency' with lines lw 2 lc rgb blue title 'equal ω_d h, as stepped', \\\n"
    "  for [k = 1:5] k * pi / 8 with lines lw 1.5 dt 3 lc rgb grey \\\n"
    "    title (k == 1 ? 'the same of the oscillator' : ''), \\\n"
    "  data index 'border' with lines lw 1.5 dt 2 lc rgb red title 'border of vibration'\n";

static const char decays_script[] =
    "set xlabel 'σ h  [per sample]'\n"
    "set ylabel 'μ h  [rad per sample]'\n"
    "set key at graph 0.02, graph 0.97 left Left reverse\n"
    "do for [k = 1:7] {\n"
    "  d = word('-0.05 -0.1 -0.2 -0.3 -0.5 -0.8 -1.2', k)\n"
    "  s = (exp(2 * d) - 1) / 2\n"
    "  set label k d at s, 1.0 center rotate by 90 font ',12' front \\\n"
    "    textcolor rgb black boxed\n"
    "}\n"
    "set style textbox opaque noborder margins 0.3, 0.3\n"
    "plot [-0.9:0][0:2.15] \\\n"
    "  data index 'decay' with lines lw 1.5 lc rgb blue title 'equal σ_d h, as stepped', \\\n"
    "  data index 'border' with lines lw 2.5 lc rgb red title 'limit of stability: σ_d h = 0'\n";

const Figure figure_lines[2] = {
    {.number = 16,
     .title = "Iso-frequency lines",
     .shows = "Along each solid line all masses are heard at the same frequency, ω_d h = π/8, π/4, "
              "… 7π/8.  Were nothing warped they would be "
              "level: the dotted lines, of which the upper two lie outside.",
     .equation =
         "(ω0 h)² = 2 − γh − 2 √(1 − γh) cos(ω_d h), which is (30) solved, for γh from 0 to "
         "1",
     .source = "Subject known: iso-frequency lines.  Which ones is our choice.",
     .script = frequencies_script,
     .write = write_frequencies},
    {.number = 17,
     .title = "Iso-damping lines",
     .shows = "Along each line all masses die equally fast.  It is upright while the poles are "
              "complex, for then damping is free of frequency; at both ends it turns and follows "
              "the larger real pole until it meets itself.",
     .equation = "σ_d h = ln|z| (40): complex, σh = (exp(2σ_d h) − 1)/2; real, (23) with z = "
                 "±exp(σ_d h)",
     .source = "Subject known: iso-damping lines.  Which ones is our choice.",
     .script = decays_script,
     .write = write_decays},
};

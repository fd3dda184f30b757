#include "tools/report/figure_groups.h"

#include "core/string/pole.h"

#include <math.h>
#include <stdbool.h>

static const double PI = 3.14159265358979323846;

enum { N_LINE = 100 };

/* The frequency `eighth` π/8, dense towards the singular point. */
static void write_frequency(FILE* data, int eighth) {
  for (int i = 0; i < N_LINE; ++i) {
    const double sigma_h = -0.5 * sin(0.5 * PI * i / N_LINE);
    const double mu_h = pole_line_of_frequency(sigma_h, eighth * PI / 8.0);
    (void)fprintf(data, "%.5f %.5f\n", sigma_h, mu_h);
  }
  (void)fprintf(data, "%.5f %.5f\n\n", POLE_SINGULAR_SIGMA_H, POLE_SINGULAR_MU_H);
}

/* An edge from μh = 0 to 2. */
static void write_edge(FILE* data, double (*edge)(double)) {
  for (int i = 0; i <= N_LINE; ++i) {
    const double s = sin(0.5 * PI * i / N_LINE);
    (void)fprintf(data, "%.5f %.5f\n", edge(2.0 * s * s), 2.0 * s * s);
  }
}

static Status write_frequencies(FILE* data) {
  figure_block(data, "frequency: sigma h, mu h, a line for each pi/8");
  for (int eighth = 1; eighth < 8; ++eighth) {
    write_frequency(data, eighth);
  }
  figure_block(data, "border: of the masses that vibrate");
  write_edge(data, pole_edge_vibrating);
  return STATUS_OK;
}

/* Real poles ±r from σh `first` to `last`, dense at both ends; what lies below μh = 0 is left out.
 */
static void write_branch(FILE* data, double r, bool is_at_pi, double first, double last) {
  for (int i = 0; i <= N_LINE; ++i) {
    const double s = sin(0.5 * PI * i / N_LINE);
    const double sigma_h = first + (last - first) * s * s;
    const double mu_h = pole_branch_of_damping(sigma_h, r, is_at_pi);
    if (mu_h >= 0.0) {
      (void)fprintf(data, "%.5f %.5f\n", sigma_h, mu_h);
    }
  }
}

/* A line of equal decay: real poles at r, up through the complex ones, real poles at −r.  The real
 * ones end where the two meet, γh = 1 + r², or where they leave the picture, μh = 0. */
static void write_decay(FILE* data, double damping) {
  const double r = exp(damping);
  const double upright = pole_line_of_damping(r);
  const double meet = -0.5 * (1.0 + r * r);
  const double creep = -(1.0 - r) * (1.0 + sqrt(1.0 - r)) / r;
  const double flip = -(1.0 + r) * (sqrt(1.0 + r) - 1.0) / r;
  write_branch(data, r, false, fmax(meet, creep), upright);
  write_branch(data, r, true, upright, fmax(meet, flip));
  (void)fputc('\n', data);
}

static Status write_decays(FILE* data) {
  static const double dampings[] = {-0.05, -0.1, -0.2, -0.3, -0.5, -0.8, -1.2};
  figure_block(data, "decay: sigma h, mu h, a line for each sigma_d h");
  for (unsigned i = 0; i < sizeof(dampings) / sizeof(dampings[0]); ++i) {
    write_decay(data, dampings[i]);
  }
  figure_block(data, "border: of the stable masses");
  write_edge(data, pole_edge_stable);
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
    "set label 10 'border of vibration' at -0.54,0.15 font ',12'\n"
    "set rmargin 11\n"
    "plot [-0.55:0][0:2.45] \\\n"
    "  data index 'border' with filledcurves closed fc rgb vibrates notitle, \\\n"
    "  data index 'frequency' with lines lw 2 lc rgb blue title 'equal ω_d h, as stepped', \\\n"
    "  for [k = 1:5] k * pi / 8 with lines lw 1.5 dt 3 lc rgb grey \\\n"
    "    title (k == 1 ? 'the same of the oscillator' : ''), \\\n"
    "  data index 'border' with lines lw 1.5 dt 2 lc rgb red notitle\n";

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

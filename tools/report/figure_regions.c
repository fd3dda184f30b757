#include "tools/report/figure_groups.h"
#include "tools/report/figure_plane.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* The first script counts on the first 50 of N_BORDER lying up to ω0 h = 1. */
enum { N_BORDER = 100, N_LOCUS = 80 };

static Status write_parameters(FILE* data) {
  figure_block(data, "borders: omega0 h, gamma h where it vibrates below, turns above, is limited");
  for (int i = 0; i <= N_BORDER; ++i) {
    const double w = 2.0 * i / N_BORDER;
    (void)fprintf(data, "%.6g %.6g %.6g %.6g\n", w, figure_plane_border(FIGURE_BORDER_VIBRATES, w),
                  figure_plane_border(FIGURE_BORDER_TURNS, w),
                  figure_plane_border(FIGURE_BORDER_LIMIT, w));
  }
  return STATUS_OK;
}

/* Both poles (z1 z2 = 1 − g), and the larger modulus over w. */
static void write_poles(FILE* data, double w, double g) {
  const Pole pole = {.a = w * w, .g = g};
  const double angle = pole_angle(pole);
  const double r = pole_radius(pole);
  const double re = r * cos(angle);
  const double im = r * sin(angle);
  const bool is_complex = pole_is_complex(pole);
  (void)fprintf(data, "%.5f %.5f %.5f %.5f %.5f %.5f\n", re, is_complex ? im : 0.0,
                is_complex ? re : (1.0 - g) / re, is_complex ? -im : 0.0, w, r);
}

/* Dense at both ends, where the poles part. */
static void write_stretch(FILE* data, double g, double first, double last) {
  for (int i = 0; i <= N_LOCUS; ++i) {
    const double s = sin(0.5 * PI * i / N_LOCUS);
    write_poles(data, first + (last - first) * s * s, g);
  }
}

static void write_locus(FILE* data, const char* name, double g) {
  const double apart = sqrt(1.0 - g);
  figure_block(data, name);
  write_stretch(data, g, 0.0, 1.0 - apart);
  write_stretch(data, g, 1.0 - apart, 1.0 + apart);
  write_stretch(data, g, 1.0 + apart, sqrt(4.0 - 2.0 * g));
}

static Status write_loci(FILE* data) {
  write_locus(data, "undamped: Re, Im of a pole, of the other, omega0 h, larger modulus", 0.0);
  write_locus(data, "light: gamma h = 0.2", 0.2);
  write_locus(data, "middling: gamma h = 0.6", 0.6);
  write_locus(data, "heavy: gamma h = 0.9", 0.9);
  return STATUS_OK;
}

/* An edge of the s-plane from one μh to another, dense at both ends. */
static void write_edge(FILE* data, double (*edge)(double), double first, double last) {
  for (int i = 0; i <= N_BORDER; ++i) {
    const double s = sin(0.5 * PI * i / N_BORDER);
    const double mu = first + (last - first) * s * s;
    (void)fprintf(data, "%.5f %.5f\n", edge(mu), mu);
  }
}

static void write_corners(FILE* data) {
  static const double mu[] = {0.1, 0.8, 0.87};
  figure_block(data, "corners: sigma h, mu h");
  for (int i = 0; i < 2; ++i) {
    (void)fprintf(data, "%.6f %.2f\n", pole_edge_vibrating(mu[i]), mu[i]);
  }
  for (int i = 0; i < 3; ++i) {
    (void)fprintf(data, "%.6f %.2f\n", pole_edge_turning(mu[i]), mu[i]);
  }
  figure_block(data, "singular: sigma h, mu h");
  (void)fprintf(data, "-0.5 %.6f\n", figure_plane_singular_mu());
}

static Status write_plane(FILE* data) {
  figure_block(data, "vibrates: sigma h, mu h along its border");
  write_edge(data, pole_edge_vibrating, 0.0, 2.0);
  figure_block(data, "creeps");
  write_edge(data, pole_edge_vibrating, 0.0, POLE_SINGULAR_MU_H);
  write_edge(data, pole_edge_turning, POLE_SINGULAR_MU_H, 0.0);
  figure_block(data, "flips");
  write_edge(data, pole_edge_vibrating, 2.0, POLE_SINGULAR_MU_H);
  write_edge(data, pole_edge_turning, POLE_SINGULAR_MU_H, 0.0);
  write_edge(data, pole_edge_stable, 0.0, 2.0);
  write_corners(data);
  return STATUS_OK;
}

static const char parameters_script[] =
    "set xlabel 'natural frequency  ω_0 h  [rad per sample]'\n"
    "set ylabel 'damping  γ h  [per sample]'\n"
    "set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb grows fs solid noborder behind\n"
    "set label 1 'vibrates' at 1.0,0.45 center front\n"
    "set label 2 'creeps: real, z > 0' at 0.08,1.2 front\n"
    "set label 3 'flips: real, z < 0' at 0.86,1.38 front rotate by -34 center\n"
    "set label 4 'grows' at 1.75,1.5 center front\n"
    "set label 5 'both poles at z = 0' at 1.0,0.9 center font ',12' front\n"
    "unset key\n"
    "plot [0:2.2][0:2.2] \\\n"
    "  data index 'borders' every ::0::50 using 1:3:2 with filledcurves fc rgb creeps, \\\n"
    "  data index 'borders' using 1:4:($2 > $3 ? $2 : $3) with filledcurves fc rgb flips, \\\n"
    "  data index 'borders' using 1:2:(0) with filledcurves fc rgb vibrates, \\\n"
    "  data index 'borders' using 1:2 with lines lw 2 lc rgb blue, \\\n"
    "  data index 'borders' every ::0::50 using 1:3 with lines lw 2 dt 2 lc rgb orange, \\\n"
    "  data index 'borders' using 1:4 with lines lw 2.5 lc rgb red, \\\n"
    "  '+' using (1):(1) every ::0::0 with points pt 7 ps 0.8 lc rgb black\n";

static const char loci_script[] =
    "set multiplot\n"
    "set size ratio -1\n"
    "set lmargin at screen 0.11\n"
    "set rmargin at screen 0.47\n"
    "set xlabel 'Re z'\n"
    "set ylabel 'Im z'\n"
    "unset key\n"
    "set xzeroaxis lt 1 lc rgb grey\n"
    "set yzeroaxis lt 1 lc rgb grey\n"
    "plot [-1.15:1.15][-1.15:1.15] \\\n"
    "  data index 'undamped' with lines lw 2 dt 1 lc rgb grey notitle, \\\n"
    "  data index 'undamped' using 3:4 with lines lw 2 dt 1 lc rgb grey notitle, \\\n"
    "  data index 'light' with lines lw 2 dt 1 lc rgb blue notitle, \\\n"
    "  data index 'light' using 3:4 with lines lw 2 dt 1 lc rgb blue notitle, \\\n"
    "  data index 'middling' with lines lw 2 dt 4 lc rgb red notitle, \\\n"
    "  data index 'middling' using 3:4 with lines lw 2 dt 4 lc rgb red notitle, \\\n"
    "  data index 'heavy' with lines lw 2 dt 3 lc rgb green notitle, \\\n"
    "  data index 'heavy' using 3:4 with lines lw 2 dt 3 lc rgb green notitle\n"
    "set size noratio\n"
    "set lmargin at screen 0.6\n"
    "set rmargin at screen 0.98\n"
    "set xlabel 'natural frequency  ω_0 h  [rad per sample]'\n"
    "set ylabel 'larger |z|'\n"
    "set label 1 'γh = 0' at 1,1.035 center\n"
    "set label 2 'γh = 0.2' at 1,0.855 center\n"
    "set label 3 'γh = 0.6' at 1,0.595 center\n"
    "set label 4 'γh = 0.9' at 1,0.28 center\n"
    "plot [0:2][0:1.08] \\\n"
    "  data index 'undamped' using 5:6 with lines lw 2 dt 1 lc rgb grey, \\\n"
    "  data index 'light' using 5:6 with lines lw 2 dt 1 lc rgb blue, \\\n"
    "  data index 'middling' using 5:6 with lines lw 2 dt 4 lc rgb red, \\\n"
    "  data index 'heavy' using 5:6 with lines lw 2 dt 3 lc rgb green\n"
    "unset multiplot\n";

static const char plane_script[] =
    "set xlabel 'σ h  [per sample]'\n"
    "set ylabel 'μ h  [rad per sample]'\n"
    "set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb grows fs solid noborder behind\n"
    "set label 1 'vibrates' at -0.2,1.2 center front\n"
    "set label 2 'creeps' at -0.5,0.3 center front\n"
    "set label 3 'flips' at -0.6,1.0 center front\n"
    "set label 4 'grows' at -0.72,1.55 center front\n"
    "set label 5 'μh = 0.87' at -0.005,0.96 right font ',12' front\n"
    "set label 6 'μh = 0.8' at -0.005,0.71 right font ',12' front\n"
    "set label 7 'μh = 0.1' at -0.005,0.19 right font ',12' front\n"
    "set arrow 1 from -0.9,0.87 to 0,0.87 nohead front dt 3 lc rgb '#555555'\n"
    "set arrow 2 from -0.9,0.8 to 0,0.8 nohead front dt 3 lc rgb '#555555'\n"
    "set arrow 3 from -0.9,0.1 to 0,0.1 nohead front dt 3 lc rgb '#555555'\n"
    "set key at graph 0.02, graph 0.97 left Left reverse samplen 1\n"
    "plot [-0.9:0][0:2.1] \\\n"
    "  data index 'creeps' with filledcurves closed fc rgb creeps notitle, \\\n"
    "  data index 'flips' with filledcurves closed fc rgb flips notitle, \\\n"
    "  data index 'vibrates' with filledcurves closed fc rgb vibrates notitle, \\\n"
    "  data index 'creeps' with lines lw 1.5 lc rgb orange notitle, \\\n"
    "  data index 'flips' with lines lw 1.5 lc rgb purple notitle, \\\n"
    "  data index 'vibrates' with lines lw 2 lc rgb blue notitle, \\\n"
    "  data index 'corners' every ::0::0 using 1:2:(sprintf('%.4f', $1)) with labels left \\\n"
    "    offset 0.6,0.6 font ',12' notitle, \\\n"
    "  data index 'corners' every ::1::1 using 1:2:(sprintf('%.4f', $1)) with labels left \\\n"
    "    offset 0.8,-0.6 font ',12' notitle, \\\n"
    "  data index 'corners' every ::2::3 using 1:2:(sprintf('%.4f', $1)) with labels right \\\n"
    "    offset -0.6,0.5 font ',12' notitle, \\\n"
    "  data index 'corners' every ::4::4 using 1:2:(sprintf('%.4f', $1)) with labels left \\\n"
    "    offset 0.8,0.6 font ',12' notitle, \\\n"
    "  data index 'corners' with points pt 7 ps 0.6 lc rgb black title 'corner', \\\n"
    "  data index 'singular' with points pt 6 ps 1.1 lw 2 lc rgb red title 'both poles at z = 0'\n";

const Figure figure_regions[3] = {
    {.number = 8,
     .title = "The four motions, by natural frequency and damping",
     .shows = "Every mass is a point (ω0 h, γh).  Inside the parabola its poles are complex and it "
              "vibrates; left of it it creeps back to rest, right of it its sign flips in every "
              "step; beyond the outermost line it grows.  All borders but the outermost meet at "
              "(1, 1), where both poles vanish.",
     .equation = "complex: (ω0 h)⁴ + (2γh − 4)(ω0 h)² + (γh)² < 0 (27), which is γh < ω0 h (2 − ω0 "
                 "h); stable: (ω0 h)² + 2γh ≤ 4 (33); flips: (ω0 h)² + γh > 2 (34)",
     .source = "Inferred: section 3 derives these borders in this order; the figure's caption was "
               "not at hand.",
     .script = parameters_script,
     .write = write_parameters},
    {.number = 9,
     .title = "Poles in the z-plane as the spring grows stiffer",
     .shows = "Left: both poles for ω0 h from 0 to the limit of stability.  While they are complex "
              "they run round a circle whose radius is the damping's alone; before and after they "
              "lie on the real axis.  Right: the larger modulus on the way.",
     .equation = "z² + ((ω0 h)² + γh − 2) z + (1 − γh) = 0 (23); |z| = √(1 − γh) (29)",
     .source = "Inferred: that the radius is free of frequency is this section's result; the "
               "figure's caption was not at hand.",
     .script = loci_script,
     .write = write_loci},
    {.number = 10,
     .title = "The four motions in the s-plane, and the corners of section 3.7",
     .shows = "The same four motions, where the oscillator's eigenvalues σ ± jμ are the axes.  The "
              "dotted lines are the three frequencies of section 3.7; dots mark where each comes "
              "to a border (or, at 0.87, where its angle passes π/2).",
     .equation = "ω0² = σ² + μ², γ = −2σ in (27), (33), (34): the paper's (37) to (39)",
     .source = "Values known: section 3.7 states the corners at μh = 0.1, 0.8 and 0.87 and the "
               "singular point.  Inferred: that this figure shows the plane that they lie in.",
     .script = plane_script,
     .write = write_plane},
};

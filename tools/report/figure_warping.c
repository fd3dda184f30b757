#include "tools/report/figure_groups.h"
#include "tools/report/figure_plane.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

enum { N_CURVE = 300 };

/* Undamped: how sharp it plays, against the frequency of the oscillator. */
static Status write_undamped(FILE* data) {
  figure_block(data, "undamped: omega0 h, omega_d h, F/rate as heard, cents sharp");
  for (int i = 1; i <= N_CURVE; ++i) {
    const double w = 2.0 * i / N_CURVE;
    const double angle = pole_angle((Pole){.a = w * w, .g = 0.0});
    (void)fprintf(data, "%.5f %.5f %.6f %.4f\n", w, angle, angle / (2.0 * PI),
                  1200.0 * log2(angle / w));
  }
  return STATUS_OK;
}

/* One line of constant μh; a line is broken where the motion changes at once. */
static void write_line(FILE* data, double mu_h) {
  PoleRegion last = POLE_REGION_COUNT;
  figure_block(data, "line: sigma h, omega_d h, sigma_d h");
  for (int i = 0; i <= 2 * N_CURVE; ++i) {
    const double sigma_h = pole_edge_stable(mu_h) * i / (2.0 * N_CURVE);
    const Pole pole = pole_from_eigenvalue(1.0, sigma_h, mu_h);
    const PoleRegion region = pole_region(pole);
    if (region == POLE_REAL_AT_PI && last == POLE_REAL_AT_ZERO) {
      (void)fprintf(data, "%.5f NaN %.5f\n", sigma_h, figure_plane_damping(pole));
    }
    last = region;
    (void)fprintf(data, "%.5f %.5f %.5f\n", sigma_h, pole_angle(pole), figure_plane_damping(pole));
  }
}

static void write_corner(FILE* data, double (*edge)(double), double mu_h) {
  const double sigma_h = edge(mu_h);
  const Pole pole = pole_from_eigenvalue(1.0, sigma_h, mu_h);
  (void)fprintf(data, "%.6f %.5f %.5f\n", sigma_h, pole_angle(pole), figure_plane_damping(pole));
}

static Status write_low(FILE* data) {
  write_line(data, 0.1);
  figure_block(data, "corners: as above");
  write_corner(data, pole_edge_vibrating, 0.1);
  write_corner(data, pole_edge_turning, 0.1);
  return STATUS_OK;
}

static Status write_middle(FILE* data) {
  write_line(data, 0.8);
  figure_block(data, "corners: as above");
  write_corner(data, pole_edge_vibrating, 0.8);
  write_corner(data, pole_edge_turning, 0.8);
  return STATUS_OK;
}

static Status write_high(FILE* data) {
  write_line(data, 0.87);
  figure_block(data, "corners: as above");
  write_corner(data, pole_edge_turning, 0.87);
  return STATUS_OK;
}

static Status write_damping(FILE* data) {
  figure_block(data, "damping: sigma h, sigma_d h, how much faster it dies [%]");
  for (int i = 1; i < N_CURVE; ++i) {
    const double sigma_h = -0.5 * i / N_CURVE;
    /* Any frequency will do at which these poles are complex: ω0 h = 1 does for all. */
    const double damping = figure_plane_damping((Pole){.a = 1.0, .g = -2.0 * sigma_h});
    (void)fprintf(data, "%.5f %.5f %.4f\n", sigma_h, damping, 100.0 * (damping / sigma_h - 1.0));
  }
  return STATUS_OK;
}

static const char undamped_script[] =
    "set multiplot\n"
    "set lmargin at screen 0.12\n"
    "set rmargin at screen 0.47\n"
    "set xlabel 'natural frequency  ω_0 h  [rad per sample]'\n"
    "set ylabel 'heard  ω_d h  [rad per sample]'\n"
    "set ytics ('0' 0, 'π/4' pi/4, 'π/2' pi/2, '3π/4' 3*pi/4, 'π' pi)\n"
    "set key left top Left reverse\n"
    "plot [0:2][0:pi] \\\n"
    "  x with lines lw 2 dt 2 lc rgb grey title 'the oscillator', \\\n"
    "  data index 'undamped' with lines lw 2 lc rgb blue title 'as stepped'\n"
    "set lmargin at screen 0.62\n"
    "set rmargin at screen 0.98\n"
    "set ytics auto\n"
    "set xlabel 'heard frequency / sample rate'\n"
    "set ylabel 'sharp by  [cents]'\n"
    "unset key\n"
    "plot [0:0.5][0:800] data index 'undamped' using 3:4 with lines lw 2 lc rgb blue\n"
    "unset multiplot\n";

#define LINE_SCRIPT(mu, first, second)                                                             \
  "mu = " mu "\n"                                                                                  \
  "last = 2 - sqrt(8 - mu**2)\n"                                                                   \
  "set multiplot\n"                                                                                \
  "set lmargin at screen 0.12\n"                                                                   \
  "set rmargin at screen 0.47\n"                                                                   \
  "set xlabel 'σ h  [per sample]'\n"                                                              \
  "set ylabel 'frequency  ω_d h  [rad per sample]'\n"                                             \
  "set ytics ('0' 0, 'π/4' pi/4, 'π/2' pi/2, '3π/4' 3*pi/4, 'π' pi)\n"                         \
  "set key top right\n"                                                                            \
  "plot [last:0][-0.1:pi+0.1] \\\n"                                                                \
  "  mu with lines lw 2 dt 2 lc rgb grey title 'the oscillator', \\\n"                             \
  "  data index 'line' with lines lw 2 lc rgb blue title 'as stepped', \\\n"                       \
  "  data index 'corners' with points pt 7 ps 0.7 lc rgb black notitle, \\\n"                      \
  "  data index 'corners' every ::0::0 using 1:2:(sprintf('%.4f', $1)) with labels \\\n"           \
  "    " first " font ',12' notitle, \\\n"                                                         \
  "  data index 'corners' every ::1::1 using 1:2:(sprintf('%.4f', $1)) with labels \\\n"           \
  "    " second " font ',12' notitle\n"                                                            \
  "set lmargin at screen 0.62\n"                                                                   \
  "set rmargin at screen 0.98\n"                                                                   \
  "set ytics auto\n"                                                                               \
  "set ylabel 'damping  σ_d h  [per sample]'\n"                                                   \
  "set key bottom right\n"                                                                         \
  "plot [last:0] \\\n"                                                                             \
  "  x with lines lw 2 dt 2 lc rgb grey title 'the oscillator', \\\n"                              \
  "  data index 'line' using 1:3 with lines lw 2 lc rgb blue title 'as stepped'\n"                 \
  "unset multiplot\n"

static const char damping_script[] =
    "set multiplot\n"
    "set lmargin at screen 0.12\n"
    "set rmargin at screen 0.47\n"
    "set xlabel 'σ h  [per sample]'\n"
    "set ylabel 'σ_d h  [per sample]'\n"
    "set key bottom right\n"
    "plot [-0.5:0][-2:0] \\\n"
    "  x with lines lw 2 dt 2 lc rgb grey title 'the oscillator', \\\n"
    "  data index 'damping' with lines lw 2 lc rgb blue title 'as stepped'\n"
    "set lmargin at screen 0.62\n"
    "set rmargin at screen 0.98\n"
    "set ylabel 'dies faster by  [%]'\n"
    "unset key\n"
    "plot [-0.5:0][0:200] data index 'damping' using 1:3 with lines lw 2 lc rgb blue\n"
    "unset multiplot\n";

#define LINE_EQUATION                                                                              \
  "ω_d h = atan2(√(4(1 − γh) − (2 − (ω0 h)² − γh)²), 2 − (ω0 h)² − γh) (30); σ_d h = ln|z| (40)"

#define LINE_SOURCE                                                                                \
  "Values known: section 3.7 states the corners at this μh.  Inferred: that this figure shows "   \
  "the line that they lie on."

const Figure figure_warping[5] = {
    {.number = 11,
     .title = "How sharp an undamped mass plays",
     .shows = "Left: the heard frequency runs ahead of the natural one, to half the sample rate at "
              "the limit ω0 h = 2, where the oscillator itself is only at 1/π of the sample rate.  "
              "Right: the same in cents.",
     .equation = "(30) without damping: ω_d h = 2 asin(ω0 h / 2)",
     .source = "Inferred: the warping of frequency without damping is where section 3 begins; the "
               "figure's caption was not at hand.",
     .script = undamped_script,
     .write = write_undamped},
    {.number = 12,
     .title = "Frequency and damping along μh = 0.1",
     .shows = "A low frequency: with growing damping (to the left) the mass ceases to vibrate, "
              "creeps, and then flips at half the sample rate until it is unstable at the left "
              "edge.",
     .equation = LINE_EQUATION,
     .source = LINE_SOURCE,
     .script = LINE_SCRIPT("0.1", "left offset 0,1.1", "left offset -1,1.1"),
     .write = write_low},
    {.number = 13,
     .title = "Frequency and damping along μh = 0.8",
     .shows = "Just under the singular point the mass creeps for a short stretch only.",
     .equation = LINE_EQUATION,
     .source = LINE_SOURCE,
     .script = LINE_SCRIPT("0.8", "left offset 0.6,0.6", "right offset -0.6,0.6"),
     .write = write_middle},
    {.number = 14,
     .title = "Frequency and damping along μh = 0.87",
     .shows = "Just over the singular point the frequency rises steeply instead of falling, and "
              "passes π/2 where an arc tangent of a quotient would jump.",
     .equation = LINE_EQUATION,
     .source = LINE_SOURCE,
     .script = LINE_SCRIPT("0.87", "right offset -0.8,0", ""),
     .write = write_high},
    {.number = 15,
     .title = "How much faster a stepped mass dies",
     .shows = "Left: σ_d h against σh, for every mass that vibrates, whatever its frequency; near "
              "0, on the right side, the two agree.  Right: the difference.",
     .equation = "σ_d h = ½ ln(1 + 2σh), from (29) and (40)",
     .source = "Subject known: the paper speaks of a figure of σ_d h against σh whose right side "
               "is where the two agree.  Inferred: that it is this one.",
     .script = damping_script,
     .write = write_damping},
};

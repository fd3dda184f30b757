#include "tools/report/figure_groups.h"
#include "tools/report/figure_scheme.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

enum { STEPS_PER_PERIOD = 40, N_PERIODS = 3, N_STATES = STEPS_PER_PERIOD * N_PERIODS + 1 };

/* Undamped. */
static Pole swing(void) {
  const double w = 2.0 * PI / STEPS_PER_PERIOD;
  return (Pole){.a = w * w, .g = 0.0};
}

static void write_row(FILE* data, double n, FigureState state) {
  const Pole pole = swing();
  const double energy = figure_scheme_energy(pole, state) / (0.5 * pole.a);
  (void)fprintf(data, "%.6g %.6g %.6g %.9g\n", n / STEPS_PER_PERIOD, state.x,
                state.u / sqrt(pole.a), energy);
}

static void write_exact(FILE* data) {
  const double w = sqrt(swing().a);
  figure_block(data, "exact: time [periods], x/x0, v/(x0 omega0), energy/first");
  for (int i = 0; i <= 3 * (N_STATES - 1); ++i) {
    const double n = i / 3.0;
    write_row(data, n, (FigureState){.x = cos(w * n), .u = -w * sin(w * n)});
  }
  figure_block(data, "scheme: as above");
}

static Status write_scheme(FILE* data, NetworkScheme scheme) {
  FigureState states[N_STATES];
  const FigureState start = {.x = 1.0, .u = 0.0};
  const Status status = figure_scheme_play(scheme, swing(), start, N_STATES, states);
  write_exact(data);
  for (int n = 0; status == STATUS_OK && n < N_STATES; ++n) {
    write_row(data, n, states[n]);
  }
  return status;
}

static Status write_forward(FILE* data) {
  return write_scheme(data, NETWORK_FORWARD);
}

static Status write_backward(FILE* data) {
  return write_scheme(data, NETWORK_BACKWARD);
}

static Status write_symplectic(FILE* data) {
  return write_scheme(data, NETWORK_SYMPLECTIC);
}

#define SCRIPT(name, range)                                                                        \
  "r = " range "\n"                                                                                \
  "stats data index 'scheme' using 4 nooutput\n"                                                   \
  "set multiplot\n"                                                                                \
  "set lmargin at screen 0.11\n"                                                                   \
  "set rmargin at screen 0.54\n"                                                                   \
  "set xlabel 'time  [periods]'\n"                                                                 \
  "set ylabel 'displacement  x / x_0'\n"                                                           \
  "plot [0:3][-r:1.5*r] \\\n"                                                                      \
  "  data index 'exact' with lines lc rgb grey lw 2 title 'exact', \\\n"                           \
  "  data index 'scheme' with linespoints lc rgb blue pt 7 ps 0.3 lw 1.5 title '" name "'\n"       \
  "set lmargin at screen 0.66\n"                                                                   \
  "set rmargin at screen 0.98\n"                                                                   \
  "set xlabel 'displacement  x / x_0'\n"                                                           \
  "set ylabel 'velocity  v / (ω_0 x_0)' offset 1\n"                                               \
  "set label 1 sprintf('energy / first: %.4g to %.4g', STATS_min, STATS_max) \\\n"                 \
  "  at graph 0.5, graph 1.04 center\n"                                                            \
  "plot [-r:r][-r:r] \\\n"                                                                         \
  "  data index 'exact' using 2:3 with lines lc rgb grey lw 2 notitle, \\\n"                       \
  "  data index 'scheme' using 2:3 with linespoints lc rgb blue pt 7 ps 0.3 lw 1.5 notitle\n"      \
  "unset multiplot\n"

#define SOURCE                                                                                     \
  "Subject known: the paper sets the three methods of Euler side by side here.  Mass, step and "   \
  "duration are ours."

#define SHOWS                                                                                      \
  "An undamped mass is let go at x0 and stepped 40 times a period for three periods; on the left " \
  "its displacement, on the right its path in the plane of displacement and velocity.  "

const Figure figure_euler[3] = {
    {.number = 3,
     .title = "Forward Euler",
     .shows =
         SHOWS "Each step multiplies the energy by 1 + (ω0 h)², and the mass spirals outwards, "
               "however small the step.",
     .equation = "x ← x + h v,  v ← v − h ω0² x,  both from the old state",
     .source = SOURCE,
     .script = SCRIPT("forward Euler", "6.5"),
     .write = write_forward},
    {.number = 4,
     .title = "Backward Euler",
     .shows =
         SHOWS "Each step divides the energy by 1 + (ω0 h)², and the mass comes to rest though "
               "nothing damps it.",
     .equation = "v ← (v − h ω0² x) / (1 + (ω0 h)²),  x ← x + h v,  which is the step from the new "
                 "state, solved",
     .source = SOURCE,
     .script = SCRIPT("backward Euler", "1.4"),
     .write = write_backward},
    {.number = 5,
     .title = "Symplectic Euler",
     .shows = SHOWS "The path is closed: the energy sways a little and neither grows nor falls.",
     .equation = "(5): v ← v − h ω0² x,  x ← x + h v,  with the new velocity",
     .source = SOURCE,
     .script = SCRIPT("symplectic Euler", "1.4"),
     .write = write_symplectic},
};

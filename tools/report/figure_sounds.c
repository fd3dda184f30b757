#include "tools/report/figure_groups.h"
#include "tools/report/figure_sound.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

enum { N_RING = 81, N_SHOWN = 41, FINE = 8, N_STRING = 5 * 6000 };

/* Below rounding is drawn as rounding. */
static double floored(double difference) {
  return fmax(fabs(difference), DBL_EPSILON / 4.0);
}

static Status write_ring(FILE* data) {
  FigureState state[N_RING];
  const Pole pole = figure_sound_ring();
  const FigureState rest = {.x = 1.0, .u = 0.0};
  const Status status = figure_scheme_play(NETWORK_SYMPLECTIC, pole, rest, N_RING, state);
  figure_block(data, "curves: n, x by the discrete start, by the continuous start");
  for (int i = 0; i <= FINE * (N_SHOWN - 1); ++i) {
    const double n = (double)i / FINE;
    (void)fprintf(data, "%g %.5f %.5f\n", n, figure_sound_discrete(pole, rest, n),
                  figure_sound_continuous_start(n));
  }
  figure_block(data, "steps: n, simulated x, differences from the two");
  for (int n = 0; status == STATUS_OK && n < N_RING; ++n) {
    (void)fprintf(data, "%d %.6f %.3e %.3e\n", n, state[n].x,
                  floored(state[n].x - figure_sound_discrete(pole, rest, n)),
                  floored(state[n].x - figure_sound_continuous_start(n)));
  }
  return status;
}

/* Re(exp(s n h)), n steps on. */
static double wanted(double n) {
  const FigureEigenvalue s = figure_sound_eigenvalue();
  const double t = n / FIGURE_RING_RATE_HZ;
  return exp(s.sigma * t) * cos(s.mu * t);
}

static Status write_retuned(FILE* data) {
  FigureState plain[N_RING];
  FigureState tuned[N_RING];
  const FigureState start = figure_sound_cosine_start(figure_sound_retuned());
  Status status =
      figure_scheme_play(NETWORK_SYMPLECTIC, figure_sound_retuned(), start, N_RING, tuned);
  status = status
               ? status
               : figure_scheme_play(NETWORK_SYMPLECTIC, figure_sound_ring(),
                                    figure_sound_cosine_start(figure_sound_ring()), N_RING, plain);
  figure_block(data, "wanted: n, x");
  for (uint32_t i = 0; i <= FINE * (N_SHOWN - 1); ++i) {
    (void)fprintf(data, "%g %.5f\n", (double)i / FINE, wanted((double)i / FINE));
  }
  figure_block(data, "steps: n, retuned x, x as it comes, differences from the wanted");
  for (uint32_t n = 0; status == STATUS_OK && n < N_RING; ++n) {
    (void)fprintf(data, "%u %.6f %.6f %.3e %.3e\n", n, tuned[n].x, plain[n].x,
                  floored(tuned[n].x - wanted(n)), floored(plain[n].x - wanted(n)));
  }
  return status;
}

static double decibels(double level, double reference) {
  return 20.0 * log10(level / reference);
}

/* Rows of frequency and level from `low` to `high`. */
static void
write_span(FILE* data, const double* x, double reference, double low, double high, double step) {
  const int n_rows = (int)ceil((high - low) / step);
  for (int i = 0; i < n_rows; ++i) {
    const double f = low + i * step;
    const double level = figure_sound_level(x, N_STRING, FIGURE_STRING_RATE_HZ, f);
    (void)fprintf(data, "%.2f %.2f\n", f, decibels(level, reference));
  }
}

/* Close about each partial, wide between. */
static void write_spectrum(FILE* data, const double* x, double reference) {
  double low = 20.0;
  figure_block(data, "spectrum: F [Hz], level [dB]");
  for (uint32_t k = 1; k <= FIGURE_STRING_MASSES; ++k) {
    const double f = figure_sound_partial(figure_sound_tuned(), k).f0_hz;
    write_span(data, x, reference, low, f - 20.0, 10.0);
    write_span(data, x, reference, f - 20.0, f + 20.0, 0.5);
    low = f + 20.0;
  }
  write_span(data, x, reference, low, 2400.0, 10.0);
}

static void write_partials(FILE* data, const char* name, Pole segment) {
  figure_block(data, name);
  for (uint32_t k = 1; k <= FIGURE_STRING_MASSES; ++k) {
    const Tone tone = figure_sound_partial(segment, k);
    (void)fprintf(data, "%u %.5f %.7f\n", k, tone.f0_hz, tone.tau_s);
  }
}

static Status write_strings(FILE* data, double* x) {
  Status status = figure_scheme_pluck(FIGURE_STRING_MASSES, figure_sound_tuned(), N_STRING, x);
  if (status == STATUS_OK) {
    const double reference =
        figure_sound_level(x, N_STRING, FIGURE_STRING_RATE_HZ, FIGURE_STRING_F0_HZ);
    write_spectrum(data, x, reference);
    figure_block(data, "corrected: F [Hz], level [dB]");
    write_span(data, x, reference, 436.0, 448.0, 0.05);
    status = figure_scheme_pluck(FIGURE_STRING_MASSES, figure_sound_untuned(), N_STRING, x);
    figure_block(data, "warped: F [Hz], level [dB]");
    write_span(data, x, reference, 436.0, 448.0, 0.05);
  }
  write_partials(data, "partials: k, F [Hz], tau [s], corrected", figure_sound_tuned());
  write_partials(data, "sharp: k, F [Hz], tau [s], warped", figure_sound_untuned());
  return status;
}

static Status write_string(FILE* data) {
  double* const x = malloc(N_STRING * sizeof(*x));
  const Status status = x ? write_strings(data, x) : STATUS_NO_MEMORY;
  free(x);
  return status;
}

#define RING_PANELS(left, right)                                                                   \
  "set multiplot\n"                                                                                \
  "set lmargin at screen 0.115\n"                                                                  \
  "set rmargin at screen 0.53\n"                                                                   \
  "set xlabel 'sample  n'\n"                                                                       \
  "set ylabel 'displacement  x  [m]'\n"                                                            \
  "set key top right\n" left "set lmargin at screen 0.66\n"                                        \
  "set rmargin at screen 0.98\n"                                                                   \
  "set logscale y\n"                                                                               \
  "set format y '10^{%T}'\n"                                                                       \
  "set ytics 1e-16, 1e4, 1\n"                                                                      \
  "unset mytics\n"                                                                                 \
  "set ylabel 'difference  [m]' offset 0.5\n"                                                      \
  "set key at graph 0.97, graph 0.6\n" right "unset multiplot\n"

static const char ring_script[] = RING_PANELS(
    "plot [0:40][-1.1:1.6] \\\n"
    "  data index 'curves' using 1:3 with lines lw 1.5 dt 2 lc rgb red \\\n"
    "    title 'continuous start', \\\n"
    "  data index 'curves' using 1:2 with lines lw 1.5 lc rgb sky \\\n"
    "    title 'discrete start', \\\n"
    "  data index 'steps' using 1:2 with points pt 7 ps 0.5 lc rgb blue title 'simulated'\n",
    "plot [0:80][1e-17:3] \\\n"
    "  data index 'steps' every ::1 using 1:4 with lines lw 1.5 dt 2 lc rgb red title 'continuous "
    "start', \\\n"
    "  data index 'steps' every ::1 using 1:3 with lines lw 1.5 lc rgb blue title 'discrete "
    "start'\n");

static const char retuned_script[] = RING_PANELS(
    "plot [0:40][-1.1:1.6] \\\n"
    "  data index 'wanted' with lines lw 1.5 lc rgb grey title 'wanted: Re e^{st}', \\\n"
    "  data index 'steps' using 1:3 with points pt 8 ps 0.7 lc rgb red \\\n"
    "    title 'stepped as it is', \\\n"
    "  data index 'steps' using 1:2 with points pt 7 ps 0.5 lc rgb blue title 'stepped, retuned'\n",
    "plot [0:80][1e-17:3] \\\n"
    "  data index 'steps' every ::1 using 1:5 with lines lw 1.5 dt 2 lc rgb red title 'as it is', "
    "\\\n"
    "  data index 'steps' every ::1 using 1:4 with lines lw 1.5 lc rgb blue title 'retuned'\n");

static const char string_script[] =
    "set multiplot\n"
    "set lmargin at screen 0.115\n"
    "set rmargin at screen 0.6\n"
    "set ytics -60,10,0\n"
    "set xlabel 'frequency  [Hz]'\n"
    "set ylabel 'level  [dB]'\n"
    "unset key\n"
    "plot [0:2400][-65:25] \\\n"
    "  data index 'partials' using 2:(-65):(0):(68) with vectors nohead lw 1 dt 3 lc rgb grey, \\\n"
    "  data index 'spectrum' with lines lw 1.5 lc rgb blue, \\\n"
    "  data index 'partials' using 2:(6):(sprintf('%.2f', $2)) with labels left \\\n"
    "    rotate by 90 font ',12'\n"
    "set lmargin at screen 0.68\n"
    "set rmargin at screen 0.975\n"
    "unset ylabel\n"
    "set key top right samplen 2\n"
    "set xtics 4\n"
    "plot [436:448][-65:25] \\\n"
    "  data index 'corrected' with lines lw 1.5 lc rgb blue title 'tuned: 440', \\\n"
    "  data index 'warped' with lines lw 1.5 dt 4 lc rgb red title 'as it comes: 444.03'\n"
    "unset multiplot\n";

const Figure figure_sounds[3] = {
    {.number = 18,
     .title = "First experiment of section 3.9: the formula against the simulation",
     .shows = "A mass with ω0 = 2π · 125 Hz and γ = 50 1/s is let go from x = 1 m at rest and "
              "stepped 1000 times a second by the reference engine.  With the discrete start the "
              "closed form meets every sample to rounding; with amplitude and phase of the "
              "continuous oscillator it does not.  Differences under 6·10⁻¹⁷ are drawn as that.",
     .equation = "x[n] = R rⁿ cos(ω_d n h + φ), with R and φ from x[0] and x[1]",
     .source = "Values known: r and ω_d of section 3.9.  Inferred: the oscillator, from these, and "
               "that its two experiments are figures 18 and 19.",
     .script = ring_script,
     .write = write_ring},
    {.number = 19,
     .title = "Second experiment of section 3.9: the oscillator retuned",
     .shows = "The same oscillator is the sound that is wanted, and the one that is stepped is "
              "solved for.  Its samples lie on the wanted curve to rounding; those of the "
              "oscillator stepped as it is run ahead.",
     .equation = "γh = 1 − exp(2σh) (45), (ω0 h)² = 2 − γh − 2 exp(σh) cos(μh): Algorithm 2, "
                 "corrected, and (35)",
     .source = "Inferred: section 3.9 has two experiments; what the second varies was not at hand.",
     .script = retuned_script,
     .write = write_retuned},
    {.number = 21,
     .title = "The string of Table 1: its partials, tuned and as they come",
     .shows = "Left: spectrum of the tuned string of five masses, played by the reference engine "
              "at 6000 Hz for five seconds, plucked and heard at its first mass; dotted lines are "
              "the partials of Table 1.  Right: its fundamental, beside that of the string whose "
              "eigenvalue was set to −1 ± j2π440 as if the scheme warped nothing.",
     .equation = "mode k is one mass with (ω0 h)²λ_k and γh λ_k, λ_k = 4 sin²(kπ/12), in (30) and "
                 "(40); level = |Σ x[n] exp(−j2πFn/6000)|",
     .source =
         "Values known: Table 1.  Inferred: that the figure shows the spectrum of its string.",
     .script = string_script,
     .write = write_string},
};

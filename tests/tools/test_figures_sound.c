#include "tools/report/figure_sound.h"

#include "tests/support/oracle.h"

#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

static double complex polar(double r, double angle) {
  return complex_of(r * cos(angle), r * sin(angle));
}

static void first_experiment_is_met_by_the_discrete_start_alone(void** state) {
  (void)state;
  FigureState played[400];
  const FigureState rest = {.x = 1.0, .u = 0.0};
  const Pole pole = figure_sound_ring();
  assert_int_equal(figure_scheme_play(NETWORK_SYMPLECTIC, pole, rest, 400, played), STATUS_OK);
  double discrete = 0.0;
  double continuous = 0.0;
  double written = 0.0;
  const FigureEigenvalue s = figure_sound_eigenvalue();
  for (int n = 0; n < 400; ++n) {
    discrete = fmax(discrete, fabs(played[n].x - figure_sound_discrete(pole, rest, n)));
    continuous = fmax(continuous, fabs(played[n].x - figure_sound_continuous_start(n)));
    /* R rⁿ cos(ω_d n h + φ), as the paper writes it. */
    const double decay = pow(0.97467943448090, n);
    const double paper = cos(0.8177132374981528 * n + atan2(s.sigma, s.mu));
    written = fmax(written, fabs(hypot(1.0, s.sigma / s.mu) * decay * paper -
                                 figure_sound_continuous_start(n)));
  }
  assert_within("discrete start [m]", discrete, 1e-12);
  assert_within("continuous start, as written [m]", written, 1e-12);
  assert_true(continuous > 0.1);
}

static void second_experiment_lies_on_the_oscillator(void** state) {
  (void)state;
  FigureState played[400];
  const Pole pole = figure_sound_retuned();
  const FigureEigenvalue s = figure_sound_eigenvalue();
  assert_int_equal(
      figure_scheme_play(NETWORK_SYMPLECTIC, pole, figure_sound_cosine_start(pole), 400, played),
      STATUS_OK);
  double worst = 0.0;
  for (int n = 0; n < 400; ++n) {
    const double t = n / FIGURE_RING_RATE_HZ;
    worst = fmax(worst, fabs(played[n].x - exp(s.sigma * t) * cos(s.mu * t)));
  }
  assert_within("samples from the oscillator [m]", worst, 1e-12);
}

static void partials_are_the_poles_of_the_dense_string(void** state) {
  (void)state;
  const Pole segment = figure_sound_tuned();
  const StringCoefs coefs = {.k1 = segment.a, .z1 = segment.g};
  double complex z[2 * FIGURE_STRING_MASSES];
  oracle_poles(coefs, FIGURE_STRING_MASSES, z);
  double worst = 0.0;
  for (uint32_t k = 1; k <= FIGURE_STRING_MASSES; ++k) {
    const Tone tone = figure_sound_partial(segment, k);
    const double angle = 2.0 * PI * tone.f0_hz / FIGURE_STRING_RATE_HZ;
    const double r = exp(-1.0 / (tone.tau_s * FIGURE_STRING_RATE_HZ));
    double nearest = HUGE_VAL;
    for (int i = 0; i < 2 * FIGURE_STRING_MASSES; ++i) {
      nearest = fmin(nearest, cabs(z[i] - polar(r, angle)));
    }
    worst = fmax(worst, nearest);
  }
  assert_within("from the nearest pole", worst, 1e-13);
}

/* By a plain sum, and by where the played string is loudest. */
static void spectrum_is_a_fourier_sum_that_peaks_at_the_fundamental(void** state) {
  (void)state;
  enum { N = 30000 };
  double* const x = malloc(N * sizeof(*x));
  assert_non_null(x);
  assert_int_equal(figure_scheme_pluck(FIGURE_STRING_MASSES, figure_sound_tuned(), N, x),
                   STATUS_OK);
  double complex sum = 0.0;
  for (int n = 0; n < N; ++n) {
    sum += polar(x[n], -2.0 * PI * 443.0 * n / 6000.0);
  }
  const double level = figure_sound_level(x, N, 6000.0, 443.0);
  assert_within("level, relative", fabs(level / cabs(sum) - 1.0), 1e-9);
  double loudest = 0.0;
  double loudest_hz = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double f = 430.0 + 0.01 * i;
    const double here = figure_sound_level(x, N, 6000.0, f);
    loudest_hz = here > loudest ? f : loudest_hz;
    loudest = fmax(loudest, here);
  }
  free(x);
  /* As near as was looked. */
  assert_within("peak from 440 Hz", fabs(loudest_hz - 440.0), 0.01);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(first_experiment_is_met_by_the_discrete_start_alone),
      cmocka_unit_test(second_experiment_lies_on_the_oscillator),
      cmocka_unit_test(partials_are_the_poles_of_the_dense_string),
      cmocka_unit_test(spectrum_is_a_fourier_sum_that_peaks_at_the_fundamental),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

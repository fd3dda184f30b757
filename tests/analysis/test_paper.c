/* The numbers that [MQ09] prints, each by the core and, where there is one, by another way. */

#include "core/analysis/modes.h"
#include "core/analysis/network_schemes.h"
#include "core/string/tuning.h"

#include "tests/support/networks.h"
#include "tests/support/oracle.h"

#include <complex.h>
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

enum { N_FRAMES = 400 };

/* Of what is printed with so many decimals. */
static double half_digit(int n_decimals) {
  return 0.5 * pow(10.0, -n_decimals);
}

/* A line of Table 1. */
typedef struct {
  double sigma, mu;        /* Analog eigenvalue [1/s, rad/s] */
  double omega_d, sigma_d; /* Digital [rad/s, 1/s] */
  double f0_hz, tau_s;
} Row;

static const Row table_1[] = {
    {-0.99983335, 2739.98210, 2764.60154, -1.000000, 440.00000, 1.000000},
    {-3.73142886, 5293.23798, 5483.76570, -3.733751, 872.76842, 0.2678272},
    {-7.46285773, 7485.76708, 8089.32370, -7.472156, 1287.45585, 0.1338302},
    {-11.19428660, 9168.15257, 10447.41229, -11.215224, 1662.75731, 0.0891645},
    {-13.92588212, 10225.74360, 12263.63276, -13.958304, 1951.81777, 0.0716419},
};
enum { N_ROWS = 5 };

static const TuningTarget example = {.rate_hz = 6000.0, .tone = {440.0, 1.0}, .loss = 1.0};

static StringCoefs solved(void) {
  StringCoefs coefs = {0};
  assert_int_equal(tuning_solve(&example, N_ROWS, &coefs), STATUS_OK);
  return coefs;
}

static void check_tone(const char* who, const Row* row, Tone tone) {
  print_message("  %s, %g Hz\n", who, row->f0_hz);
  assert_within("frequency [Hz]", fabs(tone.f0_hz - row->f0_hz), half_digit(5));
  assert_within("ω_d [rad/s]", fabs(2.0 * PI * tone.f0_hz - row->omega_d), half_digit(5));
  assert_within("τ [s]", fabs(tone.tau_s - row->tau_s), half_digit(7));
  assert_within("σ_d [1/s]", fabs(-1.0 / tone.tau_s - row->sigma_d), half_digit(6));
}

static void closed_form_is_table_1_to_every_digit(void** state) {
  (void)state;
  const StringCoefs coefs = solved();
  for (uint32_t k = 1; k <= N_ROWS; ++k) {
    check_tone("closed form", &table_1[k - 1], pole_tone(6000.0, tuning_mode(coefs, N_ROWS, k)));
  }
}

/* The paper's own way: the system matrix of a network of springs and dampers, and its eigenvalues.
 */
static void eigenvalues_are_table_1_to_every_digit(void** state) {
  (void)state;
  const StringCoefs coefs = solved();
  Network* const network =
      networks_string(N_ROWS, 1.0, coefs.k1 * 6000.0 * 6000.0, coefs.z1 * 6000.0);
  Modes* modes = NULL;
  assert_int_equal(modes_solve(network, 6000.0, 0, &modes), STATUS_OK);
  assert_int_equal(modes->n_modes, N_ROWS);
  assert_true(modes->is_stable && modes->paper_is_stable);
  for (uint32_t k = 0; k < N_ROWS; ++k) {
    const double complex s = modes->mode[k].analog[0];
    check_tone("eigenvalues", &table_1[k], modes->mode[k].tone);
    /* Cut off after five decimals, not rounded: 7485.7670874 is printed as 7485.76708. */
    const double cut_off = cimag(s) - table_1[k].mu;
    assert_within("Im s [rad/s]", cut_off, 1e-5);
    assert_true(cut_off > -1e-8);
    /* Printed to eight decimals, of which a γ that keeps twelve digits gives the last one or two
     * wrong: line 5 ends in 12, where it should be 17. */
    assert_within("Re s [1/s]", fabs(creal(s) - table_1[k].sigma), k < 4 ? 1e-8 : 6e-8);
    assert_int_equal(modes->mode[k].region, POLE_COMPLEX);
  }
  modes_free(modes);
  network_free(network);
}

/* Eigenvalue −1 ± j2π440, nothing corrected: 444.026 Hz, 0.915 % sharp. */
static void uncorrected_string_is_sharp_by_0_915_percent(void** state) {
  (void)state;
  const Pole pole = pole_from_eigenvalue(6000.0, -1.0, 2.0 * PI * 440.0);
  const double f0_hz = pole_tone(6000.0, pole).f0_hz;
  double complex z[2];
  oracle_mass_poles(pole.a, pole.g, z);
  assert_within("Hz", fabs(f0_hz - 444.026), half_digit(3));
  assert_within("%", fabs(100.0 * (f0_hz / 440.0 - 1.0) - 0.915), half_digit(3));
  assert_within("by the step's eigenvalues [Hz]",
                fabs(fabs(carg(z[0])) * 6000.0 / (2.0 * PI) - f0_hz), 1e-9);
}

/* Figure 11: with γh = 0.5, poles are a pair from ω0 h = 0.293 to 1.707. */
static void pair_of_figure_11_has_the_limits_printed(void** state) {
  static const double limits[] = {0.293, 1.707};
  (void)state;
  for (int i = 0; i < 2; ++i) {
    const double inwards = i == 0 ? half_digit(3) : -half_digit(3);
    const double inside = limits[i] + inwards;
    const double outside = limits[i] - inwards;
    double complex z[2];
    assert_true(pole_is_complex((Pole){inside * inside, 0.5}));
    assert_false(pole_is_complex((Pole){outside * outside, 0.5}));
    oracle_mass_poles(outside * outside, 0.5, z);
    assert_true(cimag(z[0]) == 0.0);
  }
  /* Figure 10: without damping up to 2, which is Nyquist. */
  assert_true(pole_is_complex((Pole){3.9999, 0.0}) && !pole_is_complex((Pole){4.0001, 0.0}));
  assert_within("angle at 2", fabs(pole_angle((Pole){4.0, 0.0}) - PI), 1e-7);
}

/* Figure 16: the line of 2 radians per sample is at around 1.68 undamped and 1.2 at σh = −0.4. */
static void line_of_figure_16_passes_where_it_is_said_to(void** state) {
  (void)state;
  assert_within("undamped", fabs(pole_line_of_frequency(0.0, 2.0) - 1.68), half_digit(2));
  assert_within("σh = −0.4", fabs(pole_line_of_frequency(-0.4, 2.0) - 1.2), half_digit(1));
}

/* At μh = 0.87 the paper has −0.4977 for the end of the pair; there it only passes π/2, and its
 * end, where (27) puts it, is at −0.49999. */
static void pair_of_figure_15_ends_further_left_than_printed(void** state) {
  (void)state;
  double complex z[2];
  const Pole printed = pole_from_eigenvalue(1.0, -0.4977, 0.87);
  oracle_mass_poles(printed.a, printed.g, z);
  assert_true(cimag(z[0]) != 0.0);
  assert_within("angle from π/2", fabs(fabs(carg(z[0])) - 0.5 * PI), 1e-3);
  const Pole end = pole_from_eigenvalue(1.0, pole_edge_vibrating(0.87), 0.87);
  oracle_mass_poles(end.a, end.g, z);
  assert_within("poles apart", cabs(z[0] - z[1]), 1e-7);
  assert_within("σh", fabs(pole_edge_vibrating(0.87) + 0.49999), half_digit(5));
}

/* What a mass of a network plays. */
static void play(Pole pole, double x, double u, double* out) {
  Network* const network = networks_mass(1.0, pole.a, pole.g);
  network->x[0] = x;
  network->v[0] = u;
  for (int n = 0; n < N_FRAMES; ++n) {
    out[n] = network->x[0];
    network_step(network, 1.0);
  }
  network_free(network);
}

static const double omega0 = 125.0 * 2.0 * 3.14159265358979323846;

/* Section 3.9: R e^{−γt/2} cos(μt + φ) starts at x = 1 and at rest with −φ, not with the φ printed.
 */
static void analog_solution_of_section_3_9_has_the_numbers_printed(void** state) {
  (void)state;
  const double mu = sqrt(omega0 * omega0 - 25.0 * 25.0);
  const double phi = atan(25.0 / mu);
  const double r = 1.0 / cos(phi);
  assert_within("R", fabs(r - 1.00050699121789), half_digit(14) + DBL_EPSILON);
  assert_within("μ, relative", fabs(mu / 785.0001752025822 - 1.0), 2.0 * DBL_EPSILON);
  assert_within("φ", fabs(phi - 0.03183636632642), half_digit(14));
  assert_within("x(0)", fabs(r * cos(-phi) - 1.0), 2.0 * DBL_EPSILON);
  assert_within("x'(0) with −φ", fabs(r * (-25.0 * cos(-phi) - mu * sin(-phi))), 1e-12);
  assert_true(fabs(r * (-25.0 * cos(phi) - mu * sin(phi))) > 49.0);
}

/* ω0 = 125 · 2π, γ = 50, h = 1/1000, from 1 and at rest: the network's samples are those of its
 * pole from the discrete start, and (42) with the analog amplitude and phase is up to 0.3 off. */
static void first_test_of_section_3_9_is_met_by_the_discrete_start(void** state) {
  (void)state;
  double played[N_FRAMES];
  const Pole pole = pole_from_analog(1000.0, omega0, 50.0);
  const double r = 0.97467943448090;
  const double angle = 0.8177132374981528;
  double discrete = 0.0;
  double printed[2] = {0.0, 0.0};
  play(pole, 1.0, 0.0, played);
  for (int n = 0; n < N_FRAMES; ++n) {
    const double im = (cos(angle) - (1.0 - pole.a) / r) / sin(angle);
    const double x = pow(r, n) * (cos(n * angle) - im * sin(n * angle));
    discrete = fmax(discrete, fabs(played[n] - x));
    for (int i = 0; i < 2; ++i) {
      const double phi = (i ? -1.0 : 1.0) * 0.03183636632642;
      const double form_42 = 1.00050699121789 * pow(r, n) * cos(n * angle + phi);
      printed[i] = fmax(printed[i], fabs(played[n] - form_42));
    }
  }
  assert_within("r", fabs(pole_radius(pole) - r), half_digit(14) + DBL_EPSILON);
  assert_within("ω_d h", fabs(pole_angle(pole) - angle), 4.0 * DBL_EPSILON);
  /* r is known to 14 digits, and counts n rⁿ⁻¹ times, at most 15. */
  assert_within("discrete start", discrete, 1e-12);
  assert_true(printed[0] > 0.25 && printed[1] > 0.25);
}

/* ω0 = 1708, γ = 500, h = 1/1000, from 1 with 2324: stable, π radians per sample, and of the two
 * real poles the start leaves next to nothing of the smaller. */
static void second_test_of_section_3_9_flips_at_nyquist(void** state) {
  (void)state;
  double played[N_FRAMES];
  double complex z[2];
  const Pole pole = pole_from_analog(1000.0, 1708.0, 500.0);
  oracle_mass_poles(pole.a, pole.g, z);
  const double larger = fmin(creal(z[0]), creal(z[1]));
  assert_int_equal(pole_region(pole), POLE_REAL_AT_PI);
  assert_true(pole_is_stable(pole) && pole_angle(pole) == PI);
  assert_within("radius", fabs(pole_radius(pole) + larger), 1e-12);
  play(pole, 1.0, 2.324, played);
  double worst = 0.0;
  for (int n = 0; n < N_FRAMES; ++n) {
    assert_true((played[n] > 0.0) == (n % 2 == 0));
    worst = fmax(worst, fabs(played[n] - pow(larger, n)));
  }
  /* 2324 is rounded: 0.0002 of another pole is there, at most at the fourth sample. */
  assert_within("from rⁿ cos(πn)", worst, 1e-3);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(closed_form_is_table_1_to_every_digit),
      cmocka_unit_test(eigenvalues_are_table_1_to_every_digit),
      cmocka_unit_test(uncorrected_string_is_sharp_by_0_915_percent),
      cmocka_unit_test(pair_of_figure_11_has_the_limits_printed),
      cmocka_unit_test(line_of_figure_16_passes_where_it_is_said_to),
      cmocka_unit_test(pair_of_figure_15_ends_further_left_than_printed),
      cmocka_unit_test(analog_solution_of_section_3_9_has_the_numbers_printed),
      cmocka_unit_test(first_test_of_section_3_9_is_met_by_the_discrete_start),
      cmocka_unit_test(second_test_of_section_3_9_flips_at_nyquist),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

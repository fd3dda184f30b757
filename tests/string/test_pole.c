#include "core/string/pole.h"

#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

static Pole solve(double rate_hz, double f0_hz, double tau_s) {
  Pole pole = {0};
  assert_int_equal(pole_solve(rate_hz, (Tone){f0_hz, tau_s}, &pole), STATUS_OK);
  return pole;
}

static double relative(double value, double truth) {
  return fabs(value - truth) / fabs(truth);
}

static void example_of_section_3_9_is_met_to_every_digit(void** state) {
  (void)state;
  const Pole pole = pole_from_analog(1000.0, 2.0 * PI * 125.0, 50.0);
  assert_within("r", fabs(pole_radius(pole) - 0.97467943448090), 0.5e-14 + DBL_EPSILON);
  assert_within("ω_d, relative", relative(pole_angle(pole) * 1000.0, 817.7132374981528),
                4.0 * DBL_EPSILON);
  assert_within("τ, relative", relative(pole_tone(1000.0, pole).tau_s, -2e-3 / log1p(-0.05)),
                4.0 * DBL_EPSILON);
}

/* R of Algorithm 2 with tan²(ω_d h), or with the tangent that is given for it. */
static double algorithm_2(double g, double tangent, double sign) {
  return 2.0 - g - sign * 2.0 * sqrt((1.0 - g) / (1.0 + tangent * tangent));
}

static void solution_is_algorithm_2_followed_by_35(void** state) {
  (void)state;
  double worst = 0.0;
  Random random = random_start();
  for (int n = 0; n < 20000; ++n) {
    const double rate_hz = random_log_between(&random, 1000.0, 400000.0);
    const double f0_hz = random_between(&random, 0.001, 0.499) * rate_hz;
    const double tau_s = random_log_between(&random, 1e-3, 1e3);
    const double h = 1.0 / rate_hz;
    const double angle = 2.0 * PI * f0_hz * h;
    const double g = 1.0 - exp(-2.0 * h / tau_s);
    const double gamma = g / h;
    const double big_r = algorithm_2(g, tan(angle), cos(angle) < 0.0 ? -1.0 : 1.0);
    const double mu2 = big_r / (h * h) - gamma * gamma / 4.0;
    /* (35): the eigenvalue −γ/2 ± jμ has ω0² = γ²/4 + μ². */
    const Pole expected = {(gamma * gamma / 4.0 + mu2) * h * h, g};
    const Pole pole = solve(rate_hz, f0_hz, tau_s);
    worst = fmax(worst, fmax(fabs(pole.a - expected.a), fabs(pole.g - expected.g)));
  }
  /* The printed form subtracts numbers of size 2 to 4: a few of their last bits. */
  assert_within("a and g, absolute", worst, 16.0 * DBL_EPSILON);
}

static void slip_1_would_mistake_the_stiffness_for_its_square(void** state) {
  (void)state;
  const double h = 1.0 / 6000.0;
  const Pole pole = solve(6000.0, 440.0, HUGE_VAL);
  const double corrected = sqrt(pole.a / (h * h));
  const double printed = sqrt(pole.a * pole.a) / h;
  assert_within(
      "corrected, cents off",
      1200.0 *
          fabs(log2(pole_tone(6000.0, pole_from_analog(6000.0, corrected, 0.0)).f0_hz / 440.0)),
      1e-9);
  assert_within("printed is ω0 h times that, relative", relative(printed / corrected, sqrt(pole.a)),
                4.0 * DBL_EPSILON);
  assert_true(pole_tone(6000.0, pole_from_analog(6000.0, printed, 0.0)).f0_hz < 205.0);
  /* And with any damping to speak of, γ²/4 is taken from a number below 16: no frequency at all. */
  const double gamma = -expm1(-2.0 * h / 0.1) / h;
  assert_true(pole.a * pole.a - gamma * gamma / 4.0 < 0.0);
}

static void slip_2_would_silence_every_whole_hertz(void** state) {
  (void)state;
  const double g = solve(6000.0, 440.0, 1.0).g;
  const double omega_d = 2.0 * PI * 440.0;
  const Pole corrected = {algorithm_2(g, tan(omega_d / 6000.0), 1.0), g};
  const Pole printed = {algorithm_2(g, tan(omega_d), 1.0), g};
  assert_within("corrected, Hz off", fabs(pole_tone(6000.0, corrected).f0_hz - 440.0), 1e-9);
  assert_true(pole_tone(6000.0, printed).f0_hz < 0.001);
}

static void unwarp_undoes_warp(void** state) {
  (void)state;
  static const double rates_hz[] = {1000.0, 8000.0, 44100.0, 48000.0, 192000.0};
  static const double taus_s[] = {1e-3, 0.01, 0.1, 1.0, 30.0, 1e3, HUGE_VAL};
  double worst_f0 = 0.0;
  double worst_tau = 0.0;
  for (size_t i = 0; i < 5; ++i) {
    for (size_t j = 0; j < 7; ++j) {
      for (int step = 0; step < 200; ++step) {
        /* Closer and closer to 0 below a quarter of the rate, and to Nyquist above it. */
        const double least = 0.25 * pow(0.95, step);
        const double share = step % 2 ? least : 0.5 - 0.99 * least - 1e-4;
        const double f0_hz = share * rates_hz[i];
        const Tone tone = pole_tone(rates_hz[i], solve(rates_hz[i], f0_hz, taus_s[j]));
        /* θ² = a − g²/4 + … cancels as 1 + (1/ωτ)², and near Nyquist sin θ is what is left of it.
         */
        const double per_angle = 1.0 / (2.0 * PI * f0_hz * taus_s[j]);
        const double condition =
            (1.0 + per_angle * per_angle) / sin(2.0 * PI * share) * share * 8.0;
        worst_f0 = fmax(worst_f0, relative(tone.f0_hz, f0_hz) / fmax(1.0, condition));
        if (isinf(taus_s[j])) {
          assert_true(tone.tau_s == HUGE_VAL);
        } else {
          worst_tau = fmax(worst_tau, relative(tone.tau_s, taus_s[j]));
        }
      }
    }
  }
  assert_within("F, relative, over its condition", worst_f0, 16.0 * DBL_EPSILON);
  assert_within("τ, relative", worst_tau, 16.0 * DBL_EPSILON);
}

static void poles_are_the_eigenvalues_of_the_step(void** state) {
  (void)state;
  double worst_radius = 0.0;
  double worst_angle = 0.0;
  Random random = random_start();
  for (int n = 0; n < 20000; ++n) {
    const Pole pole = {random_between(&random, 0.0, 5.0), random_between(&random, 0.0, 2.5)};
    double complex z[2];
    oracle_mass_poles(pole.a, pole.g, z);
    const double complex larger = cabs(z[0]) >= cabs(z[1]) ? z[0] : z[1];
    /* Two poles at a distance apart feel a rounding of the matrix (size 8) as 1/distance. */
    const double condition = 8.0 / cabs(z[0] - z[1]) + 1.0;
    worst_radius = fmax(worst_radius, fabs(pole_radius(pole) - cabs(larger)) / condition);
    if (pole_is_complex(pole)) {
      worst_angle = fmax(worst_angle, fabs(pole_angle(pole) - fabs(carg(larger))) / condition);
    } else if (fabs(creal(z[0] + z[1])) > 1e-9) {
      assert_true(pole_angle(pole) == (creal(larger) < 0.0 ? PI : 0.0));
    }
    assert_int_equal(pole_is_complex(pole), cimag(z[0]) != 0.0);
  }
  assert_within("radius, over its condition", worst_radius, 16.0 * DBL_EPSILON);
  assert_within("angle, over its condition", worst_angle, 64.0 * DBL_EPSILON);
}

/* The discrete motion from x[0] and x[1]: Re(C zⁿ). */
static double complex amplitude_of(double complex z, double x0, double x1) {
  return complex_of(x0, (creal(z) * x0 - x1) / cimag(z));
}

static double complex power(Pole pole, int n) {
  return pow(pole_radius(pole), n) *
         complex_of(cos(n * pole_angle(pole)), sin(n * pole_angle(pole)));
}

static void stepped_mass_is_a_power_of_its_pole(void** state) {
  (void)state;
  double worst = 0.0;
  Random random = random_start();
  for (int trial = 0; trial < 300; ++trial) {
    const double tau_s = trial % 4 == 0 ? HUGE_VAL : random_log_between(&random, 1e-3, 10.0);
    const Pole pole = solve(48000.0, random_between(&random, 500.0, 23500.0), tau_s);
    double x = random_between(&random, -1.0, 1.0);
    double u = random_between(&random, -1.0, 1.0) * sqrt(pole.a);
    const double complex z = power(pole, 1);
    const double complex c = amplitude_of(z, x, x + (1.0 - pole.g) * u - pole.a * x);
    for (int n = 0; n < 200; ++n) {
      worst = fmax(worst, fabs(x - creal(c * power(pole, n))) / cabs(c));
      u -= pole.a * x + pole.g * u;
      x += u;
    }
  }
  /* 200 roundings, each felt as 1/sin θ, which is under 16 from 500 Hz to 23.5 kHz. */
  assert_within("samples, relative to the amplitude", worst, 1e-12);
}

static void continuous_start_is_not_the_discrete_one(void** state) {
  (void)state;
  const double sigma = -25.0;
  const double omega0 = 2.0 * PI * 125.0;
  const double mu = sqrt(omega0 * omega0 - sigma * sigma);
  const Pole pole = pole_from_analog(1000.0, omega0, -2.0 * sigma);
  double x = 1.0;
  double u = 0.0;
  const double complex discrete = amplitude_of(power(pole, 1), 1.0, 1.0 - pole.a);
  const double complex continuous = complex_of(1.0, sigma / mu);
  double worst_discrete = 0.0;
  double worst_continuous = 0.0;
  for (int n = 0; n < 200; ++n) {
    worst_discrete = fmax(worst_discrete, fabs(x - creal(discrete * power(pole, n))));
    worst_continuous = fmax(worst_continuous, fabs(x - creal(continuous * power(pole, n))));
    u -= pole.a * x + pole.g * u;
    x += u;
  }
  assert_within("slip 5 corrected", worst_discrete, 1e-12);
  assert_true(worst_continuous > 0.1);
}

static void nonsense_is_refused_and_nothing_is_written(void** state) {
  (void)state;
  const double nan = (double)NAN;
  const struct {
    double rate_hz;
    Tone tone;
  } bad[] = {
      {nan, {440.0, 1.0}},        {0.0, {440.0, 1.0}},       {-48000.0, {440.0, 1.0}},
      {HUGE_VAL, {440.0, 1.0}},   {48000.0, {nan, 1.0}},     {48000.0, {0.0, 1.0}},
      {48000.0, {-1.0, 1.0}},     {48000.0, {24000.0, 1.0}}, {48000.0, {30000.0, 1.0}},
      {48000.0, {HUGE_VAL, 1.0}}, {48000.0, {440.0, nan}},   {48000.0, {440.0, 0.0}},
      {48000.0, {440.0, -1.0}},
  };
  for (size_t i = 0; i < sizeof(bad) / sizeof(bad[0]); ++i) {
    Pole pole = {1.25, 0.75};
    assert_int_equal(pole_solve(bad[i].rate_hz, bad[i].tone, &pole), STATUS_BAD_ARGUMENT);
    assert_true(pole.a == 1.25 && pole.g == 0.75);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(example_of_section_3_9_is_met_to_every_digit),
      cmocka_unit_test(solution_is_algorithm_2_followed_by_35),
      cmocka_unit_test(slip_1_would_mistake_the_stiffness_for_its_square),
      cmocka_unit_test(slip_2_would_silence_every_whole_hertz),
      cmocka_unit_test(unwarp_undoes_warp),
      cmocka_unit_test(poles_are_the_eigenvalues_of_the_step),
      cmocka_unit_test(stepped_mass_is_a_power_of_its_pole),
      cmocka_unit_test(continuous_start_is_not_the_discrete_one),
      cmocka_unit_test(nonsense_is_refused_and_nothing_is_written),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

#include "tools/figure.h"
#include "tools/figure_plane.h"
#include "tools/figure_scheme.h"
#include "tools/figure_sound.h"

#include "tests/oracle.h"
#include "tests/random.h"

#include <complex.h>
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

static double complex polar(double r, double angle) {
  return oracle_complex(r * cos(angle), r * sin(angle));
}

/* Of the eigenvalues of the step, the one of larger modulus; of a pair, the upper. */
static double complex larger_pole(Pole pole) {
  double complex z[2];
  oracle_mass_poles(pole.a, pole.g, z);
  const double complex larger = cabs(z[0]) > cabs(z[1]) ? z[0] : z[1];
  return oracle_complex(creal(larger), fabs(cimag(larger)));
}

static FigureState anywhere(Random* random) {
  const double x = random_between(random, -1.0, 1.0);
  return (FigureState){.x = x, .u = random_between(random, -1.0, 1.0)};
}

static void euler_feeds_or_starves_an_undamped_mass(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int n = 0; n < 10000; ++n) {
    const Pole pole = {.a = random_log_between(&random, 1e-4, 3.0), .g = 0.0};
    const FigureState old = anywhere(&random);
    const double energy = figure_scheme_energy(pole, old);
    const FigureState forward = figure_scheme_step(FIGURE_FORWARD, pole, old);
    const FigureState backward = figure_scheme_step(FIGURE_BACKWARD, pole, old);
    const double fed = figure_scheme_energy(pole, forward) / energy / (1.0 + pole.a);
    const double starved = figure_scheme_energy(pole, backward) / energy * (1.0 + pole.a);
    worst = fmax(worst, fmax(fabs(fed - 1.0), fabs(starved - 1.0)));
  }
  /* A dozen roundings, none magnified: sums of squares. */
  assert_within("energy, relative", worst, 64.0 * DBL_EPSILON);
}

static void backward_euler_solves_its_own_equation(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int n = 0; n < 10000; ++n) {
    const Pole pole = {random_between(&random, 0.0, 4.0), random_between(&random, 0.0, 2.0)};
    const FigureState old = anywhere(&random);
    const FigureState new = figure_scheme_step(FIGURE_BACKWARD, pole, old);
    worst = fmax(worst, fabs(new.x - old.x - new.u));
    worst = fmax(worst, fabs(new.u - old.u + pole.a* new.x + pole.g* new.u));
  }
  assert_within("residual", worst, 32.0 * DBL_EPSILON);
}

static void engine_plays_symplectic_euler(void** state) {
  (void)state;
  const Pole pole = {.a = 0.3, .g = 0.02};
  FigureState played[200];
  FigureState stepped = {.x = 1.0, .u = -0.2};
  assert_int_equal(figure_scheme_play(pole, stepped, 200, played), STATUS_OK);
  double worst = 0.0;
  for (int n = 0; n < 200; ++n) {
    worst = fmax(worst, fabs(played[n].x - stepped.x) + fabs(played[n].u - stepped.u));
    stepped = figure_scheme_step(FIGURE_SYMPLECTIC, pole, stepped);
  }
  /* The order of the sums may differ: a rounding or two in each of 200 steps. */
  assert_within("engine from the step", worst, 400.0 * DBL_EPSILON);
}

static void borders_part_the_eigenvalues_of_the_step(void** state) {
  (void)state;
  Random random = random_start();
  int n_judged = 0;
  for (int n = 0; n < 50000; ++n) {
    const double w = random_between(&random, 0.01, 2.2);
    const double g = random_between(&random, 0.0, 2.2);
    const double vibrates = figure_plane_border(FIGURE_BORDER_VIBRATES, w);
    const double turns = figure_plane_border(FIGURE_BORDER_TURNS, w);
    const double limit = figure_plane_border(FIGURE_BORDER_LIMIT, w);
    /* On a border rounding decides. */
    if (fabs(g - vibrates) < 1e-9 || fabs(g - turns) < 1e-9 || fabs(g - limit) < 1e-9) {
      continue;
    }
    const double complex larger = larger_pole((Pole){.a = w * w, .g = g});
    assert_true((cimag(larger) > 0.0) == (g < vibrates));
    assert_true((cabs(larger) <= 1.0 + 1e-12) == (g < limit));
    assert_true((creal(larger) < 0.0) == (g > turns));
    ++n_judged;
  }
  assert_true(n_judged > 49000);
}

static void plane_and_mass_are_each_others_inverse(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int n = 0; n < 10000; ++n) {
    const double sigma_h = random_between(&random, -1.0, 0.0);
    const double mu_h = random_between(&random, 0.01, 2.0);
    const Pole pole = figure_plane_mass(sigma_h, mu_h);
    worst = fmax(worst, fabs(figure_plane_sigma(pole) - sigma_h));
    worst = fmax(worst, fabs(figure_plane_mu(pole) - mu_h) * mu_h);
    worst = fmax(worst, fabs(exp(figure_plane_damping(pole)) - cabs(larger_pole(pole))) * 1e-4);
  }
  assert_within("there and back", worst, 1e-12);
}

/* (27) and (34) as equalities, in σ and μ. */
static void corners_lie_on_the_borders(void** state) {
  (void)state;
  double worst = 0.0;
  for (int i = 1; i < 86; ++i) {
    const double mu = 0.01 * i;
    const double s = figure_plane_corner(FIGURE_BORDER_VIBRATES, mu);
    const double t = figure_plane_corner(FIGURE_BORDER_TURNS, mu);
    const double w = 1.0 - sqrt(1.0 + 2.0 * s);
    worst = fmax(worst, fabs(w * w - s * s - mu * mu));
    worst = fmax(worst, fabs(t - (1.0 - sqrt(3.0 - mu * mu))));
  }
  /* Near μ = √3/2 the border is upright and 1 + 2σ near 0: a root magnifies rounding 1e4 times. */
  assert_within("corners", worst, 1e-11);
  assert_within("singular point", fabs(figure_plane_singular_mu() - sqrt(0.75)), 1e-15);
}

static void lines_keep_what_they_are_drawn_for(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int n = 0; n < 10000; ++n) {
    const double angle = random_between(&random, 0.05, PI - 0.05);
    const double damping = -random_log_between(&random, 1e-3, 2.0);
    const double r = exp(damping);
    const double complex wanted = polar(r, angle);
    worst = fmax(worst, cabs(larger_pole(figure_plane_tone(angle, damping)) - wanted));
    const double g = random_between(&random, 1.0 - 0.99 * r * r, 1.0 + 0.99 * r * r);
    const bool is_at_pi = n % 2;
    const Pole real = figure_plane_real(damping, is_at_pi, g);
    worst = fmax(worst, cabs(larger_pole(real) - (is_at_pi ? -r : r)));
  }
  /* Near a double pole rounding is felt as its root over the distance: here up to 1e4 times. */
  assert_within("poles on the lines", worst, 1e-11);
}

static void first_experiment_is_met_by_the_discrete_start_alone(void** state) {
  (void)state;
  FigureState played[400];
  const FigureState rest = {.x = 1.0, .u = 0.0};
  const Pole pole = figure_sound_ring();
  assert_int_equal(figure_scheme_play(pole, rest, 400, played), STATUS_OK);
  double discrete = 0.0;
  double continuous = 0.0;
  for (int n = 0; n < 400; ++n) {
    discrete = fmax(discrete, fabs(played[n].x - figure_sound_discrete(pole, rest, n)));
    continuous = fmax(continuous, fabs(played[n].x - figure_sound_continuous_start(n)));
  }
  assert_within("discrete start [m]", discrete, 1e-12);
  assert_true(continuous > 0.1);
}

static void second_experiment_lies_on_the_oscillator(void** state) {
  (void)state;
  FigureState played[400];
  const Pole pole = figure_sound_retuned();
  const FigureEigenvalue s = figure_sound_eigenvalue();
  assert_int_equal(figure_scheme_play(pole, figure_sound_cosine_start(pole), 400, played),
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

/* The text between the quotes of `index '…'` heads a block of the data. */
static void assert_block(const char* data, const char* index) {
  char head[64];
  const int length = (int)strcspn(index, "'");
  (void)snprintf(head, sizeof(head), "\n\n# %.*s", length, index);
  if (!strstr(data, head)) {
    fail_msg("no block '%.*s'", length, index);
  }
}

static void figures_are_the_papers_and_find_their_data(void** state) {
  (void)state;
  static const unsigned numbers[FIGURE_COUNT] = {3,  4,  5,  8,  9,  10, 11, 12,
                                                 13, 14, 15, 16, 17, 18, 19, 21};
  static char data[200000];
  for (unsigned i = 0; i < FIGURE_COUNT; ++i) {
    const Figure* const figure = figure_at(i);
    assert_int_equal(figure->number, numbers[i]);
    assert_true(*figure->title && *figure->shows && *figure->equation && *figure->source);
    FILE* const file = tmpfile();
    assert_non_null(file);
    assert_int_equal(figure->write(file), STATUS_OK);
    rewind(file);
    const size_t n_bytes = fread(data, 1, sizeof(data) - 1, file);
    (void)fclose(file);
    assert_true(n_bytes > 1000 && n_bytes < sizeof(data) - 1);
    data[n_bytes] = '\0';
    assert_null(strstr(data, "nan"));
    assert_null(strstr(data, "inf"));
    for (const char* at = figure->script; (at = strstr(at, "index '"));) {
      at += strlen("index '");
      assert_block(data, at);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(euler_feeds_or_starves_an_undamped_mass),
      cmocka_unit_test(backward_euler_solves_its_own_equation),
      cmocka_unit_test(engine_plays_symplectic_euler),
      cmocka_unit_test(borders_part_the_eigenvalues_of_the_step),
      cmocka_unit_test(plane_and_mass_are_each_others_inverse),
      cmocka_unit_test(corners_lie_on_the_borders),
      cmocka_unit_test(lines_keep_what_they_are_drawn_for),
      cmocka_unit_test(first_experiment_is_met_by_the_discrete_start_alone),
      cmocka_unit_test(second_experiment_lies_on_the_oscillator),
      cmocka_unit_test(partials_are_the_poles_of_the_dense_string),
      cmocka_unit_test(spectrum_is_a_fourier_sum_that_peaks_at_the_fundamental),
      cmocka_unit_test(figures_are_the_papers_and_find_their_data),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

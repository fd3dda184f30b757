#include "tools/report/figure.h"
#include "tools/report/figure_plane.h"
#include "tools/report/figure_scheme.h"

#include "tests/support/oracle.h"
#include "tests/support/random.h"

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

/* Of the eigenvalues of the step, the one of larger modulus; of a pair, the upper. */
static double complex larger_pole(Pole pole) {
  double complex z[2];
  oracle_mass_poles(pole.a, pole.g, z);
  const double complex larger = cabs(z[0]) > cabs(z[1]) ? z[0] : z[1];
  return complex_of(creal(larger), fabs(cimag(larger)));
}

static FigureState anywhere(Random* random) {
  const double x = random_between(random, -1.0, 1.0);
  return (FigureState){.x = x, .u = random_between(random, -1.0, 1.0)};
}

static void euler_feeds_or_starves_an_undamped_mass(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const Pole pole = {.a = random_log_between(&random, 1e-4, 3.0), .g = 0.0};
    const FigureState old = anywhere(&random);
    const double energy = figure_scheme_energy(pole, old);
    FigureState fed[2];
    FigureState starved[2];
    assert_int_equal(figure_scheme_play(NETWORK_FORWARD, pole, old, 2, fed), STATUS_OK);
    assert_int_equal(figure_scheme_play(NETWORK_BACKWARD, pole, old, 2, starved), STATUS_OK);
    const double gain = figure_scheme_energy(pole, fed[1]) / energy;
    const double rest = figure_scheme_energy(pole, starved[1]) / energy;
    worst = fmax(worst, fabs(gain / (1.0 + pole.a) - 1.0));
    worst = fmax(worst, fabs(rest * (1.0 + pole.a) - 1.0));
  }
  /* A few dozen roundings, none magnified: sums of squares. */
  assert_within("energy, relative", worst, 64.0 * DBL_EPSILON);
}

static void engine_plays_symplectic_euler(void** state) {
  (void)state;
  const Pole pole = {.a = 0.3, .g = 0.02};
  FigureState played[200];
  FigureState stepped = {.x = 1.0, .u = -0.2};
  assert_int_equal(figure_scheme_play(NETWORK_SYMPLECTIC, pole, stepped, 200, played), STATUS_OK);
  double worst = 0.0;
  for (int n = 0; n < 200; ++n) {
    worst = fmax(worst, fabs(played[n].x - stepped.x) + fabs(played[n].u - stepped.u));
    stepped.u -= pole.a * stepped.x + pole.g * stepped.u;
    stepped.x += stepped.u;
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

static void damping_is_the_logarithm_of_the_larger_pole(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int n = 0; n < 10000; ++n) {
    const Pole pole = {random_between(&random, 0.01, 4.0), random_between(&random, 0.0, 2.0)};
    worst = fmax(worst, fabs(exp(figure_plane_damping(pole)) - cabs(larger_pole(pole))));
  }
  /* Near a double pole rounding is felt as its root. */
  assert_within("|z|", worst, 1e-9);
}

/* Read the rows of a block as points, and give each to `judge`. */
static double worst_of_block(unsigned index, const char* name, double (*judge)(double, double)) {
  char line[256] = "";
  double worst = 0.0;
  int n_points = 0;
  FILE* const file = tmpfile();
  assert_non_null(file);
  assert_int_equal(figure_at(index)->write(file), STATUS_OK);
  rewind(file);
  while (fgets(line, sizeof(line), file) && strncmp(line + 2, name, strlen(name)) != 0) {
  }
  while (fgets(line, sizeof(line), file) && *line != '#') {
    char* end = NULL;
    const double x = strtod(line, &end);
    if (end != line) {
      worst = fmax(worst, judge(x, strtod(end, NULL)));
      ++n_points;
    }
  }
  (void)fclose(file);
  assert_true(n_points > 100);
  return worst;
}

/* How far the angle is from the nearest eighth of π. */
static double off_frequency(double sigma, double mu) {
  const double complex z = larger_pole(pole_from_eigenvalue(1.0, sigma, mu));
  const double eighths = carg(z) * 8.0 / PI;
  /* The five decimals of a row weigh as 1/|z| near the singular point. */
  return fabs(eighths - nearbyint(eighths)) * cabs(z) * cabs(z);
}

/* How far ln|z| is from the nearest of those drawn. */
static double off_damping(double sigma, double mu) {
  static const double drawn[] = {-0.05, -0.1, -0.2, -0.3, -0.5, -0.8, -1.2};
  const double r = cabs(larger_pole(pole_from_eigenvalue(1.0, sigma, mu)));
  double nearest = HUGE_VAL;
  for (unsigned i = 0; i < sizeof(drawn) / sizeof(drawn[0]); ++i) {
    nearest = fmin(nearest, fabs(r - exp(drawn[i])));
  }
  return nearest;
}

/* In the other plane: g less the border's at the same ω0 h. */
static double off_vibrating(double sigma, double mu) {
  return fabs(-2.0 * sigma - figure_plane_border(FIGURE_BORDER_VIBRATES, hypot(sigma, mu)));
}

static double off_limit(double sigma, double mu) {
  return fabs(-2.0 * sigma - figure_plane_border(FIGURE_BORDER_LIMIT, hypot(sigma, mu)));
}

static void planes_have_the_same_borders(void** state) {
  (void)state;
  /* Rows are rounded by 5e-6 at most; g leans on σ and on ω0 h twice as much. */
  assert_within("vibrating", worst_of_block(5, "vibrates", off_vibrating), 3e-5);
  assert_within("limit", worst_of_block(12, "border", off_limit), 3e-5);
  assert_within("singular point", fabs(figure_plane_singular_mu() - sqrt(0.75)), 1e-15);
}

static void lines_keep_what_they_are_drawn_for(void** state) {
  (void)state;
  assert_within("frequency, in π/8", worst_of_block(11, "frequency", off_frequency), 2e-4);
  /* At the ends of a branch two poles meet: five decimals are felt as their root. */
  assert_within("modulus", worst_of_block(12, "decay", off_damping), 2.0 * sqrt(1e-5));
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
  static const unsigned numbers[FIGURE_COUNT] = {3,  4,  5,  8,  9,  10, 11, 12, 13,
                                                 14, 15, 16, 17, 18, 19, 21, 31, 32};
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
      cmocka_unit_test(engine_plays_symplectic_euler),
      cmocka_unit_test(borders_part_the_eigenvalues_of_the_step),
      cmocka_unit_test(planes_have_the_same_borders),
      cmocka_unit_test(damping_is_the_logarithm_of_the_larger_pole),
      cmocka_unit_test(lines_keep_what_they_are_drawn_for),
      cmocka_unit_test(figures_are_the_papers_and_find_their_data),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

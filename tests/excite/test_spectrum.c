/* What plays a string gives to each of its modes, told beforehand and as it is. */
#include "core/excite/spectrum.h"

#include "core/excite/bow.h"
#include "core/excite/hammer.h"
#include "core/excite/pluck.h"
#include "tests/support/hammers.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"
#include "tests/support/strung.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

/* What partial k counts in a sum, k to this power; and the octaves whose sums are rehearsed. */
enum { N_POWERS = 3, N_OCTAVES = 4, RATE = 48000 };
static const char* const powers[] = {"displacement", "between", "velocity"};

static _Alignas(CHAIN_ALIGNMENT) char memory[32 * CHAIN_MAX_MASSES];
static double given[CHAIN_MAX_MASSES];
static double told[CHAIN_MAX_MASSES];

/* X_k² of all modes, by the sine of each over all masses. */
static void read_squares(const Strung* strung, double* squares) {
  Motion motion;
  strung_read(strung, &motion);
  for (uint32_t k = 1; k <= motion.n; ++k) {
    const double a = tuning_mode(strung->chain.now, motion.n, k).a;
    double x = 0.0;
    double u = 0.0;
    for (uint32_t i = 0; i < motion.n; ++i) {
      const double sine = 2.0 / (motion.n + 1.0) * sin(PI * k * (i + 1.0) / (motion.n + 1.0));
      x += sine * motion.x[i];
      u += sine * motion.u[i];
    }
    squares[k - 1] = (x * x - x * u + u * u / a) / (1.0 - 0.25 * a);
  }
}

static void tell_squares(const Strung* strung, const Spectrum* spectrum, double* squares) {
  const uint32_t n = strung->chain.n_masses;
  for (uint32_t k = 1; k <= n; ++k) {
    const double cosines[] = {cos(k * spectrum->angles[0]), cos(k * spectrum->angles[1])};
    const Pole mode = tuning_mode(strung->chain.now, n, k);
    squares[k - 1] = spectrum_square(spectrum, k, mode, cosines);
  }
}

static void forget(double* squares) {
  for (uint32_t k = 0; k < CHAIN_MAX_MASSES; ++k) {
    squares[k] = 0.0;
  }
}

/* Sum of the partials `from` to `to`, each times k^power. */
static double sum(const double* squares, uint32_t from, uint32_t to, int power) {
  double all = 0.0;
  for (uint32_t k = from; k <= to; ++k) {
    all += squares[k - 1] * pow(k, power);
  }
  return all;
}

/* Of pulls a_k X_k, largest difference of what is told from what is given, of the largest given. */
static double pluck_and_tell(Strung* strung, Pluck pluck) {
  const uint32_t n = strung->chain.n_masses;
  Pluck one = pluck;
  double most = 0.0;
  double worst = 0.0;
  chain_rest(&strung->chain);
  pluck_pull(&strung->chain, pluck);
  forget(given);
  read_squares(strung, given);
  one.amplitude = 1.0;
  const Spectrum spectrum = spectrum_of_pluck(n, one, strung->angle1);
  tell_squares(strung, &spectrum, told);
  for (uint32_t k = 1; k <= n; ++k) {
    const double a = tuning_mode(strung->chain.now, n, k).a;
    const double is = a * sqrt(given[k - 1]);
    most = fmax(most, is);
    worst = fmax(worst, fabs(is - a * pluck.amplitude * sqrt(told[k - 1])));
  }
  return worst / most;
}

static Pluck any_pluck(Random* random) {
  const double place =
      random_below(random, 4) ? random_between(random, 0.0, 1.0) : 0.25 * random_below(random, 5);
  const double hardness =
      random_below(random, 4) ? random_between(random, 0.0, 1.0) : 0.5 * random_below(random, 3);
  return (Pluck){place, hardness, random_log_between(random, 1e-3, 0.25), 0.0};
}

static Strung any_string(Random* random, uint32_t least, uint32_t most) {
  Strung strung;
  const double limit = random_log_between(random, least, most + 1.0);
  do {
    strung_key(&strung, memory, 21 + random_below(random, 60),
               strung_rate_hz(random_below(random, STRUNG_N_RATES)), (uint32_t)limit, 1e9);
  } while (strung.chain.n_masses < least);
  return strung;
}

/* Whether a wall cuts a finger. */
static bool is_cut(uint32_t n_masses, Pluck pluck) {
  const double width = fmax(2.0 / (n_masses + 1.0), 0.3 * pow(0.005 / 0.3, pluck.hardness));
  return fmin(pluck.place, 1.0 - pluck.place) < width;
}

/* Masses are single points: the fewer are under a finger, the less are they its integral.  The
 * least have three, and two at a wall. */
static void plucks_give_what_is_told(void** state) {
  (void)state;
  Random random = random_start();
  double worst[2] = {0.0};
  for (int trial = 0; trial < 600; ++trial) {
    Strung strung = any_string(&random, SPECTRUM_FEW + 1, 300);
    const Pluck pluck = any_pluck(&random);
    double* const kind = &worst[is_cut(strung.chain.n_masses, pluck)];
    *kind = fmax(*kind, pluck_and_tell(&strung, pluck));
  }
  assert_within("pulls, off, of the largest", worst[0], 0.04);
  assert_within("those of fingers that a wall cuts", worst[1], 0.18);
}

/* A finger as wide as a mode is long has a pole there, at both its edges. */
static void plucks_as_wide_as_a_mode_give_what_is_told(void** state) {
  (void)state;
  double worst = 0.0;
  for (uint32_t n_masses = 51; n_masses <= 99; n_masses += 2) {
    Strung strung;
    strung_key(&strung, memory, 33, RATE, n_masses, 1e9);
    assert_int_equal(strung.chain.n_masses, n_masses);
    for (int p = 1; p <= 4; ++p) {
      worst = fmax(worst, pluck_and_tell(&strung, (Pluck){0.1 * p + 0.02, 1.0, 0.1, 0.0}));
    }
  }
  assert_within("pulls, off, of the largest", worst, 0.04);
}

static void plucks_of_few_masses_give_what_is_told(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 600; ++trial) {
    Strung strung = any_string(&random, 1, SPECTRUM_FEW);
    worst = fmax(worst, pluck_and_tell(&strung, any_pluck(&random)));
  }
  /* Masses are pulled in floats, of whose rounding the stiffest modes make the most. */
  assert_within("pulls, off, of the largest", worst, 3e-5);
}

/* dB that more is told than is given, of sums of all partials. */
static double decibels_over(uint32_t from, uint32_t to, int power, double square) {
  return 10.0 * log10(square * sum(told, from, to, power) / sum(given, from, to, power));
}

typedef struct {
  double least, most, mean, n;
} Span;

static void stretch_to(Span* span, double db) {
  span->least = fmin(span->least, db);
  span->most = fmax(span->most, db);
  span->mean += db;
  span->n += 1.0;
}

static void assert_span(const char* what, Span s, double worst_db, double mean_db) {
  print_message("  %s: %.1f to %.1f dB, %.1f in the mean\n", what, s.least, s.most, s.mean / s.n);
  assert_within("  dB off", fmax(-s.least, s.most), worst_db);
  assert_within("  dB off in the mean", fabs(s.mean / s.n), mean_db);
}

/* What is rehearsed with few masses; higher octaves are too weak to count. */
static void strikes_give_about_what_is_told(void** state) {
  (void)state;
  Random random = random_start();
  Span span[N_POWERS] = {{.n = 0.0}};
  Span octave[N_OCTAVES] = {{.n = 0.0}};
  for (int trial = 0; trial < 200; ++trial) {
    Strung strung = any_string(&random, 2, 128);
    const Strike strike = {random_between(&random, 0.05, 0.3), random_between(&random, 0.0, 1.0),
                           0.25, random_log_between(&random, 0.01, 0.25)};
    const uint32_t n = strung.chain.n_masses;
    uint32_t n_pressed = 0;
    hammers_strike(&strung, strike, &n_pressed);
    forget(given);
    read_squares(&strung, given);
    const Spectrum spectrum = spectrum_of_strike(n, strike, strung.angle1);
    tell_squares(&strung, &spectrum, told);
    for (int p = 0; p < N_POWERS; ++p) {
      stretch_to(&span[p], decibels_over(1, n, p, strike.amplitude * strike.amplitude));
    }
    for (uint32_t b = 0; b < N_OCTAVES && (2u << b) - 1 <= n; ++b) {
      stretch_to(&octave[b],
                 decibels_over(1u << b, (2u << b) - 1, 0, strike.amplitude * strike.amplitude));
    }
  }
  for (int p = 0; p < N_POWERS; ++p) {
    assert_span(powers[p], span[p], 2.0, 0.5);
  }
  for (int b = 0; b < N_OCTAVES; ++b) {
    assert_span("an octave", octave[b], 5.0, 1.5);
  }
}

/* 2 u²/a in the mean: a bow holds the string aside, which is not heard. */
static void add_speeds(const Strung* strung, double* squares, double share) {
  Motion motion;
  strung_read(strung, &motion);
  for (uint32_t k = 1; k <= motion.n; ++k) {
    double u = 0.0;
    for (uint32_t i = 0; i < motion.n; ++i) {
      u += 2.0 / (motion.n + 1.0) * sin(PI * k * (i + 1.0) / (motion.n + 1.0)) * motion.u[i];
    }
    squares[k - 1] += share * 2.0 * u * u / tuning_mode(strung->chain.now, motion.n, k).a;
  }
}

/* From 0.5 s to a second. */
static void bow_it(Strung* strung, double place) {
  Bow bow = {0};
  const Stroke stroke = {place, 0.5, 0.1, 0.04, 0.03};
  bow_start(&bow, &strung->chain, stroke, strung->angle1, RATE);
  forget(given);
  for (int n = 0; n < RATE; ++n) {
    strung_step(strung, 0);
    bow_act(&bow, &strung->chain);
    if (n >= RATE / 2 && n % 121 == 0) {
      add_speeds(strung, given, 121.0 / (RATE / 2));
    }
  }
}

static void bows_give_about_what_is_told(void** state) {
  (void)state;
  static const double places[] = {0.05, 0.08, 0.13, 0.15};
  Span span[N_POWERS] = {{.n = 0.0}};
  for (uint32_t key = 33; key <= 81; key += 8) {
    for (int p = 0; p < 4; ++p) {
      Strung strung;
      strung_key(&strung, memory, key, RATE, 64, 2.0);
      bow_it(&strung, places[p]);
      const Spectrum spectrum = spectrum_of_bow(places[p], strung.angle1);
      tell_squares(&strung, &spectrum, told);
      for (int i = 0; i < N_POWERS; ++i) {
        stretch_to(&span[i], decibels_over(1, strung.chain.n_masses, i, 0.01));
      }
    }
  }
  assert_span(powers[0], span[0], 2.0, 1.5);
  assert_span(powers[1], span[1], 2.5, 1.5);
  /* The corner is not round in the same way on every string. */
  assert_span(powers[2], span[2], 4.5, 1.5);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(plucks_give_what_is_told),
      cmocka_unit_test(plucks_as_wide_as_a_mode_give_what_is_told),
      cmocka_unit_test(plucks_of_few_masses_give_what_is_told),
      cmocka_unit_test(strikes_give_about_what_is_told),
      cmocka_unit_test(bows_give_about_what_is_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* The maps of the margin, row by row against the string counted mode by mode. */
#include "tools/report/figure.h"

#include "tests/support/oracle.h"
#include "tests/support/settings.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

static const double RATE_HZ = 48000.0;

/* The harp's string, made anew. */
static double margin_of(Setting setting, uint32_t key, uint32_t n_masses) {
  const HarpPatch patch = settings_patch(&setting);
  const TuningTarget target = {
      .rate_hz = RATE_HZ,
      .tone = settings_tone(&setting, key, 0.0),
      .loss = patch.string.loss,
      .inharmonicity = patch.string.inharmonicity,
      .partials = patch.string.partials,
  };
  StringCoefs coefs = {0};
  assert_int_equal(tuning_solve(&target, n_masses, &coefs), STATUS_OK);
  return oracle_headroom(coefs, n_masses);
}

static void check_map(unsigned number, SettingName name) {
  const Figure* figure = figure_at(0);
  for (unsigned i = 0; i < FIGURE_COUNT && figure->number != number; ++i) {
    figure = figure_at(i);
  }
  FILE* const file = tmpfile();
  assert_non_null(file);
  assert_int_equal(figure->write(file), STATUS_OK);
  rewind(file);
  char line[128];
  uint32_t n_rows = 0;
  double worst = 0.0;
  double least = 1.0;
  while (fgets(line, sizeof(line), file)) {
    Setting setting = settings_default();
    uint32_t key = 0;
    uint32_t n_masses = 0;
    double margin = 0.0;
    if (sscanf(line, "%u %lf %lf %u", &key, &setting.value[name], &margin, &n_masses) == 4) {
      worst = fmax(worst, fabs(margin / margin_of(setting, key, n_masses) - 1.0));
      const double more = n_masses < 128 ? margin_of(setting, key, n_masses + 1) : 0.0;
      assert_true(margin >= TUNING_MARGIN && more < TUNING_MARGIN);
      least = fmin(least, margin);
      ++n_rows;
    }
  }
  (void)fclose(file);
  assert_int_equal(n_rows, 49 * 128);
  print_message("  %u rows, least margin %g\n", n_rows, least);
  assert_within("margin, relative", worst, 1e-3);
}

/* The file has four digits of a margin. */
static void margins_are_those_of_every_mode(void** state) {
  (void)state;
  check_map(31, SETTING_STIFFNESS);
  check_map(32, SETTING_LOSS);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(margins_are_those_of_every_mode)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

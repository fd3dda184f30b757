/* The energy that the tests watch, against dense matrices. */
#include "tests/support/energy.h"

#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static Motion motion;

static void energy_is_the_quadratic_form_and_falls(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  double worst_step = 0.0;
  for (motion.n = 1; motion.n <= 24; ++motion.n) {
    double stiffness[24 * 24];
    double damping[24 * 24];
    double before[24];
    double x[24];
    const StringCoefs coefs = {.k1 = random_between(&random, 0.1, 0.5),
                               .k2 = random_between(&random, 0.0, 0.1),
                               .z0 = random_between(&random, 0.0, 0.1),
                               .z1 = random_between(&random, 0.0, 0.1),
                               .k3 = random_between(&random, 0.0, 0.01)};
    oracle_forces(coefs, motion.n, stiffness, damping);
    for (uint32_t i = 0; i < motion.n; ++i) {
      motion.x[i] = x[i] = random_between(&random, -1.0, 1.0);
      motion.u[i] = before[i] = random_between(&random, -1.0, 1.0);
    }
    const double drag = oracle_loss(damping, motion.n, before, before);
    const double first = motion_energy(&motion, coefs);
    const double dense = oracle_energy(stiffness, motion.n, x, before) - 0.25 * drag;
    motion_step(&motion, coefs);
    oracle_step(coefs, motion.n, x, before);
    worst = fmax(worst, fabs(first - dense));
    for (uint32_t i = 0; i < motion.n; ++i) {
      worst_step = fmax(worst_step, fabs(x[i] - motion.x[i]) + fabs(before[i] - motion.u[i]));
    }
    assert_true(motion_energy(&motion, coefs) < first);
  }
  assert_within("energy", worst, 1e-13);
  assert_within("step", worst_step, 1e-14);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(energy_is_the_quadratic_form_and_falls)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

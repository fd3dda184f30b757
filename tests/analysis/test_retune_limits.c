#include "core/analysis/retune.h"

#include "core/analysis/modes.h"

#include "tests/support/networks.h"
#include "tests/support/oracle.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

static double relative(double value, double truth) {
  return fabs(value - truth) / fabs(truth);
}

/* A damper on one mass of a string damps less again as it comes to hold the mass still, so there
 * is a shortest τ.  The rate is so high that the analog eigenvalues tell which. */
static void one_damper_can_do_only_so_much(void** state) {
  (void)state;
  Network* const network = networks_string(9, 1.0, 1.0, 0.0);
  network_add_damper(network, 2, 9, 1.0);
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  double reached = 1.0;
  double missed = 1e-6;
  Retuning retuning = {0};
  for (int n = 0; n < 40; ++n) {
    const double tau_s = sqrt(reached * missed);
    const Status status = retune_solve(network, 4.8e6, (Tone){440.0, tau_s}, 1, &retuning);
    *(status ? &missed : &reached) = tau_s;
    assert_true(!status || status == STATUS_UNREACHABLE);
  }
  print_message("  shortest τ at 440 Hz: %.6f ms\n", 1e3 * reached);
  /* −σ/μ of the first mode over all dampers: its peak, at Z = 1.54. */
  double most = 0.0;
  for (double damping = 1.0; damping < 2.0; damping *= 1.001) {
    network->dampers.link[0].value = damping;
    Modes* modes = NULL;
    assert_int_equal(modes_solve(network, 1e4, 1, &modes), STATUS_OK);
    const double complex s = modes->mode[0].analog[0];
    most = fmax(most, -creal(s) / cimag(s));
    modes_free(modes);
  }
  assert_within("of 1/(2π F τ), relative", relative(1.0 / (2.0 * PI * 440.0 * reached), most),
                2e-3);
  network_free(network);
}

static void what_cannot_be_tuned_is_refused(void** state) {
  (void)state;
  Retuning out = {-1.0, -1.0};
  const Tone tone = {100.0, 1.0};
  Network* const network = networks_string(3, 1.0, 2.0, 3.0);
  assert_int_equal(retune_solve(network, 0.0, tone, 1, &out), STATUS_BAD_ARGUMENT);
  assert_int_equal(retune_solve(network, (double)NAN, tone, 1, &out), STATUS_BAD_ARGUMENT);
  assert_int_equal(retune_solve(network, 1e3, (Tone){0.0, 1.0}, 1, &out), STATUS_BAD_ARGUMENT);
  assert_int_equal(retune_solve(network, 1e3, (Tone){(double)NAN, 1.0}, 1, &out),
                   STATUS_BAD_ARGUMENT);
  assert_int_equal(retune_solve(network, 1e3, (Tone){100.0, 0.0}, 1, &out), STATUS_BAD_ARGUMENT);
  assert_int_equal(retune_solve(network, 1e3, (Tone){100.0, (double)NAN}, 1, &out),
                   STATUS_BAD_ARGUMENT);
  assert_int_equal(retune_solve(network, 1e3, (Tone){500.0, 1.0}, 1, &out), STATUS_UNREACHABLE);
  assert_int_equal(retune_solve(network, 1e3, (Tone){HUGE_VAL, 1.0}, 1, &out), STATUS_UNREACHABLE);
  assert_int_equal(retune_solve(network, 1e3, tone, 4, &out), STATUS_NO_SUCH_MODE);
  assert_int_equal(retune_solve(network, 1e3, (Tone){499.0, 1.0}, 1, &out), STATUS_UNSTABLE);
  network_add_mass(network, 1.0, NULL);
  assert_int_equal(retune_solve(network, 1e3, tone, 1, &out), STATUS_BAD_ARGUMENT);
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  /* What hangs on nothing is of 0 Hz, whatever its springs. */
  assert_int_equal(retune_solve(network, 1e3, tone, 1, &out), STATUS_FREE);
  network_free(network);
  Network* const undamped = networks_string(3, 1.0, 2.0, 0.0);
  assert_int_equal(retune_solve(undamped, 1e3, tone, 1, &out), STATUS_UNREACHABLE);
  assert_int_equal(retune_solve(undamped, 1e3, (Tone){100.0, HUGE_VAL}, 1, &out), STATUS_OK);
  network_free(undamped);
}

/* What is overdamped as given can still be tuned: only factors count. */
static void overdamped_networks_are_no_obstacle(void** state) {
  (void)state;
  Network* const light = networks_string(5, 1.0, 10.0, 0.01);
  Network* const heavy = networks_string(5, 1.0, 10.0, 1e4);
  Retuning a = {0};
  Retuning b = {0};
  assert_int_equal(retune_solve(light, 6000.0, (Tone){440.0, 1.0}, 1, &a), STATUS_OK);
  assert_int_equal(retune_solve(heavy, 6000.0, (Tone){440.0, 1.0}, 1, &b), STATUS_OK);
  assert_within("p, relative", relative(b.stiffness_factor, a.stiffness_factor), 8.0 * DBL_EPSILON);
  assert_within("q Z, relative", relative(1e6 * b.damping_factor, a.damping_factor),
                8.0 * DBL_EPSILON);
  network_free(light);
  network_free(heavy);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_damper_can_do_only_so_much),
      cmocka_unit_test(what_cannot_be_tuned_is_refused),
      cmocka_unit_test(overdamped_networks_are_no_obstacle),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

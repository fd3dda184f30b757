#include "tools/report/report_pins.h"

#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void every_number_of_the_paper_is_met(void** state) {
  (void)state;
  unsigned n_pins = 0;
  const ReportPin* const pins = report_pins(&n_pins);
  assert_int_equal(n_pins, 21);
  for (unsigned i = 0; i < n_pins; ++i) {
    assert_within(pins[i].quantity, fabs(report_pin_difference(&pins[i])),
                  report_pin_precision(&pins[i]));
  }
  /* To 20 digits, for the two that doubles gave no better. */
  assert_within("ω0 of a segment", fabs(pins[8].ours(0.0) - 5293.2393003368564032), 2e-12);
  assert_within("γ of a segment", fabs(pins[9].ours(0.0) - 7.4628577364144843712), 1e-14);
}

/* The string that is not tuned does not meet the first partial. */
static void number_can_be_missed(void** state) {
  (void)state;
  unsigned n_pins = 0;
  ReportPin wrong = report_pins(&n_pins)[n_pins - 1];
  assert_within("444.026", fabs(report_pin_difference(&wrong)), 0.5e-3);
  wrong.paper = "440.00000";
  assert_true(report_pin_difference(&wrong) > 4.0);
  assert_true(report_pin_precision(&wrong) < 1.1e-5);
}

static void precision_is_that_of_the_last_digit(void** state) {
  (void)state;
  const ReportPin plain = {.paper = "-0.1954"};
  assert_int_equal(report_pin_decimals(&plain), 4);
  assert_within("0.0001", fabs(report_pin_precision(&plain) - 1e-4), 1e-18);
  const ReportPin rounded = {.paper = "-5.123456789012345", .rounding = 1e-12};
  assert_within("5e-12", fabs(report_pin_precision(&rounded) - 5.123456789012e-12), 1e-23);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_number_of_the_paper_is_met),
      cmocka_unit_test(number_can_be_missed),
      cmocka_unit_test(precision_is_that_of_the_last_digit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

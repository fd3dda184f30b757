#include "core/base/status.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static void every_status_has_a_text_of_its_own(void** state) {
  (void)state;
  for (int s = 0; s < STATUS_COUNT; ++s) {
    const char* const text = status_text((Status)s);
    assert_non_null(text);
    assert_true(strlen(text) > 0);
    for (int other = 0; other < s; ++other) {
      assert_string_not_equal(text, status_text((Status)other));
    }
  }
}

static void what_is_no_status_has_a_text_too(void** state) {
  (void)state;
  const char* const text = status_text(STATUS_COUNT);
  assert_non_null(text);
  assert_true(strlen(text) > 0);
  assert_ptr_equal(text, status_text((Status)(STATUS_COUNT + 1000)));
}

static void success_is_zero(void** state) {
  (void)state;
  assert_int_equal(STATUS_OK, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_status_has_a_text_of_its_own),
      cmocka_unit_test(what_is_no_status_has_a_text_too),
      cmocka_unit_test(success_is_zero),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* What the meters tell of the limit of stability, in both plugins: what is left, and what is used.
 */
#include "core/base/maths.h"
#include "tests/support/plugins.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static double meter(const Host* host, const char* symbol) {
  return (double)host_get(host, symbol);
}

static void play(Host* host, uint32_t key) {
  Sound sound = sound_new(PLUGINS_BLOCK);
  strings_note_on(host, 0, key, 100);
  strings_run(host, &sound, 0, PLUGINS_BLOCK, PLUGINS_BLOCK);
  sound_free(&sound);
}

static void nothing_is_used_at_rest(void** state) {
  (void)state;
  for (int i = 0; i < N_PLUGINS; ++i) {
    Host* const host = plugins_open(i);
    assert_true(host_run(host, PLUGINS_BLOCK));
    assert_true(meter(host, "headroom") == 1.0);
    assert_true(meter(host, "stability_used") == 0.0);
    host_free(host);
  }
}

static void what_is_used_is_not_left(void** state) {
  (void)state;
  for (int i = 0; i < N_PLUGINS; ++i) {
    Host* const host = plugins_open(i);
    for (uint32_t key = 45; key < 70; key += 5) {
      play(host, key);
      assert_true(meter(host, "stability_used") > 0.0 && meter(host, "stability_used") <= 1.0);
      assert_true(fabs(meter(host, "stability_used") + meter(host, "headroom") - 1.0) < 1e-7);
    }
    host_free(host);
  }
}

/* A string of one mass is one oscillator: it uses (a + 2 g)/4 of the limit. */
static void one_mass_uses_what_its_coefficients_say(void** state) {
  (void)state;
  for (int i = 0; i < N_PLUGINS; ++i) {
    Host* const host = plugins_open(i);
    strings_set(host, "masses", 1.0);
    strings_set(host, "damping", 3.0);
    play(host, 69);
    const double step_s = 1.0 / PLUGINS_RATE;
    const double g = -expm1(-2.0 * step_s * 3.0);
    const double turn = cos(2.0 * PI * 440.0 * step_s);
    const double a = 2.0 - g - 2.0 * exp(-step_s * 3.0) * turn;
    print_message("used %g, (a + 2 g)/4 = %g\n", meter(host, "stability_used"),
                  (a + 2.0 * g) / 4.0);
    assert_true(meter(host, "sounding") == 1.0 && meter(host, "mass_count") == 1.0);
    assert_true(fabs(meter(host, "stability_used") / ((a + 2.0 * g) / 4.0) - 1.0) < 1e-6);
    host_free(host);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(nothing_is_used_at_rest),
      cmocka_unit_test(what_is_used_is_not_left),
      cmocka_unit_test(one_mass_uses_what_its_coefficients_say),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

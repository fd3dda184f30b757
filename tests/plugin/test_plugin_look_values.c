/* What the Turtle tells a host of values: units, words, scales and steps, and who may move them. */
#include "tests/support/host_inside.h"
#include "tests/support/panel.h"
#include "tests/support/plugins.h"

#include <lv2/core/lv2.h>
#include <lv2/midi/midi.h>
#include <lv2/port-props/port-props.h>
#include <lv2/units/units.h>

#include <ctype.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static bool is_one_of(const char* symbol, const char* const symbols[], size_t n) {
  bool is_found = false;
  for (size_t i = 0; i < n; ++i) {
    is_found = is_found || !strcmp(symbol, symbols[i]);
  }
  return is_found;
}

/* The conversion of printf() that shows the values of a port which says no unit of LV2's own. All
 * are numbers with a point to a host, which prints garbage for %d. */
static const char* conversion_of(Host* host, uint32_t port) {
  LilvNode* const minimum = panel_get(host, port, LV2_CORE__minimum);
  const double least = (double)lilv_node_as_float(minimum);
  const bool is_whole =
      panel_has(host, port, LV2_CORE__integer) || panel_has(host, port, LV2_CORE__toggled);
  lilv_node_free(minimum);
  return is_whole                                           ? "%.0f"
         : least > 0.0 && least < 0.0005                    ? "%g"
         : !strcmp(host_port_symbol(host, port), "damping") ? "%.2f 1/s"
                                                            : "%.3f";
}

/* A host may print what it is told to, and %f is six decimals.  What it shows beside a number has
 * to be a unit: no letter of a formula, nor once more what is counted. */
static void check_unit(Host* host, uint32_t port) {
  static const char* const of_lv2[] = {"dB", "Hz", "s", "ms", "ct"};
  LilvNode* const unit = panel_get(host, port, LV2_UNITS__unit);
  print_message("%s\n", host_port_symbol(host, port));
  assert_non_null(unit);
  LilvNode* const symbol = panel_of(host, unit, LV2_UNITS__symbol);
  LilvNode* const render = panel_of(host, unit, LV2_UNITS__render);
  assert_true(lilv_node_is_string(symbol) && lilv_node_is_string(render));
  if (!is_one_of(lilv_node_as_string(symbol), of_lv2, sizeof(of_lv2) / sizeof(of_lv2[0]))) {
    const char* const conversion = conversion_of(host, port);
    assert_string_equal(lilv_node_as_string(render), conversion);
    assert_string_equal(lilv_node_as_string(symbol), strstr(conversion, " 1/s") ? "1/s" : "");
  }
  lilv_node_free(render);
  lilv_node_free(symbol);
  lilv_node_free(unit);
}

static void numbers_are_shown_as_one_reads_them(void** state) {
  (void)state;
  panel_check_all(check_unit);
}

static void check_unit_of(const char* symbol, const char* unit_uri) {
  for (int i = 0; i < N_PLUGINS; ++i) {
    Host* const host = plugins_open(i);
    LilvNode* const unit = panel_get(host, host_port_index(host, symbol), LV2_UNITS__unit);
    assert_string_equal(lilv_node_as_uri(unit), unit_uri);
    lilv_node_free(unit);
    host_free(host);
  }
}

static void level_is_in_decibels_and_tuning_in_hertz(void** state) {
  (void)state;
  check_unit_of("level", LV2_UNITS__db);
  check_unit_of("tuning", LV2_UNITS__hz);
  check_unit_of("release", LV2_UNITS__s);
}

static void check_number(Host* host, uint32_t port, const char* predicate) {
  LilvNode* const number = panel_get(host, port, predicate);
  const bool is_whole =
      panel_has(host, port, LV2_CORE__integer) || panel_has(host, port, LV2_CORE__toggled);
  print_message("%s <%s>\n", host_port_symbol(host, port), predicate);
  assert_int_equal(lilv_node_is_int(number), is_whole);
  assert_int_equal(lilv_node_is_float(number), !is_whole);
  lilv_node_free(number);
}

/* A switch has 0 and 1 too: of false and true, lilv makes no number. */
static void check_numbers(Host* host, uint32_t port) {
  check_number(host, port, LV2_CORE__default);
  check_number(host, port, LV2_CORE__minimum);
  check_number(host, port, LV2_CORE__maximum);
}

static void whole_numbers_are_whole_and_others_have_a_point(void** state) {
  (void)state;
  panel_check_all(check_numbers);
}

/* What is above nought and may be many times as much is logarithmic, but for places. */
static void check_scale(Host* host, uint32_t port) {
  static const char* const places[] = {"pickup", "pickup2", "pluck"};
  HostRange range;
  const char* const symbol = host_port_symbol(host, port);
  if (host_range(host, symbol, &range)) {
    const bool is_wide = !range.is_integer && range.min > 0.0f && range.max / range.min > 10.0f;
    print_message("%s\n", symbol);
    assert_int_equal(panel_has(host, port, LV2_PORT_PROPS__logarithmic),
                     is_wide && !is_one_of(symbol, places, sizeof(places) / sizeof(places[0])));
  }
}

static void what_is_wide_is_logarithmic(void** state) {
  (void)state;
  panel_check_all(check_scale);
}

static uint32_t n_points(Host* host, uint32_t port) {
  HostRange range;
  uint32_t n = 0;
  LilvScalePoints* const points = lilv_port_get_scale_points(
      host_plugin(host), lilv_plugin_get_port_by_index(host_plugin(host), port));
  LILV_FOREACH(scale_points, i, points) {
    const LilvScalePoint* const point = lilv_scale_points_get(points, i);
    const float value = lilv_node_as_float(lilv_scale_point_get_value(point));
    assert_true(host_range(host, host_port_symbol(host, port), &range));
    assert_true(value >= range.min && value <= range.max);
    assert_true(isupper((unsigned char)lilv_node_as_string(lilv_scale_point_get_label(point))[0]));
    LILV_FOREACH(scale_points, k, points) {
      const LilvScalePoint* const other = lilv_scale_points_get(points, k);
      assert_int_equal(point == other, lilv_node_equals(lilv_scale_point_get_label(point),
                                                        lilv_scale_point_get_label(other)));
      assert_int_equal(point == other,
                       value == lilv_node_as_float(lilv_scale_point_get_value(other)));
    }
    ++n;
  }
  lilv_scale_points_free(points);
  return n;
}

/* Each value of an enumeration has its word.  Nothing else has: there are hosts that take a knob of
 * two words for a switch, and others that show the word where the number should be. */
static void check_words(Host* host, uint32_t port) {
  HostRange range;
  const uint32_t n = n_points(host, port);
  print_message("%s\n", host_port_symbol(host, port));
  if (panel_has(host, port, LV2_CORE__enumeration)) {
    assert_true(host_range(host, host_port_symbol(host, port), &range));
    assert_true(panel_has(host, port, LV2_CORE__integer));
    assert_true((float)n == range.max - range.min + 1.0f);
    return;
  }
  assert_int_equal(n, 0);
}

static void choices_have_words_and_nothing_else(void** state) {
  (void)state;
  panel_check_all(check_words);
}

/* Of a knob, where 300 would fall between what players think in; and they go where presets are. */
static void check_steps(Host* host, uint32_t port) {
  static const char* const stepped[] = {"level", "tuning", "strum"};
  const char* const symbol = host_port_symbol(host, port);
  LilvNode* const steps = panel_get(host, port, LV2_PORT_PROPS__rangeSteps);
  HostRange range;
  assert_int_equal(steps != NULL, is_one_of(symbol, stepped, sizeof(stepped) / sizeof(stepped[0])));
  if (!steps) {
    return;
  }
  assert_true(host_range(host, symbol, &range) && !range.is_integer);
  for (uint32_t k = 0; k < host_n_presets(host); ++k) {
    assert_true(host_preset(host, host_preset_uri(host, k)));
    const double way =
        (double)(host_get(host, symbol) - range.min) / (double)(range.max - range.min);
    const double at = way * (lilv_node_as_int(steps) - 1);
    assert_true(fabs(at - round(at)) < 1e-3);
  }
  lilv_node_free(steps);
}

static void presets_are_on_the_steps_of_knobs(void** state) {
  (void)state;
  panel_check_all(check_steps);
}

/* What is heard of it comes with the next note, and costs. */
static void check_automation(Host* host, uint32_t port) {
  assert_int_equal(panel_has(host, port, LV2_PORT_PROPS__notAutomatic),
                   !strcmp(host_port_symbol(host, port), "masses"));
}

static void all_but_masses_may_be_automated(void** state) {
  (void)state;
  panel_check_all(check_automation);
}

/* The instruments hear controllers themselves, and a host that bound one as well would apply it
 * twice. */
static void check_binding(Host* host, uint32_t port) {
  LilvNode* const binding = panel_get(host, port, LV2_MIDI__binding);
  assert_null(binding);
  lilv_node_free(binding);
}

static void no_controller_is_applied_twice(void** state) {
  (void)state;
  panel_check_all(check_binding);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(numbers_are_shown_as_one_reads_them),
      cmocka_unit_test(level_is_in_decibels_and_tuning_in_hertz),
      cmocka_unit_test(whole_numbers_are_whole_and_others_have_a_point),
      cmocka_unit_test(what_is_wide_is_logarithmic),
      cmocka_unit_test(choices_have_words_and_nothing_else),
      cmocka_unit_test(presets_are_on_the_steps_of_knobs),
      cmocka_unit_test(all_but_masses_may_be_automated),
      cmocka_unit_test(no_controller_is_applied_twice),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

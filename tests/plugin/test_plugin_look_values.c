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

/* A host prints three digits behind the point for %f; what is less must be shown as %g. */
static void check_unit(Host* host, uint32_t port) {
  const bool has_words =
      panel_has(host, port, LV2_CORE__toggled) || panel_has(host, port, LV2_CORE__enumeration);
  LilvNode* const unit = panel_get(host, port, LV2_UNITS__unit);
  LilvNode* const minimum = panel_get(host, port, LV2_CORE__minimum);
  print_message("%s\n", host_port_symbol(host, port));
  assert_int_equal(unit != NULL, !has_words);
  if (unit) {
    LilvNode* const symbol = panel_of(host, unit, LV2_UNITS__symbol);
    LilvNode* const render = panel_of(host, unit, LV2_UNITS__render);
    const double least = (double)lilv_node_as_float(minimum);
    assert_non_null(symbol);
    assert_non_null(render);
    const char* const percent = strchr(lilv_node_as_string(render), '%');
    assert_true(percent && !strchr(percent + 1, '%'));
    assert_int_equal(percent[1] == 'g', least > 0.0 && least < 0.0005);
    assert_true(lilv_node_as_string(render)[0] != '*');
    lilv_node_free(symbol);
    lilv_node_free(render);
  }
  lilv_node_free(minimum);
  lilv_node_free(unit);
}

static void what_has_no_words_has_a_unit(void** state) {
  (void)state;
  panel_check_all(check_unit);
}

/* What is above nought and may be many times as much is logarithmic, but for places. */
static void check_scale(Host* host, uint32_t port) {
  static const char* const places[] = {"pickup", "pickup2", "pluck"};
  HostRange range;
  const char* const symbol = host_port_symbol(host, port);
  if (host_range(host, symbol, &range)) {
    const bool is_wide = !range.is_integer && range.min > 0.0f && range.max / range.min > 20.0f;
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
      cmocka_unit_test(what_has_no_words_has_a_unit),
      cmocka_unit_test(what_is_wide_is_logarithmic),
      cmocka_unit_test(choices_have_words_and_nothing_else),
      cmocka_unit_test(presets_are_on_the_steps_of_knobs),
      cmocka_unit_test(all_but_masses_may_be_automated),
      cmocka_unit_test(no_controller_is_applied_twice),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* What a host writes into a control port, be it out of range, no number or nothing at all. */
#include "plugin/strings_ports.h"
#include "tests/support/host_inside.h"
#include "tests/support/strings_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

/* What a host never connects is at its default, so with none connected it sounds as with all. */
static void an_instance_comes_up_at_its_defaults(void** state) {
  (void)state;
  Sound sounds[2] = {sound_new(9600), sound_new(9600)};
  for (int i = 0; i < 2; ++i) {
    Host* const host = strings_open(48000.0, 960);
    for (uint32_t port = 0; i == 1 && port < host_n_ports(host); ++port) {
      if (host_port_is_control_input(host, port)) {
        host_connect(host, port, NULL);
      }
    }
    strings_note_on(host, 10, 50, 100);
    strings_note_off(host, 5000, 50);
    strings_run(host, &sounds[i], 0, 9600, 960);
    host_free(host);
  }
  assert_true(sound_is_same(&sounds[0], &sounds[1]));
  sound_free(&sounds[0]);
  sound_free(&sounds[1]);
}

/* One note of few masses. */
static Sound play_partials(double value) {
  Host* const host = strings_open(48000.0, 960);
  Sound sound = sound_new(4800);
  strings_set(host, "partials", value);
  strings_set(host, "masses", 30);
  strings_note_on(host, 10, 40, 100);
  strings_run(host, &sound, 0, 4800, 960);
  host_free(host);
  return sound;
}

static void partials_between_settings_are_the_nearest(void** state) {
  static const double near[3][2] = {{-0.4, 0.49}, {0.51, 1.49}, {1.51, 2.4}};
  (void)state;
  for (int setting = 0; setting < 3; ++setting) {
    Sound whole = play_partials(setting);
    Sound next = play_partials((setting + 1) % 3);
    assert_false(sound_is_same(&whole, &next));
    for (int i = 0; i < 2; ++i) {
      Sound sound = play_partials(near[setting][i]);
      assert_true(sound_is_same(&sound, &whole));
      sound_free(&sound);
    }
    sound_free(&whole);
    sound_free(&next);
  }
}

/* Whether a port is for the sound, and not for the host. */
static bool is_of_the_sound(Host* host, uint32_t port) {
  return host_port_is_control_input(host, port) && port != PORT_ENABLED && port != PORT_FREEWHEEL;
}

/* One note with every sounding port at `value`, or at the end of its range that is given. */
static Sound play_with(double value, bool is_end) {
  Host* const host = strings_open(48000.0, 960);
  Sound sound = sound_new(4800);
  for (uint32_t i = 0; i < STRINGS_N_PORTS; ++i) {
    HostRange range;
    if (!is_of_the_sound(host, i)) {
      continue;
    }
    assert_true(host_range(host, host_port_symbol(host, i), &range));
    const double end = (double)(value < 0.0 ? range.min : range.max);
    strings_set(host, host_port_symbol(host, i), is_end ? end : value);
  }
  strings_set(host, "pickup", 0.4); /* At the ends there is nothing to hear */
  strings_note_on(host, 10, 50, 100);
  strings_run(host, &sound, 0, 4800, 960);
  host_free(host);
  return sound;
}

static void what_is_out_of_range_is_clamped(void** state) {
  static const double values[] = {-1e30, 1e30, -HUGE_VAL, HUGE_VAL};
  (void)state;
  for (int i = 0; i < 4; ++i) {
    Sound clamped = play_with(values[i], false);
    Sound end = play_with(values[i], true);
    assert_true(sound_is_same(&clamped, &end));
    sound_free(&clamped);
    sound_free(&end);
  }
}

static void what_is_no_number_is_the_default(void** state) {
  (void)state;
  Sound sounds[2] = {sound_new(4800), sound_new(4800)};
  for (int i = 0; i < 2; ++i) {
    Host* const host = strings_open(48000.0, 960);
    for (uint32_t port = 0; i == 1 && port < host_n_ports(host); ++port) {
      if (host_port_is_control_input(host, port)) {
        strings_set(host, host_port_symbol(host, port), (double)NAN);
      }
    }
    strings_note_on(host, 10, 50, 100);
    strings_run(host, &sounds[i], 0, 4800, 960);
    host_free(host);
  }
  assert_true(sound_is_same(&sounds[0], &sounds[1]));
  sound_free(&sounds[0]);
  sound_free(&sounds[1]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(an_instance_comes_up_at_its_defaults),
      cmocka_unit_test(partials_between_settings_are_the_nearest),
      cmocka_unit_test(what_is_out_of_range_is_clamped),
      cmocka_unit_test(what_is_no_number_is_the_default),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

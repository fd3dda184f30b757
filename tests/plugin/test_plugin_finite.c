/* Whatever numbers come in, by ports, messages, scripts or the host's rate, what comes out is a
 * number, with the limiter on or off. */
#include "tests/support/guitar_host.h"
#include "tests/support/guitar_storm.h"
#include "tests/support/host_inside.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/plugins.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { BLOCK = 512, HUGE_MESSAGE = 1 << 16 };

static const float odd_values[] = {NAN,     INFINITY, -INFINITY, 1e38f,        -1e38f,
                                   FLT_MAX, -FLT_MAX, FLT_MIN,   1e-45f,       -1e-45f,
                                   -0.0f,   1e9f,     -1e9f,     4294967296.0f};
enum { N_ODD = sizeof(odd_values) / sizeof(odd_values[0]) };

static Host* open_plugin(int plugin, double rate_hz) {
  return plugin ? guitar_open(rate_hz, BLOCK) : strings_open(rate_hz, BLOCK);
}

static void run(Host* host, uint32_t n_blocks) {
  for (uint32_t i = 0; i < n_blocks; ++i) {
    if (!host_run(host, BLOCK)) {
      fail_msg("%s", host_error(host));
    }
    for (uint32_t side = 0; side < 2; ++side) {
      assert_true(isfinite(measure_peak(host_output(host, side), BLOCK)));
    }
    assert_true(isfinite(host_get(host, "headroom")));
  }
}

/* With wheels up and down, and a pedal. */
static void play(Host* host) {
  for (uint32_t key = 0; key < 128; key += 21) {
    strings_note_on(host, key, key, 127);
  }
  strings_controller(host, 50, STRINGS_PEDAL, 127);
  strings_controller(host, 60, 1, 127);
  strings_midi(host, 100, 0xE0, 127, 127);
  strings_midi(host, 300, 0xE0, 0, 0);
  run(host, 3);
}

static void set_all(Host* host, double value) {
  for (uint32_t i = 0; i < host_n_ports(host); ++i) {
    if (host_port_is_control_input(host, i)) {
      strings_set(host, host_port_symbol(host, i), value);
    }
  }
}

static void set_usual(Host* host) {
  for (uint32_t i = 0; i < host_n_ports(host); ++i) {
    HostRange range;
    if (host_range(host, host_port_symbol(host, i), &range)) {
      strings_set(host, host_port_symbol(host, i), (double)range.initial);
    }
  }
  strings_set(host, "limiter", 0.0);
}

/* Each port alone, while a note of all exciters rings, and all of them at once. */
static void any_value_of_any_port(void** state) {
  (void)state;
  for (int plugin = 0; plugin < N_PLUGINS; ++plugin) {
    Host* const host = open_plugin(plugin, 48e3);
    for (uint32_t i = 0; i < host_n_ports(host); ++i) {
      if (!host_port_is_control_input(host, i)) {
        continue;
      }
      for (int v = 0; v < N_ODD; ++v) {
        set_usual(host);
        if (plugin == 0) {
          strings_set(host, "exciter", v % 3);
          strings_set(host, "resonance", v % 2);
        }
        strings_note_on(host, 0, 45, 100);
        run(host, 1);
        strings_set(host, host_port_symbol(host, i), (double)odd_values[v]);
        strings_note_on(host, 0, 57, 100);
        run(host, 2);
        strings_controller(host, 0, STRINGS_SOUND_OFF, 0);
      }
    }
    for (int v = 0; v < N_ODD; ++v) {
      set_all(host, (double)odd_values[v]);
      play(host);
      set_usual(host);
      play(host);
      strings_controller(host, 0, STRINGS_SOUND_OFF, 0);
    }
    host_free(host);
  }
}

/* Up to the most that an instance takes. */
static void any_rate(void** state) {
  static const double rates_hz[] = {1e-3, 0.5,    1.0,   7.0,   100.0, 1999.0,
                                    8e3,  44.1e3, 192e3, 768e3, 1e7,   1e9};
  (void)state;
  for (int plugin = 0; plugin < N_PLUGINS; ++plugin) {
    for (size_t i = 0; i < sizeof(rates_hz) / sizeof(rates_hz[0]); ++i) {
      for (int exciter = 0; exciter < (plugin ? 1 : 3); ++exciter) {
        Host* const host = open_plugin(plugin, rates_hz[i]);
        strings_set(host, "limiter", 0.0);
        if (plugin == 0) {
          strings_set(host, "exciter", exciter);
          strings_set(host, "resonance", 1.0);
        }
        play(host);
        run(host, 10);
        host_free(host);
      }
    }
  }
}

/* All keys at the lowest and the highest pitch that there is, and between; wheels and tunings at
 * their widest. */
static void any_pitch(void** state) {
  static const uint8_t pitches[][3] = {{0, 0, 0}, {127, 127, 126}, {127, 127, 127},
                                       {0, 0, 1}, {64, 64, 64},    {127, 0, 0}};
  (void)state;
  for (int plugin = 0; plugin < N_PLUGINS; ++plugin) {
    Host* const host = open_plugin(plugin, 48e3);
    set_usual(host);
    for (size_t p = 0; p < sizeof(pitches) / sizeof(pitches[0]); ++p) {
      for (uint8_t key = 0; key < 128; key += 21) {
        const uint8_t* const to = pitches[p];
        const uint8_t retune[] = {0xF0, 0x7F, 0x7F,  0x08,  0x02,  0,
                                  1,    key,  to[0], to[1], to[2], 0xF7};
        assert_true(host_midi(host, 0, retune, sizeof(retune)));
      }
      for (uint32_t coarse = 0; coarse < 128; coarse += 127) {
        strings_controller(host, 0, 101, 0);
        strings_controller(host, 0, 100, 2);
        strings_controller(host, 0, 6, coarse);
        strings_controller(host, 0, 100, 0);
        strings_controller(host, 0, 6, 127);
        play(host);
      }
    }
    host_free(host);
  }
}

/* As long as they are, and of any bytes. */
static void any_message(void** state) {
  static uint8_t bytes[HUGE_MESSAGE];
  Random random = random_start();
  (void)state;
  for (int plugin = 0; plugin < N_PLUGINS; ++plugin) {
    Host* const host = open_plugin(plugin, 48e3);
    set_usual(host);
    for (int i = 0; i < 200; ++i) {
      const uint32_t size = i < 4 ? HUGE_MESSAGE : random_below(&random, 600);
      for (uint32_t b = 0; b < size; ++b) {
        bytes[b] = (uint8_t)random_below(&random, 128);
      }
      const uint8_t head[] = {0xF0, i % 2 ? 0x7F : 0x7E, 0x7F, 0x08, (uint8_t)(i / 2 % 10)};
      memcpy(bytes, head, size < sizeof(head) ? size : sizeof(head));
      if (size > 0) {
        bytes[size - 1] = 0xF7;
      }
      assert_true(host_midi(host, 0, bytes, size));
      for (uint32_t e = 0; plugin == 1 && e < 4; ++e) {
        GuitarEvent event = guitar_storm_event(&random);
        event.value[e % 3] = odd_values[random_below(&random, N_ODD)];
        guitar_send(host, e, event);
      }
      strings_note_on(host, 8, 40 + (uint32_t)i % 40, 100);
      run(host, 2);
    }
    host_free(host);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(any_value_of_any_port),
      cmocka_unit_test(any_rate),
      cmocka_unit_test(any_pitch),
      cmocka_unit_test(any_message),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Whatever comes in, in whatever blocks: what goes out is finite and bounded, no string is near its
 * limit, and nothing sticks. */
#include "tests/support/host_inside.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"
#include "tests/support/strings_host.h"

#include <lv2/atom/atom.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

enum { LARGEST = 4096, MOST_EVENTS = 12, MOST_BYTES = 9 };

/*
  Eight times full scale, at the level's +12 dB.  A storm meets, now and then, strings that are bent
  up by seven octaves while they are read by their velocity, which grows by as much; an instability
  would be beyond any bound in some hundred frames.
*/
static const double MOST_PEAK = 8.0 * 3.9811;
static const double MOST_BENT = 16.0;

typedef struct {
  double rate_hz;
  double seconds;
  double most_masses; /* The strings' cost is theirs */
  bool is_limited;    /* Nobody turns the limiter off */
} Weather;

/* A minute in all, and over ten in a long run; short where a frame costs much. */
static const Weather weathers[] = {
    {8000.0, 20.0, 1024.0, false}, {44100.0, 15.0, 256.0, true}, {44100.0, 15.0, 256.0, false},
    {48000.0, 10.0, 1024.0, true}, {192000.0, 2.0, 256.0, true}, {768000.0, 0.4, 64.0, false},
};

typedef struct {
  Host* host;
  Random* random;
  const Weather* weather;
  unsigned n_plucks;
  double peak;
  double least_headroom;
} Storm;

static double odd_value(Random* random) {
  static const double values[] = {(double)NAN, HUGE_VAL, -HUGE_VAL, 1e30,  -1e30, 1e-40,
                                  -1e-40,      0.0,      -0.0,      1e-30, -1.0,  1e9};
  return values[random_below(random, sizeof(values) / sizeof(values[0]))];
}

static void move_port(Storm* storm) {
  Random* const random = storm->random;
  const char* const symbol =
      host_port_symbol(storm->host, random_below(random, host_n_ports(storm->host)));
  HostRange range;
  if (!host_range(storm->host, symbol, &range)) {
    return;
  }
  const double low = (double)range.min;
  const double high = (double)range.max;
  const uint32_t choice = random_below(random, 8);
  const double value = choice == 0   ? odd_value(random)
                       : choice == 1 ? low
                       : choice == 2 ? high
                       : low > 0.0   ? random_log_between(random, low, high)
                                     : random_between(random, low, high);
  strings_set(storm->host, symbol, value);
}

/* Half of them are notes, or a storm would soon be over. */
static uint32_t make_message(Storm* storm, uint8_t* bytes) {
  static const uint8_t statuses[] = {0x90, 0x90, 0x90, 0x90, 0x90, 0x80,
                                     0xB0, 0xB0, 0xB0, 0xE0, 0xA0, 0xD0};
  static const uint8_t controllers[] = {1,  2,  6,  7,   11,  38,  64,  64,  66,  67,
                                        74, 96, 97, 100, 101, 120, 121, 123, 127, 0};
  Random* const random = storm->random;
  const uint32_t n_bytes = random_below(random, MOST_BYTES);
  for (uint32_t i = 0; i < MOST_BYTES; ++i) {
    bytes[i] = (uint8_t)random_below(random, 256);
  }
  if (random_below(random, 5) == 0) {
    return n_bytes;
  }
  bytes[0] = (uint8_t)(statuses[random_below(random, sizeof(statuses))] | (bytes[0] & 15));
  bytes[1] =
      (bytes[0] & 0xF0) == 0xB0 ? controllers[bytes[1] % sizeof(controllers)] : bytes[1] & 0x7F;
  bytes[2] &= 0x7F;
  return (bytes[0] & 0xF0) == 0xD0 ? 2 : 3;
}

/* One of the registered parameters, some value of it: bend range, tunings, zones. */
static void set_parameter(Storm* storm) {
  static const uint8_t parameters[] = {0, 1, 2, 6, 127};
  Random* const random = storm->random;
  const uint8_t status = (uint8_t)(0xB0 | (random_below(random, 2) ? 15 * random_below(random, 2)
                                                                   : random_below(random, 16)));
  const uint8_t parameter = parameters[random_below(random, sizeof(parameters))];
  const uint8_t steps[3][3] = {
      {status, 101, parameter == 127 ? 127 : 0},
      {status, 100, parameter},
      {status, random_below(random, 4) ? 6 : 38, (uint8_t)random_below(random, 128)}};
  for (int i = 0; i < 3; ++i) {
    assert_true(host_midi(storm->host, 0, steps[i], 3));
  }
}

static void send_messages(Storm* storm, uint32_t n_frames) {
  const uint32_t n_events = random_below(storm->random, MOST_EVENTS + 1);
  for (uint32_t i = 0; i < n_events; ++i) {
    uint8_t bytes[MOST_BYTES];
    const uint32_t size = make_message(storm, bytes);
    const uint32_t frame = random_below(storm->random, n_frames + 1);
    storm->n_plucks += size == 3 && (bytes[0] & 0xF0) == 0x90;
    if (random_below(storm->random, 10) == 0) {
      const int64_t anywhere = (int64_t)random_between(storm->random, -1e4, 1e4);
      assert_true(host_midi_raw(storm->host, anywhere, bytes, size));
    } else if (n_frames > 0) {
      assert_true(host_midi(storm->host, frame < n_frames ? frame : n_frames - 1, bytes, size));
    }
    if (random_below(storm->random, 20) == 0) {
      assert_true(host_atom(storm->host, 0, LV2_ATOM__Object, bytes, size));
    }
  }
}

static void run_and_look(Storm* storm, uint32_t n_frames) {
  if (!host_run(storm->host, n_frames)) {
    fail_msg("%s", host_error(storm->host));
  }
  for (uint32_t side = 0; side < 2; ++side) {
    const double peak = measure_peak(host_output(storm->host, side), n_frames);
    assert_true(isfinite(peak));
    storm->peak = fmax(storm->peak, peak);
  }
  const double headroom = (double)host_get(storm->host, "headroom");
  assert_true(headroom >= 0.0 && headroom <= 1.0);
  storm->least_headroom = fmin(storm->least_headroom, headroom);
}

/* Nothing may stick, whatever the ports were last set to. */
static void calm(Storm* storm) {
  strings_set(storm->host, "enabled", 1.0);
  /* Members of a zone leave that to their leader. */
  for (unsigned channel = 0; channel < 16; ++channel) {
    strings_midi(storm->host, 0, 0xB0 | channel, STRINGS_SOUND_OFF, 0);
  }
  for (double at = 0.0; at < storm->weather->rate_hz; at += LARGEST) {
    run_and_look(storm, LARGEST);
  }
  assert_true(host_get(storm->host, "sounding") == 0.0f);
  assert_true(measure_peak(host_output(storm->host, 0), LARGEST) == 0.0);
  assert_true(measure_peak(host_output(storm->host, 1), LARGEST) == 0.0);
}

static void a_storm_is_survived(void** state) {
  const Weather* const weather = *(const Weather* const*)state;
  Random random = random_start();
  Storm storm = {.host = strings_open(weather->rate_hz, LARGEST),
                 .random = &random,
                 .weather = weather,
                 .least_headroom = 1.0};
  const double seconds = (getenv("HOOKE_TEST_LONG") ? 10.0 : 1.0) * weather->seconds;
  double frames_left = seconds * weather->rate_hz;
  while (frames_left > 0.0) {
    const uint32_t n_frames = (uint32_t)random_log_between(&random, 1.0, LARGEST + 2.0) - 1;
    for (uint32_t i = random_below(&random, 4); i > 0; --i) {
      move_port(&storm);
    }
    if (weather->is_limited) {
      strings_set(storm.host, "limiter", 1.0);
    }
    const double masses = (double)host_get(storm.host, "masses");
    strings_set(storm.host, "masses",
                masses < weather->most_masses ? masses : weather->most_masses);
    if (n_frames > 0 && random_below(&random, 20) == 0) {
      set_parameter(&storm);
    }
    send_messages(&storm, n_frames);
    run_and_look(&storm, n_frames);
    frames_left -= n_frames;
  }
  calm(&storm);
  print_message("%g s at %g Hz, %u plucks, least headroom %g\n", seconds, weather->rate_hz,
                storm.n_plucks, storm.least_headroom);
  assert_within("peak", storm.peak, weather->is_limited ? 1.0 : MOST_PEAK * MOST_BENT);
  assert_true(storm.peak > 0.0 && storm.n_plucks > 50);
  host_free(storm.host);
}

int main(void) {
  enum { N_WEATHERS = sizeof(weathers) / sizeof(weathers[0]) };
  struct CMUnitTest tests[N_WEATHERS];
  for (size_t i = 0; i < N_WEATHERS; ++i) {
    tests[i] = (struct CMUnitTest)cmocka_unit_test_prestate(a_storm_is_survived,
                                                            (void*)(uintptr_t)&weathers[i]);
  }
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Nothing that a player, a host or a file can swing feeds what rings, in time with it or at random:
 * no note is louder for it, storms stay bounded without the limiter, and the next note is right. */
#include "tests/support/guitar_host.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/swings.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 4096, MOST_PORTS = 4, N_KEYS = 3 };
enum { N_RATIOS = 11, N_PARTIALS = 5, N_PERIODS = N_RATIOS * N_PARTIALS + 2 };

/* How long a note is listened to that nothing swings [s]. */
static const double STILL_S = 0.6;

/* What nobody hears as louder, and what storms may reach [full scale]. */
static const double MOST_LOUDER_DB = 3.0;
static const double MOST_PEAK = 8.0;

/* What the instrument promises of a note, and what nobody hears of its level. */
static const double MOST_CENTS = 0.005;
static const double MOST_LEVEL_DB = 0.01;

static bool is_long(void) {
  return getenv("HOOKE_TEST_LONG");
}

static double decibels(double ratio) {
  return 20.0 * log10(ratio);
}

/* As they come, but that nobody limits it, and that displacements are heard: velocities grow with
 * the pitch. */
static void put_ports_back(Host* host) {
  HostRange range;
  for (uint32_t i = 0; host_symbol(host, i); ++i) {
    if (host_range(host, host_symbol(host, i), &range)) {
      strings_set(host, host_symbol(host, i), (double)range.initial);
    }
  }
  strings_set(host, "limiter", 0.0);
  if (host_range(host, "sense", &range)) {
    strings_set(host, "sense", 0.0);
  }
}

static void put_back(Host* host) {
  strings_restart(host);
  put_ports_back(host);
}

/* The search: one note, held, and one thing that swings */

/* What is played. */
typedef struct {
  int plugin;
  int exciter;
  double resonance;
  const Swing* swing;
  uint32_t range; /* Of the wheel [semitones] */
} Played;

static void set_up(Host* host, const Played* played) {
  put_back(host);
  strings_set(host, "damping", 0.05);
  strings_set(host, "masses", 40.0);
  if (played->plugin == 0) {
    strings_set(host, "exciter", played->exciter);
    strings_set(host, "resonance", played->resonance);
  }
  swings_set_range(host, played->range);
}

/* At either end and between. */
static double loudest_still(Host* host, const Played* played, SwingTrial trial) {
  double loudest = 0.0;
  trial.seconds = STILL_S;
  for (trial.end = -1.0; trial.end <= 1.0; trial.end += 1.0) {
    set_up(host, played);
    loudest = fmax(loudest, swings_play(host, &trial).rms);
  }
  return loudest;
}

/* The `i`-th: every ratio to the period of each of the first partials, and at random, fast and
 * slow. */
static void choose_period(uint32_t i, SwingTrial* trial, Random* random) {
  static const double ratios[N_RATIOS] = {0.25, 1.0 / 3.0, 0.5, 2.0 / 3.0, 0.8, 1.0,
                                          1.25, 1.5,       2.0, 3.0,       4.0};
  const double period = trial->rate_hz / (440.0 * exp2((trial->key - 69.0) / 12.0));
  const uint32_t in_time = N_RATIOS * N_PARTIALS;
  trial->random = i < in_time ? NULL : random;
  trial->period = i < in_time    ? period * ratios[i % N_RATIOS] / (i / N_RATIOS + 1)
                  : i == in_time ? period
                                 : 20.0 * period;
}

/* By how much swings make a key louder [dB]; in a short run a few of the periods, others each time.
 */
static double search_key(Host* host, const Played* played, uint32_t key, Random* random) {
  SwingTrial trial = {.swing = played->swing, .rate_hz = RATE, .key = key};
  const double still = loudest_still(host, played, trial);
  const uint32_t step = is_long() ? 1 : N_PERIODS / 2;
  double loudest = 0.0;
  for (uint32_t i = random_below(random, step); i < N_PERIODS; i += step) {
    choose_period(i, &trial, random);
    trial.seconds = !is_long() ? STILL_S : random_below(random, 20) > 0 ? 3.0 : 120.0;
    set_up(host, played);
    loudest = fmax(loudest, swings_play(host, &trial).rms);
  }
  return decibels(loudest / still);
}

static double search_keys(Host* host, const Played* played, Random* random) {
  static const uint32_t keys[N_KEYS] = {33, 45, 69};
  double worst = -HUGE_VAL;
  if (!is_long()) {
    return search_key(host, played, keys[random_below(random, N_KEYS)], random);
  }
  for (uint32_t k = 0; k < N_KEYS; ++k) {
    worst = fmax(worst, search_key(host, played, keys[k], random));
  }
  return worst;
}

/* With all exciters, on the bridge and off it, and all ranges. */
static double search_swing(Host* host, int plugin, const Swing* swing, Random* random) {
  static const double resonances[] = {0.0, 0.7, 1.0};
  static const uint32_t ranges[] = {2, 12, 24};
  const int n_ways = plugin ? 1 : 3;
  double worst = -HUGE_VAL;
  for (int exciter = 0; exciter < n_ways; ++exciter) {
    for (int r = 0; r < n_ways; ++r) {
      for (int w = 0; w < (swing->has_ranges ? 3 : 1); ++w) {
        const Played played = {plugin, exciter, resonances[r], swing, ranges[w]};
        worst = fmax(worst, search_keys(host, &played, random));
      }
    }
  }
  return worst;
}

static void no_swing_makes_a_note_louder(void** state) {
  (void)state;
  Random random = random_start();
  double worst = -HUGE_VAL;
  for (int plugin = 0; plugin < N_PLUGINS; ++plugin) {
    Host* const host = plugin ? guitar_open(RATE, BLOCK) : strings_open(RATE, BLOCK);
    for (uint32_t i = 0; i < swings_count; ++i) {
      if (swings[i].has[plugin]) {
        const double db = search_swing(host, plugin, &swings[i], &random);
        print_message("  %-8s %-12s %6.2f dB\n", plugin ? "guitar" : "strings", swings[i].name, db);
        worst = fmax(worst, db);
      }
    }
    host_free(host);
  }
  assert_within("louder than without [dB]", worst, MOST_LOUDER_DB);
}

/* What was seen of version 0.2.0 */

typedef struct {
  const char* symbol;
  double value;
} Port;

/* Notes, one after the other or one held, while wheels go to and fro. */
typedef struct {
  const char* what;
  double rate_hz;
  const char* preset; /* NULL: the defaults */
  Port ports[MOST_PORTS];
  uint32_t range;      /* Of the wheel [semitones]; 0: it stays */
  double swings_per_s; /* Of the wheel, or of the mod wheel */
  bool is_mod;
  bool is_zone; /* A zone of MPE, whose second channel plays */
  bool is_pedal;
  double notes_per_s; /* 0: one, held */
  uint32_t key;       /* 0: a chord, one after the other */
  double seconds;
} Row;

static const Row rows[] = {
    {"bowed, thrown every 250 frames",
     48e3,
     NULL,
     {{"exciter", 2.0}},
     12,
     96.0,
     false,
     false,
     false,
     0.0,
     45,
     6.0},
    {"struck again and again",
     48e3,
     NULL,
     {{"exciter", 1.0}},
     12,
     24.0,
     false,
     false,
     false,
     8.0,
     45,
     20.0},
    {"bowed in a zone", 48e3, NULL, {{"exciter", 2.0}}, 48, 10.0, false, true, false, 0.0, 45, 8.0},
    {"Iron Frame", 22050.0, "Iron Frame", {{NULL, 0.0}}, 2, 6.0, false, false, true, 6.0, 0, 6.0},
    {"struck, on a bridge",
     48e3,
     NULL,
     {{"exciter", 1.0}, {"damping", 0.1}, {"resonance", 0.7}},
     2,
     6.0,
     false,
     false,
     true,
     6.0,
     0,
     3.0},
    {"the mod wheel alone",
     11025.0,
     NULL,
     {{"exciter", 1.0}, {"damping", 0.05}, {"resonance", 1.0}},
     0,
     6.0,
     true,
     false,
     true,
     6.0,
     0,
     10.0},
};

static void set_row(Host* host, const Row* row) {
  put_back(host);
  if (row->preset) {
    assert_true(host_preset(host, row->preset));
  }
  for (int i = 0; i < MOST_PORTS && row->ports[i].symbol; ++i) {
    strings_set(host, row->ports[i].symbol, row->ports[i].value);
  }
  strings_set(host, "limiter", 0.0);
  if (row->is_zone) {
    strings_controller(host, 0, 101, 0);
    strings_controller(host, 0, 100, 6);
    strings_controller(host, 0, 6, 15);
  } else if (row->range > 0) {
    swings_set_range(host, row->range);
  }
  if (row->is_pedal) {
    strings_controller(host, 0, STRINGS_PEDAL, 127);
  }
}

/* One end of a row's wheel. */
static void throw_wheel(Host* host, const Row* row, bool is_high) {
  const unsigned channel = row->is_zone ? 1 : 0;
  if (row->is_mod) {
    strings_controller(host, 0, 1, is_high ? 127 : 0);
  } else {
    strings_midi(host, 0, 0xE0 | channel, is_high ? 127 : 0, is_high ? 127 : 0);
  }
}

/* Run some frames, and hear that they are sound. */
static double run(Host* host, uint32_t n_frames) {
  double peak = 0.0;
  if (!host_run(host, n_frames)) {
    fail_msg("%s", host_error(host));
  }
  for (uint32_t side = 0; side < 2; ++side) {
    const double here = measure_peak(host_output(host, side), n_frames);
    assert_true(isfinite(here));
    peak = fmax(peak, here);
  }
  return peak;
}

static double play_row(Host* host, const Row* row, bool has_swing, double seconds) {
  static const uint32_t chord[] = {40, 47, 52, 56, 59, 64, 68, 71, 76};
  const unsigned channel = row->is_zone ? 1 : 0;
  const double between = row->notes_per_s > 0.0 ? row->rate_hz / row->notes_per_s : HUGE_VAL;
  const double half = 0.5 * row->rate_hz / row->swings_per_s;
  double next_note = 0.0;
  double next_throw = has_swing ? half : HUGE_VAL;
  double peak = 0.0;
  uint32_t n_notes = 0;
  uint32_t n_throws = 0;
  set_row(host, row);
  for (double done = 0.0; done < seconds * row->rate_hz;) {
    if (done >= next_note) {
      const uint32_t key = row->key ? row->key : chord[n_notes % (sizeof(chord) / sizeof(*chord))];
      strings_midi(host, 0, 0x90 | channel, key, 100);
      next_note += between;
      ++n_notes;
    }
    if (done >= next_throw) {
      throw_wheel(host, row, n_throws % 2);
      next_throw += half;
      ++n_throws;
    }
    const uint32_t n = (uint32_t)ceil(fmin(fmin(next_note, next_throw) - done, BLOCK));
    peak = fmax(peak, run(host, n));
    done += n;
  }
  return peak;
}

/* The note that comes next, once all is quiet and the wheels are let go: as one of a new instance.
 */
static void assert_next_is_right(Host* host, double rate_hz, double* cents, double* db) {
  const Tone asked = {440.0, 1.0 / 0.6};
  const size_t n_frames = (size_t)rate_hz;
  Sound sound = sound_new(n_frames);
  Host* const fresh = strings_open(rate_hz, BLOCK);
  Host* const both[] = {fresh, host};
  double levels[2] = {0};
  for (unsigned channel = 0; channel < 16; ++channel) {
    strings_midi(host, 0, 0xB0 | channel, STRINGS_SOUND_OFF, 0);
    strings_midi(host, 0, 0xB0 | channel, STRINGS_RESET, 0);
  }
  for (int i = 0; i < 2; ++i) {
    put_ports_back(both[i]);
    strings_set_plain(both[i]);
    strings_run(both[i], &sound, 0, n_frames / 2, BLOCK);
    strings_note_on(both[i], 0, 69, 100);
    strings_run(both[i], &sound, 0, n_frames, BLOCK);
    levels[i] = measure_peak(sound.left, n_frames);
  }
  *cents = fmax(*cents, strings_measure(&sound, rate_hz, n_frames / 50, n_frames, asked).cents);
  *db = fmax(*db, fabs(decibels(levels[1] / levels[0])));
  host_free(fresh);
  sound_free(&sound);
}

static void what_exploded_is_as_loud_as_without_the_wheel(void** state) {
  (void)state;
  double worst = 0.0;
  double louder = -HUGE_VAL;
  double cents = 0.0;
  double off = 0.0;
  for (size_t i = 0; i < sizeof(rows) / sizeof(*rows); ++i) {
    const Row* const row = &rows[i];
    const double seconds = is_long() ? 20.0 * row->seconds : row->seconds;
    Host* const host = strings_open(row->rate_hz, BLOCK);
    const double still = play_row(host, row, false, row->seconds);
    const double swung = play_row(host, row, true, seconds);
    print_message("  %-32s peak %6.3f, without it %6.3f: %5.2f dB\n", row->what, swung, still,
                  decibels(swung / still));
    assert_next_is_right(host, row->rate_hz, &cents, &off);
    worst = fmax(worst, swung);
    louder = fmax(louder, decibels(swung / still));
    host_free(host);
  }
  assert_within("peak", worst, MOST_PEAK);
  assert_within("louder than without [dB]", louder, MOST_LOUDER_DB);
  assert_within("next note [cents]", cents, MOST_CENTS);
  assert_within("and its level [dB]", off, MOST_LEVEL_DB);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(no_swing_makes_a_note_louder),
      cmocka_unit_test(what_exploded_is_as_loud_as_without_the_wheel),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Whatever is played, scripted, turned and sent to the guitar in whatever blocks: what goes out is
 * finite and bounded, nothing sticks, and all strings play on in tune. */
#include "tests/support/guitar_host.h"
#include "tests/support/guitar_storm.h"
#include "tests/support/host_inside.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <lv2/atom/atom.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

enum { LARGEST = 1024, MOST_EVENTS = 12, N_STRINGS = 6, N_CHANNELS = 16 };

static const uint32_t open_notes[N_STRINGS] = {64, 59, 55, 50, 45, 40};

/*
  Six strings and those beside them, 0.25 of a pluck's peak, 12 dB of level, all to one side: 17.
  Plucks of one string add, but at random, and what slides to a lower pitch swings wider; so all
  of it may be trebled, and an instability would be beyond any bound in some hundred frames.
*/
static const double MOST_PEAK = 51.0;

/* A choked string is let go after 0.1 s, at the next of the looks that come every 1024 frames, the
 * first of them up to a block after that. */
static double silent_after_s(double rate_hz) {
  return 0.1 + 3.0 * LARGEST / rate_hz;
}

/* What the instrument promises. */
static const double MOST_CENTS = 0.005;

typedef struct {
  double rate_hz;
  uint32_t n_rounds;
  uint32_t n_events; /* In a round, at least */
} Weather;

typedef struct {
  Host* host;
  Random random;
  double rate_hz;
  uint32_t n_events;
  double peak;
  ToneError worst;
} Storm;

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
}

/* Anywhere in its range, at one of the ends, or nowhere. */
static void move_port(Storm* storm) {
  Random* const random = &storm->random;
  const char* const symbol =
      host_port_symbol(storm->host, random_below(random, host_n_ports(storm->host)));
  HostRange range;
  if (!host_range(storm->host, symbol, &range)) {
    return;
  }
  const double ends[] = {(double)range.min, (double)range.max, (double)range.initial};
  const uint32_t what = random_below(random, 8);
  const double value = what == 0  ? guitar_storm_odd_value(random)
                       : what < 4 ? ends[what - 1]
                                  : random_between(random, ends[0], ends[1]);
  strings_set(storm->host, symbol, value);
}

static void send_one(Storm* storm, uint32_t frame) {
  Random* const random = &storm->random;
  uint8_t bytes[GUITAR_STORM_BYTES];
  const GuitarEvent event = guitar_storm_event(random);
  const uint32_t what = random_below(random, 20);
  const uint32_t n_bytes = guitar_storm_malformed(random, bytes);
  if (what == 0) {
    assert_true(host_midi(storm->host, frame, bytes, n_bytes));
  } else if (what == 1) {
    assert_true(host_atom(storm->host, frame, GUITAR_EVENT_URI, bytes, n_bytes));
  } else if (what == 2) {
    assert_true(host_atom(storm->host, frame, LV2_ATOM__Object, &event, sizeof(event)));
  } else if (what < 10) {
    guitar_send(storm->host, frame, event);
  } else {
    guitar_storm_midi(random, bytes);
    assert_true(what > 10 ? host_midi(storm->host, frame, bytes, 3)
                          : host_midi_raw(storm->host, (int64_t)frame * 3 - 500, bytes, 3));
  }
  ++storm->n_events;
}

static void rage(Storm* storm, uint32_t n_events) {
  for (const uint32_t until = storm->n_events + n_events; storm->n_events < until;) {
    Random* const random = &storm->random;
    const uint32_t n_frames = (uint32_t)random_log_between(random, 1.0, LARGEST + 2.0) - 1;
    for (uint32_t i = random_below(random, 3); i > 0; --i) {
      move_port(storm);
    }
    if (random_below(random, 30) == 0) {
      const uint32_t preset = random_below(random, host_n_presets(storm->host));
      assert_true(host_preset(storm->host, host_preset_uri(storm->host, preset)));
    }
    for (uint32_t i = n_frames > 0 ? random_below(random, MOST_EVENTS + 1) : 0; i > 0; --i) {
      send_one(storm, random_below(random, n_frames));
    }
    run_and_look(storm, n_frames);
  }
}

static void send_to_all(Storm* storm, uint32_t controller) {
  for (uint32_t channel = 0; channel < N_CHANNELS; ++channel) {
    strings_midi(storm->host, 0, 0xB0 | channel, controller, 0);
  }
}

static void wait(Storm* storm, double time_s) {
  for (double at = 0.0; at < time_s * storm->rate_hz; at += LARGEST) {
    run_and_look(storm, LARGEST);
  }
}

/* All keys, pedals and sound off, whatever the ports were last set to. */
static void assert_nothing_sticks(Storm* storm) {
  strings_set(storm->host, "enabled", 1.0);
  send_to_all(storm, STRINGS_NOTES_OFF);
  send_to_all(storm, STRINGS_PEDAL);
  send_to_all(storm, STRINGS_SOUND_OFF);
  wait(storm, silent_after_s(storm->rate_hz));
  run_and_look(storm, LARGEST);
  assert_true(host_get(storm->host, "sounding") == 0.0f);
  assert_true(measure_peak(host_output(storm->host, 0), LARGEST) == 0.0);
  assert_true(measure_peak(host_output(storm->host, 1), LARGEST) == 0.0);
}

/* Fine and coarse tuning, which no reset of controllers touches. */
static void put_tuning_back(Storm* storm) {
  for (uint32_t channel = 0; channel < N_CHANNELS; ++channel) {
    const unsigned status = 0xB0 | channel;
    for (unsigned parameter = 1; parameter <= 2; ++parameter) {
      strings_midi(storm->host, 0, status, 101, 0);
      strings_midi(storm->host, 0, status, 100, parameter);
      strings_midi(storm->host, 0, status, 6, 64);
      strings_midi(storm->host, 0, status, 38, 0);
    }
    run_and_look(storm, LARGEST);
  }
}

/* The ports at their defaults but for what makes the fundamental easily measured, and wheels in
 * their middle; nobody activates anything. */
static void put_back(Storm* storm, double mode) {
  for (uint32_t i = 0; i < host_n_ports(storm->host); ++i) {
    HostRange range;
    const char* const symbol = host_port_symbol(storm->host, i);
    if (host_range(storm->host, symbol, &range)) {
      strings_set(storm->host, symbol, (double)range.initial);
    }
  }
  guitar_set_plain(storm->host);
  strings_set(storm->host, "masses", 40.0);
  strings_set(storm->host, "release", 0.005);
  strings_set(storm->host, "mode", mode);
  put_tuning_back(storm);
  send_to_all(storm, STRINGS_RESET);
  wait(storm, 0.05);
}

static void silence(Storm* storm) {
  send_to_all(storm, STRINGS_SOUND_OFF);
  wait(storm, silent_after_s(storm->rate_hz));
}

/* The note of an open string alone; with one channel for all it is the guitarist's to choose
 * which. */
static void play_note(Storm* storm, uint32_t string, double mode) {
  const Tone asked = strings_tone(storm->host, open_notes[string], 0.0);
  const size_t n_frames = (size_t)(0.7 * storm->rate_hz);
  Sound sound = sound_new(n_frames);
  strings_midi(storm->host, 0, mode > 0.0 ? 0x90 + string : 0x90, open_notes[string], 100);
  strings_run(storm->host, &sound, 0, n_frames, LARGEST);
  const ToneError error = strings_measure(
      &sound, storm->rate_hz, (size_t)(2.0 * storm->rate_hz / asked.f0_hz), n_frames, asked);
  if (!(error.cents <= MOST_CENTS)) {
    print_message("mode %g, string %u: %g cents, peak %g\n", mode, string + 1, error.cents,
                  measure_peak(sound.left, n_frames));
  }
  assert_true(measure_peak(sound.left, n_frames) > 0.05);
  storm->worst = strings_worse(storm->worst, error);
  sound_free(&sound);
  silence(storm);
}

static void assert_all_play_on(Storm* storm) {
  for (double mode = 0.0; mode < 2.0; ++mode) {
    put_back(storm, mode);
    for (uint32_t string = 0; string < N_STRINGS; ++string) {
      play_note(storm, string, mode);
    }
    for (uint32_t string = 0; string < N_STRINGS; ++string) {
      strings_midi(storm->host, 0, mode > 0.0 ? 0x90 + string : 0x90, open_notes[string], 100);
    }
    run_and_look(storm, LARGEST);
    assert_true(host_get(storm->host, "sounding") == (float)N_STRINGS);
    silence(storm);
  }
}

static void a_storm_is_survived(void** state) {
  const Weather* const weather = *(const Weather* const*)state;
  const uint32_t n_rounds = getenv("HOOKE_TEST_LONG") ? 20 * weather->n_rounds : weather->n_rounds;
  Storm storm = {.host = guitar_open(weather->rate_hz, LARGEST),
                 .random = random_start(),
                 .rate_hz = weather->rate_hz};
  for (uint32_t round = 0; round < n_rounds; ++round) {
    rage(&storm, weather->n_events);
    assert_nothing_sticks(&storm);
    assert_all_play_on(&storm);
  }
  print_message("%u events at %g Hz\n", storm.n_events, weather->rate_hz);
  assert_within("peak", storm.peak, MOST_PEAK);
  assert_true(storm.peak > 0.5);
  assert_within("pitch after it [cents]", storm.worst.cents, MOST_CENTS);
  host_free(storm.host);
}

static Sound ring(Host* host, double rate_hz, double time_s) {
  Sound sound = sound_new((size_t)(time_s * rate_hz));
  strings_run(host, &sound, 0, sound.n_frames, LARGEST);
  return sound;
}

/* A finger that a script laid on a string for ever, and nobody has a message to lift. */
static void all_sound_off_lifts_what_touches(void** state) {
  static const double rate_hz = 48000.0;
  (void)state;
  Host* const host = guitar_open(rate_hz, LARGEST);
  Storm storm = {.host = host, .rate_hz = rate_hz};
  guitar_set_plain(host);
  for (uint32_t string = 0; string < N_STRINGS; ++string) {
    guitar_send(host, 0, (GuitarEvent){GUITAR_TOUCH, string, {0.37f, HUGE_VALF}});
  }
  silence(&storm);
  for (uint32_t string = 0; string < N_STRINGS; ++string) {
    play_note(&storm, string, 0.0);
  }
  assert_within("pitch [cents]", storm.worst.cents, MOST_CENTS);
  host_free(host);
}

/* Choked, a string is gone, whatever fingers are then laid on it or lifted from it by a script. */
static void what_is_choked_stays_so(void** state) {
  static const GuitarEvent events[] = {
      {GUITAR_DAMP, 0, {0.004f}}, {GUITAR_DAMP, 0, {HUGE_VALF}}, {GUITAR_LET_RING, 0, {0.0f}}};
  static const double rate_hz = 48000.0;
  (void)state;
  for (int i = 0; i < 6; ++i) {
    const bool is_by_port = i >= 3;
    Host* const host = guitar_open(rate_hz, LARGEST);
    strings_set(host, "release", 10.0);
    strings_note_on(host, 0, 64, 127);
    Sound before = ring(host, rate_hz, 0.2);
    if (is_by_port) {
      strings_set(host, "enabled", 0.0);
    } else {
      strings_controller(host, 0, STRINGS_SOUND_OFF, 0);
    }
    guitar_send(host, 1, events[i % 3]);
    Sound after = ring(host, rate_hz, 0.4);
    /* What is on does what it is told. */
    const bool is_silent = host_get(host, "sounding") == 0.0f;
    assert_int_equal(is_silent, is_by_port || events[i % 3].verb != GUITAR_LET_RING);
    sound_free(&before);
    sound_free(&after);
    host_free(host);
  }
}

int main(void) {
  static const Weather weathers[] = {
      {44100.0, 4, 2000}, {192000.0, 2, 1500}, {8000.0, 2, 1000}, {768000.0, 1, 500}};
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_prestate(a_storm_is_survived, (void*)(uintptr_t)&weathers[0]),
      cmocka_unit_test_prestate(a_storm_is_survived, (void*)(uintptr_t)&weathers[1]),
      cmocka_unit_test_prestate(a_storm_is_survived, (void*)(uintptr_t)&weathers[2]),
      cmocka_unit_test_prestate(a_storm_is_survived, (void*)(uintptr_t)&weathers[3]),
      cmocka_unit_test(all_sound_off_lifts_what_touches),
      cmocka_unit_test(what_is_choked_stays_so),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

#include "tests/support/swings.h"

#include "tests/support/guitar_host.h"
#include "tests/support/measure.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

/* Frames of a window in which it is heard how loud it is: a period of the lowest pitch at least. */
enum { WINDOW = 8192, N_STRINGS = 6 };

static void go_wheel(Host* host, uint32_t key, double to) {
  const unsigned value = (unsigned)(8192.0 + 8191.0 * to);
  (void)key;
  strings_midi(host, 0, 0xE0, value & 0x7F, value >> 7);
}

static void go_mod_wheel(Host* host, uint32_t key, double to) {
  (void)key;
  strings_controller(host, 0, 1, (unsigned)(63.5 + 63.5 * to));
}

static void go_pressure(Host* host, uint32_t key, double to) {
  (void)key;
  strings_midi(host, 0, 0xD0, (unsigned)(63.5 + 63.5 * to), 0);
}

/* By single notes of the MIDI tuning standard, two semitones either way. */
static void go_scale(Host* host, uint32_t key, double to) {
  const uint32_t pitch = (uint32_t)(16384.0 * (key + 2.0 * to));
  const uint8_t bytes[] = {0xF0,
                           0x7F,
                           0x7F,
                           0x08,
                           0x02,
                           0,
                           1,
                           (uint8_t)key,
                           (uint8_t)(pitch >> 14),
                           (uint8_t)(pitch >> 7 & 0x7F),
                           (uint8_t)(pitch & 0x7F),
                           0xF7};
  assert_true(host_midi(host, 0, bytes, sizeof bytes));
}

static void go_port(Host* host, const char* symbol, double low, double high, double to) {
  const double way = 0.5 + 0.5 * to;
  const double value = low > 0.0 ? low * pow(high / low, way) : low + (high - low) * way;
  strings_set(host, symbol, value);
}

/* How far is what a player might: the ends of a port are another string. */
#define PORT_SWING(symbol, low, high)                                                              \
  static void go_##symbol(Host* host, uint32_t key, double to) {                                   \
    (void)key;                                                                                     \
    go_port(host, #symbol, low, high, to);                                                         \
  }
PORT_SWING(tuning, 400.0, 480.0)
PORT_SWING(stiffness, 1e-6, 0.01)
PORT_SWING(damping, 0.05, 5.0)
PORT_SWING(loss, 1e-5, 0.1)
PORT_SWING(partials, 0.0, 2.0)
PORT_SWING(masses, 10.0, 40.0)
PORT_SWING(resonance, 0.0, 1.0)
PORT_SWING(release, 0.005, 10.0)
PORT_SWING(hardness, 0.0, 1.0)
PORT_SWING(capo, 0.0, 12.0)
PORT_SWING(palm, 0.0, 1.0)

/* Between strings in unison, and between two directions, that are there. */
#define GROUP_SWING(symbol, group, value, low, high)                                               \
  static void go_##symbol(Host* host, uint32_t key, double to) {                                   \
    (void)key;                                                                                     \
    strings_set(host, #group, value);                                                              \
    go_port(host, #symbol, low, high, to);                                                         \
  }
GROUP_SWING(unison_detune, unisons, 3.0, 0.0, 20.0)
GROUP_SWING(second_detune, second, 1.0, 0.0, 30.0)
GROUP_SWING(second_decay, second, 1.0, 0.25, 4.0)

/* What the strings rest on; it is not heard, for each is heard in its own way. */
static void rest_on(Host* host, double body, double size) {
  strings_set(host, "resonance", 0.7);
  strings_set(host, "body_mix", 0.0);
  strings_set(host, "body", body);
  strings_set(host, "body_size", size);
}

static void go_body(Host* host, uint32_t key, double to) {
  (void)key;
  rest_on(host, round(6.0 + 5.0 * to), 1.0);
}

static void go_body_size(Host* host, uint32_t key, double to) {
  (void)key;
  rest_on(host, 1.0, 1.25 + 0.75 * to);
}

/* All of them, whichever has the note. */
static void go_open_strings(Host* host, uint32_t key, double to) {
  static const double notes[N_STRINGS] = {64.0, 59.0, 55.0, 50.0, 45.0, 40.0};
  (void)key;
  for (int i = 0; i < N_STRINGS; ++i) {
    const char symbol[] = {'s', 't', 'r', 'i', 'n', 'g', (char)('1' + i), '\0'};
    strings_set(host, symbol, round(notes[i] + 12.0 * to));
  }
}

static void go_slide(Host* host, uint32_t key, double to) {
  (void)key;
  for (uint32_t i = 0; i < N_STRINGS; ++i) {
    guitar_send(host, 0, (GuitarEvent){GUITAR_SLIDE, i, {(float)(12.0 + 12.0 * to), 0.0f}});
  }
}

/* As they come, what reads the string, and how far it is: through another pickup it is as loud as
 * that makes it. */
static void listen_as_usual(Host* host) {
  static const char* const symbols[] = {"level", "pickup", "spread", "pickup2", "blend"};
  for (uint32_t i = 0; i < sizeof(symbols) / sizeof(symbols[0]); ++i) {
    HostRange range;
    if (host_range(host, symbols[i], &range)) {
      strings_set(host, symbols[i], (double)range.initial);
    }
  }
  HostRange senses;
  if (host_range(host, "sense", &senses)) {
    strings_set(host, "sense", 0.0);
  }
  strings_set(host, "limiter", 0.0);
}

static void go_preset(Host* host, uint32_t key, double to) {
  static const char* const names[N_PLUGINS][3] = {{"Felt Piano", "Iron Frame", "Bowed Strings"},
                                                  {"Palm-Muted", "Clean Neck", "Steel Acoustic"}};
  (void)key;
  assert_true(host_preset(host, names[host_get(host, "capo") >= 0.0f][(int)(1.5 + 1.4 * to)]));
  listen_as_usual(host);
}

const Swing swings[] = {
    {"wheel", go_wheel, {true, true}, true},
    {"mod wheel", go_mod_wheel, {true, true}, false},
    {"pressure", go_pressure, {true, true}, false},
    {"scale", go_scale, {true, true}, false},
    {"tuning", go_tuning, {true, true}, false},
    {"stiffness", go_stiffness, {true, true}, false},
    {"damping", go_damping, {true, true}, false},
    {"loss", go_loss, {true, true}, false},
    {"partials", go_partials, {true, true}, false},
    {"masses", go_masses, {true, true}, false},
    {"release", go_release, {true, true}, false},
    {"hardness", go_hardness, {true, true}, false},
    {"preset", go_preset, {true, true}, false},
    {"resonance", go_resonance, {true, false}, false},
    {"body", go_body, {true, false}, false},
    {"body size", go_body_size, {true, false}, false},
    {"unison detune", go_unison_detune, {true, false}, false},
    {"second detune", go_second_detune, {true, false}, false},
    {"second decay", go_second_decay, {true, false}, false},
    {"capo", go_capo, {false, true}, false},
    {"palm", go_palm, {false, true}, false},
    {"open strings", go_open_strings, {false, true}, false},
    {"slide", go_slide, {false, true}, false},
};
const uint32_t swings_count = sizeof(swings) / sizeof(swings[0]);

void swings_set_range(Host* host, uint32_t semitones) {
  strings_controller(host, 0, 101, 0);
  strings_controller(host, 0, 100, 0);
  strings_controller(host, 0, 6, semitones);
}

static void
hear(SwingHeard* heard, double* sum, uint32_t* n, const float* samples, uint32_t n_run) {
  for (uint32_t i = 0; i < n_run; ++i) {
    const double x = (double)samples[i];
    heard->peak = fmax(heard->peak, fabs(x));
    *sum += x * x;
    if (++*n == WINDOW) {
      heard->rms = fmax(heard->rms, sqrt(*sum / WINDOW));
      *sum = 0.0;
      *n = 0;
    }
  }
}

static double next_after(const SwingTrial* trial) {
  const double half = 0.5 * trial->period;
  return trial->random ? random_between(trial->random, 0.0, 2.0 * half) : half;
}

SwingHeard swings_play(Host* host, const SwingTrial* trial) {
  const double end = trial->seconds * trial->rate_hz;
  const double repeat = trial->repeat_s > 0.0 ? trial->repeat_s * trial->rate_hz : HUGE_VAL;
  double next_go = trial->period > 0.0 ? next_after(trial) : HUGE_VAL;
  double next_note = 0.0;
  double way = trial->end;
  double sums[2] = {0};
  uint32_t ns[2] = {0};
  SwingHeard heard = {0};
  trial->swing->go(host, trial->key, way);
  for (double done = 0.0; done < end;) {
    if (done >= next_note) {
      strings_note_on(host, 0, trial->key, 100);
      next_note += repeat;
    }
    if (done >= next_go) {
      way = trial->random ? random_between(trial->random, -1.0, 1.0) : way > 0.0 ? -1.0 : 1.0;
      trial->swing->go(host, trial->key, way);
      next_go += next_after(trial);
    }
    const double until = fmin(fmin(next_go, next_note), end) - done;
    const double most = fmin(until, trial->period > 0.0 ? 256.0 : 4096.0);
    const uint32_t n = (uint32_t)fmax(1.0, ceil(most));
    assert_true(host_run(host, n));
    for (uint32_t side = 0; side < 2; ++side) {
      const float* const out = host_output(host, side);
      assert_true(isfinite(measure_peak(out, n)));
      hear(&heard, &sums[side], &ns[side], out, n);
    }
    done += n;
  }
  return heard;
}

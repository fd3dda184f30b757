/* A hard pluck is sharp at first and settles, as both instruments are heard: by how much, exactly
 * in tune once it has died away, under bends, on the bridge, and whatever swings in time with it.
 */
#include "tests/support/guitar_host.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/plugins.h"
#include "tests/support/random.h"
#include "tests/support/swings.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 512, LARGEST = 4096, LOW_E = 40 };

/* What the instrument promises of a note. */
static const double MOST_CENTS = 0.005;

static Host* open_plain(int plugin, double tension) {
  Host* const host = plugin ? guitar_open(RATE, LARGEST) : strings_open(RATE, LARGEST);
  if (plugin) {
    guitar_set_plain(host);
  } else {
    strings_set_plain(host);
    strings_set(host, "sense", 1.0); /* What is read so moves as far as the port is told for. */
  }
  strings_set(host, "limiter", 0.0);
  strings_set(host, "tension", tension);
  return host;
}

/* With all its partials, for as long as it is listened to. */
static void let_it_ring(Host* host) {
  strings_set(host, "damping", 0.02);
  strings_set(host, "tracking", 0.0);
  strings_set(host, "loss", 1e-5);
}

/* How sharp a stretch of it is. */
static double sharp_cents(const Sound* sound, size_t from, size_t to, Tone asked) {
  Tone heard = {0};
  assert_true(measure_tone(sound->left + from, to - from, RATE, asked, &heard));
  return measure_cents(heard.f0_hz, asked.f0_hz);
}

/* The low E of the guitar as it comes but that it lasts, plucked with a force. */
static double low_e_cents(double tension, double force) {
  Host* const host = guitar_open(RATE, LARGEST);
  Sound sound = sound_new(RATE);
  strings_set(host, "limiter", 0.0);
  strings_set(host, "tension", tension);
  let_it_ring(host);
  const double usual = guitar_hardness((double)host_get(host, "hardness"), 1.0);
  guitar_send(host, 0, (GuitarEvent){GUITAR_PLUCK, 5, {(float)force, NAN, (float)usual}});
  strings_run(host, &sound, 0, RATE, BLOCK);
  const double cents = sharp_cents(&sound, RATE / 100, RATE, strings_tone(host, LOW_E, 0.0));
  host_free(host);
  sound_free(&sound);
  return cents;
}

static void a_hard_low_e_is_as_sharp_as_the_port_says(void** state) {
  (void)state;
  const double hard = low_e_cents(25.0, 1.0);
  assert_within("hard, off 25 [cents]", fabs(hard - 25.0), 2.0);
  assert_within("half as far, off a quarter", fabs(low_e_cents(25.0, 0.5) - 0.25 * hard), 0.1);
  assert_within("twice as much", fabs(low_e_cents(50.0, 1.0) - 2.0 * hard), 0.1);
  assert_within("off [cents]", fabs(low_e_cents(0.0, 1.0)), MOST_CENTS);
}

/* From 48 dB below what it was. */
static ToneError play_and_measure(Host* host, uint32_t key) {
  const Tone asked = strings_tone(host, key, 0.0);
  const size_t from = (size_t)(5.5 * asked.tau_s * RATE);
  const size_t to = from + (size_t)(fmax(2.0 * asked.tau_s, 40.0 / asked.f0_hz) * RATE);
  Sound sound = sound_new(to);
  strings_restart(host);
  strings_note_on(host, 0, key, 127);
  strings_run(host, &sound, 0, to, BLOCK);
  assert_true(sharp_cents(&sound, 1000, 1000 + (size_t)(20.0 * RATE / asked.f0_hz), asked) > 0.5);
  const ToneError error = strings_measure(&sound, RATE, from, to, asked);
  sound_free(&sound);
  return error;
}

static void it_is_exactly_in_tune_once_it_has_died_away(void** state) {
  (void)state;
  for (int way = 0; way < 3; ++way) {
    static const char* const names[] = {"plucked", "struck", "guitar"};
    ToneError worst = {0};
    Host* const host = open_plain(way == 2, 100.0);
    strings_set(host, "damping", 2.0);
    strings_set(host, "loss", 1e-4);
    if (way == 1) {
      strings_set(host, "exciter", 1.0);
    }
    for (uint32_t key = LOW_E; key <= 76; key += 6) {
      worst = strings_worse(worst, play_and_measure(host, key));
    }
    strings_assert_exact(names[way], worst);
    host_free(host);
  }
}

/* How sharp a note is a second after the wheel has gone to `bend`. */
static double bent_cents(int plugin, double bend) {
  Host* const host = open_plain(plugin, 60.0);
  Sound sound = sound_new(2 * RATE);
  let_it_ring(host);
  strings_note_on(host, 0, 45, 100);
  strings_bend(host, RATE, bend);
  strings_run(host, &sound, 0, 2 * RATE, BLOCK);
  const Tone asked = strings_tone(host, 45, strings_bend_made(bend));
  const double cents = sharp_cents(&sound, RATE + RATE / 10, 2 * RATE, asked);
  sound_free(&sound);
  host_free(host);
  return cents;
}

/* While it rings on as loud and as sharp as ever: by what the wheel says, and nothing else. */
static void bends_on_top_are_exact(void** state) {
  (void)state;
  for (int plugin = 0; plugin < N_PLUGINS; ++plugin) {
    const double unbent = bent_cents(plugin, 0.0);
    assert_true(unbent > 3.0);
    /* The uppermost partials of a chain have a little more energy where it is bent up. */
    assert_within("bent up, of that", fabs(bent_cents(plugin, 1.7) / unbent - 1.0), 0.02);
    assert_within("bent down, of that", fabs(bent_cents(plugin, -1.7) / unbent - 1.0), 0.02);
  }
}

/* Two notes of an open octave, tied by the bridge: once they have died away as if nothing had ever
 * been sharp. */
static void on_the_bridge_it_settles_too(void** state) {
  enum { N = 5 * RATE };
  (void)state;
  Tone heard[2] = {0};
  for (int i = 0; i < 2; ++i) {
    Host* const host = open_plain(0, i ? 100.0 : 0.0);
    Sound sound = sound_new(N);
    strings_set(host, "resonance", 0.7);
    strings_set(host, "damping", 2.0);
    strings_set(host, "tracking", 0.0);
    strings_note_on(host, 0, 45, 127);
    strings_note_on(host, 0, 56, 127);
    strings_run(host, &sound, 0, N, BLOCK);
    const Tone asked = strings_tone(host, 45, 0.0);
    const double early = sharp_cents(&sound, 1000, RATE / 4, asked);
    assert_true(i ? early > 5.0 : fabs(early) < 1.0);
    assert_true(measure_tone(sound.left + N - 2 * RATE, 2 * RATE, RATE, asked, &heard[i]));
    sound_free(&sound);
    host_free(host);
  }
  assert_within("pitch, against none [cents]", fabs(measure_cents(heard[1].f0_hz, heard[0].f0_hz)),
                MOST_CENTS);
}

static const Swing* swing_named(const char* name) {
  for (uint32_t i = 0; i < swings_count; ++i) {
    if (!strcmp(swings[i].name, name)) {
      return &swings[i];
    }
  }
  fail_msg("no swing is named %s", name);
  return NULL;
}

static SwingHeard swing(int plugin, double range, double period, double repeat_s, double tension) {
  Host* const host = open_plain(plugin, tension);
  SwingTrial trial = {.swing = swing_named("wheel"),
                      .rate_hz = RATE,
                      .key = 45,
                      .seconds = 1.0,
                      .period = period,
                      .repeat_s = repeat_s};
  strings_set(host, "damping", 0.05);
  strings_set(host, "masses", 40.0);
  if (plugin == 0) {
    strings_set(host, "sense", 0.0); /* A velocity grows with the pitch. */
  }
  swings_set_range(host, (uint32_t)range);
  const SwingHeard heard = swings_play(host, &trial);
  host_free(host);
  return heard;
}

/* Every ratio to its period that might be in time with it, and a wide wheel; against what is as it
 * comes and stays where it is. */
static void no_wheel_in_time_with_it_makes_it_louder(void** state) {
  static const double ratios[] = {0.25, 1.0 / 3.0, 0.5, 2.0 / 3.0, 1.0, 1.5, 2.0, 3.0, 4.0};
  (void)state;
  for (int plugin = 0; plugin < N_PLUGINS; ++plugin) {
    const double still = swing(plugin, 12.0, 0.0, 0.0, 0.0).rms;
    double worst = swing(plugin, 12.0, 0.0, 0.0, 100.0).rms / still;
    for (size_t i = 0; i < sizeof ratios / sizeof *ratios; ++i) {
      const double period = RATE / 110.0 * ratios[i];
      worst = fmax(worst, swing(plugin, 12.0, period, 0.0, 100.0).rms / still);
    }
    assert_within("louder than without [dB]", 20.0 * log10(worst), 3.0);
  }
}

/* Eight times a second, as hard as can be: at the most as if all came at once. */
static void what_is_repeated_stays_bounded(void** state) {
  (void)state;
  for (int plugin = 0; plugin < N_PLUGINS; ++plugin) {
    const double once = swing(plugin, 2.0, 0.0, 0.0, 0.0).peak;
    const double often = swing(plugin, 2.0, 0.0, 0.125, 100.0).peak;
    assert_within("of eight notes, over one", often / once, 8.0);
  }
}

/* Notes, hammer-ons, wheels, pedals and the port itself. */
static Sound play_cut(int plugin, uint32_t block, bool has_bridge) {
  enum { N = 30000 };
  static const uint8_t messages[][3] = {{0x90, 40, 127}, {0x90, 52, 110}, {0xE0, 0, 90},
                                        {0x90, 41, 20},  {0xB0, 1, 90},   {0x80, 52, 0},
                                        {0xB0, 64, 127}, {0x90, 47, 127}, {0xE0, 0, 64},
                                        {0x80, 40, 0},   {0xB0, 1, 0},    {0x90, 40, 127}};
  Host* const host = open_plain(plugin, 80.0);
  Sound sound = sound_new(N);
  if (!plugin) {
    strings_set(host, "resonance", has_bridge ? 0.7 : 0.0);
    strings_set(host, "exciter", has_bridge ? 0.0 : 1.0);
  }
  for (uint32_t i = 0; i < 30; ++i) {
    const uint8_t* const m = messages[i % (sizeof messages / sizeof *messages)];
    strings_midi(host, 997 * i, m[0], m[1], m[2]);
  }
  strings_run(host, &sound, 0, N, block);
  host_free(host);
  return sound;
}

static void blocks_do_not_change_the_sound(void** state) {
  static const uint32_t blocks[] = {1, 64, 333};
  (void)state;
  for (int way = 0; way < 3; ++way) {
    Sound whole = play_cut(way == 2, LARGEST, way == 1);
    assert_true(measure_peak(whole.left, whole.n_frames) > 0.05);
    for (size_t b = 0; b < sizeof blocks / sizeof *blocks; ++b) {
      Sound cut = play_cut(way == 2, blocks[b], way == 1);
      assert_true(sound_is_same(&whole, &cut));
      sound_free(&cut);
    }
    sound_free(&whole);
  }
}

/* Set to and fro while it rings: it goes there, and back to its pitch. */
static void the_port_is_heard_of_what_rings(void** state) {
  (void)state;
  for (int plugin = 0; plugin < N_PLUGINS; ++plugin) {
    double cents[3];
    Host* const host = open_plain(plugin, 0.0);
    Sound sound = sound_new(RATE);
    let_it_ring(host);
    strings_note_on(host, 0, 45, 127);
    for (int i = 0; i < 3; ++i) {
      strings_set(host, "tension", i == 1 ? 50.0 : 0.0);
      strings_run(host, &sound, 0, RATE, BLOCK);
      cents[i] = sharp_cents(&sound, RATE / 10, RATE, strings_tone(host, 45, 0.0));
    }
    assert_true(cents[1] > 3.0);
    assert_within("off, before and after [cents]", fmax(fabs(cents[0]), fabs(cents[2])),
                  MOST_CENTS);
    sound_free(&sound);
    host_free(host);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_hard_low_e_is_as_sharp_as_the_port_says),
      cmocka_unit_test(it_is_exactly_in_tune_once_it_has_died_away),
      cmocka_unit_test(bends_on_top_are_exact),
      cmocka_unit_test(on_the_bridge_it_settles_too),
      cmocka_unit_test(no_wheel_in_time_with_it_makes_it_louder),
      cmocka_unit_test(what_is_repeated_stays_bounded),
      cmocka_unit_test(blocks_do_not_change_the_sound),
      cmocka_unit_test(the_port_is_heard_of_what_rings),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

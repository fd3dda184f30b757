/* What the ports say is what the guitar is, whatever a host writes into them. */
#include "core/base/limiter.h"
#include "plugin/guitar_ports.h"
#include "tests/support/guitar_host.h"
#include "tests/support/host_inside.h"
#include "tests/support/measure.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 480, N_FRAMES = 40 * BLOCK, LAST = 14000 };

/* A chord, struck at once and let go, and a note softly after one of its own; in the end all
 * strings as they are fretted. */
static const struct {
  size_t frame;
  unsigned key, velocity;
} notes[] = {{10, 45, 100}, {10, 52, 90},    {10, 57, 80},  {4000, 59, 20},
             {8000, 45, 0}, {9000, 62, 127}, {12000, 62, 0}};

enum { N_NOTES = sizeof(notes) / sizeof(notes[0]) };

static Sound play(Host* host) {
  Sound sound = sound_new(N_FRAMES);
  strings_restart(host);
  for (int i = 0; i < N_NOTES; ++i) {
    strings_note_on(host, notes[i].frame, notes[i].key, notes[i].velocity);
  }
  for (uint32_t i = 0; i < 6; ++i) {
    guitar_send(host, LAST, (GuitarEvent){GUITAR_PLUCK, i, {0.3f, NAN, NAN}});
  }
  strings_run(host, &sound, 0, N_FRAMES, BLOCK);
  return sound;
}

static Sound play_ourselves(const Host* host) {
  Duo duo = duo_new(host, RATE);
  Sound sound = sound_new(N_FRAMES);
  size_t done = 0;
  for (int i = 0; i < N_NOTES; ++i) {
    duo_run(&duo, &sound, done, notes[i].frame);
    done = notes[i].frame;
    if (notes[i].velocity > 0) {
      guitarist_note_on(duo.guitarist, 0, notes[i].key, notes[i].velocity);
    } else {
      guitarist_note_off(duo.guitarist, 0, notes[i].key);
    }
  }
  duo_run(&duo, &sound, done, LAST);
  for (uint32_t i = 0; i < 6; ++i) {
    guitar_pluck(duo.guitar, i, (GuitarPluck){(double)0.3f, (double)NAN, (double)NAN});
  }
  duo_run(&duo, &sound, LAST, N_FRAMES);
  duo_free(&duo);
  Limiter limiter;
  limiter_init(&limiter, RATE);
  limiter_turn(&limiter, host_get(host, "limiter") >= 0.5f, 0);
  limiter_run(&limiter, (uint32_t)sound.n_frames, sound.left, sound.right);
  return sound;
}

static bool is_of_the_sound(Host* host, uint32_t port) {
  return host_port_is_control_input(host, port) && port != PORT_ENABLED && port != PORT_FREEWHEEL;
}

/* One after another at a value of its own, and all at random: the sound is that of a guitar of the
 * patch that the manual tells. */
static void the_ports_make_the_patch(void** state) {
  (void)state;
  Random random = random_start();
  for (uint32_t port = 0; port < GUITAR_N_PORTS + 10; ++port) {
    Host* const host = guitar_open(RATE, BLOCK);
    for (uint32_t i = 0; i < GUITAR_N_PORTS; ++i) {
      HostRange range;
      if (is_of_the_sound(host, i) && (i == port || port >= GUITAR_N_PORTS)) {
        assert_true(host_range(host, host_port_symbol(host, i), &range));
        const double value = random_between(&random, (double)range.min, (double)range.max);
        strings_set(host, host_port_symbol(host, i), range.is_integer ? round(value) : value);
      }
    }
    Sound heard = play(host);
    Sound wanted = play_ourselves(host);
    assert_true(sound_is_same(&heard, &wanted));
    sound_free(&heard);
    sound_free(&wanted);
    host_free(host);
  }
}

/* At either end of every port too: that is where nothing between masses is nothing. */
static void the_ends_of_the_ports_make_the_patch(void** state) {
  (void)state;
  for (uint32_t k = 0; k < 2 * GUITAR_N_PORTS; ++k) {
    Host* const host = guitar_open(RATE, BLOCK);
    HostRange range;
    if (is_of_the_sound(host, k / 2)) {
      const char* const symbol = host_port_symbol(host, k / 2);
      assert_true(host_range(host, symbol, &range));
      strings_set(host, symbol, (double)(k % 2 ? range.max : range.min));
      Sound heard = play(host);
      Sound wanted = play_ourselves(host);
      assert_true(sound_is_same(&heard, &wanted));
      sound_free(&heard);
      sound_free(&wanted);
    }
    host_free(host);
  }
}

/* What each port is set to here is heard in the notes above. */
static void every_port_is_heard(void** state) {
  static const struct {
    const char* symbol;
    double value;
  } others[] = {
      {"level", -6.0},
      {"damping", 3.0},
      {"tracking", 1.0},
      {"loss", 0.3},
      {"stiffness", 1e-3},
      {"pickup", 0.3},
      {"pickup2", 0.4},
      {"blend", 0.2},
      {"width", 0.9},
      {"pluck", 0.4},
      {"hardness", 0.1},
      {"masses", 30.0},
      {"partials", 0.0},
      {"release", 1.0},
      {"tuning", 415.0},
      {"string1", 66.0},
      {"string2", 58.0},
      {"string3", 57.0},
      {"string4", 49.0},
      {"string5", 44.0},
      {"string6", 38.0},
      {"capo", 2.0},
      {"palm", 0.5},
      {"strum", 20.0},
      {"mode", 1.0},
      {"legato", 0.0},
      {"harmonic", 1.0},
      {"course", 0.5},
      {"enabled", 0.0},
      {"loss_tracking", 2.0},
      {"release_tracking", 1.0},
      {"tension", 10.0},
      {"body", 1.0},
  };
  (void)state;
  Host* const host = guitar_open(RATE, BLOCK);
  Sound usual = play(host);
  for (size_t i = 0; i < sizeof(others) / sizeof(others[0]); ++i) {
    Host* const other = guitar_open(RATE, BLOCK);
    strings_set(other, others[i].symbol, others[i].value);
    Sound sound = play(other);
    print_message("%s\n", others[i].symbol);
    assert_false(sound_is_same(&usual, &sound));
    sound_free(&sound);
    host_free(other);
  }
  sound_free(&usual);
  host_free(host);
}

/* Once there is one. */
static void every_port_of_the_body_is_heard(void** state) {
  static const struct {
    const char* symbol;
    double value;
  } others[] = {{"body", 2.0},      {"body_mix", 0.3},     {"body_mix", 0.0},
                {"body_size", 1.2}, {"body_damping", 2.0}, {"knock", 0.5}};
  (void)state;
  Host* const host = guitar_open(RATE, BLOCK);
  strings_set(host, "body", 1.0);
  Sound usual = play(host);
  for (size_t i = 0; i < sizeof(others) / sizeof(others[0]); ++i) {
    Host* const other = guitar_open(RATE, BLOCK);
    strings_set(other, "body", 1.0);
    strings_set(other, others[i].symbol, others[i].value);
    Sound sound = play(other);
    print_message("%s\n", others[i].symbol);
    assert_false(sound_is_same(&usual, &sound));
    sound_free(&sound);
    host_free(other);
  }
  sound_free(&usual);
  host_free(host);
}

/* With every sounding port at `value`, or at the end of its range that is meant. */
static Sound play_with(double value, bool is_end) {
  Host* const host = guitar_open(RATE, BLOCK);
  for (uint32_t i = 0; i < GUITAR_N_PORTS; ++i) {
    HostRange range;
    if (is_of_the_sound(host, i)) {
      assert_true(host_range(host, host_port_symbol(host, i), &range));
      const double end = (double)(value < 0.0 ? range.min : range.max);
      strings_set(host, host_port_symbol(host, i), is_end ? end : value);
    }
  }
  strings_set(host, "mode", 0.0);
  Sound sound = play(host);
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

static void what_is_no_number_or_not_connected_is_the_default(void** state) {
  (void)state;
  Host* const host = guitar_open(RATE, BLOCK);
  Sound usual = play(host);
  for (uint32_t port = 0; port < GUITAR_N_PORTS; ++port) {
    if (host_port_is_control_input(host, port)) {
      strings_set(host, host_port_symbol(host, port), (double)NAN);
    }
  }
  Sound no_number = play(host);
  for (uint32_t port = 0; port < GUITAR_N_PORTS; ++port) {
    if (host_port_is_control_input(host, port)) {
      host_connect(host, port, NULL);
    }
  }
  Sound not_there = play(host);
  assert_true(measure_peak(usual.left, N_FRAMES) > 0.01);
  assert_true(sound_is_same(&usual, &no_number));
  assert_true(sound_is_same(&usual, &not_there));
  sound_free(&usual);
  sound_free(&no_number);
  sound_free(&not_there);
  host_free(host);
}

static void whole_numbers_are_the_nearest(void** state) {
  static const struct {
    const char* symbol;
    double whole;
  } whole[] = {{"masses", 33}, {"partials", 1}, {"string5", 43}, {"capo", 3},     {"mode", 0},
               {"mode", 1},    {"legato", 20},  {"legato", 19},  {"harmonic", 2}, {"string1", 65}};
  (void)state;
  Host* const host = guitar_open(RATE, BLOCK);
  for (size_t i = 0; i < sizeof(whole) / sizeof(whole[0]); ++i) {
    const float usual = host_get(host, whole[i].symbol);
    strings_set(host, whole[i].symbol, whole[i].whole);
    Sound exact = play(host);
    for (int side = 0; side < 2; ++side) {
      strings_set(host, whole[i].symbol, whole[i].whole + (side ? 0.49 : -0.49));
      Sound near = play(host);
      assert_true(sound_is_same(&exact, &near));
      sound_free(&near);
    }
    sound_free(&exact);
    strings_set(host, whole[i].symbol, (double)usual);
  }
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_ports_make_the_patch),
      cmocka_unit_test(the_ends_of_the_ports_make_the_patch),
      cmocka_unit_test(every_port_is_heard),
      cmocka_unit_test(every_port_of_the_body_is_heard),
      cmocka_unit_test(what_is_out_of_range_is_clamped),
      cmocka_unit_test(what_is_no_number_or_not_connected_is_the_default),
      cmocka_unit_test(whole_numbers_are_the_nearest),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* However many strings sound as hard as can be, nothing leaves a plugin above full scale, and what
 * is quieter leaves it as it is. */
#include "core/base/limiter.h"
#include "tests/support/guitar_host.h"
#include "tests/support/measure.h"
#include "tests/support/strings_host.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 512, N_FRAMES = RATE };

typedef struct {
  Host* (*open)(double rate_hz, uint32_t max_block);
  uint32_t first, last;
} Instrument;

static const Instrument instruments[] = {{strings_open, 21, 108}, {guitar_open, 40, 69}};

static Sound
play(const Instrument* instrument, bool is_limited, uint32_t velocity, uint32_t block) {
  Host* const host = instrument->open(RATE, BLOCK);
  Sound sound = sound_new(N_FRAMES);
  strings_set(host, "limiter", is_limited ? 1.0 : 0.0);
  strings_set(host, "level", 6.0);
  for (uint32_t key = instrument->first; key <= instrument->last; ++key) {
    strings_note_on(host, 0, key, velocity);
  }
  strings_run(host, &sound, 0, N_FRAMES, block);
  host_free(host);
  return sound;
}

static void it_is_the_limiter_that_is_in_between(void** state) {
  const Instrument* const instrument = *state;
  Sound raw = play(instrument, false, 127, BLOCK);
  Sound limited = play(instrument, true, 127, BLOCK);
  Limiter limiter;
  print_message("peak %.2f, limited %.4f\n", measure_peak(raw.left, N_FRAMES),
                measure_peak(limited.left, N_FRAMES));
  assert_true(measure_peak(raw.left, N_FRAMES) > 1.0);
  assert_true(measure_peak(limited.left, N_FRAMES) <= 1.0);
  assert_true(measure_peak(limited.right, N_FRAMES) <= 1.0);
  limiter_init(&limiter, RATE);
  limiter_turn(&limiter, true, 0);
  limiter_run(&limiter, N_FRAMES, raw.left, raw.right);
  assert_true(sound_is_same(&raw, &limited));
  sound_free(&raw);
  sound_free(&limited);
}

static void what_is_quiet_is_as_it_was(void** state) {
  const Instrument* const instrument = *state;
  Sound raw = play(instrument, false, 8, BLOCK);
  Sound limited = play(instrument, true, 8, BLOCK);
  assert_true(measure_peak(raw.left, N_FRAMES) > 0.0);
  assert_true(sound_is_same(&raw, &limited));
  sound_free(&raw);
  sound_free(&limited);
}

static void blocks_do_not_matter(void** state) {
  const Instrument* const instrument = *state;
  Sound whole = play(instrument, true, 127, BLOCK);
  Sound cut = play(instrument, true, 127, 37);
  assert_true(sound_is_same(&whole, &cut));
  sound_free(&whole);
  sound_free(&cut);
}

int main(void) {
  Instrument strings = instruments[0];
  Instrument guitar = instruments[1];
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_prestate(it_is_the_limiter_that_is_in_between, &strings),
      cmocka_unit_test_prestate(it_is_the_limiter_that_is_in_between, &guitar),
      cmocka_unit_test_prestate(what_is_quiet_is_as_it_was, &strings),
      cmocka_unit_test_prestate(what_is_quiet_is_as_it_was, &guitar),
      cmocka_unit_test_prestate(blocks_do_not_matter, &strings),
      cmocka_unit_test_prestate(blocks_do_not_matter, &guitar),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

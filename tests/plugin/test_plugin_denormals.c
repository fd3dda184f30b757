/* The plugin flushes denormals, whatever its host does, and leaves the processor as it found it. */
#include "tests/support/strings_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>

#include <cmocka.h>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

enum { RATE = 48000, BLOCK = 512 };

#if defined(__SSE2__)

/* Rounding, masks, flush to zero and denormals are zero: all but the flags of what has happened. */
static const unsigned CONTROL_BITS = 0xFFC0;

static void the_processor_is_left_as_it_was(void** state) {
  (void)state;
  static const unsigned settings[] = {0x0000, 0x8000, 0x0040, 0x8040, 0x2000};
  const unsigned found = _mm_getcsr();
  for (size_t i = 0; i < sizeof(settings) / sizeof(settings[0]); ++i) {
    Host* const host = strings_open(RATE, BLOCK);
    const unsigned before = (found & ~0xE040u) | settings[i];
    strings_note_on(host, 5, 60, 100);
    assert_true(host_run(host, BLOCK));
    for (int n = 0; n < 20; ++n) {
      _mm_setcsr(before);
      lilv_instance_run(host_instance(host), n % 2 ? BLOCK : 0);
      const unsigned after = _mm_getcsr();
      _mm_setcsr(found);
      assert_int_equal(after & CONTROL_BITS, before & CONTROL_BITS);
    }
    host_free(host);
  }
}

#else

static void the_processor_is_left_as_it_was(void** state) {
  (void)state;
  skip();
}

#endif

static size_t n_subnormal(const float* samples, size_t n) {
  size_t n_found = 0;
  for (size_t i = 0; i < n; ++i) {
    n_found += fpclassify(samples[i]) == FP_SUBNORMAL;
  }
  return n_found;
}

/* Down to nothing, on a host that flushes nothing, and at the lowest level. */
static void a_note_dies_without_denormals(void** state) {
  (void)state;
  const float planted[2] = {1.0f, 1e-40f};
  assert_int_equal(n_subnormal(planted, 2), 1);
  Host* const host = strings_open(RATE, BLOCK);
  Sound sound = sound_new(4 * RATE);
  strings_set(host, "level", -60.0);
  strings_set(host, "damping", 10.0);
  for (uint32_t key = 30; key < 100; key += 7) {
    strings_note_on(host, key, key, 1);
    strings_note_off(host, key + RATE, key);
  }
  strings_run(host, &sound, 0, sound.n_frames, BLOCK);
  assert_int_equal(n_subnormal(sound.left, sound.n_frames), 0);
  assert_int_equal(n_subnormal(sound.right, sound.n_frames), 0);
  assert_true(host_get(host, "sounding") == 0.0f);
  sound_free(&sound);
  host_free(host);
}

/* What runs ahead of the wave along the string is as small as floats get: without flushing, the far
 * end would be heard in denormals first. */
static void a_note_begins_without_denormals(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  Sound sound = sound_new(2 * BLOCK);
  strings_set(host, "masses", 200.0);
  strings_set(host, "damping", 20.0);
  strings_set(host, "pluck", 0.0);
  strings_set(host, "hardness", 1.0);
  strings_set(host, "spread", 0.5);
  strings_set(host, "pickup", 0.7);
  for (uint32_t key = 24; key < 60; ++key) {
    strings_restart(host);
    strings_note_on(host, 0, key, 1);
    strings_run(host, &sound, 0, sound.n_frames, BLOCK);
    assert_int_equal(n_subnormal(sound.left, sound.n_frames), 0);
    assert_int_equal(n_subnormal(sound.right, sound.n_frames), 0);
  }
  sound_free(&sound);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_processor_is_left_as_it_was),
      cmocka_unit_test(a_note_begins_without_denormals),
      cmocka_unit_test(a_note_dies_without_denormals),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

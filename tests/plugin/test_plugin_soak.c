/* Hours of playing: what goes out stays finite and bounded, nothing sticks, and an instance that is
 * hours old costs, holds and sounds what a new one does.
 *
 * Some seconds of it in an ordinary run.  In a long one as many hours as HOOKE_SOAK_HOURS says. */
#define _POSIX_C_SOURCE 200809L

#include "tests/support/oracle.h"
#include "tests/support/soak.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include <cmocka.h>

#ifdef __GLIBC__
#if __GLIBC_PREREQ(2, 33)
#define HAS_MALLINFO2
#include <malloc.h>
#endif
#endif

/* For each plugin: some twenty minutes of processor time. */
static const double USUAL_HOURS = 0.5;

/* The same work is done by both instances in turn, block by block, so that a busy machine tells on
 * both; what is left is some percent. */
static const double MOST_COST = 1.2;

/* The host's queues, and what the C library keeps of what was freed; a leak in
 * each note is more in seconds, and one in each minute in hours. */
static const double MOST_HEAP_BYTES = 4096.0;
static const double MOST_RESIDENT_BYTES = 1048576.0;

enum { N_COMPARED = 10 };

typedef struct {
  double minutes;
  double minute_s;   /* How long a minute is */
  double compared_s; /* The same where two instances play */
} Length;

static Length length_asked(void) {
  const char* const hours = getenv("HOOKE_SOAK_HOURS");
  if (!getenv("HOOKE_TEST_LONG")) {
    return (Length){6.0, 3.0, 1.5};
  }
  return (Length){60.0 * (hours ? strtod(hours, NULL) : USUAL_HOURS), 60.0, 60.0};
}

/* 0 where the heap does not say, or is a memory checker's, which keeps what was freed. */
static double heap_bytes(void) {
#ifdef HAS_MALLINFO2
  const struct mallinfo2 info = mallinfo2();
  return (double)info.uordblks + (double)info.hblkhd;
#else
  return 0.0;
#endif
}

static double resident_bytes(void) {
  double whole = 0.0;
  double resident = 0.0;
  FILE* const file = fopen("/proc/self/statm", "r");
  assert_non_null(file);
  assert_int_equal(fscanf(file, "%lf %lf", &whole, &resident), 2);
  assert_int_equal(fclose(file), 0);
  return resident * 4096.0;
}

/* Not the same minute at any two times. */
static void play_on(Soak* soak, uint64_t seed, Length length) {
  for (double minute = 0.0; minute < length.minutes; ++minute) {
    soak_play(soak, seed + 1000 + (uint64_t)minute, length.minute_s);
    if (fmod(minute, 10.0) == 5.0) {
      soak_silence(soak);
    }
  }
}

static int compare(const void* a, const void* b) {
  const double difference = *(const double*)a - *(const double*)b;
  return (difference > 0.0) - (difference < 0.0);
}

static void
assert_as_good_as_new(Soak* soak, const char* plugin_uri, uint64_t seed, double seconds) {
  double costs[N_COMPARED];
  soak->hosts[1] = soak_open(plugin_uri);
  soak->sound_energy = soak->unlike_energy = 0.0;
  for (uint64_t minute = 0; minute < N_COMPARED; ++minute) {
    soak_sit_down(soak);
    soak->cost_s[0] = soak->cost_s[1] = 0.0;
    soak_play(soak, seed + minute, seconds);
    costs[minute] = soak->cost_s[0] / soak->cost_s[1];
  }
  qsort(costs, N_COMPARED, sizeof(double), compare);
  assert_within("cost beside a new instance's", costs[N_COMPARED / 2], MOST_COST);
  assert_true(soak->sound_energy > 0.0);
  assert_true(soak->unlike_energy == 0.0);
}

static void an_old_instance_is_as_good_as_new(void** state) {
  const char* const plugin_uri = *state;
  const uint64_t seed = random_start().state;
  const Length whole = length_asked();
  Soak soak = soak_start(plugin_uri);
  play_on(&soak, seed, (Length){.minutes = 6.0, .minute_s = 3.0}); /* All that is made but once */
  soak_sit_down(&soak);
  const double resident = resident_bytes();
  const double heap = heap_bytes();

  play_on(&soak, seed, whole);
  soak_silence(&soak);
  soak_sit_down(&soak);
  print_message("%s: %.2f hours, %.0f notes, %.1f s of processor time, peak %g\n", plugin_uri,
                (double)soak.now / SOAK_RATE / 3600.0, (double)soak.n_notes, soak.cost_s[0],
                soak.peak);
  assert_within("growth of the heap [bytes]", heap_bytes() - heap, MOST_HEAP_BYTES);
  if (heap > 0.0) {
    assert_within("growth of memory [bytes]", resident_bytes() - resident, MOST_RESIDENT_BYTES);
  }
  assert_true(soak.n_notes > 50);
  assert_as_good_as_new(&soak, plugin_uri, seed, whole.compared_s);
  assert_within("peak", soak.peak, 1.0);
  soak_stop(&soak);
}

/* What was freed and is kept for the next of its size would count as in use; in hours that grows.
 */
static void begin_without_cache(char** argv) {
  static const char tunables[] = "GLIBC_TUNABLES";
  if (getenv("HOOKE_TEST_LONG") && !getenv(tunables) &&
      setenv(tunables, "glibc.malloc.tcache_count=0", 1) == 0) {
    (void)execv(argv[0], argv);
  }
}

int main(int argc, char** argv) {
  (void)argc;
  begin_without_cache(argv);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_prestate(an_old_instance_is_as_good_as_new, (void*)(uintptr_t)STRINGS_URI),
      cmocka_unit_test_prestate(an_old_instance_is_as_good_as_new,
                                (void*)(uintptr_t) "urn:hooke:guitar"),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

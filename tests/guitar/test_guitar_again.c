/* A string that is plucked again is stopped by the plectrum first: notes that follow each other
 * sound alike, and begin in tune. */
#include "core/guitar/guitar.h"
#include "tests/support/guitars.h"
#include "tests/support/measure.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, NOTE = RATE / 5, N_NOTES = 12, N_FRAMES = N_NOTES * NOTE };

static const GuitarPluck plain = {0.5, (double)NAN, (double)NAN};

static float left[N_FRAMES];
static float right[N_FRAMES];

static Guitar* make(void) {
  const GuitarPatch patch = guitars_patch();
  return guitars_new(RATE, &patch);
}

static double largest_step(const float* samples, size_t n) {
  double most = 0.0;
  for (size_t i = 1; i < n; ++i) {
    most = fmax(most, fabs((double)samples[i] - (double)samples[i - 1]));
  }
  return most;
}

/* Five times a second, and then thirty. */
static void repeated_notes_are_as_loud(void** state) {
  (void)state;
  static const uint32_t lengths[] = {NOTE, RATE / 30};
  for (int l = 0; l < 2; ++l) {
    for (uint32_t string = 0; string < 6; ++string) {
      Guitar* const guitar = make();
      double loudest = 0.0;
      double quietest = HUGE_VAL;
      for (int i = 0; i < N_NOTES; ++i) {
        guitar_pluck(guitar, string, plain);
        guitar_run(guitar, lengths[l], left, right);
        /* What is left of the note before is over by then. */
        const uint32_t skip = lengths[l] / 2;
        const double rms = measure_rms(left + skip, lengths[l] - skip);
        loudest = fmax(loudest, rms);
        quietest = fmin(quietest, rms);
      }
      assert_true(20.0 * log10(loudest / quietest) < (l == 0 ? 0.01 : 0.6));
      guitar_free(guitar);
    }
  }
}

/* Once what was before has died, a note is the note that it would be by itself, bit by bit but for
 * what rounding does to a sum. */
static void a_note_is_what_it_would_be_by_itself(void** state) {
  (void)state;
  Guitar* const guitar = make();
  guitar_pluck(guitar, 3, plain);
  guitar_run(guitar, NOTE, left, right);
  guitar_fret(guitar, 3, 7.0);
  guitar_pluck(guitar, 3, plain);
  guitar_run(guitar, N_FRAMES, left, right);
  Guitar* const alone = make();
  guitar_fret(alone, 3, 7.0);
  guitar_pluck(alone, 3, plain);
  guitar_run(alone, N_FRAMES, right, right);
  for (size_t i = NOTE; i < N_FRAMES; ++i) {
    assert_true(fabs((double)left[i] - (double)right[i]) < 1e-7);
  }
  guitar_free(guitar);
  guitar_free(alone);
}

/* And what was before dies without a step. */
static void what_was_before_dies_without_a_click(void** state) {
  (void)state;
  for (uint32_t string = 0; string < 6; ++string) {
    Guitar* const guitar = make();
    guitar_pluck(guitar, string, plain);
    guitar_run(guitar, NOTE, left, right);
    const double ringing = largest_step(left + NOTE / 2, NOTE / 2);
    const float last = left[NOTE - 1];
    guitar_pluck(guitar, string, (GuitarPluck){0.0, (double)NAN, (double)NAN});
    left[0] = last;
    guitar_run(guitar, NOTE, left + 1, right);
    assert_true(largest_step(left, NOTE) < 1.02 * ringing);
    assert_true(measure_peak(left + 300, 700) > 0.02 * measure_peak(left, 300));
    assert_true(measure_peak(left + NOTE / 2, NOTE / 2) < 1e-6);
    guitar_free(guitar);
  }
}

/* A finger that falls keeps what rings. */
static void a_hammer_on_keeps_the_motion(void** state) {
  (void)state;
  Guitar* const guitar = make();
  guitar_pluck(guitar, 2, plain);
  guitar_run(guitar, NOTE, left, right);
  const double before = measure_rms(left + NOTE / 2, NOTE / 2);
  guitar_hammer(guitar, 2, 2.0, 0.0);
  guitar_run(guitar, NOTE, left, right);
  assert_true(measure_rms(left, NOTE / 2) > 0.5 * before);
  guitar_free(guitar);
}

/* Quicker than what is left can die: it is added to. */
static void the_quickest_tremolo_stays_bounded(void** state) {
  (void)state;
  Guitar* const guitar = make();
  guitar_pluck(guitar, 5, (GuitarPluck){1.0, (double)NAN, (double)NAN});
  guitar_run(guitar, NOTE, left, right);
  const double one = measure_peak(left, NOTE);
  for (uint32_t done = 0; done < N_FRAMES; done += 100) {
    guitar_pluck(guitar, 5, (GuitarPluck){1.0, (double)NAN, (double)NAN});
    guitar_run(guitar, 100, left + done, right + done);
  }
  assert_true(measure_peak(left, N_FRAMES) < 30.0 * one);
  guitar_choke(guitar);
  guitar_run(guitar, N_FRAMES, left, right);
  assert_int_equal(guitar_report(guitar).n_strings, 0);
  assert_true(measure_peak(left + NOTE, N_FRAMES - NOTE) == 0.0);
  guitar_free(guitar);
}

static void play_cut(Guitar* guitar, uint32_t block) {
  for (uint32_t done = 0; done < N_FRAMES; done += NOTE) {
    guitar_fret(guitar, 4, (done / NOTE) % 5);
    guitar_pluck(guitar, 4, plain);
    guitar_bend(guitar, 4, (done / NOTE) % 2, 0.05);
    for (uint32_t n = 0; n < NOTE; n += block) {
      const uint32_t rest = NOTE - n < block ? NOTE - n : block;
      guitar_run(guitar, rest, left + done + n, right + done + n);
    }
  }
}

static void the_cut_into_blocks_does_not_matter(void** state) {
  (void)state;
  static float whole[N_FRAMES];
  static const uint32_t blocks[] = {1, 63, 64, 777};
  Guitar* const guitar = make();
  play_cut(guitar, NOTE);
  memcpy(whole, left, sizeof(whole));
  for (int b = 0; b < 4; ++b) {
    guitar_reset(guitar);
    play_cut(guitar, blocks[b]);
    assert_memory_equal(whole, left, sizeof(whole));
  }
  guitar_free(guitar);
}

/* What was plucked anew sounds on for a while beside it, and is counted. */
static void tails_that_ring_are_counted(void** state) {
  (void)state;
  Guitar* const guitar = make();
  guitar_pluck(guitar, 2, plain);
  guitar_run(guitar, NOTE, left, right);
  const VoiceReport one = guitar_report(guitar);
  guitar_pluck(guitar, 2, plain);
  const VoiceReport two = guitar_report(guitar);
  assert_int_equal(one.n_strings, 1);
  assert_int_equal(two.n_strings, 2);
  assert_int_equal(two.n_masses, 2 * one.n_masses);
  guitar_run(guitar, NOTE, left, right);
  assert_int_equal(guitar_report(guitar).n_strings, 1);
  guitar_free(guitar);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(tails_that_ring_are_counted),
      cmocka_unit_test(repeated_notes_are_as_loud),
      cmocka_unit_test(a_note_is_what_it_would_be_by_itself),
      cmocka_unit_test(what_was_before_dies_without_a_click),
      cmocka_unit_test(a_hammer_on_keeps_the_motion),
      cmocka_unit_test(the_quickest_tremolo_stays_bounded),
      cmocka_unit_test(the_cut_into_blocks_does_not_matter),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

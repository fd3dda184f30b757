/* Left and right are alike in loudness at every frequency, and their mean is what was read. */
#include "core/harp/harp_stereo.h"

#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

enum { N_FRAMES = 12000, DELAY = 24, RATE = 48000 };

static float read[N_FRAMES];
static float sides[2][N_FRAMES];
static float again[2][N_FRAMES];

static HarpStereo stereo_of(double rate_hz, double spread) {
  HarpStereo stereo;
  assert_true(harp_stereo_new(&stereo, rate_hz));
  harp_stereo_set(&stereo, spread, 0);
  return stereo;
}

static void run(HarpStereo* stereo, uint32_t piece, float out[2][N_FRAMES]) {
  for (uint32_t done = 0; done < N_FRAMES;) {
    const uint32_t n = piece < N_FRAMES - done ? piece : N_FRAMES - done;
    harp_stereo_run(stereo, read + done, n, out[0] + done, out[1] + done);
    done += n;
  }
}

static void make_noise(void) {
  Random random = random_start();
  for (int n = 0; n < N_FRAMES; ++n) {
    read[n] = (float)random_between(&random, -0.5, 0.5);
  }
}

static void mean_is_what_was_read_a_little_later(void** state) {
  (void)state;
  for (int k = 1; k <= 5; ++k) {
    HarpStereo stereo = stereo_of(RATE, 0.1 * k);
    double worst = 0.0;
    make_noise();
    run(&stereo, HARP_STEREO_FRAMES, sides);
    for (int n = DELAY; n < N_FRAMES; ++n) {
      const double mean = 0.5 * ((double)sides[0][n] + (double)sides[1][n]);
      worst = fmax(worst, fabs(mean - (double)read[n - DELAY]));
    }
    assert_within("mean, from what was read", worst, 1e-7);
    harp_stereo_free(&stereo);
  }
}

/* Of a tone, what each side is of it, against 1 ± i s sin ωd. */
static void sides_are_at_a_right_angle_and_as_loud(void** state) {
  (void)state;
  double worst = 0.0;
  double most_lost = 0.0;
  for (int hz = 40; hz < 20000; hz = hz * 5 / 4) {
    for (int k = 1; k <= 5; ++k) {
      const double spread = 0.1 * k;
      const double angle = 2.0 * PI * hz / RATE;
      HarpStereo stereo = stereo_of(RATE, spread);
      double power[2] = {0.0};
      double mono = 0.0;
      for (int n = 0; n < N_FRAMES; ++n) {
        read[n] = (float)cos(angle * n);
      }
      run(&stereo, HARP_STEREO_FRAMES, sides);
      for (int n = 2 * DELAY; n < N_FRAMES; ++n) {
        for (int s = 0; s < 2; ++s) {
          const double aside = (s ? -1.0 : 1.0) * spread * sin(angle * DELAY);
          const double late = angle * (n - DELAY);
          /* The real part of (1 + i aside) e^(i late) */
          const double told = cos(late) - aside * sin(late);
          worst = fmax(worst, fabs((double)sides[s][n] - told));
          power[s] += (double)sides[s][n] * (double)sides[s][n];
        }
        mono += 0.25 * pow((double)sides[0][n] + (double)sides[1][n], 2.0);
      }
      most_lost = fmax(most_lost, 10.0 * log10(0.5 * (power[0] + power[1]) / mono));
      harp_stereo_free(&stereo);
    }
  }
  assert_within("sides, from what they are to be", worst, 3e-7);
  assert_within("dB lost in mono", most_lost, 0.98);
}

static void without_spread_nothing_is_late(void** state) {
  (void)state;
  HarpStereo stereo = stereo_of(RATE, 0.0);
  make_noise();
  run(&stereo, 100, sides);
  assert_memory_equal(sides[0], read, sizeof(read));
  assert_memory_equal(sides[1], read, sizeof(read));
  harp_stereo_free(&stereo);
}

static void spread_comes_and_goes_without_a_step(void** state) {
  (void)state;
  HarpStereo stereo = stereo_of(RATE, 0.0);
  for (int n = 0; n < N_FRAMES; ++n) {
    read[n] = (float)sin(2.0 * PI * 440.0 * n / RATE);
  }
  double largest = 0.0;
  for (int n = 0; n < N_FRAMES; ++n) {
    if (n % 1000 == 500) {
      harp_stereo_set(&stereo, n % 2000 == 500 ? 0.5 : 0.0, 192);
    }
    harp_stereo_run(&stereo, read + n, 1, sides[0] + n, sides[1] + n);
    for (int s = 0; s < 2 && n > 0; ++s) {
      largest = fmax(largest, fabs((double)sides[s][n] - (double)sides[s][n - 1]));
    }
  }
  /* A tone of 440 Hz moves by 0.058 a frame. */
  assert_within("largest step", largest, 0.07);
  harp_stereo_free(&stereo);
}

static void cuts_change_nothing(void** state) {
  (void)state;
  for (int k = 0; k < 2; ++k) {
    HarpStereo once = stereo_of(RATE, 0.3);
    HarpStereo cut = stereo_of(RATE, 0.3);
    harp_stereo_set(&once, 0.1 * k, 3000);
    harp_stereo_set(&cut, 0.1 * k, 3000);
    make_noise();
    run(&once, HARP_STEREO_FRAMES, sides);
    run(&cut, 1, again);
    assert_memory_equal(sides, again, sizeof(sides));
    harp_stereo_free(&once);
    harp_stereo_free(&cut);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(mean_is_what_was_read_a_little_later),
      cmocka_unit_test(sides_are_at_a_right_angle_and_as_loud),
      cmocka_unit_test(without_spread_nothing_is_late),
      cmocka_unit_test(spread_comes_and_goes_without_a_step),
      cmocka_unit_test(cuts_change_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

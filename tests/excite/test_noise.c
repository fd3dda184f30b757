#include "core/excite/noise.h"

#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, N = RATE / 5, N_SEEDS = 200, N_STEPS = 9, MOST_N = 192000 / 5 };

static const double AMPLITUDE = 0.25;

static const double PI = 3.14159265358979323846;

static void run(Noise* noise, const NoiseMake* make, uint32_t n_frames, float* out) {
  memset(out, 0, n_frames * sizeof(float));
  noise_add(noise, make, n_frames, 1, (float* const[]){out});
}

static Noise scraped(uint64_t seed, double hardness) {
  Noise noise = {0};
  noise_scrape(&noise, seed, hardness, AMPLITUDE);
  return noise;
}

static Noise knocked(const NoiseMake* make, uint64_t seed, double hardness) {
  Noise noise = {0};
  noise_knock(&noise, make, seed, hardness, AMPLITUDE);
  return noise;
}

static bool is_zero(const Noise* noise) {
  static const Noise none = {0};
  bool is_zero = !noise->is_active && noise->n == 0;
  for (int i = 0; i < NOISE_MASSES; ++i) {
    is_zero = is_zero && noise->u[i] == none.u[i] && noise->x[i] == none.x[i];
  }
  return is_zero;
}

static void zero_is_silence(void** state) {
  (void)state;
  const NoiseMake make = noise_make(RATE);
  Noise noise = {0};
  float out[64] = {0.25f};
  noise_add(&noise, &make, 64, 1, (float* const[]){out});
  assert_true(out[0] == 0.25f && out[1] == 0.0f && is_zero(&noise));
}

/* After 0.15 s not a bit is left, at any rate and of the loudest; and before it there is something.
 */
static void it_dies_to_exact_zeros(void** state) {
  (void)state;
  static const double rates_hz[] = {8000.0, 44100.0, 192000.0};
  static float out[MOST_N];
  for (int r = 0; r < 3; ++r) {
    const NoiseMake make = noise_make(rates_hz[r]);
    for (int i = 0; i < 2 * N_STEPS; ++i) {
      const double hardness = i / 2 / (N_STEPS - 1.0);
      Noise noise = i % 2 ? scraped(1, hardness) : knocked(&make, 1, hardness);
      const size_t n = (size_t)(0.2 * rates_hz[r]);
      run(&noise, &make, (uint32_t)n, out);
      assert_true(is_zero(&noise));
      const size_t quiet = (size_t)(0.15 * rates_hz[r]);
      assert_true(measure_peak(out + quiet, n - quiet) == 0.0);
      assert_true(measure_peak(out, (size_t)(0.004 * rates_hz[r])) > 0.01);
    }
  }
}

static void cuts_do_not_change_it(void** state) {
  (void)state;
  static float whole[N];
  static float cut[N];
  const NoiseMake make = noise_make(RATE);
  Random random = random_start();
  Noise a = knocked(&make, 5, 0.7);
  Noise b = a;
  run(&a, &make, N, whole);
  for (uint32_t done = 0; done < N;) {
    const uint32_t wanted = 1 + random_below(&random, 50);
    const uint32_t n = wanted < N - done ? wanted : N - done;
    run(&b, &make, n, cut + done);
    done += n;
  }
  assert_memory_equal(whole, cut, sizeof(whole));
}

/* The second comes while the first is heard. */
static void what_two_notes_make_adds(void** state) {
  (void)state;
  static float first[N];
  static float second[N];
  static float both[N];
  enum { LATER = 100 };
  const NoiseMake make = noise_make(RATE);
  Noise one = knocked(&make, 3, 0.2);
  Noise other = scraped(3, 0.9);
  Noise sum = one;
  run(&one, &make, N, first);
  memset(second, 0, sizeof(second));
  other.n = LATER;
  run(&other, &make, N - LATER, second + LATER);
  run(&sum, &make, LATER, both);
  noise_scrape(&sum, 77, 0.9, AMPLITUDE);
  run(&sum, &make, N - LATER, both + LATER);
  double worst = 0.0;
  for (int n = 0; n < N / 4; ++n) {
    worst = fmax(worst, fabs((double)both[n] - (double)first[n] - (double)second[n]));
  }
  /* One of them may end while the other keeps both going. */
  assert_within("from the sum", worst, 2.0 * NOISE_FLOOR);
}

/* Whatever scrapes, at whatever rate, in the mean. */
static void a_scrape_is_as_loud_as_it_says(void** state) {
  (void)state;
  static const double rates_hz[] = {44100.0, 48000.0, 96000.0, 192000.0};
  static float out[MOST_N];
  double worst = 0.0;
  for (int r = 0; r < 4; ++r) {
    const NoiseMake make = noise_make(rates_hz[r]);
    for (int i = 0; i < N_STEPS; ++i) {
      double sum = 0.0;
      for (uint64_t seed = 0; seed < N_SEEDS; ++seed) {
        Noise noise = scraped(seed, i / (N_STEPS - 1.0));
        run(&noise, &make, (uint32_t)(rates_hz[r] / 50.0), out);
        sum += measure_peak(out, (size_t)(rates_hz[r] / 50.0)) / N_SEEDS;
      }
      const double db = 20.0 * log10(sum / (NOISE_PEAK * AMPLITUDE));
      print_message("%6.0f Hz, hardness %.3f: %5.2f dB\n", rates_hz[r], i / (N_STEPS - 1.0), db);
      worst = fmax(worst, fabs(db));
    }
  }
  assert_within("dB", worst, 2.0);
}

/* Mean power of some scrapes at a frequency. */
static double power_at(const NoiseMake* make, double hardness, double f_hz) {
  float out[RATE / 50];
  double power = 0.0;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    Noise noise = scraped(seed, hardness);
    double re = 0.0;
    double im = 0.0;
    run(&noise, make, RATE / 50, out);
    for (int n = 0; n < RATE / 50; ++n) {
      re += (double)out[n] * cos(2.0 * PI * f_hz * n / RATE);
      im += (double)out[n] * sin(2.0 * PI * f_hz * n / RATE);
    }
    power += re * re + im * im;
  }
  return power;
}

static double centroid_hz(const NoiseMake* make, double hardness) {
  double sum = 0.0;
  double moment = 0.0;
  for (double f_hz = 50.0; f_hz < 20000.0; f_hz += 100.0) {
    const double power = power_at(make, hardness, f_hz);
    sum += power;
    moment += f_hz * power;
  }
  return moment / sum;
}

/* Time in which all but a hundredth of the power of some scrapes is over [s]. */
static double length_s(const NoiseMake* make, double hardness) {
  float out[N];
  double powers[N] = {0.0};
  double left = 0.0;
  for (uint64_t seed = 0; seed < 40; ++seed) {
    Noise noise = scraped(seed, hardness);
    run(&noise, make, N, out);
    for (int n = 0; n < N; ++n) {
      powers[n] += (double)out[n] * (double)out[n];
      left += (double)out[n] * (double)out[n];
    }
  }
  const double least = 0.01 * left;
  int n = 0;
  for (; left > least; ++n) {
    left -= powers[n];
  }
  return (double)n / RATE;
}

static void harder_is_brighter_and_shorter(void** state) {
  (void)state;
  const NoiseMake make = noise_make(RATE);
  double before_hz = 0.0;
  double before_s = 1.0;
  for (int i = 0; i < 5; ++i) {
    const double hz = centroid_hz(&make, i / 4.0);
    const double s = length_s(&make, i / 4.0);
    print_message("hardness %.2f: centroid %4.0f Hz, %4.1f ms\n", i / 4.0, hz, 1e3 * s);
    assert_true(hz > 1.2 * before_hz && s < before_s);
    assert_true(i > 0 || (s > 0.01 && s < 0.02));
    assert_true(i < 4 || (s > 0.002 && s < 0.005));
    before_hz = hz;
    before_s = s;
  }
}

/* Without the felt's rustle it is two damped sines that begin at 0, at the frequencies and with the
 * decays that the manual says: the sines that fit best leave nothing. */
static void a_knock_rings_where_it_says(void** state) {
  (void)state;
  static const double f_hz[] = {170.0, 680.0};
  static const double tau_s[] = {0.010, 0.008};
  static float knock[N];
  static float felt[N];
  const NoiseMake make = noise_make(RATE);
  Noise whole = knocked(&make, 9, 0.5);
  Noise rustle = {0};
  double gram[2][2] = {{0.0}};
  double seen[2] = {0.0};
  noise_scrape(&rustle, 9, 0.25, 0.3 * AMPLITUDE);
  run(&whole, &make, N, knock);
  run(&rustle, &make, N, felt);
  enum { FIT = RATE / 25 };
  double total = 0.0;
  for (int n = 0; n < FIT; ++n) {
    const double t = (n + 1.0) / RATE;
    double sines[2];
    for (int i = 0; i < 2; ++i) {
      sines[i] = exp(-t / tau_s[i]) * sin(2.0 * PI * f_hz[i] * t);
    }
    const double x = (double)knock[n] - (double)felt[n];
    total += x * x;
    for (int i = 0; i < 4; ++i) {
      gram[i / 2][i % 2] += sines[i / 2] * sines[i % 2];
    }
    seen[0] += x * sines[0];
    seen[1] += x * sines[1];
  }
  const double det = gram[0][0] * gram[1][1] - gram[0][1] * gram[1][0];
  const double low = (seen[0] * gram[1][1] - seen[1] * gram[0][1]) / det;
  const double high = (seen[1] * gram[0][0] - seen[0] * gram[1][0]) / det;
  print_message("%g of 170 Hz, %g of 680 Hz\n", low / AMPLITUDE, high / AMPLITUDE);
  assert_true(low > 0.1 * AMPLITUDE && high > 0.05 * AMPLITUDE);
  assert_within("left, of the power", 1.0 - (low * seen[0] + high * seen[1]) / total, 1e-6);
}

static void what_is_choked_is_gone_at_once(void** state) {
  (void)state;
  float out[RATE / 20];
  const NoiseMake make = noise_make(RATE);
  Noise noise = knocked(&make, 1, 0.0);
  run(&noise, &make, 100, out);
  noise_choke(&noise);
  run(&noise, &make, RATE / 20, out);
  assert_true(is_zero(&noise));
  assert_true(measure_peak(out + RATE / 100, RATE / 20 - RATE / 100) < 1e-3);
  noise_scrape(&noise, 1, 0.0, AMPLITUDE);
  run(&noise, &make, RATE / 20, out);
  assert_true(measure_rms(out + 200, 200) > 1e-3);
}

static void what_is_no_number_is_silence(void** state) {
  static const double others[] = {(double)NAN, HUGE_VAL, -HUGE_VAL};
  (void)state;
  float out[256];
  const NoiseMake make = noise_make(RATE);
  for (int i = 0; i < 3 * NOISE_MASSES; ++i) {
    Noise noise = knocked(&make, 1, 0.5);
    noise.u[i / 3] = others[i % 3];
    run(&noise, &make, 256, out);
    assert_true(isfinite(measure_peak(out, 256)) && is_zero(&noise));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(zero_is_silence),
      cmocka_unit_test(it_dies_to_exact_zeros),
      cmocka_unit_test(cuts_do_not_change_it),
      cmocka_unit_test(what_two_notes_make_adds),
      cmocka_unit_test(a_scrape_is_as_loud_as_it_says),
      cmocka_unit_test(harder_is_brighter_and_shorter),
      cmocka_unit_test(a_knock_rings_where_it_says),
      cmocka_unit_test(what_is_choked_is_gone_at_once),
      cmocka_unit_test(what_is_no_number_is_silence),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

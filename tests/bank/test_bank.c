#include "core/bank/bank.h"

#include "core/base/complex_of.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;
static const double RATE_HZ = 48000.0;

enum { RATE = 48000, FRAMES = 4096, N_SIZES = 14 };

/* Every remainder that a kernel may have. */
static const uint32_t sizes[N_SIZES] = {1, 7, 8, 9, 16, 24, 25, 32, 33, 40, 64, 100, 255, 256};

static float force[FRAMES];

/* What a run leaves behind. */
typedef struct {
  float left[FRAMES];
  float right[FRAMES];
  double x[BANK_MAX_MODES];
  double u[BANK_MAX_MODES];
  double pushed;
} Trace;

static Pole pole_of(double f0_hz, double tau_s) {
  Pole pole = {0};
  assert_int_equal(pole_solve(RATE_HZ, (Tone){f0_hz, tau_s}, &pole), STATUS_OK);
  return pole;
}

static BankMode mode_at_random(Random* random) {
  return (BankMode){
      .pole =
          pole_of(random_log_between(random, 20.0, 21600.0), random_log_between(random, 1e-3, 1.0)),
      .in = random_between(random, -1.0, 1.0),
      .out = {random_between(random, -1.0, 1.0), random_between(random, -1.0, 1.0)},
  };
}

static void draw_force(Random* random) {
  for (int n = 0; n < FRAMES; ++n) {
    force[n] = (float)random_between(random, -1.0, 1.0);
  }
}

static void fill(Bank* bank, Random* random, uint32_t n_modes) {
  bank_clear(bank);
  for (uint32_t k = 0; k < n_modes; ++k) {
    bank_add(bank, mode_at_random(random));
  }
}

static void keep(Trace* trace, const Bank* bank) {
  memcpy(trace->x, bank->x, sizeof(trace->x));
  memcpy(trace->u, bank->u, sizeof(trace->u));
}

/* Calls of `cut` frames, and one push after the last. */
static void run_bank(Trace* trace, Bank bank, uint32_t n_frames, uint32_t cut) {
  memset(trace, 0, sizeof(*trace));
  for (uint32_t done = 0; done < n_frames; done += cut) {
    const uint32_t left = n_frames - done;
    bank_run(&bank, force + done, cut < left ? cut : left, trace->left + done, trace->right + done);
  }
  trace->pushed = bank_push(&bank, 0.5);
  keep(trace, &bank);
}

/* The plain source: the same numbers, each by itself, in the order that all kernels keep. */

static double sum_of(const double lanes[BANK_LANES]) {
  return ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) +
         ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
}

static double heard_by(const Bank* bank, int side) {
  double lanes[BANK_LANES] = {0.0};
  for (uint32_t k = 0; k < bank->n_modes; ++k) {
    lanes[k % BANK_LANES] += bank->out[side][k] * bank->u[k];
  }
  return sum_of(lanes);
}

static double step_plainly(Bank* bank, double f) {
  double lanes[BANK_LANES] = {0.0};
  for (uint32_t k = 0; k < bank->n_modes; ++k) {
    const double kept = (1.0 - bank->g[k]) * bank->u[k];
    bank->u[k] = (kept + bank->in[k] * f) - bank->a[k] * bank->x[k];
    bank->x[k] += bank->u[k];
    lanes[k % BANK_LANES] += bank->x[k];
  }
  return sum_of(lanes);
}

static void run_plainly(Trace* trace, Bank bank, uint32_t n_frames) {
  memset(trace, 0, sizeof(*trace));
  for (uint32_t n = 0; n < n_frames; ++n) {
    const double left = heard_by(&bank, 0);
    const double right = heard_by(&bank, 1);
    (void)step_plainly(&bank, (double)force[n]);
    trace->left[n] += (float)(heard_by(&bank, 0) - left);
    trace->right[n] += (float)(heard_by(&bank, 1) - right);
  }
  trace->pushed = step_plainly(&bank, 0.5);
  keep(trace, &bank);
}

static bool is_of_plain_bits(const Bank* bank, const BankKernel* kernel, uint32_t n_frames) {
  static Trace plain;
  static Trace fast;
  Bank other = *bank;
  other.kernel = kernel;
  run_plainly(&plain, *bank, n_frames);
  run_bank(&fast, other, n_frames, n_frames);
  /* The bits are meant.
   * NOLINTNEXTLINE(bugprone-suspicious-memory-comparison,cert-exp42-c,cert-flp37-c) */
  return memcmp(&plain, &fast, sizeof(plain)) == 0;
}

static void assert_plain_bits(const BankKernel* kernel) {
  static const uint32_t lengths[] = {1, 2, 63, 64, 65, 200, 1000};
  Random random = random_start();
  draw_force(&random);
  for (int s = 0; s < N_SIZES; ++s) {
    Bank bank;
    fill(&bank, &random, sizes[s]);
    for (size_t i = 0; i < sizeof(lengths) / sizeof(lengths[0]); ++i) {
      assert_true(is_of_plain_bits(&bank, kernel, lengths[i]));
    }
  }
}

static void every_kernel_gives_the_bits_of_the_plain_source(void** state) {
  (void)state;
  uint32_t i = 0;
  for (; bank_kernel(i); ++i) {
    printf("%s\n", bank_kernel(i)->name);
    assert_plain_bits(bank_kernel(i));
  }
  assert_true(i > 0 && !strcmp(bank_kernel(i - 1)->name, "plain"));
}

static void avx512_is_among_them(void** state) {
  (void)state;
  if (strcmp(bank_kernel(0)->name, "AVX-512") != 0) {
    printf("SKIPPED: this processor has no AVX-512\n");
    skip();
  }
}

static void last_bit_of_one_mode_is_seen(void** state) {
  (void)state;
  Random random = random_start();
  static Trace plain;
  static Trace fast;
  Bank bank;
  draw_force(&random);
  fill(&bank, &random, 100);
  run_plainly(&plain, bank, 1000);
  bank.a[57] = nextafter(bank.a[57], 1.0);
  run_bank(&fast, bank, 1000, 1000);
  assert_memory_not_equal(plain.x, fast.x, sizeof(plain.x));
}

static void cutting_into_calls_does_not_change_a_bit(void** state) {
  (void)state;
  static const uint32_t cuts[] = {1, 7, 64, 1000};
  static Trace whole;
  static Trace cut;
  Random random = random_start();
  draw_force(&random);
  for (uint32_t kernel = 0; bank_kernel(kernel); ++kernel) {
    for (int s = 0; s < N_SIZES; ++s) {
      Bank bank;
      fill(&bank, &random, sizes[s]);
      bank.kernel = bank_kernel(kernel);
      run_bank(&whole, bank, FRAMES, FRAMES);
      assert_true(whole.left[FRAMES - 1] != 0.0f && whole.right[FRAMES - 1] != 0.0f);
      for (size_t c = 0; c < sizeof(cuts) / sizeof(cuts[0]); ++c) {
        run_bank(&cut, bank, FRAMES, cuts[c]);
        assert_memory_equal(&whole, &cut, sizeof(whole));
      }
    }
  }
}

static void pushing_moves_it_as_running_does(void** state) {
  (void)state;
  Random random = random_start();
  draw_force(&random);
  for (uint32_t kernel = 0; bank_kernel(kernel); ++kernel) {
    static Trace trace;
    Bank run;
    double worst = 0.0;
    fill(&run, &random, 100);
    run.kernel = bank_kernel(kernel);
    Bank pushed = run;
    bank_run(&run, force, 1000, trace.left, trace.right);
    for (uint32_t n = 0; n < 1000; ++n) {
      const double y = bank_push(&pushed, (double)force[n]);
      double sum = 0.0;
      double size = 0.0;
      for (uint32_t k = 0; k < pushed.n_added; ++k) {
        sum += pushed.x[k];
        size += fabs(pushed.x[k]);
      }
      worst = fmax(worst, fabs(y - sum) / size);
    }
    assert_memory_equal(run.x, pushed.x, sizeof(run.x));
    assert_memory_equal(run.u, pushed.u, sizeof(run.u));
    /* A hundred roundings of what is at most the sum of all sizes. */
    assert_within("Σ x, over Σ |x|", worst, 100.0 * 0x1p-53);
  }
}

/* Closed form: x_n = Re(C zⁿ), z = exp((−1/τ + 2πj F)/rate), from x_0 = 1, u_0 = 0. */
typedef struct {
  double complex log_z;
  double complex c;
} Ring;

static Ring ring_of(double f0_hz, double tau_s) {
  const double complex log_z = complex_of(-1.0 / (tau_s * RATE_HZ), 2.0 * PI * f0_hz / RATE_HZ);
  const double complex z = cexp(log_z);
  /* The poles are z and its conjugate, so x_1 = (z + z* − z z*) x_0 + z z* u_0. */
  const double x1 = 2.0 * creal(z) - creal(z * conj(z));
  return (Ring){log_z, complex_of(1.0, (creal(z) - x1) / cimag(z))};
}

static double rings(const Ring* ring, double n) {
  return creal(ring->c * cexp(n * ring->log_z));
}

static const uint32_t looks[] = {1, 2, 10, 100, 1000, 4095, 4096, 12000, 30000, 47999, 48000};

/* Worst over the looks, of the amplitude; the tones that are looked for may be others. */
static double worst_ring(uint64_t seed, double wrong_f0, double wrong_tau) {
  static float nothing[RATE];
  static float out[2][RATE];
  Random random = {.state = seed};
  Bank bank;
  Ring ring[BANK_MAX_MODES];
  bank_clear(&bank);
  for (uint32_t k = 0; k < BANK_MAX_MODES; ++k) {
    const double f0_hz = random_log_between(&random, 20.0, 21600.0);
    const double tau_s = k % 4 == 0 ? HUGE_VAL : random_log_between(&random, 0.01, 100.0);
    ring[k] = ring_of(f0_hz * wrong_f0, tau_s * wrong_tau);
    bank_add(&bank, (BankMode){.pole = pole_of(f0_hz, tau_s), .in = 1.0, .out = {1.0, 1.0}});
    bank.x[k] = 1.0;
  }
  double worst = 0.0;
  uint32_t done = 0;
  for (size_t i = 0; i < sizeof(looks) / sizeof(looks[0]); ++i) {
    bank_run(&bank, nothing, looks[i] - done, out[0] + done, out[1] + done);
    done = looks[i];
    for (uint32_t k = 0; k < BANK_MAX_MODES; ++k) {
      worst = fmax(worst, fabs(bank.x[k] - rings(&ring[k], done)) / cabs(ring[k].c));
    }
  }
  return worst;
}

static void every_mode_rings_at_its_frequency_and_decay(void** state) {
  (void)state;
  const uint64_t seed = random_start().state;
  assert_within("x, of the amplitude", worst_ring(seed, 1.0, 1.0), 1e-9);
  /* A millionth of a hertz in a hundred, and a millionth of the decay, would be seen. */
  assert_true(worst_ring(seed, 1.0 + 1e-8, 1.0) > 1e-6);
  assert_true(worst_ring(seed, 1.0, 1.0 + 1e-6) > 1e-8);
}

static void one_mode_is_heard_by_what_it_speeds_up(void** state) {
  (void)state;
  static float nothing[RATE];
  static float out[2][RATE];
  const double f0_hz = 440.0;
  const double tau_s = 0.5;
  const Ring ring = ring_of(f0_hz, tau_s);
  Bank bank;
  bank_clear(&bank);
  bank_add(&bank, (BankMode){.pole = pole_of(f0_hz, tau_s), .in = 1.0, .out = {0.5, -2.0}});
  bank.x[0] = 1.0;
  memset(out, 0, sizeof(out));
  bank_run(&bank, nothing, RATE, out[0], out[1]);
  double worst = 0.0;
  for (int n = 2; n < RATE; ++n) {
    /* Sample n is of the step to x_{n+1}, and d is how much the step has grown. */
    const double d = rings(&ring, n + 1) - 2.0 * rings(&ring, n) + rings(&ring, n - 1);
    worst = fmax(worst, fabs((double)out[0][n] - 0.5 * d));
    worst = fmax(worst, fabs((double)out[1][n] + 2.0 * d));
  }
  /* Samples are floats, of no more than 2 θ². */
  const double angle = 2.0 * PI * f0_hz / RATE_HZ;
  assert_within("samples, over θ²", worst / (angle * angle), 2.0 * 0x1p-24 + 1e-9);
}

/* One bin of a transform over a second. */
static double complex bin(const float* samples, uint32_t hz) {
  double complex sum = 0.0;
  for (uint32_t n = 0; n < RATE; ++n) {
    const double turn = -2.0 * PI * (double)((uint64_t)n * hz % RATE) / RATE;
    sum += (double)samples[n] * complex_of(cos(turn), sin(turn));
  }
  return sum;
}

/*
  With q = 1 − 1/z:  U = D/q,  X = U/q,  D = i F − (a X + g U)/z, so that

      D/F = i q² z/(q² z + a + g q).
*/
typedef struct {
  double complex heard[2]; /* D/F, by l and by r */
  double complex pulled;   /* X/F */
  double size;             /* Σ |l D/F|, that roundings are of */
  double pulled_size;
} Response;

static Response response_of(const Bank* bank, double complex z) {
  Response response = {.size = 0.0};
  const double complex q = 1.0 - 1.0 / z;
  for (uint32_t k = 0; k < bank->n_added; ++k) {
    const double complex x = bank->in[k] * z / (q * q * z + bank->a[k] + bank->g[k] * q);
    const double complex d = q * q * x;
    response.heard[0] += bank->out[0][k] * d;
    response.heard[1] += bank->out[1][k] * d;
    response.pulled += x;
    response.size += fmax(fabs(bank->out[0][k]), fabs(bank->out[1][k])) * cabs(d);
    response.pulled_size += cabs(x);
  }
  return response;
}

enum { N_DRIVEN = 100, WARM_S = 2 };

/* Modes that have forgotten their beginning when they have been driven for WARM_S. */
static void fill_driven(Bank* bank, Random* random) {
  bank_clear(bank);
  for (int k = 0; k < N_DRIVEN; ++k) {
    BankMode mode = mode_at_random(random);
    mode.pole = pole_of(random_log_between(random, 20.0, 21600.0),
                        random_log_between(random, 1e-3, 0.04 * WARM_S));
    bank_add(bank, mode);
  }
}

static double worst_driven(Bank bank, uint32_t hz, const Bank* expected) {
  static float sine[RATE];
  static float out[2][RATE];
  const double complex z = cexp(complex_of(0.0, 2.0 * PI * hz / RATE));
  for (uint32_t n = 0; n < RATE; ++n) {
    sine[n] = (float)sin(2.0 * PI * (double)((uint64_t)n * hz % RATE) / RATE);
  }
  for (int second = 0; second < WARM_S + 1; ++second) {
    memset(out, 0, sizeof(out));
    bank_run(&bank, sine, RATE, out[0], out[1]);
  }
  const Response response = response_of(expected, z);
  const double complex driving = bin(sine, hz);
  double worst = 0.0;
  for (int side = 0; side < 2; ++side) {
    worst = fmax(worst, cabs(bin(out[side], hz) / driving - response.heard[side]) / response.size);
  }
  return worst;
}

static void driven_bank_answers_by_its_transfer_function(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  double least_wrong = HUGE_VAL;
  for (int trial = 0; trial < 10; ++trial) {
    Bank bank;
    fill_driven(&bank, &random);
    const uint32_t hz = (uint32_t)random_log_between(&random, 20.0, 23900.0);
    Bank other = bank;
    worst = fmax(worst, worst_driven(bank, hz, &bank));
    for (uint32_t k = 0; k < other.n_added; ++k) {
      other.in[k] *= 1.0 + 1e-5;
    }
    least_wrong = fmin(least_wrong, worst_driven(bank, hz, &other));
  }
  /* Floats are rounded to 6e-8, and a bin is a mean of 48,000. */
  assert_within("D/F, over Σ |D/F|", worst, 1e-9);
  assert_true(least_wrong > 1e-8);
}

/* The state that a steady force of Re zⁿ has left before n = 0. */
static void set_steady(Bank* bank, double complex z) {
  const double complex q = 1.0 - 1.0 / z;
  for (uint32_t k = 0; k < bank->n_added; ++k) {
    const double complex x = bank->in[k] * z / (q * q * z + bank->a[k] + bank->g[k] * q);
    bank->x[k] = creal(x / z);
    bank->u[k] = creal(q * x / z);
  }
}

static void pushed_bank_is_where_its_transfer_function_says(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 50; ++trial) {
    Bank bank;
    fill(&bank, &random, 200);
    const double angle = 2.0 * PI * random_log_between(&random, 20.0, 23900.0) / RATE_HZ;
    const Response response = response_of(&bank, cexp(complex_of(0.0, angle)));
    set_steady(&bank, cexp(complex_of(0.0, angle)));
    for (int n = 0; n < 2000; ++n) {
      const double y = bank_push(&bank, cos(n * angle));
      const double expected = creal(response.pulled * cexp(complex_of(0.0, n * angle)));
      worst = fmax(worst, fabs(y - expected) / response.pulled_size);
    }
  }
  assert_within("Σ x, over Σ |X/F|", worst, 1e-9);
}

/*
  A step takes (x, u) to A (x, u), and w = a x + (1 − a − z) u to z w, where z is one of A's two
  eigenvalues: so |w| never grows, whether they are a pair or real.
*/
static double coordinate(const Bank* bank, uint32_t k, double complex z, double* size) {
  const double complex of_u = 1.0 - bank->a[k] - z;
  *size = bank->a[k] * fabs(bank->x[k]) + cabs(of_u) * fabs(bank->u[k]);
  return cabs(bank->a[k] * bank->x[k] + of_u * bank->u[k]);
}

/* By how much a mode has grown at most in 100 steps, over what roundings are of. */
static double worst_growth(Bank* bank) {
  static double before[BANK_MAX_MODES][2];
  double worst = -HUGE_VAL;
  for (int n = 0; n <= 100; ++n) {
    for (uint32_t k = 0; k < bank->n_added; ++k) {
      double complex z[2];
      oracle_mass_poles(bank->a[k], bank->g[k], z);
      for (int i = 0; i < 2; ++i) {
        double size = 0.0;
        const double now = coordinate(bank, k, z[i], &size);
        worst = n > 0 && size > 0.0 ? fmax(worst, (now - before[k][i]) / size) : worst;
        before[k][i] = now;
      }
    }
    (void)bank_push(bank, 0.0);
  }
  return worst;
}

static void start_at_random(Bank* bank, Random* random) {
  for (uint32_t k = 0; k < bank->n_added; ++k) {
    bank->x[k] = random_between(random, -1.0, 1.0);
    bank->u[k] = random_between(random, -1.0, 1.0);
  }
}

static void left_alone_no_stable_mode_grows(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  uint32_t n_regions[POLE_REGION_COUNT] = {0};
  for (int trial = 0; trial < 40; ++trial) {
    Bank bank;
    bank_clear(&bank);
    while (bank.n_added < 250) {
      const double g = trial % 4 == 0 ? 0.0 : random_between(&random, 0.0, 2.0);
      const Pole pole = {random_log_between(&random, 1e-6, 4.0 - 2.0 * g), g};
      assert_true(pole_is_stable(pole));
      ++n_regions[pole_region(pole)];
      bank_add(&bank, (BankMode){.pole = pole});
    }
    start_at_random(&bank, &random);
    worst = fmax(worst, worst_growth(&bank));
  }
  printf("%u vibrate, %u creep, %u flip\n", n_regions[POLE_COMPLEX], n_regions[POLE_REAL_AT_ZERO],
         n_regions[POLE_REAL_AT_PI]);
  assert_true(n_regions[POLE_COMPLEX] > 1000 && n_regions[POLE_REAL_AT_ZERO] > 1000 &&
              n_regions[POLE_REAL_AT_PI] > 100);
  /* Four roundings a step, and of the eigenvalue, which near a double one is known to their root.
   */
  assert_within("growth, of its size", worst, 1e-13);
}

static void unstable_mode_is_seen_to_grow(void** state) {
  (void)state;
  Random random = random_start();
  Bank bank;
  bank_clear(&bank);
  bank_add(&bank, (BankMode){.pole = {0.01, -1e-9}});
  start_at_random(&bank, &random);
  assert_true(worst_growth(&bank) > 1e-11);
}

static void without_modes_it_is_silent(void** state) {
  (void)state;
  Random random = random_start();
  float out[2][64];
  float as_it_was[64];
  static Bank bank;
  draw_force(&random);
  for (int n = 0; n < 64; ++n) {
    out[0][n] = out[1][n] = as_it_was[n] = (float)n;
  }
  for (int round = 0; round < 2; ++round) {
    bank_run(&bank, force, 64, out[0], out[1]);
    assert_memory_equal(out[0], as_it_was, sizeof(as_it_was));
    assert_memory_equal(out[1], as_it_was, sizeof(as_it_was));
    assert_true(bank_push(&bank, 1.0) == 0.0);
    assert_true(bank_level(&bank) == 0.0);
    bank_add(&bank, mode_at_random(&random));
    bank_clear(&bank);
  }
}

static void no_frames_change_nothing(void** state) {
  (void)state;
  Random random = random_start();
  Bank bank;
  fill(&bank, &random, 20);
  const Bank before = bank;
  bank_run(&bank, NULL, 0, NULL, NULL);
  assert_memory_equal(&bank, &before, sizeof(bank));
}

static void one_mode_too_many_is_left_out(void** state) {
  (void)state;
  Random random = random_start();
  static Bank bank;
  fill(&bank, &random, BANK_MAX_MODES);
  assert_int_equal(bank.n_added, BANK_MAX_MODES);
  const Bank full = bank;
  bank_add(&bank, mode_at_random(&random));
  assert_memory_equal(&bank, &full, sizeof(bank));
}

static void rest_is_silent_and_level_is_the_largest(void** state) {
  (void)state;
  Random random = random_start();
  static Trace trace;
  Bank bank;
  fill(&bank, &random, 77);
  assert_true(bank_level(&bank) == 0.0);
  bank.x[3] = -3.0;
  bank.u[76] = 2.0;
  assert_true(bank_level(&bank) == 3.0);
  bank.u[76] = -4.0;
  assert_true(bank_level(&bank) == 4.0);
  bank_rest(&bank);
  assert_true(bank_level(&bank) == 0.0);
  memset(force, 0, sizeof(force));
  run_bank(&trace, bank, 100, 100);
  for (int n = 0; n < 100; ++n) {
    assert_true(trace.left[n] == 0.0f && trace.right[n] == 0.0f);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_kernel_gives_the_bits_of_the_plain_source),
      cmocka_unit_test(avx512_is_among_them),
      cmocka_unit_test(last_bit_of_one_mode_is_seen),
      cmocka_unit_test(cutting_into_calls_does_not_change_a_bit),
      cmocka_unit_test(pushing_moves_it_as_running_does),
      cmocka_unit_test(every_mode_rings_at_its_frequency_and_decay),
      cmocka_unit_test(one_mode_is_heard_by_what_it_speeds_up),
      cmocka_unit_test(driven_bank_answers_by_its_transfer_function),
      cmocka_unit_test(pushed_bank_is_where_its_transfer_function_says),
      cmocka_unit_test(left_alone_no_stable_mode_grows),
      cmocka_unit_test(unstable_mode_is_seen_to_grow),
      cmocka_unit_test(without_modes_it_is_silent),
      cmocka_unit_test(no_frames_change_nothing),
      cmocka_unit_test(one_mode_too_many_is_left_out),
      cmocka_unit_test(rest_is_silent_and_level_is_the_largest),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* What a strike sounds like: as loud as a pluck, brighter the harder, and then the string's own. */
#include "core/excite/hammer.h"

#include "core/excite/pluck.h"
#include "core/excite/rehearsal.h"
#include "tests/support/hammers.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

static _Alignas(CHAIN_ALIGNMENT) char memory[32 * CHAIN_MAX_MASSES];

static void strikes_are_as_loud_as_plucks(void** state) {
  (void)state;
  static const uint32_t limits[] = {1, 2, 3, 5, 12, 40, 128, 1024};
  static const double places[] = {0.0, 0.13, 0.3};
  static const double masses[] = {0.1, 0.3, 0.6};
  static const double amplitudes[] = {0.25, 0.01, 1e-4};
  double worst[3] = {0.0};
  print_message("  dB against the pluck, hardness 0, 0.5, 1 at amplitude 0.25, 0.01, 0.0001\n");
  for (size_t m = 0; m < 3; ++m) {
    for (size_t p = 0; p < 3; ++p) {
      print_message("  mass %.2f place %.2f ", masses[m], places[p]);
      for (size_t s = 0; s < 9; ++s) {
        double least = HUGE_VAL;
        double most = -HUGE_VAL;
        for (uint32_t c = 0; c < 40; ++c) {
          const uint32_t key = 21 + 29 * ((uint32_t)(c + m + p) % 4);
          Strung strung;
          uint32_t n_pressed = 0;
          strung_key(&strung, memory, key, strung_rate_hz(c / 8), limits[c % 8], 1e9);
          const double hardness = 0.5 * (double)(s % 3);
          pluck_pull(&strung.chain, (Pluck){places[p], hardness, amplitudes[s / 3], 0.0});
          const double plucked = strung_fundamental(&strung);
          chain_rest(&strung.chain);
          hammers_strike(&strung, (Strike){places[p], hardness, masses[m], amplitudes[s / 3]},
                         &n_pressed);
          const double decibels = 20.0 * log10(strung_fundamental(&strung) / plucked);
          least = fmin(least, decibels);
          most = fmax(most, decibels);
        }
        worst[m] = fmax(worst[m], fmax(-least, most));
        print_message(" %5.1f…%.1f", least, most);
      }
      print_message("\n");
    }
  }
  assert_within("dB between a strike and a pluck", fmax(worst[0], worst[1]), 3.0);
  /* This one strikes again and again, and where is a matter of hairs. */
  assert_within("dB of the heaviest", worst[2], 6.0);
}

/* Centre of the spectrum, in partials, by what each mode has. */
static double centroid(const Strung* strung) {
  Motion motion;
  double sum = 0.0;
  double weighted = 0.0;
  strung_read(strung, &motion);
  for (uint32_t k = 1; k <= motion.n; ++k) {
    const double a = tuning_mode(strung->chain.now, motion.n, k).a;
    double x = 0.0;
    double u = 0.0;
    for (uint32_t i = 0; i < motion.n; ++i) {
      const double sine = sin(PI * k * (i + 1.0) / (motion.n + 1.0));
      x += sine * motion.x[i];
      u += sine * motion.u[i];
    }
    const double amplitude = sqrt(fmax(0.0, (x * x - x * u + u * u / a) / (1.0 - 0.25 * a)));
    sum += amplitude;
    weighted += k * amplitude;
  }
  return weighted / sum;
}

static void harder_strikes_are_brighter(void** state) {
  (void)state;
  for (int by = 0; by < 3; ++by) {
    double before = 0.0;
    for (int step = 0; step <= 6; ++step) {
      Strike wanted = {0.12, 0.5, 0.1, 0.05};
      Strung strung;
      uint32_t n_pressed = 0;
      strung_key(&strung, memory, 48, 48000.0, 100, 1e9);
      wanted.amplitude = by == 0 ? 1e-4 * pow(10.0, 0.5 * step) : wanted.amplitude;
      wanted.hardness = by == 1 ? step / 6.0 : wanted.hardness;
      if (by < 2) {
        hammers_strike(&strung, wanted, &n_pressed);
      } else {
        /* The same hammer, thrown faster. */
        HammerMake make = rehearsal_make(100, wanted, strung.angle1);
        Hammer hammer;
        make.velocity *= exp2(step - 3.0);
        hammer_start(&hammer, &strung.chain, make, strung.rate_hz);
        do {
          strung_step(&strung, 0);
        } while (hammer_act(&hammer, &strung.chain));
      }
      const double centre = centroid(&strung);
      print_message("  %.2f", centre);
      assert_true(centre > 1.02 * before);
      before = centre;
    }
    print_message("\n");
  }
}

static void contact_lasts_as_long_at_any_rate(void** state) {
  (void)state;
  static const uint32_t limits[] = {24, 48, 128, 400};
  double least_s = HUGE_VAL;
  double most_s = 0.0;
  for (uint32_t r = 0; r < STRUNG_N_RATES; ++r) {
    for (size_t l = 0; l < 4; ++l) {
      Strung strung;
      uint32_t n_pressed = 0;
      strung_key(&strung, memory, 45, strung_rate_hz(r), limits[l], 2.0);
      hammers_strike(&strung, (Strike){0.12, 0.4, 0.1, 0.1}, &n_pressed);
      least_s = fmin(least_s, n_pressed / strung.rate_hz);
      most_s = fmax(most_s, n_pressed / strung.rate_hz);
    }
  }
  print_message("  %.3f to %.3f ms\n", 1e3 * least_s, 1e3 * most_s);
  assert_within("longest against shortest", most_s / least_s - 1.0, 0.15);
  assert_in_range((uintmax_t)(1e6 * most_s), 300, 4000);
}

static void pitch_and_decay_after_a_strike_are_the_strings(void** state) {
  (void)state;
  enum { MOST = 400000 };
  static float heard[MOST];
  static const uint32_t keys[] = {21, 40, 60, 84, 108};
  double worst_cents = 0.0;
  double worst_decay = 0.0;
  for (size_t k = 0; k < 5; ++k) {
    for (uint32_t r = 0; r < STRUNG_N_RATES; ++r) {
      const double tau_s = keys[k] < 30 ? 3.0 : 0.7;
      Strung strung;
      Tone tone;
      uint32_t n_pressed = 0;
      strung_key(&strung, memory, keys[k], strung_rate_hz(r), 128, tau_s);
      hammers_strike(&strung, (Strike){0.3, 0.5, 0.1, 0.25}, &n_pressed);
      chain_settle(&strung.chain);
      const size_t n = (size_t)fmin(MOST, 3.0 * tau_s * strung.rate_hz);
      for (size_t i = 0; i < n; ++i) {
        heard[i] = strung_step(&strung, strung.chain.n_masses / 5);
      }
      const Tone near = {strung.f0_hz, tau_s};
      assert_true(measure_tone(heard, n, strung.rate_hz, near, &tone));
      worst_cents = fmax(worst_cents, fabs(measure_cents(tone.f0_hz, strung.f0_hz)));
      worst_decay = fmax(worst_decay, fabs(tone.tau_s / tau_s - 1.0));
    }
  }
  assert_within("cents", worst_cents, 0.005);
  assert_within("decay, relative", worst_decay, 2e-4);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(strikes_are_as_loud_as_plucks),
      cmocka_unit_test(harder_strikes_are_brighter),
      cmocka_unit_test(contact_lasts_as_long_at_any_rate),
      cmocka_unit_test(pitch_and_decay_after_a_strike_are_the_strings),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

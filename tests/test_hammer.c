#include "core/hammer.h"

#include "core/exciter.h"
#include "core/rehearsal.h"
#include "tests/measure.h"
#include "tests/oracle.h"
#include "tests/strung.h"
#include "tools/bench_clock.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

static _Alignas(CHAIN_ALIGNMENT) char memory[32 * CHAIN_MAX_MASSES];

static bool is_long(void) {
  return getenv("HOOKE_TEST_LONG");
}

/* The felt's energy a second way. */
static double stored(const Felt* felt, double c) {
  return c > 0.0 ? felt->stiffness * pow(c, felt->exponent + 1.0) / (felt->exponent + 1.0) : 0.0;
}

/* Scaled so that one blow presses a rigid felt of this kind by about `depth`. */
static HammerMake make_anyhow(Random* random, double loss) {
  const double velocity = random_log_between(random, 1e-6, 1e3);
  const double exponent = random_between(random, 1.0, 5.0);
  const double depth = velocity * random_log_between(random, 1e-3, 1e3);
  const double mass = random_log_between(random, 1e-4, 1e3);
  return (HammerMake){
      .place = random_between(random, -0.1, 1.1),
      .mass = mass,
      .felt = {.stiffness =
                   0.5 * (exponent + 1.0) * mass * velocity * velocity / pow(depth, exponent + 1.0),
               .exponent = exponent,
               .loss = loss > 0.0 ? random_log_between(random, 1e-2, 10.0) / velocity : 0.0},
      .velocity = velocity,
  };
}

/* Hammer and felt; the felt's two compressions are worked out from positions. */
static double hammer_energy(const Hammer* hammer, const Strung* strung, const Motion* motion) {
  const double length = strung->chain.n_masses + 1.0;
  const double at = fmin(fmax(hammer->make.place * length, 1.0), length - 1.0);
  const uint32_t i = (uint32_t)at;
  const double w = at - i;
  const double x = (1.0 - w) * motion->x[i - 1] + (w > 0.0 ? w * motion->x[i] : 0.0);
  const double u = (1.0 - w) * motion->u[i - 1] + (w > 0.0 ? w * motion->u[i] : 0.0);
  const double now = hammer->position - x;
  const double before = now - hammer->velocity + u;
  Felt felt = hammer->make.felt;
  felt.stiffness *= hammer->grip * length;
  return 0.5 * hammer->make.mass * length * hammer->velocity * hammer->velocity +
         0.5 * (stored(&felt, now) + stored(&felt, before));
}

static void shake(Strung* strung, Random* random, double size) {
  for (uint32_t i = 0; i < strung->chain.n_masses; ++i) {
    chain_place(&strung->chain, i, (float)(size * random_between(random, -1.0, 1.0)),
                (float)(size * random_between(random, -1.0, 1.0)));
  }
}

typedef struct {
  double drift;  /* Largest |change| of the energy in a step, without loss, of all */
  double growth; /* Largest growth in a step */
  uint32_t n_contacts;
} Balance;

/* Follow one hammer on one string, with all energies in double, step by step. */
static void follow(Strung* strung, Hammer* hammer, uint32_t most, Balance* balance) {
  static Motion motion;
  static Motion free;
  const StringCoefs coefs = strung->chain.now;
  strung_read(strung, &motion);
  double felt = hammer_energy(hammer, strung, &motion);
  double before = strung_energy(&motion, coefs) + felt;
  const double whole = before + 1e-300;
  bool was_pressed = false;
  for (uint32_t n = 0; n < most && hammer->is_active; ++n) {
    /* What dampers take: ½ (u' + u)ᵀZ u, from the motion before and after. */
    free = motion;
    strung_step(strung, 0);
    hammer_act(hammer, &strung->chain);
    strung_read(strung, &motion);
    double lost = 0.0;
    for (uint32_t i = 0; i < motion.n; ++i) {
      const double left = i > 0 ? free.u[i - 1] : 0.0;
      const double right = i + 1 < motion.n ? free.u[i + 1] : 0.0;
      const double drag = coefs.z0 * free.u[i] + coefs.z1 * (2.0 * free.u[i] - left - right);
      lost += 0.5 * (motion.u[i] + free.u[i]) * drag;
    }
    felt = hammer_energy(hammer, strung, &motion);
    const double after = strung_energy(&motion, coefs) + felt;
    const double change = (after + lost - before) / fmax(whole, fabs(before));
    balance->drift = fmax(balance->drift, fabs(change));
    balance->growth = fmax(balance->growth, change);
    balance->n_contacts += hammer->force > 0.0 && !was_pressed;
    was_pressed = hammer->force > 0.0;
    assert_true(hammer->force >= 0.0 && isfinite(after));
    before = after;
  }
}

static void balance_anyhow(double loss, uint32_t n_contacts, Balance* balance) {
  Random random = random_start();
  while (balance->n_contacts < n_contacts) {
    Strung strung;
    strung_up_anywhere(&strung, memory, &random, CHAIN_DOUBLE);
    for (int k = 0; k < 200; ++k) {
      const HammerMake make = make_anyhow(&random, loss);
      Hammer hammer;
      if (strung.chain.n_masses > 40 && k > 10) {
        break; /* Long strings take long to add up. */
      }
      shake(&strung, &random, random_below(&random, 2) ? 0.0 : make.velocity);
      hammer_start(&hammer, &strung.chain, make, strung.rate_hz);
      follow(&strung, &hammer, 24, balance);
    }
  }
}

static void energy_is_kept_to_rounding(void** state) {
  (void)state;
  Balance balance = {0};
  balance_anyhow(0.0, is_long() ? 1000000 : 100000, &balance);
  print_message("  %u contacts\n", balance.n_contacts);
  /* Felts are pressed by the difference of positions, and some are as stiff as 10³ strings. */
  assert_within("change of energy in a step, of all of it", balance.drift, 3e-11);
}

static void lossy_felts_never_add_energy(void** state) {
  (void)state;
  Balance balance = {0};
  balance_anyhow(1.0, is_long() ? 1000000 : 100000, &balance);
  assert_within("growth of energy in a step, of all of it", balance.growth, 3e-11);
  assert_true(balance.drift > 1e-2);
}

/* The force that leaves nothing over, by halving alone, in the felt's own equation. */
static void felt_solves_its_equation(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int n = 0; n < 100000; ++n) {
    const Felt felt = {random_log_between(&random, 1e-20, 1e20), random_between(&random, 1.0, 5.0),
                       random_below(&random, 2) ? random_log_between(&random, 1e-3, 1e3) : 0.0};
    const double free = random_between(&random, -1.0, 1.0) * random_log_between(&random, 1e-6, 1.0);
    const double before = random_below(&random, 4)
                              ? random_between(&random, -1.0, 1.0)
                              : free * (1.0 + random_between(&random, -1e-3, 1e-3));
    const double admittance = random_log_between(&random, 0.5, 1e4);
    double after = 0.0;
    const double force = felt_press(&felt, before, free, admittance, &after);
    double low = fmin(0.0, free) - 1.0;
    double high = free;
    while (low > -1e40 && low > before - 1e40) {
      const double d = low - before;
      const double f = d == 0.0 ? 0.0 : (stored(&felt, low) - stored(&felt, before)) / d;
      if (low - free + admittance * f * fmax(0.0, 1.0 + felt.loss * d) <= 0.0) {
        break;
      }
      low = 2.0 * low - high;
    }
    const double lowest = low;
    for (int i = 0; i < 400; ++i) {
      const double c = 0.5 * (low + high);
      const double d = c - before;
      const double f = d == 0.0 ? 0.0 : (stored(&felt, c) - stored(&felt, before)) / d;
      if (c - free + admittance * f * fmax(0.0, 1.0 + felt.loss * d) > 0.0) {
        high = c;
      } else {
        low = c;
      }
    }
    assert_true(force >= 0.0 && isfinite(force));
    worst = fmax(worst, fabs(after - 0.5 * (low + high)) / (free - lowest));
    assert_true(fabs(after - (free - admittance * force)) <= 1e-14 * fmax(1.0, fabs(after)));
  }
  /* The halving divides a difference of energies by one of compressions. */
  assert_within("compression, of where it was sought", worst, 1e-12);
}

static void strung_for(Strung* strung, uint32_t key, double rate_hz, uint32_t limit, double tau_s) {
  const TuningTarget target = {.rate_hz = rate_hz,
                               .tone = {strung_pitch_hz(key), tau_s},
                               .loss = 0.01,
                               .partials = PARTIALS_TRUEST};
  strung_up(strung, memory, &target, limit, CHAIN_FLOAT);
}

/* Strike, and step until the hammer has left; its steps, and those in which it pressed. */
static uint32_t strike(Strung* strung, Strike wanted, uint32_t* n_pressed) {
  Hammer hammer;
  uint32_t n = 0;
  hammer_throw(&hammer, &strung->chain, wanted, strung->angle1, strung->rate_hz);
  *n_pressed = 0;
  do {
    strung_step(strung, 0);
    ++n;
    *n_pressed +=
        hammer_act(&hammer, &strung->chain) || hammer.force > 0.0 ? hammer.force > 0.0 : 0;
  } while (hammer.is_active);
  return n;
}

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
          strung_for(&strung, key, strung_rate_hz(c / 8), limits[c % 8], 1e9);
          const double hardness = 0.5 * (double)(s % 3);
          exciter_pluck(&strung.chain, (Pluck){places[p], hardness, amplitudes[s / 3]},
                        strung.angle1);
          const double plucked = strung_fundamental(&strung);
          chain_rest(&strung.chain);
          strike(&strung, (Strike){places[p], hardness, masses[m], amplitudes[s / 3]}, &n_pressed);
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
      strung_for(&strung, 48, 48000.0, 100, 1e9);
      wanted.amplitude = by == 0 ? 1e-4 * pow(10.0, 0.5 * step) : wanted.amplitude;
      wanted.hardness = by == 1 ? step / 6.0 : wanted.hardness;
      if (by < 2) {
        strike(&strung, wanted, &n_pressed);
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
      strung_for(&strung, 45, strung_rate_hz(r), limits[l], 2.0);
      strike(&strung, (Strike){0.12, 0.4, 0.1, 0.1}, &n_pressed);
      least_s = fmin(least_s, n_pressed / strung.rate_hz);
      most_s = fmax(most_s, n_pressed / strung.rate_hz);
    }
  }
  print_message("  %.3f to %.3f ms\n", 1e3 * least_s, 1e3 * most_s);
  assert_within("longest against shortest", most_s / least_s - 1.0, 0.15);
  assert_in_range((uintmax_t)(1e6 * most_s), 300, 4000);
}

static void hammers_leave_for_good(void** state) {
  (void)state;
  Random random = random_start();
  const double most_s = HAMMER_MOST_S + HAMMER_LEAVING_S;
  double longest_s = 0.0;
  uint32_t n_early = 0;
  for (int k = 0; k < 1500; ++k) {
    Strung strung;
    Hammer hammer;
    strung_up_anywhere(&strung, memory, &random, CHAIN_FLOAT);
    const bool is_wanted = random_below(&random, 2);
    const double size = random_below(&random, 2) ? 0.3 : 0.0;
    shake(&strung, &random, size);
    if (is_wanted) {
      const Strike wanted = {random_between(&random, 0.0, 1.0), random_between(&random, 0.0, 1.0),
                             random_log_between(&random, 0.02, 1.0),
                             random_log_between(&random, 1e-5, 1.0)};
      hammer_throw(&hammer, &strung.chain, wanted, strung.angle1, strung.rate_hz);
    } else {
      hammer_start(&hammer, &strung.chain, make_anyhow(&random, 1.0), strung.rate_hz);
    }
    /* None comes with its felt pressed, not even before a string that runs from it. */
    const double rounding = 1e-12 * (1.0 + fabs(hammer.position) + hammer.velocity);
    assert_true(hammer.now <= rounding && hammer.before <= rounding);
    uint32_t n = 0;
    do {
      strung_step(&strung, 0);
      ++n;
    } while (hammer_act(&hammer, &strung.chain));
    longest_s = fmax(longest_s, (n - 4.0) / strung.rate_hz);
    if (n < HAMMER_MOST_S * strung.rate_hz) {
      /* It said that the string cannot reach it: look whether it could. */
      ++n_early;
      hammer.is_active = true;
      hammer.far = HUGE_VAL;
      for (int i = 0; i < 2000; ++i) {
        strung_step(&strung, 0);
        hammer_act(&hammer, &strung.chain);
        assert_true(hammer.force == 0.0);
      }
    }
    hammer.is_active = false;
    const float x = chain_position(&strung.chain, 0);
    assert_false(hammer_act(&hammer, &strung.chain));
    assert_true(chain_position(&strung.chain, 0) == x);
  }
  assert_within("longest [s]", longest_s, most_s);
  assert_true(n_early > 500);
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
      strung_for(&strung, keys[k], strung_rate_hz(r), 128, tau_s);
      strike(&strung, (Strike){0.3, 0.5, 0.1, 0.25}, &n_pressed);
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

/* In floats, again and again on a string that rings: all that it ever has is what was thrown. */
static void storms_of_strikes_stay_bounded(void** state) {
  (void)state;
  static Motion motion;
  Random random = random_start();
  for (int k = 0; k < (is_long() ? 2000 : 200); ++k) {
    Strung strung;
    Hammer hammers[2] = {0};
    double thrown = 0.0;
    strung_up_anywhere(&strung, memory, &random, CHAIN_FLOAT);
    for (int n = 0; n < 3000; ++n) {
      for (int h = 0; h < 2; ++h) {
        if (!hammers[h].is_active && random_below(&random, 100) == 0) {
          HammerMake make = make_anyhow(&random, 1.0);
          make.velocity = fmin(make.velocity, 1.0);
          make.place = h == 0 ? 0.2 : 0.8;
          hammer_start(&hammers[h], &strung.chain, make, strung.rate_hz);
          thrown += 0.5 * make.mass * (strung.chain.n_masses + 1.0) * make.velocity * make.velocity;
        }
      }
      strung_step(&strung, 0);
      hammer_act(&hammers[0], &strung.chain);
      hammer_act(&hammers[1], &strung.chain);
    }
    strung_read(&strung, &motion);
    const double energy = motion_energy(&motion, strung.chain.now);
    /* Two hammers on the same few masses are not exactly solved for together. */
    const double most = strung.chain.n_masses > 10 ? 1.001 : 4.0;
    assert_true(isfinite(energy) && energy <= most * thrown);
  }
}

static void a_strike_adds_to_what_rings(void** state) {
  (void)state;
  double before = 0.0;
  Strung strung;
  uint32_t n_pressed = 0;
  strung_for(&strung, 52, 48000.0, 128, 1e9);
  for (int k = 0; k < 50; ++k) {
    strike(&strung, (Strike){0.12, 0.5, 0.1, 0.1}, &n_pressed);
    assert_true(n_pressed > 3);
    for (int i = 0; i < 97 * k; ++i) {
      strung_step(&strung, 0);
    }
  }
  before = strung_fundamental(&strung);
  /* Fifty at random phases: about seven times one, and at most fifty times. */
  assert_true(before > 0.1 && before < 50.0 * 0.1 * 4.0 / PI);
}

static void frames_may_be_cut_anyhow(void** state) {
  (void)state;
  float heard[2][4000];
  for (int way = 0; way < 2; ++way) {
    Strung strung;
    Hammer hammer;
    strung_for(&strung, 60, 48000.0, 128, 1.0);
    hammer_throw(&hammer, &strung.chain, (Strike){0.12, 0.5, 0.1, 0.1}, strung.angle1, 48000.0);
    memset(heard[way], 0, sizeof heard[way]);
    for (uint32_t n = 0; n < 4000;) {
      const uint32_t most = way == 0 ? 1 : 257;
      const uint32_t stretch = hammer.is_active ? 1 : most < 4000 - n ? most : 4000 - n;
      float* const out[] = {heard[way] + n};
      chain_run(&strung.chain, stretch, &(ChainTap){{3, 4}, {0.5f, 0.5f}}, 1, out);
      hammer_act(&hammer, &strung.chain);
      n += stretch;
    }
    assert_false(hammer.is_active);
  }
  assert_memory_equal(heard[0], heard[1], sizeof heard[0]);
}

/* After a pluck in mid-contact, or a change of masses, a look makes the books balance again. */
static void looking_anew_mends_the_books(void** state) {
  (void)state;
  Random random = random_start();
  Balance balance = {0};
  for (int k = 0; k < 300; ++k) {
    Strung strung;
    Hammer hammer;
    strung_up_anywhere(&strung, memory, &random, CHAIN_DOUBLE);
    const HammerMake make = make_anyhow(&random, 0.0);
    hammer_start(&hammer, &strung.chain, make, strung.rate_hz);
    follow(&strung, &hammer, 3, &balance);
    const double pushed = hammer.force > 0.0 ? 0.1 * hammer.now : make.velocity;
    chain_push(&strung.chain, strung.chain.n_masses / 2, (float)pushed);
    hammer_look(&hammer, &strung.chain);
    follow(&strung, &hammer, 10, &balance);
  }
  assert_within("change of energy in a step, of all of it", balance.drift, 3e-11);
}

static void a_hammer_costs_next_to_nothing(void** state) {
  (void)state;
  enum { N = 20000 };
  Strung strung;
  Hammer pressed;
  Hammer flying;
  Hammer gone = {0};
  strung_for(&strung, 33, 48000.0, 128, 1.0);
  /* A heavy, slow one that never lets go, and one that never comes. */
  hammer_start(&pressed, &strung.chain, (HammerMake){0.3, 100.0, {1e-4, 2.5, 0.0}, 1e-6}, 1e9);
  hammer_start(&flying, &strung.chain, (HammerMake){0.3, 0.1, {1e-4, 2.5, 0.0}, -1e-9}, 1e9);
  flying.position = -10.0;
  flying.far = HUGE_VAL;
  Hammer* const hammers[] = {&pressed, &flying, &gone};
  static const char* const names[] = {"pressed", "flying", "gone"};
  for (int h = 0; h < 3; ++h) {
    const double start_s = bench_clock_now_s();
    for (int i = 0; i < N; ++i) {
      hammer_act(hammers[h], &strung.chain);
    }
    print_message("  %-8s %6.1f ns a frame\n", names[h], 1e9 * (bench_clock_now_s() - start_s) / N);
  }
  double start_s = bench_clock_now_s();
  double longest_s = 0.0;
  for (int i = 0; i < 500; ++i) {
    const double then_s = bench_clock_now_s();
    rehearsal_make(128, (Strike){0.12, i / 500.0, i % 2 ? 0.1 : 1.0, 0.1}, 0.01);
    longest_s = fmax(longest_s, bench_clock_now_s() - then_s);
  }
  print_message("  a rehearsal %.1f us, at most %.1f us\n",
                1e6 * (bench_clock_now_s() - start_s) / 500, 1e6 * longest_s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(felt_solves_its_equation),
      cmocka_unit_test(energy_is_kept_to_rounding),
      cmocka_unit_test(lossy_felts_never_add_energy),
      cmocka_unit_test(looking_anew_mends_the_books),
      cmocka_unit_test(hammers_leave_for_good),
      cmocka_unit_test(strikes_are_as_loud_as_plucks),
      cmocka_unit_test(harder_strikes_are_brighter),
      cmocka_unit_test(contact_lasts_as_long_at_any_rate),
      cmocka_unit_test(pitch_and_decay_after_a_strike_are_the_strings),
      cmocka_unit_test(a_strike_adds_to_what_rings),
      cmocka_unit_test(storms_of_strikes_stay_bounded),
      cmocka_unit_test(frames_may_be_cut_anyhow),
      cmocka_unit_test(a_hammer_costs_next_to_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

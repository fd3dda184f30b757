/* Where the partials of a string are heard, for each setting of `partials`, and what happens when
 * it is changed while the string rings. */
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"
#include "tests/support/strings_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

/* Frames: when something is changed, when that is done, and when all that moved stands still. */
enum {
  RATE = 48000,
  BLOCK = 1024,
  CHANGED = 24 * BLOCK,
  AFTER = 26 * BLOCK,
  CALM = 48 * BLOCK,
  N_FRAMES = 200 * BLOCK
};

enum { N_KINDS = 3, N_PARTIALS = 4 };

/* Where a partial is heard against where the theory has it; what is left is the noise of the
 * numbers that a string is kept in, and the partial is as strong as a pluck makes it. */
static const double MOST_CENTS = 0.02;

/* Seconds that a measurement takes, and that a string rings before it. */
static const double LENGTH_S = 4.0;
static const double ATTACK_S = 0.1;

/* How far a splice stands out above what is allowed, at the least. */
static const double SPLICE = 50.0;

static const uint32_t partials[N_PARTIALS] = {1, 5, 10, 20};

typedef struct {
  uint32_t key;
  double masses;
  double stiffness;
} Setting;

/* The theory, from the ports alone: the frequency of partial k of a string of n masses. */
static double heard_hz(
    Tone tone, double rate_hz, double loss, double stiffness, int kind, uint32_t n, uint32_t k) {
  const double length = (n + 1.0) / PI;
  const double beta = stiffness * length * length;
  const double courant = 2.0 * tone.f0_hz * (n + 1.0) / rate_hz;
  const double rest = fmax(0.0, 1.0 - courant * courant / (1.0 + stiffness));
  const double b = beta + (kind > 0 ? rest / 12.0 : 0.0);
  const double d = kind > 1 ? rest * (3.0 + rest) / 360.0 + rest * beta / 6.0 : 0.0;
  const double lambda1 = 2.0 - 2.0 * cos(1.0 / length);
  const double lambda = 2.0 - 2.0 * cos(k / length);
  const double g1 = 1.0 - exp(-2.0 / (tone.tau_s * rate_hz));
  const double g = g1 * (1.0 - loss) + g1 * loss * lambda / lambda1;
  const double a1 = 2.0 - g1 - 2.0 * sqrt(1.0 - g1) * cos(2.0 * PI * tone.f0_hz / rate_hz);
  const double a = a1 * (lambda + b * lambda * lambda + d * lambda * lambda * lambda) /
                   (lambda1 + b * lambda1 * lambda1 + d * lambda1 * lambda1 * lambda1);
  return rate_hz / (2.0 * PI) * acos((2.0 - a - g) / (2.0 * sqrt(1.0 - g)));
}

/* Long notes, plucked and read where no partial up to 20 has a node. */
static Host* open_partials(double rate_hz, const Setting* setting, int kind) {
  Host* const host = strings_open(rate_hz, BLOCK);
  strings_set(host, "damping", 0.1);
  strings_set(host, "tracking", 0.0);
  strings_set(host, "loss", 1e-4);
  strings_set(host, "spread", 0.0);
  strings_set(host, "pickup", 0.477);
  strings_set(host, "pluck", 0.023);
  strings_set(host, "hardness", 1.0);
  strings_set(host, "masses", setting->masses);
  strings_set(host, "stiffness", setting->stiffness);
  strings_set(host, "partials", kind);
  return host;
}

/* What the theory says of a string that rings as the ports now are. */
static double wanted_hz(const Host* host, double rate_hz, Tone tone, int kind, uint32_t k) {
  const double stiffness = (double)host_get(host, "stiffness");
  return heard_hz(tone, rate_hz, (double)host_get(host, "loss"), stiffness > 1e-6 ? stiffness : 0.0,
                  kind, (uint32_t)host_get(host, "mass_count"), k);
}

/* How far partial k is from where it should be; the next ones may be as close as half of f0. */
static double error_cents(const float* samples, size_t n, double rate_hz, Tone near, double f0_hz) {
  Tone heard = {0};
  if (!measure_partial(samples, n, rate_hz, near, 0.5 * f0_hz, &heard)) {
    return HUGE_VAL;
  }
  return fabs(measure_cents(heard.f0_hz, near.f0_hz));
}

/* The worst error of the partials that are strong enough: the last ones of a chain hardly move. */
static double check_partials(
    Host* host, const Sound* sound, size_t from, size_t to, double rate_hz, Tone tone, int kind) {
  double worst = 0.0;
  for (int i = 0; i < N_PARTIALS; ++i) {
    if (2 * partials[i] <= (uint32_t)host_get(host, "mass_count")) {
      const Tone near = {wanted_hz(host, rate_hz, tone, kind, partials[i]), tone.tau_s};
      worst = fmax(worst, error_cents(sound->left + from, to - from, rate_hz, near, tone.f0_hz));
    }
  }
  return worst;
}

static void partials_are_heard_where_they_belong(void** state) {
  static const double rates_hz[] = {44100.0, 48000.0, 96000.0};
  static const Setting settings[] = {{33, 20.0, 1e-6}, {33, 40.0, 1e-6},  {33, 80.0, 1e-6},
                                     {33, 80.0, 1e-4}, {45, 40.0, 1e-6},  {45, 1024.0, 1e-6},
                                     {57, 24.0, 1e-5}, {69, 1024.0, 1e-6}};
  (void)state;
  for (int kind = 0; kind < N_KINDS; ++kind) {
    double worst = 0.0;
    for (size_t s = 0; s < sizeof(settings) / sizeof(settings[0]); ++s) {
      for (size_t r = 0; r < sizeof(rates_hz) / sizeof(rates_hz[0]); ++r) {
        const size_t n_attack = (size_t)(ATTACK_S * rates_hz[r]);
        const size_t n_frames = (size_t)((ATTACK_S + LENGTH_S) * rates_hz[r]);
        Host* const host = open_partials(rates_hz[r], &settings[s], kind);
        Sound sound = sound_new(n_frames);
        strings_note_on(host, 0, settings[s].key, 100);
        strings_run(host, &sound, 0, n_frames, BLOCK);
        worst = fmax(worst, check_partials(host, &sound, n_attack, n_frames, rates_hz[r],
                                           strings_tone(host, settings[s].key, 0.0), kind));
        sound_free(&sound);
        host_free(host);
      }
    }
    assert_within("partials 1, 5, 10 and 20 [cents]", worst, MOST_CENTS);
  }
}

/* One note, and the setting changed in the middle of it. */
static Sound play_change(const Setting* setting, int from, int to, Host** host) {
  Sound sound = sound_new(N_FRAMES);
  *host = open_partials(RATE, setting, from);
  strings_note_on(*host, 0, setting->key, 100);
  strings_run(*host, &sound, 0, CHANGED, BLOCK);
  strings_set(*host, "partials", to);
  strings_run(*host, &sound, CHANGED, N_FRAMES, BLOCK);
  return sound;
}

static void what_rings_has_the_new_partials_exactly(void** state) {
  static const Setting setting = {33, 40.0, 1e-5};
  (void)state;
  double worst = 0.0;
  for (int change = 0; change < N_KINDS * N_KINDS; ++change) {
    const int to = change % N_KINDS;
    Host* host = NULL;
    Sound sound = play_change(&setting, change / N_KINDS, to, &host);
    worst = fmax(worst, check_partials(host, &sound, AFTER, N_FRAMES, RATE,
                                       strings_tone(host, setting.key, 0.0), to));
    assert_true(host_get(host, "headroom") >= 0.0f);
    sound_free(&sound);
    host_free(host);
  }
  assert_within("partials 1, 5, 10 and 20 after a change [cents]", worst, MOST_CENTS);
}

static void damper_leaves_the_partials_where_they_are(void** state) {
  static const Setting setting = {33, 40.0, 1e-5};
  (void)state;
  double worst = 0.0;
  for (int kind = 0; kind < N_KINDS; ++kind) {
    Sound sound = sound_new(N_FRAMES);
    Host* const host = open_partials(RATE, &setting, kind);
    strings_set(host, "release", 6.0);
    strings_note_on(host, 0, setting.key, 100);
    strings_note_off(host, CHANGED, setting.key);
    strings_run(host, &sound, 0, N_FRAMES, BLOCK);
    const Tone tone = strings_released_tone(host, setting.key, 0.0);
    worst = fmax(worst, check_partials(host, &sound, CHANGED + BLOCK, N_FRAMES, RATE, tone, kind));
    sound_free(&sound);
    host_free(host);
  }
  assert_within("partials 1, 5, 10 and 20 once the key is up [cents]", worst, MOST_CENTS);
}

/* Heard where it is strong. */
static void fundamental_and_its_decay_stay_exact(void** state) {
  enum { KEY = 45 };
  (void)state;
  ToneError worst = {0};
  for (int change = 0; change < N_KINDS * N_KINDS; ++change) {
    const int from = change / N_KINDS;
    Sound sound = sound_new(N_FRAMES);
    Host* const host = strings_open(RATE, BLOCK);
    strings_set_plain(host);
    strings_set(host, "masses", 40.0);
    strings_set(host, "partials", from);
    strings_note_on(host, 0, KEY, 100);
    strings_run(host, &sound, 0, CHANGED, BLOCK);
    strings_set(host, "partials", change % N_KINDS);
    strings_run(host, &sound, CHANGED, N_FRAMES, BLOCK);
    const Tone asked = strings_tone(host, KEY, 0.0);
    worst = strings_worse(worst, strings_measure(&sound, RATE, BLOCK, CHANGED, asked));
    worst = strings_worse(worst, strings_measure(&sound, RATE, AFTER, N_FRAMES, asked));
    sound_free(&sound);
    host_free(host);
  }
  strings_assert_exact("before and after", worst);
}

/* The second difference, where a click would stand out. */
static double bend_at(float before, float here, float after) {
  return fabs((double)before - 2.0 * (double)here + (double)after);
}

/* The largest of a sound's, from a block before the change to two after; and of `a` spliced to `b`,
 * wherever that is worst. */
static double roughness(const Sound* a) {
  double worst = 0.0;
  for (size_t i = CHANGED - BLOCK; i < AFTER; ++i) {
    worst = fmax(worst, bend_at(a->left[i - 2], a->left[i - 1], a->left[i]));
  }
  return worst;
}

static double splice(const Sound* a, const Sound* b) {
  double worst = 0.0;
  for (size_t i = CHANGED - BLOCK; i < AFTER; ++i) {
    worst = fmax(worst, bend_at(a->left[i - 2], a->left[i - 1], b->left[i]));
  }
  return worst;
}

static void changing_partials_does_not_click(void** state) {
  static const Setting setting = {33, 24.0, 1e-6};
  (void)state;
  for (int change = 0; change < N_KINDS * N_KINDS; ++change) {
    const int from = change / N_KINDS;
    const int to = change % N_KINDS;
    Host* hosts[3];
    Sound before = play_change(&setting, from, from, &hosts[0]);
    Sound after = play_change(&setting, to, to, &hosts[1]);
    Sound changed = play_change(&setting, from, to, &hosts[2]);
    const double usual = 1.5 * fmax(roughness(&before), roughness(&after));
    const double control = splice(&before, &after) / usual;
    char what[64];
    (void)snprintf(what, sizeof(what), "from %d to %d, spliced %.1f", from, to, control);
    assert_within(what, roughness(&changed) / usual, 1.0);
    assert_true(from == to || control > SPLICE);
    Sound* const sounds[3] = {&before, &after, &changed};
    for (int i = 0; i < 3; ++i) {
      sound_free(sounds[i]);
      host_free(hosts[i]);
    }
  }
}

/* Wheel and setting on the move in every block, and then left alone. */
static void bends_and_changes_at_once_leave_it_in_tune(void** state) {
  static const Setting setting = {57, 60.0, 1e-5};
  (void)state;
  double loudest[2] = {0.0};
  Random random = random_start();
  for (int is_moving = 0; is_moving < 2; ++is_moving) {
    Host* const host = open_partials(RATE, &setting, PARTIALS_TRUEST);
    Sound sound = sound_new(N_FRAMES);
    strings_note_on(host, 0, setting.key, 100);
    strings_run(host, &sound, 0, BLOCK, BLOCK);
    for (size_t at = BLOCK; at < CALM; at += BLOCK) {
      const bool is_last = at + BLOCK == CALM;
      if (is_moving) {
        const uint32_t frame = random_below(&random, BLOCK);
        strings_bend(host, frame, is_last ? 0.0 : random_between(&random, -2.0, 2.0));
        strings_set(host, "partials", is_last ? PARTIALS_TRUEST : random_below(&random, N_KINDS));
      }
      strings_run(host, &sound, at, at + BLOCK, BLOCK);
      assert_true(host_get(host, "headroom") >= 0.0f);
    }
    strings_run(host, &sound, CALM, N_FRAMES, BLOCK);
    const double worst = check_partials(host, &sound, CALM + BLOCK, N_FRAMES, RATE,
                                        strings_tone(host, setting.key, 0.0), PARTIALS_TRUEST);
    assert_within("partials 1, 5, 10 and 20 [cents]", worst, MOST_CENTS);
    loudest[is_moving] = measure_peak(sound.left, N_FRAMES);
    sound_free(&sound);
    host_free(host);
  }
  assert_within("the loudest that it became, moving", loudest[1] / loudest[0], 1.3);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(partials_are_heard_where_they_belong),
      cmocka_unit_test(what_rings_has_the_new_partials_exactly),
      cmocka_unit_test(damper_leaves_the_partials_where_they_are),
      cmocka_unit_test(fundamental_and_its_decay_stay_exact),
      cmocka_unit_test(changing_partials_does_not_click),
      cmocka_unit_test(bends_and_changes_at_once_leave_it_in_tune),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Sympathy in all weathers: no setting, no body and no gesture makes it explode, step, or depend on
 * blocks. */
#include "core/harp/harp.h"
#include "core/harp/harp_bridge.h"

#include "tests/support/bridges.h"
#include "tests/support/harps.h"
#include "tests/support/measure.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { STORM = 12000, CALM = 24000, SLOWEST = 1000 };

static float left[2][CALM];
static float right[2][CALM];

/* None, one of those that are built, or one from a file, each of any size and loss. */
static BodyPatch draw_body(Random* random) {
  return (BodyPatch){
      .choice =
          random_below(random, 3) ? (BodiesChoice)random_below(random, BODIES_COUNT) : BODIES_NONE,
      .mix = 0.0,
      .shape = {random_log_between(random, 0.25, 4.0), random_log_between(random, 0.1, 10.0)},
      .knock = random_between(random, 0.0, 1.0),
  };
}

static HarpPatch draw_patch(Random* random) {
  static const uint32_t most_masses[] = {1, 4, 24, 80};
  HarpPatch patch = harps_patch(random_below(random, HARPS_N_WAYS));
  patch.resonance =
      random_below(random, 3) ? random_between(random, 0.0, 1.0) : (double)random_below(random, 2);
  patch.string.damping_per_s = random_log_between(random, 0.02, 200.0);
  patch.string.tracking = random_between(random, 0.0, 1.0);
  patch.string.loss = random_log_between(random, 1e-5, 1.0);
  patch.string.inharmonicity = random_log_between(random, 1e-6, 0.1);
  patch.string.partials = (Partials)random_below(random, 3);
  patch.string.tension = random_below(random, 2) ? random_between(random, 0.0, 100.0) : 0.0;
  patch.string.release_s = random_log_between(random, 0.005, 10.0);
  patch.string.tuning_hz = random_between(random, 400.0, 480.0);
  patch.string.max_masses = most_masses[random_below(random, 4)];
  patch.body = draw_body(random);
  patch.unisons = random_below(random, 4) ? 1 : 1 + random_below(random, 3);
  patch.second = random_below(random, 4) ? 0.0 : random_between(random, 0.0, 1.0);
  return patch;
}

/* A file as light and as slow to die as none is that is built. */
static void load_file(Harp* harp, Random* random) {
  Body body = bridges_body(random, 1 + random_below(random, BRIDGES_MODES), harp->rate_hz);
  for (uint32_t k = 0; k < body.n_modes; ++k) {
    body.modes[k].radiation[k % 2] = 1.0;
  }
  body_level(&body);
  harp_set_body(harp, random_below(random, 5) ? &body : NULL);
}

/* One thing that a player may do. */
static void gesture(Harp* harp, Random* random) {
  const uint32_t key =
      random_below(random, 3) ? 40 + random_below(random, 40) : random_below(random, HARP_KEYS);
  switch (random_below(random, 11)) {
  case 0:
  case 1:
  case 2:
    harp_note_on(harp, random_below(random, 2), key, 1 + random_below(random, 127));
    break;
  case 3:
    harp_note_off(harp, random_below(random, 2), key);
    break;
  case 4:
    harp_pedal(harp, 0, random_below(random, 2) ? 1.0 : random_between(random, 0.0, 1.0));
    break;
  case 5:
    harp_bend(harp, 0, random_between(random, -2.0, 2.0) * (random_below(random, 3) ? 1.0 : 12.0));
    break;
  case 6:
    harp_vibrato(harp, 0, random_between(random, 0.0, 1.0));
    break;
  case 7:
    if (random_below(random, 8) == 0) {
      harp_silence(harp);
    }
    break;
  case 8: {
    const HarpPatch patch = draw_patch(random);
    harp_set_patch(harp, &patch, random_below(random, SLOWEST));
    break;
  }
  case 9:
    load_file(harp, random);
    break;
  default: {
    HarpPatch patch = harp->patch;
    patch.body = draw_body(random);
    harp_set_patch(harp, &patch, random_below(random, SLOWEST));
  }
  }
}

/* Once all is quiet, the slowest glide over and what comes after it too, who is open is tied, to
 * the body that the patch has. */
static void settle(Harp* harp) {
  harp_run(harp, SLOWEST + 2 * harp->n_gesture, left[0], right[0]);
  assert_false(harp->bridge.bridge.is_leaving);
  for (uint32_t i = 0; harp->patch.resonance > 0.0 && i < HARP_STRINGS; ++i) {
    const Voice* const voice = &harp->strings[i].voice;
    const bool is_open = voice->is_awake && !voice->is_choked && harp->strings[i].lift > 0.0;
    assert_true(!is_open || tie_is_on(&voice->tie));
  }
}

/* The loudest sample over a full note's, and the least stability, of any string and of the bridge.
 */
static double storm(double rate_hz, Random* random, double headroom[2]) {
  const HarpPatch patch = draw_patch(random);
  Harp* const harp = harps_new(rate_hz, &patch);
  double peak = 0.0;
  harp_pedal(harp, 0, 1.0);
  for (uint32_t done = 0; done < STORM;) {
    const uint32_t n = 1 + random_below(random, 400);
    gesture(harp, random);
    harp_run(harp, n, left[0], right[0]);
    peak = fmax(peak, fmax(measure_peak(left[0], n), measure_peak(right[0], n)));
    assert_true(isfinite(harp->bridge.bridge.y) && isfinite(bank_level(&harp->bridge.bridge.bank)));
    headroom[0] = fmin(headroom[0], harp_report(harp).headroom);
    headroom[1] = fmin(headroom[1], harp_bridge_headroom(harp));
    done += n;
  }
  settle(harp);
  harp_free(harp);
  return peak / HARP_NOTE_PEAK;
}

/*
  As many notes as a storm has, each as loud as it may be, and four times that, as bends may feed
  them, are no more than a few hundred.
*/
static void storms_do_not_explode(void** state) {
  (void)state;
  static const double rates[] = {8e3, 44.1e3, 48e3, 192e3};
  const int n_storms = getenv("HOOKE_TEST_LONG") ? 2000 : 40;
  Random random = random_start();
  double peak = 0.0;
  double headroom[2] = {1.0, 1.0};
  for (int i = 0; i < n_storms; ++i) {
    peak = fmax(peak, storm(rates[i % 4], &random, headroom));
  }
  print_message("  peak %.1f notes, headroom %g, of the bridge %g\n", peak, headroom[0],
                headroom[1]);
  assert_true(peak < 200.0);
  assert_true(headroom[0] > 0.0 && headroom[1] >= 0.1);
}

/* The worst that a bend can do: it swings all open strings in time with the one that was played,
 * for long. */
static void bends_in_time_do_not_feed_the_bridge(void** state) {
  (void)state;
  HarpPatch patch = harps_patch(0);
  patch.resonance = 1.0;
  patch.string.damping_per_s = 0.02;
  patch.string.max_masses = 16;
  double most = 0.0;
  for (uint32_t period = 200; period < 240; period += 20) {
    Harp* const harp = harps_new(48e3, &patch);
    harp_pedal(harp, 0, 1.0);
    harp_note_on(harp, 0, 45, 127);
    harp_run(harp, CALM, left[0], right[0]);
    for (int i = 0; i < 300; ++i) {
      harp_bend(harp, 0, i % 2 ? 12.0 : 0.0);
      harp_run(harp, period, left[0], right[0]);
      most = fmax(most, measure_peak(left[0], period));
    }
    harp_free(harp);
  }
  print_message("  peak %.1f notes\n", most / HARP_NOTE_PEAK);
  assert_true(most < 40.0 * HARP_NOTE_PEAK);
}

/* At high rates the bridge's own spring is next to nothing beside the strings', so that strings and
 * their ties must go the same way. */
static void bends_at_high_rates_do_not_feed_the_bridge(void** state) {
  enum { N_GESTURE = 3072 };
  (void)state;
  HarpPatch patch = harps_patch(0);
  patch.resonance = 1.0;
  patch.string.damping_per_s = 0.02;
  patch.string.max_masses = 300;
  Harp* const harp = harps_new(768e3, &patch);
  double most = 0.0;
  harp_pedal(harp, 0, 1.0);
  harp_note_on(harp, 0, 93, 127);
  harp_run(harp, CALM, left[0], right[0]);
  for (int i = 0; i < 60; ++i) {
    harp_bend(harp, 0, i % 2 ? -24.0 : 24.0);
    harp_run(harp, N_GESTURE, left[0], right[0]);
    most = fmax(most, measure_peak(left[0], N_GESTURE));
  }
  harp_free(harp);
  print_message("  peak %.2f notes\n", most / HARP_NOTE_PEAK);
  assert_true(most < 4.0 * HARP_NOTE_PEAK);
}

/* The same storm, in blocks of its own. */
static void play(uint64_t seed, uint32_t block, float* l, float* r) {
  Random random = {seed};
  const HarpPatch patch = draw_patch(&random);
  Harp* const harp = harps_new(48e3, &patch);
  harp_pedal(harp, 0, 1.0);
  for (uint32_t done = 0; done < CALM;) {
    const uint32_t n_until = 1 + random_below(&random, 4000);
    const uint32_t end = done + n_until < CALM ? done + n_until : CALM;
    gesture(harp, &random);
    while (done < end) {
      const uint32_t n = end - done < block ? end - done : block;
      harp_run(harp, n, l + done, r + done);
      done += n;
    }
  }
  harp_free(harp);
}

static void blocks_do_not_change_the_sound(void** state) {
  (void)state;
  static const uint32_t blocks[] = {1, 7, 64, 65, 4096};
  Random random = random_start();
  for (int i = 0; i < 20; ++i) {
    const uint64_t seed = ((uint64_t)random_below(&random, 1u << 31) << 20) + 1;
    play(seed, 256, left[0], right[0]);
    play(seed, blocks[i % 5], left[1], right[1]);
    assert_memory_equal(left[0], left[1], sizeof(left[0]));
    assert_memory_equal(right[0], right[1], sizeof(right[0]));
  }
}

/* The largest step of strings that all ring, while the resonance moves to one level after the
 * other. */
static double largest_step(const double levels[5]) {
  HarpPatch patch = harps_patch(0);
  patch.string.damping_per_s = 0.1;
  Harp* const harp = harps_new(48e3, &patch);
  harp_pedal(harp, 0, 1.0);
  for (uint32_t key = 45; key < 80; key += 7) {
    harp_note_on(harp, 0, key, 100);
  }
  harp_run(harp, CALM, left[0], right[0]);
  double worst = harps_largest_step(left[0] + CALM / 2 + 1, CALM / 2 - 1);
  left[0][3999] = left[0][CALM - 1];
  for (uint32_t i = 0; i < 5; ++i) {
    patch.resonance = levels[i];
    left[0][0] = left[0][3999];
    harp_set_patch(harp, &patch, 0 + 300);
    harp_run(harp, 3999, left[0] + 1, right[0]);
    worst = fmax(worst, harps_largest_step(left[0] + 1, 3999));
  }
  harp_free(harp);
  return worst;
}

/* From any resonance to any other, against the same where nothing moves. */
static void moving_resonance_makes_no_step(void** state) {
  (void)state;
  const double moving = largest_step((const double[]){0.0, 1.0, 0.3, 0.0, 0.7});
  const double still = largest_step((const double[]){0.0, 0.0, 0.0, 0.0, 0.0});
  print_message("  steps %g, still %g\n", moving, still);
  assert_true(moving < 1.1 * still);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(storms_do_not_explode),
      cmocka_unit_test(bends_in_time_do_not_feed_the_bridge),
      cmocka_unit_test(bends_at_high_rates_do_not_feed_the_bridge),
      cmocka_unit_test(blocks_do_not_change_the_sound),
      cmocka_unit_test(moving_resonance_makes_no_step),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

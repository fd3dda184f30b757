/* Sympathy on a body: strings stay in tune at its modes, answer through it, and are let go while it
 * is another. */
#include "core/harp/harp.h"
#include "core/harp/harp_bridge.h"

#include "tests/support/harps.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000 };

static float left[2 * RATE];
static float right[2 * RATE];

/* Heard as the strings are alone. */
static HarpPatch patch_on(BodiesChoice body, double resonance) {
  HarpPatch patch = harps_patch(0);
  patch.resonance = resonance;
  patch.spread = 0.0;
  patch.body = (BodyPatch){.choice = body, .shape = {1.0, 1.0}};
  return patch;
}

/* Of the second after the first fifth. */
static Tone heard(Harp* harp, const HarpPatch* patch, uint32_t key, double lift) {
  Tone tone = {0};
  harp_pedal(harp, 0, lift);
  harp_note_on(harp, 0, key, 110);
  harp_run(harp, RATE / 5, left, right);
  harp_run(harp, RATE, left, right);
  assert_true(measure_tone(left, RATE, RATE, harps_tone(patch, key, 0.0), &tone));
  return tone;
}

/* What keys are off by: those that have their whole lever, and those that would be wolves [cents].
 */
typedef struct {
  double usual;
  double wolf;
} Worst;

static void
measure_keys(BodiesChoice body, double resonance, double lift, uint32_t step, Worst* worst) {
  for (uint32_t key = 24; key <= 106; key += step) {
    const HarpPatch patch = patch_on(body, resonance);
    const Tone asked = harps_tone(&patch, key, 0.0);
    Harp* const harp = harps_new(RATE, &patch);
    const Tone tone = heard(harp, &patch, key, lift);
    const bool is_wolf = harp->strings[key].voice.tie.hold.lever < 0.999 * resonance * resonance;
    double* const off = is_wolf ? &worst->wolf : &worst->usual;
    *off = fmax(*off, fabs(measure_cents(tone.f0_hz, asked.f0_hz)));
    assert_true(lift > 0.0 || tone.tau_s < 1.001 * asked.tau_s);
    harp_free(harp);
  }
}

/* Where no other string moves, the solver knows the body.  Beside a wolf the body's own pole is
 * heard, which is near and does not die at once. */
static void string_alone_is_in_tune(void** state) {
  (void)state;
  Worst half = {0};
  Worst full = {0};
  for (int body = BODIES_NONE + 1; body < BODIES_FILE; ++body) {
    measure_keys((BodiesChoice)body, 0.5, 0.0, 9, &half);
    measure_keys((BodiesChoice)body, 1.0, 0.0, 18, &full);
  }
  assert_within("pitch [cents]", half.usual, 0.05);
  assert_within("pitch of wolves", half.wolf, 0.5);
  assert_within("at full resonance", full.usual, 0.1);
  assert_within("wolves at full resonance", full.wolf, 0.5);
}

/* What all open strings do to each other is not known to it: they share what the body does where it
 * moves, which is at its modes. */
static void open_strings_are_nearly_in_tune(void** state) {
  (void)state;
  Worst half = {0};
  Worst quarter = {0};
  measure_keys(BODIES_GUITAR, 0.5, 1.0, 21, &half);
  measure_keys(BODIES_GUITAR, 0.25, 1.0, 21, &quarter);
  assert_within("pitch among open strings [cents]", fmax(half.usual, half.wolf), 5.0);
  assert_within("at a quarter of the resonance", fmax(quarter.usual, quarter.wolf), 0.5);
}

/* A key whose pitch is a mode's.  It dies sooner than it was to, and the body alone sooner still.
 */
static void wolf_is_in_tune_and_dies_sooner(void** state) {
  (void)state;
  const Body wood = {.n_modes = 1, .modes = {{220.0, 40.0, 0.2, {1.0, 1.0}}}};
  const double body_s = 40.0 / (acos(-1.0) * 220.0);
  HarpPatch patch = patch_on(BODIES_FILE, 1.0);
  Harp* const harp = harps_new(RATE, &patch);
  harp_set_body(harp, &wood);
  harp_set_patch(harp, &patch, 0);
  const Tone asked = harps_tone(&patch, 57, 0.0);
  Tone tone = {0};
  harp_note_on(harp, 0, 57, 110);
  harp_run(harp, RATE / 5, left, right);
  harp_run(harp, RATE / 2, left, right);
  assert_true(harp->strings[57].voice.tie.hold.lever < 0.5);
  assert_true(measure_tone(left, RATE / 2, RATE, (Tone){asked.f0_hz, 5.0 * body_s}, &tone));
  print_message("  %.4f s of %.4f, the body alone %.4f\n", tone.tau_s, asked.tau_s, body_s);
  assert_within("wolf [cents]", fabs(measure_cents(tone.f0_hz, asked.f0_hz)), 0.05);
  assert_true(tone.tau_s > 4.0 * body_s && tone.tau_s < 7.0 * body_s);
  harp_free(harp);
}

/* How far a string's middle moves that nobody played, in decibels of one that is. */
static double answer_db(uint32_t answering, double resonance) {
  static float played[RATE / 4];
  static float other[RATE / 4];
  const HarpPatch patch = patch_on(BODIES_GUITAR, resonance);
  Harp* const harp = harps_new(RATE, &patch);
  harp_pedal(harp, 0, 1.0);
  harp_note_on(harp, 0, 57, 110);
  harp_run(harp, RATE / 2, left, right);
  for (size_t i = 0; i < RATE / 4; ++i) {
    harp_run(harp, 1, left, right);
    const Chain* const a = &harp->strings[57].voice.chain;
    const Chain* const b = &harp->strings[answering].voice.chain;
    assert_true(harp->strings[answering].voice.is_awake);
    played[i] = chain_position(a, a->n_masses / 3);
    other[i] = chain_position(b, b->n_masses / 3);
  }
  harp_free(harp);
  return 20.0 * log10(measure_rms(other, RATE / 4) / measure_rms(played, RATE / 4));
}

static void open_strings_answer_through_the_body(void** state) {
  (void)state;
  const double above = answer_db(69, 0.5);
  const double below = answer_db(45, 0.5);
  const double beside = answer_db(58, 0.5);
  const double rich = answer_db(69, 1.0);
  print_message("  octave above %.1f dB, below %.1f, semitone %.1f; at full resonance %.1f\n",
                above, below, beside, rich);
  assert_true(above > -40.0 && above < 0.0 && below > -40.0 && below < 0.0);
  assert_true(beside < above - 6.0 && beside < below - 6.0);
  assert_true(rich > above);
}

static bool is_any_tied(const Harp* harp) {
  bool is_any = false;
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    is_any = is_any || (harp->strings[i].voice.is_awake && tie_is_on(&harp->strings[i].voice.tie));
  }
  return is_any;
}

/* Whether all that sound and are open pull at the bridge, and will go on. */
static bool are_all_tied(const Harp* harp) {
  bool are_all = true;
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    const Voice* const voice = &harp->strings[i].voice;
    are_all = are_all && (!voice->is_awake || voice->tie.pull.goal > 0.0);
  }
  return are_all;
}

/* Frames from a new patch on until its body is what the strings pull at; none pulls when it comes:
 * they begin in that frame. */
static uint32_t frames_until_moved(Harp* harp, const HarpPatch* patch) {
  const Bank* const bank = &harp->bridge.bridge.bank;
  static Bank before;
  uint32_t n = 0;
  assert_true(is_any_tied(harp));
  before = *bank;
  harp_set_patch(harp, patch, 300);
  while (memcmp(before.a, bank->a, sizeof(before.a)) == 0 &&
         memcmp(before.g, bank->g, sizeof(before.g)) == 0) {
    assert_true(n < RATE);
    harp_run(harp, 1, left + n++, right);
  }
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    const Line* const pull = &harp->strings[i].voice.tie.pull;
    assert_true(!harp->strings[i].voice.is_awake || pull->value <= 0.01 * pull->goal);
  }
  return n;
}

static void play_chord(Harp* harp) {
  harp_pedal(harp, 0, 1.0);
  for (uint32_t key = 45; key < 80; key += 7) {
    harp_note_on(harp, 0, key, 100);
  }
}

/* Another body, another size, another damping, none, a file's, and back: all in a hundredth of a
 * second, and every string is tied again. */
static void strings_are_let_go_while_the_body_changes(void** state) {
  (void)state;
  static const BodyPatch bodies[] = {
      {.choice = BODIES_VIOLIN, .shape = {1.0, 1.0}},
      {.choice = BODIES_VIOLIN, .shape = {1.7, 1.0}},
      {.choice = BODIES_VIOLIN, .shape = {1.7, 0.3}},
      {.choice = BODIES_NONE, .shape = {1.7, 0.3}},
      {.choice = BODIES_FILE, .shape = {1.0, 1.0}},
      {.choice = BODIES_GUITAR, .shape = {0.5, 2.0}},
  };
  const Body wood = {.n_modes = 2,
                     .modes = {{110.0, 30.0, 0.3, {1.0, 1.0}}, {331.0, 50.0, 0.2, {1.0, -1.0}}}};
  HarpPatch patch = patch_on(BODIES_GUITAR, 0.7);
  patch.string.damping_per_s = 0.1;
  Harp* const harp = harps_new(RATE, &patch);
  harp_set_body(harp, &wood);
  play_chord(harp);
  harp_run(harp, RATE, left, right);
  for (size_t i = 0; i < sizeof(bodies) / sizeof(bodies[0]); ++i) {
    const uint32_t n_strings = harp_report(harp).n_strings;
    patch.body = bodies[i];
    const uint32_t n = frames_until_moved(harp, &patch);
    assert_true(n <= RATE / 100);
    harp_run(harp, RATE / 50, left, right);
    assert_false(harp->bridge.bridge.is_leaving);
    assert_true(are_all_tied(harp));
    assert_true(harp_report(harp).n_strings >= n_strings);
  }
  harp_free(harp);
}

/* Nor does what was set before its tension was taken away hold one that is struck meanwhile. */
static void string_struck_while_the_body_changes_is_let_go(void** state) {
  (void)state;
  HarpPatch patch = patch_on(BODIES_GUITAR, 0.7);
  patch.exciter = EXCITER_STRIKE;
  patch.string.tension = 50.0;
  patch.string.damping_per_s = 6.0;
  Harp* const harp = harps_new(RATE, &patch);
  const Voice* const voice = &harp->strings[45].voice;
  harp_note_on(harp, 0, 45, 127);
  harp_run(harp, RATE / 100, left, right);
  assert_true(voice->tension.is_moving);
  for (int i = 0; voice->tension.is_moving; ++i) {
    assert_true(i < 400);
    harp_run(harp, RATE / 100, left, right);
  }
  patch.string.tension = 0.0;
  harp_set_patch(harp, &patch, 0);
  patch.body.choice = BODIES_VIOLIN;
  harp_set_patch(harp, &patch, 300);
  harp_run(harp, 10, left, right);
  assert_true(voice->is_awake && harp->bridge.bridge.is_leaving);
  harp_note_on(harp, 0, 45, 127);
  harp_run(harp, RATE / 50, left, right);
  assert_false(harp->bridge.bridge.is_leaving || voice->tension.is_moving);
  assert_true(are_all_tied(harp) && harp->bridge.on.body == bodies_shipped(BODIES_VIOLIN));
  harp_free(harp);
}

/* Another file is another body, though the choice stays. */
static void another_file_is_another_bridge(void** state) {
  (void)state;
  const Body first = {.n_modes = 1, .modes = {{110.0, 30.0, 0.3, {1.0, 1.0}}}};
  const Body second = {.n_modes = 1, .modes = {{310.0, 30.0, 0.3, {1.0, 1.0}}}};
  const HarpPatch patch = patch_on(BODIES_FILE, 0.7);
  Harp* const harp = harps_new(RATE, &patch);
  harp_set_body(harp, &first);
  play_chord(harp);
  harp_run(harp, RATE / 2, left, right);
  assert_true(are_all_tied(harp));
  const double a = harp->bridge.bridge.bank.a[0];
  harp_set_body(harp, &second);
  harp_run(harp, RATE / 10, left, right);
  assert_true(harp->bridge.bridge.bank.a[0] > 4.0 * a);
  assert_true(are_all_tied(harp));
  harp_set_body(harp, NULL);
  harp_run(harp, RATE / 10, left, right);
  assert_true(harp->bridge.bridge.bank.a[0] < a && harp->bridge.on.body == NULL);
  assert_true(are_all_tied(harp));
  harp_free(harp);
}

/* The largest step of strings that ring, while the body is one after the other. */
static double largest_step(bool is_moving) {
  enum { N = 4799 };
  HarpPatch patch = patch_on(BODIES_GUITAR, 0.7);
  patch.string.damping_per_s = 0.1;
  Harp* const harp = harps_new(RATE, &patch);
  double worst = 0.0;
  play_chord(harp);
  harp_run(harp, RATE, left, right);
  left[0] = left[RATE - 1];
  for (int i = 0; i < 6; ++i) {
    if (is_moving) {
      patch.body.choice = i % 3 == 2 ? BODIES_NONE : i % 3 == 1 ? BODIES_CELLO : BODIES_HARP;
      patch.body.shape.size = 1.0 + 0.1 * i;
    }
    harp_set_patch(harp, &patch, 300);
    harp_run(harp, N, left + 1, right);
    worst = fmax(worst, harps_largest_step(left + 1, N));
    left[0] = left[N];
  }
  harp_free(harp);
  return worst;
}

static void moving_the_body_makes_no_step(void** state) {
  (void)state;
  const double moving = largest_step(true);
  const double still = largest_step(false);
  print_message("  steps %g, still %g\n", moving, still);
  assert_true(moving < 1.3 * still);
}

/* Nothing of what it was on before. */
static void reset_harp_is_as_a_new_one(void** state) {
  static float fresh[RATE];
  (void)state;
  const HarpPatch patch = patch_on(BODIES_GUITAR, 0.7);
  Harp* const harp = harps_new(RATE, &patch);
  harp_pedal(harp, 0, 1.0);
  harp_note_on(harp, 0, 45, 100);
  harp_run(harp, RATE, fresh, right);
  harp_reset(harp);
  harp_pedal(harp, 0, 1.0);
  harp_note_on(harp, 0, 45, 100);
  harp_run(harp, RATE, left, right);
  assert_memory_equal(left, fresh, sizeof(fresh));
  harp_free(harp);
}

/* Every key on every channel that there are strings for. */
static void all_strings_at_once_keep_clear_of_the_limit(void** state) {
  (void)state;
  static const double rates[] = {8e3, 22050.0, 48e3, 192e3};
  double least = 1.0;
  for (int body = BODIES_NONE; body < BODIES_FILE; ++body) {
    const double rate_hz = rates[body % 4];
    HarpPatch patch = patch_on((BodiesChoice)body, 1.0);
    patch.string.max_masses = body % 2 ? 4 : 1024;
    patch.body.shape = (BodyShape){body % 3 ? 1.0 : 0.25, body % 5 ? 0.1 : 4.0};
    Harp* const harp = harps_new(rate_hz, &patch);
    for (uint32_t channel = 0; channel < 2; ++channel) {
      for (uint32_t key = 0; key < HARP_KEYS; ++key) {
        harp_note_on(harp, channel, key, 100);
      }
    }
    harp_run(harp, 2000, left, right);
    assert_true(harp->bridge.n_tied > 100);
    least = fmin(least, harp_bridge_headroom(harp));
    harp_free(harp);
  }
  print_message("  least headroom %g\n", least);
  assert_true(least >= 0.1);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(string_alone_is_in_tune),
      cmocka_unit_test(open_strings_are_nearly_in_tune),
      cmocka_unit_test(wolf_is_in_tune_and_dies_sooner),
      cmocka_unit_test(open_strings_answer_through_the_body),
      cmocka_unit_test(strings_are_let_go_while_the_body_changes),
      cmocka_unit_test(string_struck_while_the_body_changes_is_let_go),
      cmocka_unit_test(another_file_is_another_bridge),
      cmocka_unit_test(moving_the_body_makes_no_step),
      cmocka_unit_test(reset_harp_is_as_a_new_one),
      cmocka_unit_test(all_strings_at_once_keep_clear_of_the_limit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* What pickups hear of the harp's strings: how far they are, how fast they move, how they pull. */
#include "tests/support/harps.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

/* What the fundamental of a velocity and of a force is weakened by. */
static const double VELOCITY_GAIN = 0.24;
static const double FORCE_GAIN = 0.18;

/* ONSET: what hides that a string was pulled aside is over, whatever is read.  LATE: so is what was
 * read before, which a spread keeps. */
enum { RATE = 48000, FRAMES = 24000, SWITCH = 6000, GLIDE = 960, ONSET = 720, LATE = 48 };

static float sounds[3][2][FRAMES];

static HarpPatch plain(PickupType sense) {
  HarpPatch patch = harps_patch(sense);
  patch.string.damping_per_s = 1.0;
  return patch;
}

static double velocity_gain(uint32_t key) {
  const double angle1 = 2.0 * PI * 440.0 * exp2(((double)key - 69.0) / 12.0) / RATE;
  return VELOCITY_GAIN * 0.5 / sin(0.5 * angle1);
}

/* What is heard says how hard a string is played: so all are played as one of them is. */
static void pluck_alike(Harp* harp, const HarpPatch* patch, uint32_t key) {
  const HarpPatch displacement = plain(PICKUP_DISPLACEMENT);
  harp_set_patch(harp, &displacement, 0);
  harp_note_on(harp, 0, key, 100);
  harp_set_patch(harp, patch, 0);
}

static void play(Harp* harp, const HarpPatch* patch, uint32_t key, float sound[2][FRAMES]) {
  harps_restart(harp, patch);
  pluck_alike(harp, patch, key);
  harps_run(harp, FRAMES, sound[0], sound[1]);
}

/* From the one sense to the other, `n_glide` frames from frame SWITCH on. */
static void
play_switch(Harp* harp, PickupType from, PickupType to, uint32_t n_glide, float sound[2][FRAMES]) {
  const HarpPatch before = plain(from);
  const HarpPatch after = plain(to);
  harps_restart(harp, &before);
  pluck_alike(harp, &before, 45);
  pluck_alike(harp, &before, 57);
  harps_run(harp, SWITCH, sound[0], sound[1]);
  harp_set_patch(harp, &after, n_glide);
  harps_run(harp, FRAMES - SWITCH, sound[0] + SWITCH, sound[1] + SWITCH);
}

static void velocity_is_what_displacement_changes_by(void** state) {
  (void)state;
  double worst = 0.0;
  const HarpPatch displacement = plain(PICKUP_DISPLACEMENT);
  Harp* const harp = harps_new(RATE, &displacement);
  for (uint32_t key = 33; key <= 96; key += 7) {
    const HarpPatch velocity = plain(PICKUP_VELOCITY);
    const double gain = velocity_gain(key);
    play(harp, &displacement, key, sounds[0]);
    play(harp, &velocity, key, sounds[1]);
    for (int s = 0; s < 2; ++s) {
      const double peak = measure_peak(sounds[1][s], FRAMES);
      for (size_t i = ONSET; i < FRAMES; ++i) {
        const double change = (double)sounds[0][s][i] - (double)sounds[0][s][i - 1];
        /* Displacements are rounded before they are taken from each other. */
        const double rounding = gain * (double)FLT_EPSILON * fabs((double)sounds[0][s][i]) / peak;
        worst = fmax(worst, fabs(gain * change - (double)sounds[1][s][i]) / peak - 4.0 * rounding);
      }
    }
  }
  assert_within("velocity, from the difference, of its peak", worst, 1e-5);
  harp_free(harp);
}

static double end_of(const Harp* harp, uint32_t key) {
  const Chain* const chain = &harp->strings[key].voice.chain;
  return FORCE_GAIN * (chain->n_masses + 1.0) / PI * (double)chain_position(chain, 0);
}

/* Wherever the pickup is. */
static void force_is_where_the_mass_at_the_end_is(void** state) {
  (void)state;
  double worst = 0.0;
  HarpPatch patch = plain(PICKUP_FORCE);
  Harp* const harp = harps_new(RATE, &patch);
  for (uint32_t key = 33; key <= 96; key += 7) {
    for (int k = 0; k < 4; ++k) {
      float left = 0.0f;
      float right = 0.0f;
      patch.pickup = 0.25 * k;
      patch.spread = 0.0;
      harps_restart(harp, &patch);
      harp_note_on(harp, 0, key, 127);
      for (int n = 0; n < ONSET + 500; ++n) {
        harp_run(harp, 1, &left, &right);
        assert_true(left == right);
        worst = n < ONSET ? worst : fmax(worst, fabs((double)left - end_of(harp, key)));
      }
    }
  }
  /* Of a peak of about 0.3. */
  assert_within("force, from the mass at the end", worst, 1e-6);
  harp_free(harp);
}

/* After the fade, or at once, it is as if it had never been heard otherwise: no differentiator has
 * a memory of another place. */
static void a_sense_switched_to_is_as_if_it_had_always_been(void** state) {
  (void)state;
  double worst = 0.0;
  const HarpPatch patch = plain(PICKUP_DISPLACEMENT);
  Harp* const harp = harps_new(RATE, &patch);
  for (PickupType from = 0; from <= PICKUP_FORCE; ++from) {
    for (PickupType to = 0; to <= PICKUP_FORCE; ++to) {
      for (uint32_t n_glide = 0; n_glide <= GLIDE; n_glide += GLIDE) {
        play_switch(harp, from, to, n_glide, sounds[0]);
        play_switch(harp, to, to, 0, sounds[1]);
        for (size_t i = SWITCH + n_glide + LATE; i < FRAMES; ++i) {
          for (int s = 0; s < 2; ++s) {
            worst = fmax(worst, fabs((double)sounds[0][s][i] - (double)sounds[1][s][i]));
          }
        }
      }
    }
  }
  assert_within("largest difference", worst, 1e-6);
  harp_free(harp);
}

static double largest_step(float sound[2][FRAMES], size_t from, size_t to) {
  return fmax(harps_largest_step(sound[0] + from, to - from),
              harps_largest_step(sound[1] + from, to - from));
}

static void switching_senses_makes_no_click(void** state) {
  (void)state;
  const HarpPatch patch = plain(PICKUP_DISPLACEMENT);
  Harp* const harp = harps_new(RATE, &patch);
  double worst = 0.0;
  for (PickupType from = 0; from <= PICKUP_FORCE; ++from) {
    for (PickupType to = 0; to <= PICKUP_FORCE; ++to) {
      play_switch(harp, from, from, 0, sounds[0]);
      play_switch(harp, to, to, 0, sounds[1]);
      play_switch(harp, from, to, GLIDE, sounds[2]);
      const size_t end = SWITCH + 2 * GLIDE;
      const double own =
          fmax(largest_step(sounds[0], SWITCH, end), largest_step(sounds[1], SWITCH, end));
      const double crossing =
          (measure_peak(sounds[0][0], FRAMES) + measure_peak(sounds[1][0], FRAMES)) / GLIDE;
      worst = fmax(worst, largest_step(sounds[2], SWITCH, end) / (own + crossing));
    }
  }
  assert_within("largest step, of what it may be", worst, 1.0);
  harp_free(harp);
}

/* A bend that takes masses from a string moves the shape a little, and a difference would hear. */
static void a_new_mesh_makes_no_click(void** state) {
  (void)state;
  for (PickupType sense = 0; sense <= PICKUP_FORCE; ++sense) {
    double worst = 0.0;
    HarpPatch patch = plain(sense);
    patch.string.max_masses = CHAIN_MAX_MASSES;
    Harp* const harp = harps_new(RATE, &patch);
    for (uint32_t key = 45; key <= 93; key += 3) {
      harps_restart(harp, &patch);
      harp_note_on(harp, 0, key, 100);
      const uint32_t n_masses = harp_report(harp).n_masses;
      harps_run(harp, SWITCH, sounds[0][0], sounds[0][1]);
      harp_bend(harp, 0, 7.0);
      assert_true(harp_report(harp).n_masses < n_masses);
      harps_run(harp, SWITCH, sounds[0][0] + SWITCH, sounds[0][1] + SWITCH);
      const double own = largest_step(sounds[0], SWITCH - 2000, SWITCH);
      worst = fmax(worst, largest_step(sounds[0], SWITCH, SWITCH + 3) / own);
    }
    print_message("  %s\n", harps_pickup_type(sense));
    assert_within("    largest step of the change, of those before", worst, 1.5);
    harp_free(harp);
  }
}

static void places_hold_for_velocities(void** state) {
  (void)state;
  HarpPatch patch = plain(PICKUP_VELOCITY);
  Harp* const harp = harps_new(RATE, &patch);
  for (int k = 0; k <= 4; ++k) {
    patch.pickup = 0.25 * k;
    patch.spread = 0.0;
    play(harp, &patch, 57, sounds[0]);
    const double peak = measure_peak(sounds[0][0], FRAMES);
    assert_true(k % 4 == 0 ? peak < 1e-6 : peak > 0.05);
    assert_memory_equal(sounds[0][0], sounds[0][1], sizeof(sounds[0][0]));
  }
  harp_free(harp);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(velocity_is_what_displacement_changes_by),
      cmocka_unit_test(force_is_where_the_mass_at_the_end_is),
      cmocka_unit_test(a_sense_switched_to_is_as_if_it_had_always_been),
      cmocka_unit_test(switching_senses_makes_no_click),
      cmocka_unit_test(a_new_mesh_makes_no_click),
      cmocka_unit_test(places_hold_for_velocities),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

#include "tests/support/guitars.h"

#include "core/guitar/guitar_event.h"
#include "plugin/guitar_ports.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { PIECE = 4096 };

GuitarPatch guitars_patch(void) {
  GuitarPatch patch = guitar_ports_usual();
  patch.hardness = 0.5;
  patch.width = 0.0;
  patch.pickups[0] = (GuitarPickup){0.1, 1.0};
  patch.pickups[1] = (GuitarPickup){0.25, 0.0};
  return patch;
}

Guitar* guitars_new(double rate_hz, const GuitarPatch* patch) {
  Guitar* const guitar = guitar_new(rate_hz);
  assert_non_null(guitar);
  guitar_set_patch(guitar, patch, 0);
  return guitar;
}

void guitars_pluck(Guitar* guitar, uint32_t string, double force) {
  guitar_pluck(guitar, string, (GuitarPluck){force, (double)NAN, (double)NAN});
}

void guitars_run(Guitar* guitar, uint32_t n_frames, float* left) {
  float other[2][PIECE];
  for (uint32_t done = 0; done < n_frames;) {
    const uint32_t n = n_frames - done < PIECE ? n_frames - done : PIECE;
    guitar_run(guitar, n, left ? left + done : other[0], other[1]);
    done += n;
  }
}

Tone guitars_tone(const GuitarPatch* patch, uint32_t string, double fret) {
  const double octaves = (patch->open[string] + patch->capo + fret - 69.0) / 12.0;
  const StringPatch* const p = &patch->string;
  return (Tone){
      .f0_hz = p->tuning_hz * exp2(octaves),
      .tau_s = 1.0 / (p->damping_per_s * exp2(p->tracking * octaves)),
  };
}

/* A value at an end of its range as often as within it. */
static double draw(Random* random, double low, double high) {
  const uint32_t choice = random_below(random, 6);
  return choice == 0 ? low : choice == 1 ? high : random_between(random, low, high);
}

static double draw_time_s(Random* random) {
  static const double times_s[] = {0.0, 1e-4, 3e-3, 2e-2, 0.1};
  return times_s[random_below(random, 5)];
}

static GuitarPatch draw_patch(Random* random) {
  GuitarPatch patch = guitars_patch();
  StringPatch* const p = &patch.string;
  patch.level = draw(random, 0.0, 1.0);
  p->damping_per_s = random_log_between(random, 0.02, 200.0);
  p->tracking = draw(random, 0.0, 1.0);
  p->loss = draw(random, 0.0, 1.0);
  p->inharmonicity = random_below(random, 2) ? 0.0 : random_log_between(random, 1e-6, 0.1);
  p->partials = (Partials)random_below(random, 3);
  p->loss_tracking = random_below(random, 2) ? 0.0 : draw(random, -2.0, 4.0);
  p->inharmonicity_tracking = random_below(random, 2) ? 0.0 : draw(random, 0.0, 4.0);
  p->tension = random_below(random, 2) ? 0.0 : draw(random, 0.0, 100.0);
  p->release_tracking = random_below(random, 2) ? 0.0 : draw(random, 0.0, 2.0);
  patch.pluck = draw(random, 0.0, 1.0);
  patch.hardness = draw(random, 0.0, 1.0);
  p->release_s = random_log_between(random, 0.005, 10.0);
  p->tuning_hz = draw(random, 400.0, 480.0);
  p->max_masses = 1 + random_below(random, GUITAR_MAX_MASSES);
  for (int i = 0; i < GUITAR_PICKUPS; ++i) {
    patch.pickups[i] = (GuitarPickup){draw(random, 0.0, 1.0), draw(random, -1.0, 1.0)};
  }
  patch.n_strings = 1 + random_below(random, GUITAR_STRINGS);
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    patch.open[s] = draw(random, 16.0, 88.0);
  }
  patch.capo = random_below(random, 13);
  patch.palm = random_below(random, 2) ? 0.0 : draw(random, 0.0, 1.0);
  patch.course = random_below(random, 2) ? 0.0 : draw(random, 0.0, 1.0);
  patch.width = draw(random, 0.0, 1.0);
  patch.body.choice = random_below(random, 2) ? BODIES_NONE : random_below(random, BODIES_COUNT);
  patch.body.mix = draw(random, 0.0, 1.0);
  patch.body.shape = (BodyShape){draw(random, 0.5, 2.0), draw(random, 0.25, 4.0)};
  patch.body.knock = draw(random, 0.0, 1.0);
  patch.is_uncorrected = random_below(random, 4) == 0;
  return patch;
}

static void gesture(Guitar* guitar, Random* random) {
  const uint32_t string = random_below(random, GUITAR_STRINGS + 1);
  const double fret =
      random_below(random, 4) ? random_below(random, 23) : draw(random, -48.0, 48.0);
  switch (random_below(random, 9)) {
  case 0:
    guitar_fret(guitar, string, fret);
    break;
  case 1:
    guitar_hammer(guitar, string, fret, draw(random, 0.0, 1.0));
    break;
  case 2:
    guitar_slide(guitar, string, fret, draw_time_s(random));
    break;
  case 3:
    guitar_bend(guitar, string, random_below(random, 4) ? draw(random, -2.0, 2.0) : fret,
                draw_time_s(random));
    break;
  case 4:
    guitar_vibrato(guitar, string, draw(random, 0.0, 12.0), draw(random, 0.0, 50.0));
    break;
  case 5:
    guitar_damp(guitar, string, random_below(random, 4) ? draw_time_s(random) : HUGE_VAL);
    break;
  case 6:
    guitar_let_ring(guitar, string);
    break;
  case 7:
    guitar_touch(guitar, string, draw(random, 0.0, 1.0), draw_time_s(random));
    break;
  default:
    guitar_palm(guitar, draw(random, 0.0, 1.0));
    break;
  }
}

void guitars_storm(Guitar* guitar, Random* random) {
  const uint32_t choice = random_below(random, 40);
  if (choice == 0) {
    const GuitarPatch patch = draw_patch(random);
    guitar_set_patch(guitar, &patch, random_below(random, 3000));
  } else if (choice == 1) {
    guitar_choke(guitar);
  } else if (choice < 14) {
    const double place = random_below(random, 2) ? (double)NAN : draw(random, 0.0, 1.0);
    const double hardness = random_below(random, 2) ? (double)NAN : draw(random, 0.0, 1.0);
    guitar_pluck(guitar, random_below(random, GUITAR_STRINGS),
                 (GuitarPluck){draw(random, -1.0, 1.0), place, hardness});
  } else {
    gesture(guitar, random);
  }
}

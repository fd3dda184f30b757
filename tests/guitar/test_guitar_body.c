/* The body of the guitar: it hears what the strings pull at the bridge, beside what the pickups
 * read, and does nothing to them. */
#include "core/guitar/guitar.h"
#include "core/guitar/guitar_string.h"

#include "core/base/aligned.h"
#include "plugin/guitar_ports.h"
#include "tests/support/guitars.h"
#include "tests/support/loudness.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, N_FRAMES = RATE, N_STRINGS = 6, EVERY = 97 };

/* What the mixer makes of a pull, and how a knock is beside a pluck. */
static const double BODY_GAIN = 3.2;
static const double KNOCK = 2.0;

static float left[N_FRAMES];
static float right[N_FRAMES];
static float others[2][N_FRAMES];
static double pulled[N_FRAMES];

static GuitarPatch patch_with(BodiesChoice choice, double mix) {
  GuitarPatch patch = guitars_patch();
  patch.pickups[1].gain = 0.5;
  patch.body = (BodyPatch){.choice = choice, .mix = mix, .shape = {1.0, 1.0}};
  return patch;
}

static double rms_of(const float* samples, uint32_t n_frames) {
  double sum = 0.0;
  for (uint32_t n = 0; n < n_frames; ++n) {
    sum += (double)samples[n] * (double)samples[n];
  }
  return sqrt(sum / n_frames);
}

/* The largest change of a step from sample to sample: what a click is seen by. */
static double turn_of(const float* samples, uint32_t n_frames) {
  double turn = 0.0;
  for (uint32_t n = 2; n < n_frames; ++n) {
    turn = fmax(turn,
                fabs((double)samples[n] - 2.0 * (double)samples[n - 1] + (double)samples[n - 2]));
  }
  return turn;
}

/* What the modes of a body, one by one, make of a pull: their impulses, as they come by
 * convolution; in every so many frames, for each costs as many products. */
static void convolve(const Body* body, const double* pull, float out[2][N_FRAMES]) {
  static double response[2][N_FRAMES];
  memset(response, 0, sizeof(response));
  for (uint32_t k = 0; k < body->n_modes; ++k) {
    const BodyMode* const mode = &body->modes[k];
    const double tau_s = mode->q / (acos(-1.0) * mode->f0_hz);
    Pole pole;
    double x = 0.0;
    double u = 0.0;
    if (mode->f0_hz >= BODY_HIGHEST * RATE) {
      continue;
    }
    assert_int_equal(pole_solve(RATE, (Tone){mode->f0_hz, tau_s}, &pole), STATUS_OK);
    /* What is heard of a mass that is stepped peaks as high as the body's. */
    const double half = acos(-1.0) * mode->f0_hz / RATE;
    const double heard = half * sqrt(1.0 - pole.g) / tan(half);
    for (int n = 0; n < N_FRAMES; ++n) {
      const double before = u;
      u += heard * (n == 0) / mode->mass_kg - pole.a * x - pole.g * u;
      x += u;
      response[0][n] += mode->radiation[0] * (u - before);
      response[1][n] += mode->radiation[1] * (u - before);
    }
  }
  for (int side = 0; side < 2; ++side) {
    for (int n = 0; n < N_FRAMES; n += EVERY) {
      double sum = 0.0;
      for (int m = 0; m <= n; ++m) {
        sum += response[side][n - m] * pull[m];
      }
      out[side][n] = (float)sum;
    }
  }
}

/* How far what is heard is from that, of how loud it is. */
static double distance(const Body* body, const double* pull, const float* l, const float* r) {
  double worst = 0.0;
  convolve(body, pull, others);
  for (int n = 0; n < N_FRAMES; n += EVERY) {
    worst = fmax(worst, fabs((double)l[n] - (double)others[0][n]));
    worst = fmax(worst, fabs((double)r[n] - (double)others[1][n]));
  }
  assert_true(rms_of(l, N_FRAMES) > 1e-4);
  return worst / rms_of(l, N_FRAMES);
}

/* What the mass at the bridge tells of a string by itself.  Of a pull from rest the first is hidden
 * by two poles at p = exp(−1/(0.5 ms · rate)): −f pⁿ (1 + n (1 − p)). */
static void pull_by(const GuitarPatch* patch, uint32_t string) {
  const double p = exp(-1.0 / (0.0005 * RATE));
  void* const memory = aligned_new(CHAIN_ALIGNMENT, chain_size(GUITAR_MAX_MASSES));
  const GuitarGains gains = {{false, false}, {{0}}};
  float none[1];
  GuitarString s;
  assert_non_null(memory);
  memset(memory, 0, chain_size(GUITAR_MAX_MASSES));
  guitar_string_init(&s, patch, RATE, string, memory);
  s.open = patch->open[string];
  guitar_string_pluck(&s, (Pluck){.place = patch->pluck,
                                  .hardness = patch->hardness,
                                  .amplitude = GUITAR_NOTE_PEAK,
                                  .softness = pluck_softness(1.0)});
  const double length = s.voice.chain.n_masses + 1.0;
  const double scale = 0.18 * length / acos(-1.0);
  const double first = scale * (double)chain_position(&s.voice.chain, 0);
  for (int n = 0; n < N_FRAMES; ++n) {
    guitar_string_run(&s, &gains, 1, none, NULL);
    const double hidden = first * pow(p, n + 1.0) * (1.0 + (n + 1.0) * (1.0 - p));
    pulled[n] = BODY_GAIN * (scale * (double)chain_position(&s.voice.chain, 0) - hidden);
  }
  aligned_free(memory);
}

static void play(const GuitarPatch* patch, uint32_t string, double force, float* l, float* r) {
  Guitar* const guitar = guitars_new(RATE, patch);
  guitars_pluck(guitar, string, force);
  guitar_run(guitar, N_FRAMES, l, r);
  guitar_free(guitar);
}

static void what_is_heard_is_the_pull_through_its_modes(void** state) {
  (void)state;
  double worst = 0.0;
  for (BodiesChoice choice = BODIES_NONE + 1; choice < BODIES_FILE; ++choice) {
    const uint32_t string = (uint32_t)choice % N_STRINGS;
    const GuitarPatch patch = patch_with(choice, 1.0);
    play(&patch, string, 1.0, left, right);
    pull_by(&patch, string);
    worst = fmax(worst, distance(bodies_shipped(choice), pulled, left, right));
  }
  assert_within("from the pull", worst, 2e-4);
}

/* What is done to it at random, in pieces of some size between; bodies of the patch come and go as
 * they are kept or not. */
typedef struct {
  bool has_body;
  double mix;
  uint32_t piece;
} Storm;

/* A body of one mode that nothing is heard of. */
static Body mute_body(void) {
  return (Body){.n_modes = 1, .modes = {{200.0, 20.0, 1.0, {0.0, 0.0}}}};
}

static void storm(Storm storm, uint64_t seed, float* l, float* r) {
  enum { STEP = 750 };
  GuitarPatch patch = patch_with(storm.has_body ? BODIES_FILE : BODIES_NONE, storm.mix);
  const Body body = mute_body();
  Guitar* const guitar = guitars_new(RATE, &patch);
  Random random = {.state = seed};
  guitar_set_body(guitar, &body);
  guitar_set_patch(guitar, &patch, 0);
  for (uint32_t done = 0; done < N_FRAMES; done += STEP) {
    const uint32_t string = random_below(&random, N_STRINGS);
    const double fret = random_below(&random, 13);
    switch (random_below(&random, 6)) {
    case 0:
      guitar_slide(guitar, string, fret, 0.02);
      break;
    case 1:
      guitar_hammer(guitar, string, fret, 0.5);
      break;
    case 2:
      guitar_bend(guitar, string, random_between(&random, -2.0, 3.0), 0.01);
      break;
    case 3:
      patch.pickups[random_below(&random, 2)].place = random_between(&random, 0.05, 0.4);
      patch.pickups[random_below(&random, 2)].gain = random_between(&random, -1.0, 1.0);
      guitar_set_patch(guitar, &patch, 300);
      break;
    default:
      guitars_pluck(guitar, string, 0.8);
      break;
    }
    for (uint32_t n = 0; n < STEP; n += storm.piece) {
      const uint32_t now = STEP - n < storm.piece ? STEP - n : storm.piece;
      guitar_run(guitar, now, l + done + n, r + done + n);
    }
  }
  guitar_free(guitar);
}

/* Bit by bit: with a body that is not heard what is left are the strings, times √(1 − mix). */
static void strings_do_not_know_of_it(void** state) {
  (void)state;
  const uint64_t seed = random_start().state;
  for (uint64_t i = 0; i < 8; ++i) {
    storm((Storm){false, 0.0, 750}, seed + i, others[0], others[1]);
    storm((Storm){true, 0.0, 750}, seed + i, left, right);
    assert_memory_equal(left, others[0], sizeof(left));
    assert_memory_equal(right, others[1], sizeof(right));
    storm((Storm){true, 0.75, 750}, seed + i, left, right);
    for (int n = 0; n < N_FRAMES; ++n) {
      assert_true(left[n] == 0.5f * others[0][n] && right[n] == 0.5f * others[1][n]);
    }
  }
}

/* Another body, shape or mix now and then, and strings of all kinds under them. */
static void change_all_along(uint32_t piece, float* l, float* r) {
  enum { STEP = 1200 };
  Random random = {.state = 7};
  const Body file = *bodies_shipped(BODIES_VIOLIN);
  GuitarPatch patch = patch_with(BODIES_GUITAR, 0.6);
  patch.body.knock = 0.5;
  patch.noise = 0.5;
  Guitar* const guitar = guitars_new(RATE, &patch);
  for (uint32_t done = 0; done < N_FRAMES; done += STEP) {
    guitars_pluck(guitar, random_below(&random, N_STRINGS), random_between(&random, 0.1, 1.0));
    guitar_slide(guitar, random_below(&random, N_STRINGS), random_below(&random, 13), 0.01);
    if (random_below(&random, 3) == 0) {
      patch.body.choice = random_below(&random, BODIES_COUNT);
      patch.body.shape.size = random_between(&random, 0.5, 2.0);
      patch.body.mix = random_between(&random, 0.0, 1.0);
      guitar_set_patch(guitar, &patch, random_below(&random, 500));
      guitar_set_body(guitar, random_below(&random, 2) ? &file : NULL);
    }
    for (uint32_t n = 0; n < STEP; n += piece) {
      const uint32_t now = STEP - n < piece ? STEP - n : piece;
      guitar_run(guitar, now, l + done + n, r + done + n);
    }
  }
  guitar_free(guitar);
}

static void blocks_do_not_change_the_sound(void** state) {
  static const uint32_t pieces[] = {1, 7, 64, 512};
  (void)state;
  change_all_along(4096, left, right);
  assert_true(rms_of(left, N_FRAMES) > 1e-3);
  for (size_t i = 0; i < sizeof(pieces) / sizeof(pieces[0]); ++i) {
    change_all_along(pieces[i], others[0], others[1]);
    assert_memory_equal(left, others[0], sizeof(left));
    assert_memory_equal(right, others[1], sizeof(right));
  }
}

/* Once all has died away, exactly nothing is heard of it. */
static void it_comes_to_rest(void** state) {
  (void)state;
  GuitarPatch patch = patch_with(BODIES_GUITAR, 0.7);
  patch.body.knock = 1.0;
  Guitar* const guitar = guitars_new(RATE, &patch);
  guitar_run(guitar, RATE / 10, left, right);
  for (int n = 0; n < RATE / 10; ++n) {
    assert_true(left[n] == 0.0f && right[n] == 0.0f);
  }
  for (uint32_t s = 0; s < N_STRINGS; ++s) {
    guitars_pluck(guitar, s, 1.0);
  }
  guitar_run(guitar, RATE / 10, left, right);
  assert_true(rms_of(left, RATE / 10) > 1e-3);
  guitar_choke(guitar);
  for (int second = 0; second < 6; ++second) {
    guitar_run(guitar, RATE, left, right);
  }
  for (int n = 0; n < N_FRAMES; ++n) {
    assert_true(left[n] == 0.0f && right[n] == 0.0f);
  }
  guitar_free(guitar);
}

/* Reset, it is as new. */
static void a_reset_leaves_nothing_of_it(void** state) {
  (void)state;
  GuitarPatch patch = patch_with(BODIES_CELLO, 1.0);
  patch.body.knock = 1.0;
  Guitar* const guitar = guitars_new(RATE, &patch);
  guitars_pluck(guitar, 2, 1.0);
  guitar_run(guitar, 33, left, right);
  guitar_reset(guitar);
  guitar_run(guitar, 1000, left, right);
  for (int n = 0; n < 1000; ++n) {
    assert_true(left[n] == 0.0f && right[n] == 0.0f);
  }
  guitar_free(guitar);
}

/* The sharpest edge while one body becomes another under a chord, of those before and after. */
static double edge_of_a_change(BodiesChoice from, BodiesChoice to) {
  enum { BEFORE = 4800, FADE = 1920, AFTER = 4800 };
  const Body files[2] = {*bodies_shipped(BODIES_BANJO), *bodies_shipped(BODIES_CELLO)};
  GuitarPatch patch = patch_with(from, 0.7);
  Guitar* const guitar = guitars_new(RATE, &patch);
  guitar_set_body(guitar, &files[0]);
  guitar_set_patch(guitar, &patch, 0);
  for (uint32_t s = 0; s < N_STRINGS; ++s) {
    guitars_pluck(guitar, s, 0.7);
  }
  guitar_run(guitar, BEFORE, left, right);
  if (from == to) {
    guitar_set_body(guitar, &files[1]);
  } else {
    patch.body.choice = to;
    guitar_set_patch(guitar, &patch, 64);
  }
  guitar_run(guitar, FADE + AFTER, left + BEFORE, right + BEFORE);
  guitar_free(guitar);
  const double before = turn_of(left + BEFORE / 2, BEFORE / 2);
  const double after = turn_of(left + BEFORE + FADE, AFTER);
  return turn_of(left + BEFORE - 2, FADE) / fmax(before, after);
}

static void changing_it_makes_no_step(void** state) {
  (void)state;
  double worst = edge_of_a_change(BODIES_FILE, BODIES_FILE);
  for (BodiesChoice from = BODIES_NONE; from < BODIES_COUNT; ++from) {
    worst = fmax(worst, edge_of_a_change(from, (from + 5) % BODIES_COUNT));
  }
  assert_within("edges while it fades, of those before and after", worst, 1.1);
}

/* The edge where a string is plucked, once more every so many frames, of those between. */
static double edge_of_plucks(uint32_t string, uint32_t every) {
  enum { N_PLUCKS = 8, START = 2 };
  const GuitarPatch patch = patch_with(BODIES_GUITAR, 1.0);
  Guitar* const guitar = guitars_new(RATE, &patch);
  double worst = 0.0;
  double usual = 0.0;
  memset(left, 0, START * sizeof(float));
  for (uint32_t i = 0; i < N_PLUCKS; ++i) {
    guitars_pluck(guitar, string, i % 2 ? 1.0 : -1.0);
    guitar_run(guitar, every, left + START + every * i, right);
  }
  guitar_run(guitar, 4800, left + START + every * N_PLUCKS, right);
  for (uint32_t i = 0; i < N_PLUCKS; ++i) {
    worst = fmax(worst, turn_of(left + every * i, START + 3));
    usual = fmax(usual, turn_of(left + every * i + START + 1, every));
  }
  usual = fmax(usual, turn_of(left + every * N_PLUCKS + START, 4800));
  guitar_free(guitar);
  return worst / usual;
}

/* What rings is plucked again, late, or while the last pull is under way: the body is never hit by
 * the string's being pulled aside at once. */
static void a_pull_is_no_hit(void** state) {
  static const uint32_t every[] = {1000, 300, 40, 10};
  (void)state;
  double worst = 0.0;
  for (uint32_t s = 0; s < N_STRINGS; ++s) {
    for (size_t i = 0; i < sizeof(every) / sizeof(every[0]); ++i) {
      const double edge = edge_of_plucks(s, every[i]);
      print_message("  string %u every %u: %.2f\n", s, every[i], edge);
      worst = fmax(worst, edge);
    }
  }
  assert_within("edge of a pull, of the others", worst, 1.0);
}

/* What a string pulls by, a frame at a time, while it goes to a fret and back. */
static double edge_of_a_way(uint32_t string, double fret, uint32_t n_slide) {
  enum { RINGING = 4000, MOVING = 2000 };
  static float pull[RINGING + 2 * MOVING];
  const GuitarPatch patch = patch_with(BODIES_GUITAR, 1.0);
  const GuitarGains gains = {{true, true}, {{1.0f}, {1.0f}}};
  void* const memory = aligned_new(CHAIN_ALIGNMENT, chain_size(GUITAR_MAX_MASSES));
  float none[1] = {0.0f};
  GuitarString s;
  assert_non_null(memory);
  memset(memory, 0, chain_size(GUITAR_MAX_MASSES));
  memset(pull, 0, sizeof(pull));
  guitar_string_init(&s, &patch, RATE, string, memory);
  s.open = patch.open[string];
  guitar_string_pluck(&s, (Pluck){0.13, 0.3, GUITAR_NOTE_PEAK, 0.0});
  for (int n = 0; n < RINGING + 2 * MOVING; ++n) {
    if (n == RINGING || n == RINGING + MOVING) {
      guitar_string_slide(&s, n == RINGING ? fret : 0.0, n_slide);
    }
    guitar_string_run(&s, &gains, 1, none, &pull[n]);
  }
  aligned_free(memory);
  return turn_of(pull + RINGING - 2, 2 * MOVING) / turn_of(pull + 500, RINGING - 500);
}

/* Edges go with the square of the pitch, and nothing else makes them sharper. */
static void other_masses_make_no_step(void** state) {
  (void)state;
  double worst = 0.0;
  for (uint32_t s = 0; s < N_STRINGS; ++s) {
    for (double fret = 1.0; fret < 13.0; fret += 3.0) {
      worst = fmax(worst, edge_of_a_way(s, fret, 192) / exp2(fret / 6.0));
    }
  }
  assert_within("edge, of those before at the pitch", worst, 1.0);
}

/* What a pull of one string by a hand sounds like with and without a knock, less one another. */
static void knock_of(uint32_t string, double force, double hardness, double palm) {
  GuitarPatch patch = patch_with(BODIES_GUITAR, 1.0);
  patch.palm = palm;
  for (int i = 0; i < 2; ++i) {
    patch.body.knock = i == 0 ? 0.0 : 0.8;
    Guitar* const guitar = guitars_new(RATE, &patch);
    guitar_set_gain(guitar, string, 0.5);
    guitar_pluck(guitar, string, (GuitarPluck){force, 0.2, hardness});
    guitar_run(guitar, N_FRAMES, i == 0 ? others[0] : left, i == 0 ? others[1] : right);
    guitar_free(guitar);
  }
  for (int n = 0; n < N_FRAMES; ++n) {
    left[n] -= others[0][n];
    right[n] -= others[1][n];
  }
}

/* Whatever the string is: by its force and its hardness, through the modes. */
static void a_knock_is_a_push_on_the_modes(void** state) {
  static const struct {
    uint32_t string;
    double force, hardness, palm;
  } hands[] = {{5, 1.0, 1.0, 0.0}, {0, 1.0, 0.0, 0.0}, {2, -0.6, 0.5, 0.0}, {4, 0.8, 0.5, 1.0}};
  (void)state;
  for (size_t i = 0; i < sizeof(hands) / sizeof(hands[0]); ++i) {
    const int n_frames = (int)(0.006 * pow(0.25, hands[i].hardness) * RATE);
    const double height = KNOCK * BODY_GAIN * 0.5 * 0.8 * GUITAR_NOTE_PEAK * fabs(hands[i].force);
    knock_of(hands[i].string, hands[i].force, hands[i].hardness, hands[i].palm);
    for (int n = 0; n < N_FRAMES; ++n) {
      const double phase = 2.0 * acos(-1.0) * (n + 1.0) / (n_frames + 1.0);
      pulled[n] = n < n_frames ? 0.5 * height * (1.0 - cos(phase)) : 0.0;
    }
    /* It is what is left of a sum in floats, of which it is a part. */
    assert_within("from the push", distance(bodies_shipped(BODIES_GUITAR), pulled, left, right),
                  2e-3);
  }
}

/* Power at a frequency [Hz]. */
static double power_at(const float* samples, uint32_t n_frames, double hz) {
  double re = 0.0;
  double im = 0.0;
  for (uint32_t n = 0; n < n_frames; ++n) {
    const double window = 1.0 - cos(2.0 * acos(-1.0) * (n + 0.5) / n_frames);
    re += window * (double)samples[n] * cos(2.0 * acos(-1.0) * hz * n / RATE);
    im += window * (double)samples[n] * sin(2.0 * acos(-1.0) * hz * n / RATE);
  }
  return re * re + im * im;
}

/* Beside a hard note, halfway between its partials, where the body has its low modes. */
static void a_knock_is_heard_between_the_partials(void** state) {
  enum { N = 9600 };
  (void)state;
  double power[2] = {0.0, 0.0};
  for (int i = 0; i < 2; ++i) {
    GuitarPatch patch = patch_with(BODIES_GUITAR, 0.5);
    patch.body.knock = i;
    play(&patch, 0, 1.0, left, right);
    for (double k = 0.5; k < 3.0; k += 1.0) {
      power[i] += power_at(left, N, k * guitars_tone(&patch, 0, 0.0).f0_hz);
    }
  }
  const double db = 10.0 * log10(power[1] / power[0]);
  print_message("  %.1f dB\n", db);
  assert_true(db > 6.0);
}

static void noises_pull_as_well(void** state) {
  (void)state;
  GuitarPatch patch = patch_with(BODIES_GUITAR, 1.0);
  play(&patch, 1, 1.0, others[0], others[1]);
  patch.noise = 1.0;
  play(&patch, 1, 1.0, left, right);
  for (int n = 0; n < N_FRAMES; ++n) {
    left[n] -= others[0][n];
  }
  assert_true(rms_of(left, 1000) > 0.01 * rms_of(others[0], 1000));
}

/* Nor is it heard of the body that comes after. */
static void a_knock_without_a_body_is_forgotten(void** state) {
  (void)state;
  GuitarPatch patch = patch_with(BODIES_NONE, 1.0);
  patch.body.knock = 1.0;
  Guitar* const guitar = guitars_new(RATE, &patch);
  guitars_pluck(guitar, 0, 1.0);
  guitar_choke(guitar);
  guitar_run(guitar, RATE / 2, left, right);
  assert_int_equal(guitar_report(guitar).n_strings, 0);
  patch.body.choice = BODIES_GUITAR;
  guitar_set_patch(guitar, &patch, 100);
  guitar_run(guitar, RATE / 2, left, right);
  for (int n = 0; n < RATE / 2; ++n) {
    assert_true(left[n] == 0.0f && right[n] == 0.0f);
  }
  guitar_free(guitar);
}

static void hammers_knock_as_well(void** state) {
  (void)state;
  for (int i = 0; i < 2; ++i) {
    GuitarPatch patch = patch_with(BODIES_GUITAR, 1.0);
    patch.body.knock = i;
    Guitar* const guitar = guitars_new(RATE, &patch);
    guitar_hammer(guitar, 1, 5.0, 1.0);
    guitar_run(guitar, 4800, i ? left : others[0], i ? right : others[1]);
    guitar_free(guitar);
  }
  assert_true(memcmp(left, others[0], 4800 * sizeof(float)) != 0);
}

/* By a power of two, so to the bit; and it has no sides. */
static void gain_and_level_are_the_body_s_as_well(void** state) {
  (void)state;
  GuitarPatch patch = patch_with(BODIES_GUITAR, 1.0);
  patch.body.knock = 0.5;
  patch.noise = 0.5;
  play(&patch, 3, 1.0, others[0], others[1]);
  patch.width = 1.0;
  play(&patch, 3, 1.0, left, right);
  assert_memory_equal(left, others[0], sizeof(left));
  assert_memory_equal(right, others[1], sizeof(right));
  patch.level = 0.5;
  Guitar* const guitar = guitars_new(RATE, &patch);
  guitar_set_gain(guitar, 3, 0.25);
  guitars_pluck(guitar, 3, 1.0);
  guitar_run(guitar, N_FRAMES, left, right);
  for (int n = 0; n < N_FRAMES; ++n) {
    assert_true(fabs((double)left[n] - 0.125 * (double)others[0][n]) < 1e-6);
  }
  guitar_free(guitar);
}

/* Of open strings in the mean, each by itself. */
static double loudness_db(GuitarPatch patch) {
  double sum = 0.0;
  for (uint32_t s = 0; s < N_STRINGS; ++s) {
    play(&patch, s, 0.8, left, right);
    sum += loudness_lufs(left, right, N_FRAMES);
  }
  return sum / N_STRINGS;
}

static void a_guitar_is_as_loud_as_its_pickups(void** state) {
  (void)state;
  GuitarPatch patch = guitar_ports_usual();
  const double pickups_db = loudness_db(patch);
  patch.body.mix = 1.0;
  for (BodiesChoice choice = BODIES_GUITAR; choice < BODIES_FILE; ++choice) {
    patch.body.choice = choice;
    const double more_db = loudness_db(patch) - pickups_db;
    const bool is_guitar = choice <= BODIES_CLASSICAL_GUITAR;
    print_message("  body %d: %.1f dB\n", (int)choice, more_db);
    assert_within("open strings, against the pickups [dB]", fabs(more_db), is_guitar ? 2.0 : 3.0);
  }
}

static void a_body_from_a_file_is_copied(void** state) {
  (void)state;
  Body body = *bodies_shipped(BODIES_VIOLIN);
  const GuitarPatch shipped = patch_with(BODIES_VIOLIN, 0.7);
  const GuitarPatch file = patch_with(BODIES_FILE, 0.7);
  const GuitarPatch plain = patch_with(BODIES_NONE, 0.7);
  play(&shipped, 4, 1.0, others[0], others[1]);
  Guitar* const guitar = guitars_new(RATE, &file);
  guitar_set_body(guitar, &body);
  guitar_set_patch(guitar, &file, 0);
  memset(&body, 0, sizeof(body));
  guitars_pluck(guitar, 4, 1.0);
  guitar_run(guitar, N_FRAMES, left, right);
  assert_memory_equal(left, others[0], sizeof(left));
  assert_memory_equal(right, others[1], sizeof(right));
  guitar_free(guitar);
  play(&file, 4, 1.0, left, right); /* There is none yet. */
  play(&plain, 4, 1.0, others[0], others[1]);
  assert_memory_equal(left, others[0], sizeof(left));
  assert_memory_equal(right, others[1], sizeof(right));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_is_heard_is_the_pull_through_its_modes),
      cmocka_unit_test(strings_do_not_know_of_it),
      cmocka_unit_test(blocks_do_not_change_the_sound),
      cmocka_unit_test(it_comes_to_rest),
      cmocka_unit_test(a_reset_leaves_nothing_of_it),
      cmocka_unit_test(changing_it_makes_no_step),
      cmocka_unit_test(a_pull_is_no_hit),
      cmocka_unit_test(other_masses_make_no_step),
      cmocka_unit_test(a_knock_is_a_push_on_the_modes),
      cmocka_unit_test(a_knock_is_heard_between_the_partials),
      cmocka_unit_test(noises_pull_as_well),
      cmocka_unit_test(a_knock_without_a_body_is_forgotten),
      cmocka_unit_test(hammers_knock_as_well),
      cmocka_unit_test(gain_and_level_are_the_body_s_as_well),
      cmocka_unit_test(a_guitar_is_as_loud_as_its_pickups),
      cmocka_unit_test(a_body_from_a_file_is_copied),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

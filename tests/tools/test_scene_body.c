/* The statements that bodies are made of, against closed forms, and what is wrong in them. */

#include "core/analysis/modes.h"
#include "core/base/maths.h"
#include "tools/formats/scene.h"

#include "tests/support/oracle.h"
#include "tests/support/scenes.h"

#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static Scene* read_for_modes(const char* text) {
  ScenesRead read;
  Scene* const scene = scenes_read_bytes(text, strlen(text), SCENE_FOR_MODES, &read);
  if (!scene) {
    fail_msg("%s", read.error);
  }
  return scene;
}

/* The lowest `n`; 0: all. */
static Modes* modes_of(const char* text, uint32_t n) {
  Scene* const scene = read_for_modes(text);
  Modes* modes = NULL;
  assert_int_equal(modes_solve(scene->network, 1e6, n, &modes), STATUS_OK);
  assert_true(modes->is_stable);
  scene_free(scene);
  return modes;
}

static double omega_of(const Modes* modes, uint32_t k) {
  return cimag(modes->mode[k].analog[0]);
}

/* The place in the order of the modes is not told: the nearest is. */
static double miss(const Modes* modes, double omega) {
  double least = HUGE_VAL;
  for (uint32_t k = 0; k < modes->n_modes; ++k) {
    least = fmin(least, fabs(omega_of(modes, k) / omega - 1.0));
  }
  return least;
}

/* The second difference of a sine of half-waves m over n + 1 places of `spacing`. */
static double curvature(int m, int n, double spacing_m) {
  const double s = 2.0 * sin(0.5 * PI * m / (n + 1)) / spacing_m;
  return s * s;
}

/* D_x κ_x² + D_y κ_y² + 2 √(D_x D_y) κ_x κ_y = (√D_x κ_x + √D_y κ_y)² over the density, at all 6 ×
 * 5 modes. */
static void a_hinged_plate_has_its_closed_form(void** state) {
  (void)state;
  Modes* const modes =
      modes_of("rate 1\nplate p 6 5 size 0.35 0.3 density 1.3 bending 20 2 edge hinged\n", 0);
  double worst = 0.0;
  for (int m = 1; m <= 6; ++m) {
    for (int n = 1; n <= 5; ++n) {
      const double x = sqrt(20.0) * curvature(m, 6, 0.05);
      const double y = sqrt(2.0) * curvature(n, 5, 0.05);
      worst = fmax(worst, miss(modes, (x + y) / sqrt(1.3)));
    }
  }
  assert_within("ω, relative", worst, 1e-11);
  modes_free(modes);
}

static void a_membrane_has_its_closed_form(void** state) {
  (void)state;
  Modes* const modes =
      modes_of("rate 1\nmembrane p 6 5 size 0.35 0.36 density 0.3 tension 900\n", 0);
  double worst = 0.0;
  for (int m = 1; m <= 6; ++m) {
    for (int n = 1; n <= 5; ++n) {
      const double square = 3000.0 * (curvature(m, 6, 0.05) + curvature(n, 5, 0.06));
      worst = fmax(worst, miss(modes, sqrt(square)));
    }
  }
  assert_within("ω, relative", worst, 1e-12);
  modes_free(modes);
}

/* 2.4048, 3.8317 and 5.1356 over the radius, of a mesh of some hundred masses; 3.196² and 4.611² of
 * a plate that is clamped, and of steel, with Poisson's ratio no part of it. */
static void round_sheets_come_near_to_theirs(void** state) {
  (void)state;
  Modes* modes =
      modes_of("rate 1\nmembrane p 31 31 size 0.3 0.3 density 0.3 tension 3000 round\n", 3);
  assert_within("membrane, 0 1", fabs(omega_of(modes, 0) / (2.40483 / 0.15 * 100.0) - 1.0), 0.02);
  assert_within("membrane, 1 1", fabs(omega_of(modes, 1) / (3.83171 / 0.15 * 100.0) - 1.0), 0.02);
  assert_within("both", fabs(omega_of(modes, 2) / omega_of(modes, 1) - 1.0), 1e-9);
  modes_free(modes);
  modes = modes_of(
      "rate 1\nplate p 31 31 size 0.3 0.3 density 4 bending 40 40 edge clamped round\n", 3);
  const double unit = sqrt(10.0) / (0.15 * 0.15);
  assert_within("plate, 0 0", fabs(omega_of(modes, 0) / (10.2158 * unit) - 1.0), 0.05);
  assert_within("plate, 1 0", fabs(omega_of(modes, 1) / (21.26 * unit) - 1.0), 0.05);
  modes_free(modes);
}

/* A square that is clamped: 35.99; as a mesh is finer, it comes nearer by the square. */
static void a_clamped_plate_converges_to_its_own(void** state) {
  (void)state;
  double error[2];
  for (int pass = 0; pass < 2; ++pass) {
    char text[128];
    const int n = pass ? 23 : 11;
    (void)snprintf(text, sizeof(text),
                   "rate 1\nplate p %d %d size 0.2 0.2 density 1 bending 1 1 edge clamped\n", n, n);
    Modes* const modes = modes_of(text, 3);
    error[pass] = omega_of(modes, 0) * 0.04 / 35.9852 - 1.0;
    modes_free(modes);
  }
  assert_within("error", fabs(error[1]), 0.01);
  assert_within("as the square", fabs(error[0] / error[1] - 4.0), 0.5);
}

/* Bars: 22.373 of one that is free, as a plate of one column; and by bends alone; 3.516 of one that
 * is clamped at one end, as a brace on it would be. */
static void free_plates_drift_turn_and_ring(void** state) {
  (void)state;
  Modes* const modes =
      modes_of("rate 1\nplate p 1 60 size 0.02 0.6 density 2 bending 1e-9 3 edge free\n", 0);
  assert_true(modes->mode[0].is_free);
  assert_within("turns [1/s]", cabs(modes->mode[1].analog[0]), 1e-2);
  const double unit = sqrt(3.0 / 2.0) / 0.36;
  assert_within("first", fabs(omega_of(modes, 2) / (22.3733 * unit) - 1.0), 0.002);
  assert_within("second", fabs(omega_of(modes, 3) / (61.6728 * unit) - 1.0), 0.005);
  modes_free(modes);
}

static double energy_at(Scene* scene, const char* name, double x) {
  (void)name;
  Network* const network = scene->network;
  for (uint32_t p = 0; p < network->n_points; ++p) {
    network->x[p] = network->is_ground[p] ? 0.0 : x;
  }
  return network_energy(network);
}

static void braces_add_mass_and_moments(void** state) {
  (void)state;
  static const char plain[] = "rate 1\nplate p 5 7 size 0.1 0.24 density 2 bending 3 3 edge free\n";
  static const struct {
    const char* line;
    double length_m;
    double curve; /* (x₁ − 2 x₂ + x₃)² summed, of x = row² + 2 column² */
    int n;
  } braces[] = {
      {"brace p.3.2 p.3.6 mass 0.5 bending 0.4\n", 0.24 / 7, 3 * 4.0, 5},
      {"brace p.5.4 p.1.4 mass 0.5 bending 0.4\n", 0.02, 3 * 16.0, 5},
      {"brace p.1.5 p.4.2 mass 0.5 bending 0.4\n", 0.0, 2 * 36.0, 4},
  };
  for (size_t b = 0; b < sizeof(braces) / sizeof(braces[0]); ++b) {
    char text[256];
    double energy[2];
    double mass_kg[2] = {0.0, 0.0};
    for (int pass = 0; pass < 2; ++pass) {
      (void)snprintf(text, sizeof(text), "%s%s", plain, pass ? braces[b].line : "");
      Scene* const scene = read_for_modes(text);
      for (uint32_t i = 0; i < 35; ++i) {
        const double row = i / 5;
        const double column = i % 5;
        scene->network->x[i] = row * row + 2.0 * column * column;
        mass_kg[pass] += scene->network->mass_kg[i];
      }
      energy[pass] = network_energy(scene->network);
      scene_free(scene);
    }
    const double length_m = braces[b].length_m > 0.0 ? braces[b].length_m : hypot(0.02, 0.24 / 7);
    const double expected = 0.5 * 0.4 / pow(length_m, 3.0) * braces[b].curve;
    assert_within("energy, relative", fabs((energy[1] - energy[0]) / expected - 1.0), 1e-9);
    assert_within("mass [kg]", fabs(mass_kg[1] - mass_kg[0] - 0.5), 1e-14);
  }
}

/* All of it moved outwards by x: K/2 (A x + S x)² with the areas that there are. */
static void air_is_pressed_by_all_walls(void** state) {
  (void)state;
  static const char walls[] = "rate 1\nplate t 4 4 size 0.2 0.2 density 2 bending 3 3 edge free\n"
                              "plate b 3 2 size 0.3 0.2 density 2 bending 3 3 edge free\n";
  char text[512];
  (void)snprintf(text, sizeof(text), "%sair h mass 1e-3 area 0.005 volume 0.01 walls t b\n", walls);
  Scene* const scene = read_for_modes(text);
  const double expected = 0.5 * 1.4 * 101325.0 / 0.01 * pow((0.04 + 0.06 + 0.005) * 1e-3, 2.0);
  assert_within("energy, relative", fabs(energy_at(scene, "h", 1e-3) / expected - 1.0), 1e-9);
  scene_free(scene);
}

static void an_outline_leaves_out_what_is_outside(void** state) {
  (void)state;
  Scene* const scene =
      read_for_modes("rate 1\nplate p 9 3 size 0.9 0.3 density 1 bending 1 1 edge free "
                     "outline 0.3 0.3 1 1\nground g\nspring p.5.1 g 1\n");
  /* Rows at 1/6, 1/2 and 5/6 of the height: shares 0.3, 0.65 and 1 of 9 columns. */
  static const uint32_t n_wanted[3] = {3, 5, 9};
  for (uint32_t row = 0; row < 3; ++row) {
    uint32_t n = 0;
    for (uint32_t column = 0; column < 9; ++column) {
      n += scene->network->is_ground[9 * row + column] ? 0 : 1;
    }
    assert_int_equal(n, n_wanted[row]);
  }
  scene_free(scene);
}

#define HEAD                                                                                       \
  "rate 6000\nmass a 2\nplate p 3 4 size 0.1 0.1 density 1 bending 1 1 edge hinged outline 0.2 "   \
  "1\n"
#define TAIL "bridge a 1\nradiate p 1\nloss 100 20\n"

static const struct {
  const char* text;
  unsigned line;
  const char* what;
} refusals[] = {
    {HEAD "radiate p 1\nloss 100 20\n", 5, "expected 'bridge MASS WEIGHT'"},
    {HEAD "bridge a 1\nloss 100 20\n", 5, "expected 'radiate NAME GAIN'"},
    {HEAD "bridge a 1\nradiate p 1\n", 5, "expected 'loss HZ Q'"},
    {HEAD "bend a p.2.2 a 1\n" TAIL, 4, "found 'a' again, expected another point"},
    {HEAD "bend a p.2.2 p.2.3 -1\n" TAIL, 4, "found '-1', expected a stiffness from 0 N/m up"},
    {HEAD "twist a p.2.2 p.2.3 1\n" TAIL, 4, "found '1', expected a point declared above"},
    {HEAD "bend a p p.2.3 1\n" TAIL, 4,
     "found 'p', expected one of the sheet's masses, .1.1 to .3.4 after its name"},
    {HEAD "bridge p.4.1 1\n" TAIL, 4, "found 'p.4.1', expected one of the sheet's masses"},
    {HEAD "bridge p.0.1 1\n" TAIL, 4, "found 'p.0.1', expected one of the sheet's masses"},
    {HEAD "bridge p.1 1\n" TAIL, 4, "found 'p.1', expected one of the sheet's masses"},
    {HEAD "bridge p.1.x 1\n" TAIL, 4, "found 'p.1.x', expected one of the sheet's masses"},
    {HEAD "bridge p.000000000000001.1 1\n" TAIL, 4, "expected one of the sheet's masses"},
    {HEAD "bridge p.1.1 1\n" TAIL, 4, "found 'p.1.1', which lies outside of the outline"},
    {HEAD "plate q 0 4 size\n" TAIL, 4, "found '0', expected a whole number of columns"},
    {HEAD "plate q 3 300 size\n" TAIL, 4, "found '300', expected a whole number of rows"},
    {HEAD "plate q 3 3 size 0.1 0\n" TAIL, 4, "found '0', expected a size from 0.001"},
    {HEAD "plate q 3 3 size 1 1 density 1 bending 1 0\n" TAIL, 4,
     "found '0', expected a bending stiffness"},
    {HEAD "plate q 3 3 size 1 1 density 1 bending 1 1 edge loose\n" TAIL, 4,
     "found 'loose', expected free, hinged or clamped"},
    {HEAD "plate q 3 3 size 1 1 density 1 bending 1 1 edge free square\n" TAIL, 4,
     "found 'square', expected round, outline or the end of the line"},
    {HEAD "plate q 3 3 size 1 1 density 1 bending 1 1 edge free outline\n" TAIL, 4,
     "found the end of the line, expected a share of the width"},
    {HEAD "plate q 3 3 size 1 1 density 1 bending 1 1 edge free outline 2\n" TAIL, 4,
     "found '2', expected a share of the width"},
    {HEAD "plate q 3 3 size 1 1 density 1 bending 1 1 edge free outline 0\n" TAIL, 4,
     "found an outline that no mass is inside of"},
    {HEAD "plate p 3 3 size 1 1 density 1 bending 1 1 edge free\n" TAIL, 4,
     "found 'p', declared in line 3 already"},
    {HEAD "membrane q 3 3 size 1 1 density 1 tension 0\n" TAIL, 4, "found '0', expected a tension"},
    {HEAD "brace p.2.2 p.3.4 mass 1 bending 1\n" TAIL, 4, "found a brace that does not lie"},
    {HEAD "brace p.2.2 a mass 1 bending 1\n" TAIL, 4, "found a brace that does not lie"},
    {HEAD "brace p.2.2 p.2.2 mass 1 bending 1\n" TAIL, 4, "found a brace that does not lie"},
    {HEAD "air h mass 1 area 1 volume 1 walls\n" TAIL, 4, "expected a plate or membrane"},
    {HEAD "air h mass 1 area 1 volume 1 walls p p\n" TAIL, 4, "found 'p', expected a plate or"},
    {HEAD "air h mass 1 area 1 volume 1 walls a\n" TAIL, 4, "found 'a', expected a plate or"},
    {HEAD "radiate a 1\n" TAIL, 4, "found 'a', expected a plate, membrane or air"},
    {HEAD "bridge a far\n" TAIL, 4, "found 'far', expected a weight"},
    {HEAD "loss 100 20\n" TAIL, 7, "found 100 Hz after 100 Hz, expected a higher one"},
    {HEAD "loss 100 0.5\n" TAIL, 4, "found '0.5', expected a Q"},
    {HEAD "above 100 density\n" TAIL, 4, "found the end of the line, expected a density"},
    {HEAD "above\n" TAIL, 4, "found the end of the line, expected a frequency"},
};

static void what_is_wrong_is_said(void** state) {
  (void)state;
  for (size_t i = 0; i < sizeof(refusals) / sizeof(refusals[0]); ++i) {
    ScenesRead read;
    char start[TEMPORARY_SIZE + 64];
    const char* const text = refusals[i].text;
    if (scenes_read_bytes(text, strlen(text), SCENE_FOR_BODY, &read)) {
      fail_msg("taken: %s", text);
    }
    (void)snprintf(start, sizeof(start), "%s:%u: found ", read.path, refusals[i].line);
    if (strncmp(read.error, start, strlen(start)) != 0 || !strstr(read.error, refusals[i].what) ||
        !strstr(read.error, ", expected ") || strchr(read.error, '\n')) {
      fail_msg("'%s' does not say '%s…%s' in one line", read.error, start, refusals[i].what);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_hinged_plate_has_its_closed_form),
      cmocka_unit_test(a_membrane_has_its_closed_form),
      cmocka_unit_test(round_sheets_come_near_to_theirs),
      cmocka_unit_test(a_clamped_plate_converges_to_its_own),
      cmocka_unit_test(free_plates_drift_turn_and_ring),
      cmocka_unit_test(braces_add_mass_and_moments),
      cmocka_unit_test(air_is_pressed_by_all_walls),
      cmocka_unit_test(an_outline_leaves_out_what_is_outside),
      cmocka_unit_test(what_is_wrong_is_said),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

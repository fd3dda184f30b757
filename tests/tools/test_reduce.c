/* Networks reduced to modes, against themselves stepped mass by mass, and what is made of them
 * while Hooke is built, against the same made now. */

#include "tools/bodies/reduce.h"

#include "core/analysis/shapes.h"
#include "core/bank/bank.h"
#include "core/bank/bodies.h"
#include "core/base/complex_of.h"
#include "core/base/maths.h"
#include "core/string/pole.h"
#include "tools/bodies/body_file.h"

#include "tests/support/oracle.h"
#include "tests/support/scenes.h"

#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

static const char* const NAMES[BODIES_COUNT] = {
#define NAME(name, file, text) [BODIES_##name] = file,
    BODIES_LIST(NAME)
#undef NAME
};

static bool path_of(int choice, const char* ending, char path[1024]) {
  const char* const source = getenv("HOOKE_SOURCE");
  (void)snprintf(path, 1024, "%s/presets/bodies/%s.%s", source ? source : ".", NAMES[choice],
                 ending);
  return !access(path, R_OK);
}

static Scene* read_scene(int choice) {
  char path[1024];
  char error[SCENE_ERROR_SIZE];
  if (!path_of(choice, "scene", path)) {
    return NULL;
  }
  Scene* const scene = scene_new(path, SCENE_FOR_BODY, error, sizeof(error));
  if (!scene) {
    fail_msg("%s", error);
  }
  return scene;
}

static double bridge_of(const Scene* scene, const double* x) {
  double sum = 0.0;
  for (size_t i = 0; i < scene->n_bridge; ++i) {
    sum += scene->bridge[i].gain * x[scene->bridge[i].point];
  }
  return sum;
}

static void push(const Scene* scene, double force) {
  for (size_t i = 0; i < scene->n_bridge; ++i) {
    scene->network->force[scene->bridge[i].point] = force * scene->bridge[i].gain;
  }
}

static double pull_of(const Shapes* shapes, const Scene* scene, uint32_t k) {
  double sum = 0.0;
  for (size_t i = 0; i < scene->n_bridge; ++i) {
    sum += scene->bridge[i].gain * shapes_at(shapes, k, scene->bridge[i].point);
  }
  return sum;
}

/* A blow on the bridge, and where it is then: the masses, stepped one by one, against all modes,
 * each a mass with the a and g that its analog eigenvalue has by the same scheme, which without
 * dampers is the same samples to rounding. */
static void masses_and_modes_are_the_same_samples(void** state) {
  (void)state;
  enum { FRAMES = 4000 };
  for (int i = BODIES_NONE + 1; i < BODIES_FILE; ++i) {
    Scene* const scene = read_scene(i);
    if (!scene) {
      continue;
    }
    Shapes shapes;
    const double rate_hz = scene->rate_hz;
    const double step_s = 1.0 / rate_hz;
    assert_int_equal(shapes_solve(scene->network, &shapes), STATUS_OK);
    double* const x = calloc(2 * (size_t)shapes.n, sizeof(double));
    assert_non_null(x);
    double* const u = x + shapes.n;
    double worst = 0.0;
    double largest = 0.0;
    for (int n = 0; n < FRAMES; ++n) {
      const double force = n == 0 ? rate_hz : 0.0;
      double sum = 0.0;
      push(scene, force);
      network_step(scene->network, step_s);
      for (uint32_t k = 0; k < shapes.n; ++k) {
        const Pole pole = pole_from_analog(rate_hz, shapes.omega[k], 0.0);
        const double shape = pull_of(&shapes, scene, k);
        u[k] += step_s * step_s * shape * force - pole.a * x[k];
        x[k] += u[k];
        sum += shape * x[k];
      }
      const double at = bridge_of(scene, scene->network->x);
      worst = fmax(worst, fabs(sum - at));
      largest = fmax(largest, fabs(at));
    }
    assert_within(NAMES[i], worst / largest, 1e-7);
    free(x);
    shapes_clear(&shapes);
    scene_free(scene);
  }
}

/* φᵀ M φ = 1 and φᵀ K φ = ω², none of them below 0, and Σ φ(i)² = 1/m_i at each mass: all of its
 * mass is in the modes. */
static void shapes_are_orthonormal_and_have_all_mass(void** state) {
  (void)state;
  double worst_product = 0.0;
  double worst_mass = 0.0;
  double worst_stiffness = 0.0;
  for (int i = BODIES_NONE + 1; i < BODIES_FILE; ++i) {
    Scene* const scene = read_scene(i);
    if (!scene) {
      continue;
    }
    Shapes shapes;
    Network* const network = scene->network;
    assert_int_equal(shapes_solve(network, &shapes), STATUS_OK);
    for (uint32_t p = 0; p < network->n_points; ++p) {
      double sum = 0.0;
      for (uint32_t k = 0; k < shapes.n && !network->is_ground[p]; ++k) {
        sum += shapes_at(&shapes, k, p) * shapes_at(&shapes, k, p) * network->mass_kg[p];
      }
      worst_mass = fmax(worst_mass, network->is_ground[p] ? 0.0 : fabs(sum - 1.0));
    }
    for (uint32_t k = 0; k < shapes.n; k += 7) {
      for (uint32_t j = 0; j <= k; j += 5) {
        double sum = 0.0;
        for (uint32_t p = 0; p < network->n_points; ++p) {
          sum += network->is_ground[p]
                     ? 0.0
                     : network->mass_kg[p] * shapes_at(&shapes, k, p) * shapes_at(&shapes, j, p);
        }
        worst_product = fmax(worst_product, fabs(sum - (j == k ? 1.0 : 0.0)));
      }
      /* The energy of the shape, spring by spring. */
      network_rest(network);
      for (uint32_t p = 0; p < network->n_points; ++p) {
        network->x[p] = shapes_at(&shapes, k, p);
      }
      assert_true(shapes.omega[k] > 2.0 * PI * 10.0);
      const double square = shapes.omega[k] * shapes.omega[k];
      worst_stiffness = fmax(worst_stiffness, fabs(2.0 * network_energy(network) / square - 1.0));
    }
    shapes_clear(&shapes);
    scene_free(scene);
  }
  assert_within("products", worst_product, 1e-11);
  assert_within("mass, relative", worst_mass, 1e-11);
  assert_within("stiffness, relative", worst_stiffness, 1e-8);
}

/* Σ l_k D/F with D = F/M − a X − g U, (z − 1) U = D and (z − 1) X = z U:
 *
 *     D/F = 1/M (z − 1)² / ((z − 1)² + g (z − 1) + a z). */
static double complex mass_at(Pole pole, double turn) {
  const double complex z = complex_of(cos(2.0 * PI * turn), sin(2.0 * PI * turn));
  const double complex w = z - 1.0;
  return w * w / (w * w + pole.g * w + pole.a * z);
}

/* The sum of modes, of which less is heard by how much higher than its Q a mass peaks that is
 * stepped. */
static double complex response_of(
    const Body* body, const Pole* poles, uint32_t n_modes, int side, double rate_hz, double turn) {
  double complex sum = 0.0;
  for (uint32_t k = 0; k < n_modes; ++k) {
    const BodyMode* const mode = &body->modes[k];
    const double half = PI * mode->f0_hz / rate_hz;
    const double peak = tan(half) / (half * sqrt(1.0 - poles[k].g));
    sum += mode->radiation[side] / (mode->mass_kg * peak) * mass_at(poles[k], turn);
  }
  return sum;
}

static double complex spectrum_at(const float* sound, uint32_t n_frames, double turn) {
  const double complex step = complex_of(cos(2.0 * PI * turn), -sin(2.0 * PI * turn));
  double complex turned = 1.0;
  double complex sum = 0.0;
  for (uint32_t n = 0; n < n_frames; ++n) {
    sum += (double)sound[n] * turned;
    turned *= step;
  }
  return sum;
}

static double db_of(double complex left, double complex right) {
  return 10.0 * log10(0.5 * (cabs(left) * cabs(left) + cabs(right) * cabs(right)));
}

/* A blow on each body's bank: its sound has the level of the sum of all modes at every seventh of
 * them below 0.4 of the rate, each of which has the pitch that its line says; and low ones the
 * level that they have in time that is not stepped. */
static void banks_sound_as_their_modes_say(void** state) {
  (void)state;
  enum { FRAMES = 1 << 16 };
  static const double rate_hz = 48000.0;
  static float sound[2][FRAMES];
  static float force[FRAMES];
  static Bank bank;
  for (int i = BODIES_NONE + 1; i < BODIES_FILE; ++i) {
    const Body* const body = bodies_shipped((BodiesChoice)i);
    static Pole poles[BODY_MAX_MODES];
    uint32_t n_modes = 0;
    double worst_cents = 0.0;
    double worst_db = 0.0;
    double worst_analog_db = 0.0;
    memset(sound, 0, sizeof(sound));
    force[0] = 1.0F;
    body_bank(body, (BodyShape){1.0, 1.0}, rate_hz, &bank);
    bank_run(&bank, force, FRAMES, sound[0], sound[1]);
    while (n_modes < body->n_modes && body->modes[n_modes].f0_hz < BODY_HIGHEST * rate_hz) {
      poles[n_modes] = (Pole){.a = bank.a[n_modes], .g = bank.g[n_modes]};
      ++n_modes;
    }
    assert_int_equal(n_modes, bank.n_added);
    for (uint32_t k = 0; k < n_modes && body->modes[k].f0_hz < 0.4 * rate_hz; k += 7) {
      const double hz = body->modes[k].f0_hz;
      const double turn = hz / rate_hz;
      double complex poles_of_mass[2];
      oracle_mass_poles(poles[k].a, poles[k].g, poles_of_mass);
      const double got = fabs(carg(poles_of_mass[0])) / (2.0 * PI) * rate_hz;
      const double db =
          db_of(spectrum_at(sound[0], FRAMES, turn), spectrum_at(sound[1], FRAMES, turn));
      const double said = db_of(response_of(body, poles, n_modes, 0, rate_hz, turn),
                                response_of(body, poles, n_modes, 1, rate_hz, turn));
      const double analog = 10.0 * log10(body_gain_square(body, (BodyShape){1.0, 1.0}, hz));
      worst_cents = fmax(worst_cents, fabs(1200.0 * log2(got / hz)));
      worst_db = fmax(worst_db, fabs(db - said));
      worst_analog_db = fmax(worst_analog_db, hz < 0.01 * rate_hz ? fabs(db - analog) : 0.0);
    }
    printf("%s\n", NAMES[i]);
    assert_within("cents", worst_cents, 1e-6);
    assert_within("dB", worst_db, 0.01);
    assert_within("dB, low, of what is not stepped", worst_analog_db, 0.2);
  }
}

/* What is shipped is what its file says today, to the digits that are written. */
static void shipped_bodies_are_their_files(void** state) {
  (void)state;
  const clock_t start = clock();
  for (int i = BODIES_NONE + 1; i < BODIES_FILE; ++i) {
    char path[1024];
    char error[BODY_FILE_ERROR_SIZE];
    static Body body;
    Reduction reduction;
    double worst = 0.0;
    if (!path_of(i, "scene", path)) {
      assert_true(path_of(i, "body", path));
    }
    if (!body_file_read(path, &body, &reduction, error, sizeof(error))) {
      fail_msg("%s", error);
    }
    const Body* const shipped = bodies_shipped((BodiesChoice)i);
    assert_int_equal(body.n_modes, shipped->n_modes);
    for (uint32_t k = 0; k < body.n_modes; ++k) {
      worst = fmax(worst, fabs(body.modes[k].f0_hz / shipped->modes[k].f0_hz - 1.0));
      worst = fmax(worst, fabs(body.modes[k].q / shipped->modes[k].q - 1.0));
    }
    printf("%s: %u masses, %u modes heard, %u kept, lost %.1f dB\n", NAMES[i], reduction.n_masses,
           reduction.n_heard, body.n_modes, 10.0 * log10(reduction.lost));
    assert_within("F and Q, relative", worst, 1e-9);
    assert_true(reduction.lost < 1e-3);
  }
  const double took_s = (double)(clock() - start) / CLOCKS_PER_SEC;
  printf("all in %.2f s\n", took_s);
  assert_true(took_s < 20.0);
}

/* Two modes of one frequency: strings pull at one turn of them, of mass M where they pull. */
static void modes_of_one_frequency_are_one(void** state) {
  (void)state;
  static const char text[] = "rate 48000\nmembrane m 9 9 size 0.3 0.3 density 0.3 tension 3000\n"
                             "bridge m.3.4 1\nradiate m 1\nloss 100 20\n";
  ScenesRead read;
  Scene* const scene = scenes_read_bytes(text, sizeof(text) - 1, SCENE_FOR_BODY, &read);
  assert_non_null(scene);
  BodyMode* modes = NULL;
  uint32_t n_modes = 0;
  double mobility = 0.0;
  assert_int_equal(reduce_modes(scene, &modes, &n_modes), STATUS_OK);
  assert_true(n_modes <= 45);
  for (uint32_t k = 0; k < n_modes; ++k) {
    assert_true(k == 0 || modes[k].f0_hz > modes[k - 1].f0_hz * (1.0 + 1e-9));
    mobility += 1.0 / modes[k].mass_kg;
  }
  /* f² ∝ sin² + sin², and the bridge at 3/10 and 4/10. */
  const double c = sqrt(3000.0 / 0.3);
  const double first = c / (PI * 0.03) * sqrt(2.0) * sin(PI / 20.0);
  const double shape = sin(0.3 * PI) * sin(0.4 * PI) * 2.0 / 10.0;
  const double mass_kg = 0.3 * 0.03 * 0.03;
  assert_within("F", fabs(modes[0].f0_hz / first - 1.0), 1e-10);
  assert_within("M", fabs(modes[0].mass_kg * shape * shape / mass_kg - 1.0), 1e-10);
  assert_true(mobility <= 1.0 / mass_kg * (1.0 + 1e-9));
  free(modes);
  scene_free(scene);
}

static const char BOX[] = "rate 48000\nplate t 3 3 size 0.1 0.1 density 5 bending 1e5 1e5 edge "
                          "clamped\nair a mass 0.001 area 0.005 volume 0.01 walls t\n";

/* Rigid walls: Helmholtz's resonator, S √(γ p/(V m)); with a damper its Q is √(k m)/Z beside the
 * law's. */
static void air_in_a_box_is_helmholtz_resonator(void** state) {
  (void)state;
  char text[512];
  ScenesRead read;
  (void)snprintf(text, sizeof(text),
                 "%sground g\ndamper a g 0.1\nbridge a 1\nradiate a 1\nloss 50 10\nloss 500 100\n",
                 BOX);
  Scene* const scene = scenes_read_bytes(text, strlen(text), SCENE_FOR_BODY, &read);
  assert_non_null(scene);
  BodyMode* modes = NULL;
  uint32_t n_modes = 0;
  assert_int_equal(reduce_modes(scene, &modes, &n_modes), STATUS_OK);
  const double omega = 0.005 * sqrt(1.4 * 101325.0 / (0.01 * 0.001));
  const double hz = omega / (2.0 * PI);
  const double q = 1.0 / (1.0 / (10.0 * hz / 50.0) + 0.1 / 0.001 / omega);
  /* The walls give way a little. */
  assert_within("F", fabs(modes[0].f0_hz / hz - 1.0), 1e-3);
  assert_within("Q", fabs(modes[0].q / q - 1.0), 1e-3);
  assert_within("M", fabs(modes[0].mass_kg / 0.001 - 1.0), 2e-3);
  free(modes);
  scene_free(scene);
}

static void what_is_not_heard_is_no_body(void** state) {
  (void)state;
  char text[512];
  Body body = {.n_modes = 7};
  ScenesRead read;
  /* A square that is symmetric, pulled at where it is not, and heard where it is: the first modes
   * only; and a mass by itself that nothing hears. */
  (void)snprintf(text, sizeof(text),
                 "%smass b 1\nground g\nspring b g 1e5\nbridge b 1\n"
                 "radiate a 1\nloss 50 10\n",
                 BOX);
  Scene* const scene = scenes_read_bytes(text, strlen(text), SCENE_FOR_BODY, &read);
  assert_non_null(scene);
  assert_int_equal(reduce_scene(scene, &body, NULL), STATUS_EMPTY);
  assert_int_equal(body.n_modes, 7);
  scene_free(scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(masses_and_modes_are_the_same_samples),
      cmocka_unit_test(shapes_are_orthonormal_and_have_all_mass),
      cmocka_unit_test(banks_sound_as_their_modes_say),
      cmocka_unit_test(shipped_bodies_are_their_files),
      cmocka_unit_test(modes_of_one_frequency_are_one),
      cmocka_unit_test(air_in_a_box_is_helmholtz_resonator),
      cmocka_unit_test(what_is_not_heard_is_no_body),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

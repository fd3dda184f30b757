/* Any scene has modes, or is refused for its numbers; what they say of it holds, and what is called
 * stable stays so when it is stepped. */
#include "core/analysis/modes.h"
#include "tests/fuzz/fuzz.h"
#include "tools/formats/scene.h"

#include <math.h>
#include <stdlib.h>

/* Dense matrices of more masses take longer, and find nothing new. */
enum { MOST_MASSES = 24, FEW = 3, MOST_LINKS = 200, STEPS = 500 };

/* Half of the largest step is clear of the edge, where what swings grows with time. */
static const double MOST_GROWTH = 1e3;

static uint32_t count_free(const Network* network) {
  uint32_t n_free = 0;
  uint32_t* const part = malloc(network->n_points * sizeof(uint32_t));
  FUZZ_CLAIM(part && !network_find_free(network, false, part, &n_free));
  free(part);
  return n_free;
}

static void claim_modes(const Network* network, const Modes* modes) {
  uint32_t n_free = 0;
  double last = 0.0;
  for (uint32_t k = 0; k < modes->n_modes; ++k) {
    const Mode* const mode = &modes->mode[k];
    const double size = sqrt(cabs(mode->analog[0])) * sqrt(cabs(mode->analog[1]));
    FUZZ_CLAIM(isfinite(size) && size >= last * (1.0 - 1e-6));
    FUZZ_CLAIM(mode->is_free == (mode->analog[0] == 0.0));
    FUZZ_CLAIM(mode->tone.f0_hz >= 0.0 && mode->tone.f0_hz <= 0.5 * modes->rate_hz * (1.0 + 1e-9));
    FUZZ_CLAIM((mode->region == POLE_UNSTABLE) <= !modes->is_stable);
    FUZZ_CLAIM(!modes->is_stable || mode->radius <= 1.0 + 1e-6);
    last = size;
    n_free += mode->is_free ? 1 : 0;
  }
  FUZZ_CLAIM(n_free == fmin(count_free(network), modes->n_modes));
}

static Status solve(const Scene* scene, uint32_t n_wanted) {
  Modes* modes = NULL;
  const Status status = modes_solve(scene->network, scene->rate_hz, n_wanted, &modes);
  FUZZ_CLAIM(!status || status == STATUS_ILL_SCALED || status == STATUS_NO_CONVERGENCE);
  if (!status) {
    FUZZ_CLAIM(
        modes->n_modes ==
        (n_wanted && n_wanted < scene->network->n_masses ? n_wanted : scene->network->n_masses));
    claim_modes(scene->network, modes);
  }
  modes_free(modes);
  return status;
}

/* From any velocities. */
static void claim_stable(Network* network) {
  double step_s = 0.0;
  if (modes_largest_step(network, NULL, &step_s) || !(step_s > 1e-100 && step_s < 1e100)) {
    return;
  }
  network_rest(network);
  for (uint32_t p = 0; p < network->n_points; ++p) {
    network->v[p] = network->is_ground[p] ? 0.0 : cos(3.0 * p) / sqrt(network->mass_kg[p]);
  }
  const double before = network_energy(network);
  for (int i = 0; i < STEPS; ++i) {
    network_step(network, 0.5 * step_s);
  }
  FUZZ_CLAIM(network_energy(network) <= MOST_GROWTH * before);
}

void fuzz_one(const uint8_t* bytes, size_t n_bytes) {
  char* const error = malloc(SCENE_ERROR_SIZE);
  const char* const path = fuzz_file(bytes, n_bytes);
  Scene* const scene = scene_new(path, SCENE_FOR_MODES, error, SCENE_ERROR_SIZE);
  if (scene && scene->network->n_masses <= MOST_MASSES &&
      scene->network->springs.n + scene->network->dampers.n + scene->network->levers.n_terms <=
          MOST_LINKS) {
    (void)solve(scene, 0);
    (void)solve(scene, FEW);
    claim_stable(scene->network);
  }
  scene_free(scene);
  free(error);
}

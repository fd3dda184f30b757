#include "tools/report/figure_scheme.h"

#include "core/analysis/network.h"

#include <stddef.h>

double figure_scheme_energy(Pole pole, FigureState state) {
  return 0.5 * state.u * state.u + 0.5 * pole.a * state.x * state.x;
}

static Status hang(Network* network, Pole pole, uint32_t* mass) {
  uint32_t ground = 0;
  Status status = network_add_mass(network, 1.0, mass);
  status = status ? status : network_add_ground(network, &ground);
  status = status ? status : network_add_spring(network, *mass, ground, pole.a);
  status = status ? status : network_add_damper(network, *mass, ground, pole.g);
  status = status ? status : network_check(network, NULL);
  return status ? status : network_prepare(network);
}

Status figure_scheme_play(
    NetworkScheme scheme, Pole pole, FigureState start, uint32_t n_states, FigureState* out) {
  uint32_t mass = 0;
  Network* const network = network_new();
  Status status = network ? hang(network, pole, &mass) : STATUS_NO_MEMORY;
  if (status == STATUS_OK) {
    network->x[mass] = start.x;
    network->v[mass] = start.u;
  }
  for (uint32_t n = 0; status == STATUS_OK && n < n_states; ++n) {
    out[n] = (FigureState){.x = network->x[mass], .u = network->v[mass]};
    status = network_step_by(network, scheme, 1.0);
  }
  network_free(network);
  return status;
}

Status figure_scheme_pluck(uint32_t n_masses, Pole segment, uint32_t n_frames, double* x) {
  uint32_t first = 0;
  Network* const network = network_new();
  if (!network) {
    return STATUS_NO_MEMORY;
  }
  Status status = network_add_string(network, n_masses, 1.0, segment.a, segment.g, &first);
  status = status ? status : network_check(network, NULL);
  if (status == STATUS_OK) {
    network->x[first] = 1.0;
    for (uint32_t n = 0; n < n_frames; ++n) {
      x[n] = network->x[first];
      network_step(network, 1.0);
    }
  }
  network_free(network);
  return status;
}

#include "tests/support/energy.h"

/* y = L x */
static void bend(uint32_t n, const double* x, double* y) {
  for (uint32_t i = 0; i < n; ++i) {
    const double left = i > 0 ? x[i - 1] : 0.0;
    const double right = i + 1 < n ? x[i + 1] : 0.0;
    y[i] = 2.0 * x[i] - left - right;
  }
}

/* y = K x = L (k1 x + L (k2 x + L k3 x)) */
static void pull(StringCoefs coefs, uint32_t n, const double* x, double* y) {
  double sum[CHAIN_MAX_MASSES];
  const double k[] = {coefs.k2, coefs.k1};
  for (uint32_t i = 0; i < n; ++i) {
    sum[i] = coefs.k3 * x[i];
  }
  for (int order = 0; order < 2; ++order) {
    bend(n, sum, y);
    for (uint32_t i = 0; i < n; ++i) {
      sum[i] = y[i] + k[order] * x[i];
    }
  }
  bend(n, sum, y);
}

void motion_read(const Chain* chain, Motion* motion) {
  motion->n = chain->n_masses;
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    motion->x[i] = (double)chain_position(chain, i);
    motion->u[i] = (double)chain_velocity(chain, i);
  }
}

double motion_energy(const Motion* motion, StringCoefs coefs) {
  double force[CHAIN_MAX_MASSES];
  double drag[CHAIN_MAX_MASSES];
  double twice = 0.0;
  pull(coefs, motion->n, motion->x, force);
  bend(motion->n, motion->u, drag);
  for (uint32_t i = 0; i < motion->n; ++i) {
    const double u = motion->u[i];
    twice += u * (u - 0.5 * (coefs.z0 * u + coefs.z1 * drag[i])) + force[i] * (motion->x[i] - u);
  }
  return 0.5 * twice;
}

void motion_step(Motion* motion, StringCoefs coefs) {
  double force[CHAIN_MAX_MASSES];
  double drag[CHAIN_MAX_MASSES];
  pull(coefs, motion->n, motion->x, force);
  bend(motion->n, motion->u, drag);
  for (uint32_t i = 0; i < motion->n; ++i) {
    motion->u[i] -= force[i] + coefs.z0 * motion->u[i] + coefs.z1 * drag[i];
    motion->x[i] += motion->u[i];
  }
}

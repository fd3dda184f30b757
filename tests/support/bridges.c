#include "tests/support/bridges.h"

#include "tests/support/oracle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

size_t bridges_order(const Strung* strung) {
  size_t order = 1;
  for (uint32_t j = 0; j < strung->n_strings; ++j) {
    order += strung->n_masses[j];
  }
  return order;
}

/* Put a string's n × n matrix on the diagonal of the whole's. */
static void
put(double* whole, size_t order, size_t at, const double* part, size_t n, double weight) {
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < n; ++j) {
      whole[(at + i) + (at + j) * order] = weight * part[i + j * n];
    }
  }
}

void bridges_forces(const Strung* strung, double* stiffness, double* damping, double* mass) {
  static double part_k[BRIDGES_MASSES * BRIDGES_MASSES];
  static double part_z[BRIDGES_MASSES * BRIDGES_MASSES];
  const size_t order = bridges_order(strung);
  const size_t last = order - 1;
  size_t at = 0;
  memset(stiffness, 0, order * order * sizeof(double));
  memset(damping, 0, order * order * sizeof(double));
  stiffness[last + last * order] = strung->bridge.bare.a;
  damping[last + last * order] = strung->bridge.bare.g;
  mass[last] = 1.0;
  for (uint32_t j = 0; j < strung->n_strings; ++j) {
    const BridgeTie* const tie = &strung->ties[j];
    const uint32_t n = strung->n_masses[j];
    oracle_forces(strung->coefs[j], n, part_k, part_z);
    put(stiffness, order, at, part_k, n, tie->weight);
    put(damping, order, at, part_z, n, tie->weight);
    for (size_t i = 0; i < n; ++i) {
      mass[at + i] = tie->weight;
    }
    at += n;
    stiffness[(at - 1) + last * order] = -tie->weight * tie->pull;
    stiffness[last + (at - 1) * order] = -tie->weight * tie->pull;
    stiffness[last + last * order] += tie->spring;
  }
}

void bridges_poles(const Strung* strung, double complex* poles) {
  const size_t n = bridges_order(strung);
  const size_t order = 2 * n;
  double* const k = malloc(n * n * sizeof(double));
  double* const z = malloc(n * n * sizeof(double));
  double* const mass = malloc(n * sizeof(double));
  double* const step = calloc(order * order, sizeof(double));
  bridges_forces(strung, k, z, mass);
  for (size_t j = 0; j < n; ++j) {
    for (size_t i = 0; i < n; ++i) {
      const double one = i == j ? 1.0 : 0.0;
      const double of_x = -k[i + j * n] / mass[i];
      const double of_u = one - z[i + j * n] / mass[i];
      step[i + j * order] = one + of_x;
      step[(n + i) + j * order] = of_x;
      step[i + (n + j) * order] = of_u;
      step[(n + i) + (n + j) * order] = of_u;
    }
  }
  oracle_eigenvalues(order, step, poles);
  free(k);
  free(z);
  free(mass);
  free(step);
}

double bridges_complement(size_t order, double* matrix) {
  for (size_t p = 0; p + 1 < order; ++p) {
    const double pivot = matrix[p + p * order];
    if (!(pivot > 0.0)) {
      return (double)NAN;
    }
    for (size_t j = p + 1; j < order; ++j) {
      const double share = matrix[p + j * order] / pivot;
      for (size_t i = p + 1; i < order; ++i) {
        matrix[i + j * order] -= share * matrix[i + p * order];
      }
    }
  }
  return matrix[order * order - 1];
}

static double last_of(const Strung* strung, uint32_t j, double step_back) {
  const uint32_t i = strung->n_masses[j] - 1;
  return strung->motions[j].x[i] - step_back * strung->motions[j].u[i];
}

double bridges_energy(const Strung* strung) {
  const Bridge* const bridge = &strung->bridge;
  const double y = bridge->y;
  const double y_back = y - bridge->w;
  double spring = bridge->bare.a;
  double sum = 0.0;
  for (uint32_t j = 0; j < strung->n_strings; ++j) {
    const BridgeTie* const tie = &strung->ties[j];
    const double x = last_of(strung, j, 0.0);
    const double x_back = last_of(strung, j, 1.0);
    spring += tie->spring;
    sum += tie->weight * motion_energy(&strung->motions[j], strung->coefs[j]);
    sum -= 0.5 * tie->weight * tie->pull * (x * y_back + y * x_back);
  }
  return sum + 0.5 * (1.0 - 0.5 * bridge->bare.g) * bridge->w * bridge->w +
         0.5 * spring * y * y_back;
}

void bridges_step(Strung* strung) {
  double force = 0.0;
  double spring = 0.0;
  for (uint32_t j = 0; j < strung->n_strings; ++j) {
    const BridgeTie* const tie = &strung->ties[j];
    Motion* const motion = &strung->motions[j];
    const uint32_t last = strung->n_masses[j] - 1;
    force += tie->weight * tie->pull * motion->x[last];
    spring += tie->spring;
    motion_step(motion, strung->coefs[j]);
    motion->u[last] += tie->pull * strung->bridge.y;
    motion->x[last] += tie->pull * strung->bridge.y;
  }
  bridge_step(&strung->bridge, force, spring);
}

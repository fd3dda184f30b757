#include "tests/support/bridges.h"

#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

Body bridges_body(Random* random, uint32_t n_modes, double rate_hz) {
  Body body = {.n_modes = n_modes};
  for (uint32_t i = 0; i < n_modes; ++i) {
    body.modes[i] = (BodyMode){
        .f0_hz =
            random_log_between(random, fmin(50.0, 0.1 * rate_hz), fmin(4000.0, 0.44 * rate_hz)),
        .q = random_log_between(random, 5.0, 200.0),
        .mass_kg = random_log_between(random, 0.02, 5.0),
    };
  }
  return body;
}

void bridges_draw(Random* random, double rate_hz, Bridge* bridge) {
  if (random_below(random, 2)) {
    bridge_init(bridge, rate_hz);
  } else {
    const uint32_t n_modes = 1 + random_below(random, BRIDGES_MODES);
    const Body body = bridges_body(random, n_modes, rate_hz);
    bridge_init_on(bridge, &body, (BodyShape){1.0, 1.0}, rate_hz);
    assert_int_equal(bridge->bank.n_added, n_modes);
  }
}

size_t bridges_order(const Strung* strung) {
  size_t order = strung->bridge.bank.n_added;
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
  const Bank* const bank = &strung->bridge.bank;
  const size_t order = bridges_order(strung);
  const size_t first = order - bank->n_added;
  double spring = 0.0;
  size_t at = 0;
  memset(stiffness, 0, order * order * sizeof(double));
  memset(damping, 0, order * order * sizeof(double));
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
    for (size_t i = first; i < order; ++i) {
      stiffness[(at - 1) + i * order] = -tie->weight * tie->pull;
      stiffness[i + (at - 1) * order] = -tie->weight * tie->pull;
    }
    spring += tie->spring;
  }
  for (size_t i = first; i < order; ++i) {
    mass[i] = 1.0 / bank->in[i - first];
    for (size_t j = first; j < order; ++j) {
      stiffness[i + j * order] = spring;
    }
    stiffness[i + i * order] += mass[i] * bank->a[i - first];
    damping[i + i * order] = mass[i] * bank->g[i - first];
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

bool bridges_eliminate(size_t order, size_t n_last, double* matrix) {
  for (size_t p = 0; p + n_last < order; ++p) {
    const double pivot = matrix[p + p * order];
    if (!(pivot > 0.0)) {
      return false;
    }
    for (size_t j = p + 1; j < order; ++j) {
      const double share = matrix[p + j * order] / pivot;
      for (size_t i = p + 1; i < order; ++i) {
        matrix[i + j * order] -= share * matrix[i + p * order];
      }
    }
  }
  return true;
}

void bridges_top(size_t order, double* stiffness, const double* damping, const double* mass) {
  for (size_t i = 0; i < order * order; ++i) {
    stiffness[i] = -stiffness[i] - 2.0 * damping[i];
  }
  for (size_t i = 0; i < order; ++i) {
    stiffness[i + i * order] += 4.0 * mass[i];
  }
}

static double last_of(const Strung* strung, uint32_t j, double step_back) {
  const uint32_t i = strung->n_masses[j] - 1;
  return strung->motions[j].x[i] - step_back * strung->motions[j].u[i];
}

/* H of the body alone; and where the bridge was a step ago. */
static double energy_of_body(const Bank* bank, double* y_back) {
  double sum = 0.0;
  *y_back = 0.0;
  for (uint32_t i = 0; i < bank->n_added; ++i) {
    const double back = bank->x[i] - bank->u[i];
    sum += 0.5 / bank->in[i] *
           ((1.0 - 0.5 * bank->g[i]) * bank->u[i] * bank->u[i] + bank->a[i] * bank->x[i] * back);
    *y_back += back;
  }
  return sum;
}

double bridges_energy(const Strung* strung) {
  const double y = strung->bridge.y;
  double y_back = 0.0;
  double sum = energy_of_body(&strung->bridge.bank, &y_back);
  for (uint32_t j = 0; j < strung->n_strings; ++j) {
    const BridgeTie* const tie = &strung->ties[j];
    const double x = last_of(strung, j, 0.0);
    const double x_back = last_of(strung, j, 1.0);
    sum += tie->weight * motion_energy(&strung->motions[j], strung->coefs[j]);
    sum -= 0.5 * tie->weight * tie->pull * (x * y_back + y * x_back);
    sum += 0.5 * tie->spring * y * y_back;
  }
  return sum;
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

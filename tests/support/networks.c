#include "tests/support/networks.h"

#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void check(Network* network) {
  assert_int_equal(network_check(network, NULL), STATUS_OK);
}

static double decades(Random* random, double n_decades) {
  return pow(10.0, random_between(random, -n_decades, n_decades));
}

static void add_spring(Network* network, uint32_t a, uint32_t b, double stiffness) {
  assert_int_equal(network_add_spring(network, a, b, stiffness), STATUS_OK);
}

/* Critical for the two ends' own stiffness, times what chance gives. */
static void
add_damper(Network* network, Random* random, const NetworkKind* kind, uint32_t a, uint32_t b) {
  const double mass_kg = fmin(network->mass_kg[a], network->mass_kg[b]);
  double stiffness = 0.0;
  for (uint32_t s = 0; s < network->springs.n; ++s) {
    const NetworkLink spring = network->springs.link[s];
    if (spring.from == a || spring.to == a) {
      stiffness += spring.value;
    }
  }
  const double damping = 2.0 * sqrt(stiffness * mass_kg) * decades(random, kind->damping_decades);
  assert_int_equal(network_add_damper(network, a, b, damping), STATUS_OK);
}

/* One part of `n` masses: a tree, some loops, and the ground. */
static void add_part(Network* network, Random* random, const NetworkKind* kind, uint32_t n) {
  uint32_t ground = 0;
  uint32_t first = 0;
  assert_int_equal(network_add_ground(network, &ground), STATUS_OK);
  for (uint32_t i = 0; i < n; ++i) {
    uint32_t point = 0;
    assert_int_equal(network_add_mass(network, decades(random, kind->mass_decades), &point),
                     STATUS_OK);
    first = i == 0 ? point : first;
    const uint32_t other = i == 0 ? ground : first + random_below(random, i);
    add_spring(network, point, other, decades(random, kind->stiffness_decades));
  }
  for (uint32_t more = random_below(random, n + 1); more > 0; --more) {
    const uint32_t a = first + random_below(random, n);
    const uint32_t b = random_below(random, 4) ? first + random_below(random, n) : ground;
    if (a != b) {
      add_spring(network, a, b, decades(random, kind->stiffness_decades));
    }
  }
  for (uint32_t more = kind->is_damped ? random_below(random, 2 * n + 1) : 0; more > 0; --more) {
    const uint32_t a = first + random_below(random, n);
    const uint32_t b = random_below(random, 3) ? first + random_below(random, n) : ground;
    if (a != b) {
      add_damper(network, random, kind, a, b);
    }
  }
}

Network* networks_random(Random* random, const NetworkKind* kind) {
  Network* const network = network_new();
  assert_non_null(network);
  uint32_t left = 1 + random_below(random, kind->most_masses);
  for (uint32_t n_parts = 1 + random_below(random, 4); left > 0; --n_parts) {
    const uint32_t n = n_parts > 1 ? 1 + random_below(random, left) : left;
    add_part(network, random, kind, n);
    left -= n;
  }
  check(network);
  return network;
}

void networks_add_levers(Network* network, Random* random, uint32_t n) {
  for (; n > 0; --n) {
    NetworkTerm term[5];
    uint32_t n_terms = 0;
    for (uint32_t most = 2 + random_below(random, 4); most > 0; --most) {
      const uint32_t point = random_below(random, network->n_points);
      bool is_new = true;
      for (uint32_t i = 0; i < n_terms; ++i) {
        is_new &= term[i].point != point;
      }
      if (is_new) {
        term[n_terms++] = (NetworkTerm){point, random_between(random, -2.0, 2.0)};
      }
    }
    assert_int_equal(network_add_lever(network, decades(random, 1.0), n_terms, term), STATUS_OK);
  }
  check(network);
}

Network* networks_mass(double mass_kg, double stiffness, double damping) {
  Network* const network = network_new();
  assert_non_null(network);
  assert_int_equal(network_add_mass(network, mass_kg, NULL), STATUS_OK);
  assert_int_equal(network_add_ground(network, NULL), STATUS_OK);
  add_spring(network, 0, 1, stiffness);
  assert_int_equal(network_add_damper(network, 0, 1, damping), STATUS_OK);
  check(network);
  return network;
}

Network* networks_string(uint32_t n, double mass_kg, double stiffness, double damping) {
  Network* const network = network_new();
  assert_non_null(network);
  assert_int_equal(network_add_string(network, n, mass_kg, stiffness, damping, NULL), STATUS_OK);
  check(network);
  return network;
}

bool networks_is_long(void) {
  return getenv("HOOKE_TEST_LONG");
}

void networks_masses(const Network* network, uint32_t* point) {
  for (uint32_t p = 0; p < network->n_points; ++p) {
    if (!network->is_ground[p]) {
      *point++ = p;
    }
  }
}

void networks_get(const Network* network, double* state) {
  for (uint32_t p = 0; p < network->n_points; ++p) {
    if (!network->is_ground[p]) {
      state[0] = network->x[p];
      state[network->n_masses] = network->v[p];
      ++state;
    }
  }
}

void networks_set(Network* network, const double* state) {
  for (uint32_t p = 0; p < network->n_points; ++p) {
    if (!network->is_ground[p]) {
      network->x[p] = state[0];
      network->v[p] = state[network->n_masses];
      ++state;
    }
  }
}

void networks_step_matrix(Network* network, double step_s, double* matrix) {
  const size_t order = 2 * (size_t)network->n_masses;
  double* const unit = networks_zeros(order);
  for (size_t j = 0; j < order; ++j) {
    unit[j] = 1.0;
    networks_set(network, unit);
    network_step(network, step_s);
    networks_get(network, matrix + j * order);
    unit[j] = 0.0;
  }
  network_rest(network);
  free(unit);
}

void networks_state_matrix(const Network* network, double* matrix) {
  const size_t n = network->n_masses;
  const size_t order = 2 * n;
  size_t* const row = calloc(network->n_points, sizeof(size_t));
  assert_non_null(row);
  memset(matrix, 0, order * order * sizeof(double));
  size_t next = 0;
  for (uint32_t p = 0; p < network->n_points; ++p) {
    row[p] = network->is_ground[p] ? n : next++;
  }
  for (size_t i = 0; i < n; ++i) {
    matrix[i + (n + i) * order] = 1.0;
  }
  for (int kind = 0; kind < 2; ++kind) {
    const NetworkLinks* const links = kind ? &network->dampers : &network->springs;
    double* const block = matrix + (kind ? n * order : 0);
    for (uint32_t l = 0; l < links->n; ++l) {
      const uint32_t end[2] = {links->link[l].from, links->link[l].to};
      for (int e = 0; e < 2; ++e) {
        const size_t i = row[end[e]];
        const size_t j = row[end[1 - e]];
        if (i < n) {
          block[n + i + i * order] -= links->link[l].value / network->mass_kg[end[e]];
        }
        if (i < n && j < n) {
          block[n + i + j * order] += links->link[l].value / network->mass_kg[end[e]];
        }
      }
    }
  }
  for (uint32_t l = 0; l < network->levers.n; ++l) {
    const NetworkLever lever = network->levers.lever[l];
    for (uint32_t a = 0; a < lever.n_terms; ++a) {
      for (uint32_t b = 0; b < lever.n_terms; ++b) {
        const NetworkTerm from = network->levers.term[lever.first + a];
        const NetworkTerm to = network->levers.term[lever.first + b];
        if (row[from.point] < n && row[to.point] < n) {
          matrix[n + row[from.point] + row[to.point] * order] -=
              lever.stiffness * from.weight * to.weight / network->mass_kg[from.point];
        }
      }
    }
  }
  free(row);
}

void networks_multiply(size_t order, const double* a, const double* b, double* product) {
  for (size_t j = 0; j < order; ++j) {
    networks_apply(order, a, b + j * order, product + j * order);
  }
}

void networks_apply(size_t order, const double* a, const double* x, double* y) {
  memset(y, 0, order * sizeof(double));
  for (size_t j = 0; j < order; ++j) {
    for (size_t i = 0; i < order; ++i) {
      y[i] += a[i + j * order] * x[j];
    }
  }
}

void networks_exponential(size_t order, const double* a, double t, double* result) {
  const size_t size = order * order;
  double* const scaled = networks_zeros(3 * size);
  double* const term = scaled + size;
  double* const next = scaled + 2 * size;
  double norm = 0.0;
  for (size_t i = 0; i < size; ++i) {
    norm += fabs(a[i] * t);
  }
  const int n_squarings = norm > 0.5 ? (int)ceil(log2(norm)) + 1 : 0;
  for (size_t i = 0; i < size; ++i) {
    scaled[i] = ldexp(a[i] * t, -n_squarings);
    term[i] = result[i] = i % (order + 1) == 0 ? 1.0 : 0.0;
  }
  for (int k = 1; k < 20; ++k) {
    networks_multiply(order, scaled, term, next);
    for (size_t i = 0; i < size; ++i) {
      term[i] = next[i] / k;
      result[i] += term[i];
    }
  }
  for (int s = 0; s < n_squarings; ++s) {
    networks_multiply(order, result, result, next);
    memcpy(result, next, size * sizeof(double));
  }
  free(scaled);
}

double networks_spectral_radius(Network* network, double step_s) {
  const size_t order = 2 * (size_t)network->n_masses;
  double* const matrix = networks_zeros(order * order);
  double complex* const values = calloc(order, sizeof(double complex));
  assert_non_null(values);
  networks_step_matrix(network, step_s, matrix);
  oracle_eigenvalues(order, matrix, values);
  double radius = 0.0;
  for (size_t k = 0; k < order; ++k) {
    radius = fmax(radius, cabs(values[k]));
  }
  free(matrix);
  free(values);
  return radius;
}

double* networks_zeros(size_t n) {
  double* const values = calloc(n, sizeof(double));
  assert_non_null(values);
  return values;
}

#include "core/analysis/network_schemes.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Vectors of n_points in the working space. */
enum { N_VECTORS = 3 };

/* Conjugate gradients end in as many rounds as there are masses but for rounding; allow for that.
 */
enum { ROUNDS_PER_MASS = 4, MORE_ROUNDS = 100 };

/* The residual, of the right side, which rounding does not let fall further. */
static const double LEAST_RESIDUAL = 4.0 * DBL_EPSILON;

/* The residual at which a step is no step any more. */
static const double MOST_RESIDUAL = 1e-12;

/* Add to `sum` scale · L y, where L is the matrix of the links. */
static void add_links(const NetworkLinks* links, double scale, const double* y, double* sum) {
  for (uint32_t l = 0; l < links->n; ++l) {
    const NetworkLink link = links->link[l];
    const double pull = scale * link.value * (y[link.from] - y[link.to]);
    sum[link.from] += pull;
    sum[link.to] -= pull;
  }
}

static void add_levers(const Network* network, double scale, const double* y, double* sum) {
  for (uint32_t l = 0; l < network->levers.n; ++l) {
    const NetworkLever lever = network->levers.lever[l];
    const NetworkTerm* const term = network->levers.term + lever.first;
    const double pull = scale * lever.stiffness * network_stretch(network, l, y);
    for (uint32_t i = 0; i < lever.n_terms; ++i) {
      sum[term[i].point] += term[i].weight * pull;
    }
  }
}

static void sum_forces(const Network* network) {
  memcpy(network->sum, network->force, network->n_points * sizeof(double));
  add_links(&network->springs, -1.0, network->x, network->sum);
  add_levers(network, -1.0, network->x, network->sum);
}

static void drift(const Network* network, double step_s) {
  for (uint32_t p = 0; p < network->n_points; ++p) {
    network->x[p] += step_s * network->v[p];
  }
}

static void kick(const Network* network, double step_s) {
  for (uint32_t p = 0; p < network->n_points; ++p) {
    if (!network->is_ground[p]) {
      network->v[p] += step_s * network->sum[p] / network->mass_kg[p];
    }
  }
}

static void step_forward(const Network* network, double step_s) {
  sum_forces(network);
  add_links(&network->dampers, -1.0, network->v, network->sum);
  drift(network, step_s);
  kick(network, step_s);
}

/* y = (M + h Z + h² K) v; nothing where grounded. */
static void multiply(const Network* network, double step_s, const double* v, double* y) {
  for (uint32_t p = 0; p < network->n_points; ++p) {
    y[p] = network->is_ground[p] ? 0.0 : network->mass_kg[p] * v[p];
  }
  add_links(&network->springs, step_s * step_s, v, y);
  add_levers(network, step_s * step_s, v, y);
  add_links(&network->dampers, step_s, v, y);
  for (uint32_t p = 0; p < network->n_points; ++p) {
    y[p] = network->is_ground[p] ? 0.0 : y[p];
  }
}

/* rᵀ D⁻¹ r by the inverse diagonal. */
static double weigh(const Network* network, const double* inverse, const double* r) {
  double sum = 0.0;
  for (uint32_t p = 0; p < network->n_points; ++p) {
    sum += network->is_ground[p] ? 0.0 : inverse[p] * r[p] * r[p];
  }
  return sum;
}

/* 1/diag(M + h Z + h² K), which evens out unlike masses. */
static void invert_diagonal(const Network* network, double step_s, double* inverse) {
  for (uint32_t p = 0; p < network->n_points; ++p) {
    inverse[p] = network->is_ground[p] ? 1.0 : network->mass_kg[p];
  }
  for (uint32_t s = 0; s < network->springs.n; ++s) {
    const NetworkLink spring = network->springs.link[s];
    inverse[spring.from] += step_s * step_s * spring.value;
    inverse[spring.to] += step_s * step_s * spring.value;
  }
  for (uint32_t d = 0; d < network->dampers.n; ++d) {
    const NetworkLink damper = network->dampers.link[d];
    inverse[damper.from] += step_s * damper.value;
    inverse[damper.to] += step_s * damper.value;
  }
  for (uint32_t l = 0; l < network->levers.n; ++l) {
    const NetworkLever lever = network->levers.lever[l];
    const NetworkTerm* const term = network->levers.term + lever.first;
    for (uint32_t i = 0; i < lever.n_terms; ++i) {
      const double w = term[i].weight;
      inverse[term[i].point] += step_s * step_s * lever.stiffness * w * w;
    }
  }
  for (uint32_t p = 0; p < network->n_points; ++p) {
    inverse[p] = 1.0 / inverse[p];
  }
}

/* One round of conjugate gradients on v; the new weight of the residual. */
static double improve(const Network* network,
                      double step_s,
                      double weight,
                      double* direction,
                      const double* inverse) {
  double* const r = network->sum;
  double* const image = network->space + 2 * (size_t)network->n_points;
  double curvature = 0.0;
  multiply(network, step_s, direction, image);
  for (uint32_t p = 0; p < network->n_points; ++p) {
    curvature += direction[p] * image[p];
  }
  for (uint32_t p = 0; p < network->n_points; ++p) {
    network->v[p] += weight / curvature * direction[p];
    r[p] -= weight / curvature * image[p];
  }
  const double new_weight = weigh(network, inverse, r);
  for (uint32_t p = 0; p < network->n_points; ++p) {
    const double steepest = network->is_ground[p] ? 0.0 : inverse[p] * r[p];
    direction[p] = steepest + new_weight / weight * direction[p];
  }
  return new_weight;
}

static Status step_backward(const Network* network, double step_s) {
  const uint32_t n = network->n_points;
  double* const direction = network->space;
  double* const inverse = network->space + n;
  double* const image = network->space + 2 * (size_t)n;
  double* const r = network->sum;
  invert_diagonal(network, step_s, inverse);
  /* From the old v: the residual of M v + h F is h (F − Z v − h K v). */
  sum_forces(network);
  multiply(network, step_s, network->v, image);
  for (uint32_t p = 0; p < n; ++p) {
    const double momentum = network->is_ground[p] ? 0.0 : network->mass_kg[p] * network->v[p];
    r[p] = network->is_ground[p] ? 0.0 : momentum + step_s * r[p];
  }
  const double whole = weigh(network, inverse, r);
  for (uint32_t p = 0; p < n; ++p) {
    r[p] -= image[p];
    direction[p] = network->is_ground[p] ? 0.0 : inverse[p] * r[p];
  }
  double weight = weigh(network, inverse, r);
  const uint64_t most = (uint64_t)ROUNDS_PER_MASS * network->n_masses + MORE_ROUNDS;
  for (uint64_t round = 0; round < most && weight > LEAST_RESIDUAL * LEAST_RESIDUAL * whole;
       ++round) {
    weight = improve(network, step_s, weight, direction, inverse);
  }
  drift(network, step_s);
  return weight <= MOST_RESIDUAL * MOST_RESIDUAL * whole ? STATUS_OK : STATUS_NO_CONVERGENCE;
}

/* What one damper alone does in a time: its ends' velocities approach each other. */
static void relax(const Network* network, uint32_t d, double time_s) {
  const NetworkLink damper = network->dampers.link[d];
  const double for_from =
      network->is_ground[damper.from] ? 0.0 : 1.0 / network->mass_kg[damper.from];
  const double for_to = network->is_ground[damper.to] ? 0.0 : 1.0 / network->mass_kg[damper.to];
  const double ease = for_from + for_to;
  if (ease > 0.0) {
    const double apart = network->v[damper.to] - network->v[damper.from];
    const double lost = -expm1(-damper.value * ease * time_s) / ease * apart;
    network->v[damper.from] += for_from * lost;
    network->v[damper.to] -= for_to * lost;
  }
}

static void step_leapfrog(const Network* network, double step_s) {
  const double half_s = 0.5 * step_s;
  for (uint32_t d = 0; d < network->dampers.n; ++d) {
    relax(network, d, half_s);
  }
  sum_forces(network);
  kick(network, half_s);
  drift(network, step_s);
  sum_forces(network);
  kick(network, half_s);
  for (uint32_t d = network->dampers.n; d > 0; --d) {
    relax(network, d - 1, half_s);
  }
}

static void step_fourth(const Network* network, double step_s) {
  const double outer = 1.0 / (2.0 - cbrt(2.0));
  step_leapfrog(network, outer * step_s);
  step_leapfrog(network, (1.0 - 2.0 * outer) * step_s);
  step_leapfrog(network, outer * step_s);
}

const char* network_scheme_text(NetworkScheme scheme) {
#define SCHEME_TEXT(name, text, order) text,
  static const char* const texts[] = {NETWORK_SCHEME_LIST(SCHEME_TEXT)};
#undef SCHEME_TEXT
  return (unsigned)scheme < (unsigned)NETWORK_SCHEME_COUNT ? texts[scheme] : "unknown scheme";
}

int network_scheme_order(NetworkScheme scheme) {
#define SCHEME_ORDER(name, text, order) order,
  static const int orders[] = {NETWORK_SCHEME_LIST(SCHEME_ORDER)};
#undef SCHEME_ORDER
  return (unsigned)scheme < (unsigned)NETWORK_SCHEME_COUNT ? orders[scheme] : 0;
}

Status network_prepare(Network* network) {
  const size_t n_values = (size_t)N_VECTORS * network->n_points;
  double* const space = realloc(network->space, n_values * sizeof(double));
  if (!space) {
    return STATUS_NO_MEMORY;
  }
  network->space = space;
  return STATUS_OK;
}

Status network_step_by(Network* network, NetworkScheme scheme, double step_s) {
  assert(network->is_checked);
  switch (scheme) {
  case NETWORK_FORWARD:
    step_forward(network, step_s);
    break;
  case NETWORK_SYMPLECTIC:
    network_step(network, step_s);
    break;
  case NETWORK_BACKWARD:
    assert(network->space);
    return step_backward(network, step_s);
  case NETWORK_LEAPFROG:
    step_leapfrog(network, step_s);
    break;
  case NETWORK_FOURTH:
    step_fourth(network, step_s);
    break;
  case NETWORK_SCHEME_COUNT:
    return STATUS_BAD_ARGUMENT;
  }
  return STATUS_OK;
}

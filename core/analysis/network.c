#include "core/analysis/network.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_CAPACITY = 16 };

/* Twice as much, or 0 where the count cannot be told any more. */
static uint32_t more_than(uint32_t capacity) {
  if (capacity > UINT32_MAX / 2) {
    return 0;
  }
  return capacity ? 2 * capacity : FIRST_CAPACITY;
}

/* Grow *array; on failure it is as it was. */
static bool grow(void** array, size_t capacity, size_t size) {
  void* const grown = capacity <= SIZE_MAX / size ? realloc(*array, capacity * size) : NULL;
  if (grown) {
    *array = grown;
  }
  return grown;
}

static bool grow_values(double** values, size_t capacity) {
  void* array = *values;
  const bool is_grown = grow(&array, capacity, sizeof(double));
  *values = array;
  return is_grown;
}

static bool grow_flags(bool** flags, size_t capacity) {
  void* array = *flags;
  const bool is_grown = grow(&array, capacity, sizeof(bool));
  *flags = array;
  return is_grown;
}

static bool make_room_for_point(Network* network) {
  if (network->n_points < network->capacity) {
    return true;
  }
  const uint32_t capacity = more_than(network->capacity);
  if (!capacity || !grow_flags(&network->is_ground, capacity) ||
      !grow_values(&network->mass_kg, capacity) || !grow_values(&network->x, capacity) ||
      !grow_values(&network->v, capacity) || !grow_values(&network->force, capacity) ||
      !grow_values(&network->sum, capacity)) {
    return false;
  }
  network->capacity = capacity;
  return true;
}

static Status add_point(Network* network, bool is_ground, double mass_kg, uint32_t* point) {
  if (!make_room_for_point(network)) {
    return STATUS_NO_MEMORY;
  }
  const uint32_t p = network->n_points++;
  network->n_masses += is_ground ? 0 : 1;
  network->is_ground[p] = is_ground;
  network->mass_kg[p] = mass_kg;
  network->x[p] = network->v[p] = network->force[p] = 0.0;
  network->is_checked = false;
  if (point) {
    *point = p;
  }
  return STATUS_OK;
}

static bool make_room_for_link(NetworkLinks* links) {
  if (links->n < links->capacity) {
    return true;
  }
  const uint32_t capacity = more_than(links->capacity);
  void* array = links->link;
  const bool is_grown = capacity && grow(&array, capacity, sizeof(NetworkLink));
  links->link = array;
  links->capacity = is_grown ? capacity : links->capacity;
  return is_grown;
}

static Status
add_link(Network* network, NetworkLinks* links, uint32_t from, uint32_t to, double value) {
  if (!make_room_for_link(links)) {
    return STATUS_NO_MEMORY;
  }
  links->link[links->n++] = (NetworkLink){.from = from, .to = to, .value = value};
  network->is_checked = false;
  return STATUS_OK;
}

static Status add_terms(NetworkLevers* levers, uint32_t n_terms, const NetworkTerm* term) {
  while (n_terms > levers->term_capacity - levers->n_terms) {
    const uint32_t capacity = more_than(levers->term_capacity);
    void* array = levers->term;
    const bool is_grown = capacity && grow(&array, capacity, sizeof(NetworkTerm));
    levers->term = array;
    if (!is_grown) {
      return STATUS_NO_MEMORY;
    }
    levers->term_capacity = capacity;
  }
  for (uint32_t i = 0; i < n_terms; ++i) {
    levers->term[levers->n_terms + i] = term[i];
  }
  return STATUS_OK;
}

static bool make_room_for_lever(NetworkLevers* levers) {
  if (levers->n < levers->capacity) {
    return true;
  }
  const uint32_t capacity = more_than(levers->capacity);
  void* array = levers->lever;
  const bool is_grown = capacity && grow(&array, capacity, sizeof(NetworkLever));
  levers->lever = array;
  levers->capacity = is_grown ? capacity : levers->capacity;
  return is_grown;
}

static bool copy_array(void** copy, const void* array, size_t bytes) {
  *copy = bytes ? malloc(bytes) : NULL;
  if (*copy) {
    memcpy(*copy, array, bytes);
  }
  return *copy || !bytes;
}

static bool copy_values(double** copy, const double* values, size_t n) {
  void* array = NULL;
  const bool is_copied = copy_array(&array, values, n * sizeof(double));
  *copy = array;
  return is_copied;
}

static bool copy_links(NetworkLinks* copy, const NetworkLinks* links) {
  void* array = NULL;
  const bool is_copied = copy_array(&array, links->link, links->n * sizeof(NetworkLink));
  *copy = (NetworkLinks){.link = array, .n = links->n, .capacity = links->n};
  return is_copied;
}

static bool copy_levers(NetworkLevers* copy, const NetworkLevers* levers) {
  void* lever = NULL;
  void* term = NULL;
  const bool is_copied = copy_array(&lever, levers->lever, levers->n * sizeof(NetworkLever));
  const bool has_terms = copy_array(&term, levers->term, levers->n_terms * sizeof(NetworkTerm));
  *copy = (NetworkLevers){.lever = lever,
                          .n = levers->n,
                          .capacity = levers->n,
                          .term = term,
                          .n_terms = levers->n_terms,
                          .term_capacity = levers->n_terms};
  return is_copied && has_terms;
}

static bool copy_points(Network* copy, const Network* network) {
  const size_t n = network->n_points;
  void* flags = NULL;
  const bool is_copied = copy_array(&flags, network->is_ground, n * sizeof(bool));
  copy->is_ground = flags;
  return copy_values(&copy->mass_kg, network->mass_kg, n) && copy_values(&copy->x, network->x, n) &&
         copy_values(&copy->v, network->v, n) && copy_values(&copy->force, network->force, n) &&
         copy_values(&copy->sum, network->x, n) && is_copied;
}

/* Add to each mass the force of every spring on its two ends. */
static void add_spring_forces(const Network* network) {
  const double* const x = network->x;
  double* const sum = network->sum;
  for (uint32_t s = 0; s < network->springs.n; ++s) {
    const NetworkLink spring = network->springs.link[s];
    const double pull = spring.value * (x[spring.to] - x[spring.from]);
    sum[spring.from] += pull;
    sum[spring.to] -= pull;
  }
}

static void add_lever_forces(const Network* network) {
  for (uint32_t l = 0; l < network->levers.n; ++l) {
    const NetworkLever lever = network->levers.lever[l];
    const NetworkTerm* const term = network->levers.term + lever.first;
    const double pull = lever.stiffness * network_stretch(network, l, network->x);
    for (uint32_t i = 0; i < lever.n_terms; ++i) {
      network->sum[term[i].point] -= term[i].weight * pull;
    }
  }
}

static void add_damper_forces(const Network* network) {
  const double* const v = network->v;
  double* const sum = network->sum;
  for (uint32_t d = 0; d < network->dampers.n; ++d) {
    const NetworkLink damper = network->dampers.link[d];
    const double drag = damper.value * (v[damper.to] - v[damper.from]);
    sum[damper.from] += drag;
    sum[damper.to] -= drag;
  }
}

static double kinetic_energy(const Network* network) {
  double energy = 0.0;
  for (uint32_t p = 0; p < network->n_points; ++p) {
    if (!network->is_ground[p]) {
      energy += 0.5 * network->mass_kg[p] * network->v[p] * network->v[p];
    }
  }
  return energy;
}

Network* network_new(void) {
  return calloc(1, sizeof(Network));
}

void network_free(Network* network) {
  if (network) {
    free(network->is_ground);
    free(network->mass_kg);
    free(network->x);
    free(network->v);
    free(network->force);
    free(network->sum);
    free(network->springs.link);
    free(network->dampers.link);
    free(network->levers.lever);
    free(network->levers.term);
    free(network->space);
    free(network);
  }
}

Network* network_copy(const Network* network) {
  Network* const copy = network_new();
  if (!copy) {
    return NULL;
  }
  copy->n_points = copy->capacity = network->n_points;
  copy->n_masses = network->n_masses;
  copy->is_checked = network->is_checked;
  if (!copy_points(copy, network) || !copy_links(&copy->springs, &network->springs) ||
      !copy_links(&copy->dampers, &network->dampers) ||
      !copy_levers(&copy->levers, &network->levers)) {
    network_free(copy);
    return NULL;
  }
  return copy;
}

Status network_add_mass(Network* network, double mass_kg, uint32_t* point) {
  return add_point(network, false, mass_kg, point);
}

Status network_add_ground(Network* network, uint32_t* point) {
  return add_point(network, true, HUGE_VAL, point);
}

Status network_add_spring(Network* network, uint32_t from, uint32_t to, double stiffness) {
  return add_link(network, &network->springs, from, to, stiffness);
}

Status network_add_damper(Network* network, uint32_t from, uint32_t to, double damping) {
  return add_link(network, &network->dampers, from, to, damping);
}

Status
network_add_lever(Network* network, double stiffness, uint32_t n_terms, const NetworkTerm* term) {
  NetworkLevers* const levers = &network->levers;
  if (!make_room_for_lever(levers) || add_terms(levers, n_terms, term)) {
    return STATUS_NO_MEMORY;
  }
  levers->lever[levers->n++] =
      (NetworkLever){.first = levers->n_terms, .n_terms = n_terms, .stiffness = stiffness};
  levers->n_terms += n_terms;
  network->is_checked = false;
  return STATUS_OK;
}

void network_load(Network* network, uint32_t point, double mass_kg) {
  network->is_checked = false;
  network->mass_kg[point] += mass_kg;
}

Status network_add_string(Network* network,
                          uint32_t n_masses,
                          double mass_kg,
                          double stiffness,
                          double damping,
                          uint32_t* first) {
  if (n_masses == 0 || n_masses > UINT32_MAX - 2 - network->n_points) {
    return STATUS_BAD_ARGUMENT;
  }
  const uint32_t start = network->n_points;
  Status status = STATUS_OK;
  for (uint32_t i = 0; i < n_masses && !status; ++i) {
    status = network_add_mass(network, mass_kg, NULL);
  }
  for (int end = 0; end < 2 && !status; ++end) {
    status = network_add_ground(network, NULL);
  }
  for (uint32_t i = 0; i <= n_masses && !status; ++i) {
    const uint32_t from = i > 0 ? start + i - 1 : start + n_masses;
    const uint32_t to = i < n_masses ? start + i : start + n_masses + 1;
    status = network_add_spring(network, from, to, stiffness);
    if (!status && damping != 0.0) {
      status = network_add_damper(network, from, to, damping);
    }
  }
  if (!status && first) {
    *first = start;
  }
  return status;
}

void network_scale(Network* network, double stiffness_factor, double damping_factor) {
  for (uint32_t s = 0; s < network->springs.n; ++s) {
    network->springs.link[s].value *= stiffness_factor;
  }
  for (uint32_t d = 0; d < network->dampers.n; ++d) {
    network->dampers.link[d].value *= damping_factor;
  }
  for (uint32_t l = 0; l < network->levers.n; ++l) {
    network->levers.lever[l].stiffness *= stiffness_factor;
  }
}

void network_rest(Network* network) {
  for (uint32_t p = 0; p < network->n_points; ++p) {
    network->x[p] = network->v[p] = network->force[p] = 0.0;
  }
}

void network_step(Network* network, double step_s) {
  assert(network->is_checked);
  memcpy(network->sum, network->force, network->n_points * sizeof(double));
  add_spring_forces(network);
  add_lever_forces(network);
  add_damper_forces(network);
  for (uint32_t p = 0; p < network->n_points; ++p) {
    if (!network->is_ground[p]) {
      network->v[p] += step_s * network->sum[p] / network->mass_kg[p];
      network->x[p] += step_s * network->v[p];
    }
  }
}

double network_stretch(const Network* network, uint32_t lever, const double* x) {
  const NetworkTerm* const term = network->levers.term + network->levers.lever[lever].first;
  double sum = 0.0;
  for (uint32_t i = 0; i < network->levers.lever[lever].n_terms; ++i) {
    sum += term[i].weight * x[term[i].point];
  }
  return sum;
}

double network_energy(const Network* network) {
  return network_scheme_energy(network, 0.0);
}

double network_scheme_energy(const Network* network, double step_s) {
  double energy = kinetic_energy(network);
  for (uint32_t s = 0; s < network->springs.n; ++s) {
    const NetworkLink spring = network->springs.link[s];
    const double stretch = network->x[spring.to] - network->x[spring.from];
    const double stretching = network->v[spring.to] - network->v[spring.from];
    energy += 0.5 * spring.value * stretch * (stretch - step_s * stretching);
  }
  for (uint32_t l = 0; l < network->levers.n; ++l) {
    const double stretch = network_stretch(network, l, network->x);
    const double stretching = network_stretch(network, l, network->v);
    energy += 0.5 * network->levers.lever[l].stiffness * stretch * (stretch - step_s * stretching);
  }
  return energy;
}

/* What can be said of a network without stepping it: whether it is well formed, its parts, its
 * matrices. */

#include "core/analysis/network.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The share of its weights by which a lever's sum may miss 0. */
static const double ROUNDINGS = 1e-12;

static Status check_link(const Network* network, NetworkLink link) {
  if (!(link.value >= 0.0) || !isfinite(link.value)) {
    return STATUS_BAD_LINK;
  }
  if (link.from >= network->n_points || link.to >= network->n_points) {
    return STATUS_NO_SUCH_POINT;
  }
  return link.from == link.to ? STATUS_SELF_LINK : STATUS_OK;
}

static Status check_links(const Network* network, const NetworkLinks* links, uint32_t* index) {
  for (uint32_t l = 0; l < links->n; ++l) {
    const Status status = check_link(network, links->link[l]);
    if (status) {
      *index = l;
      return status;
    }
  }
  return STATUS_OK;
}

/* `last` tells of each point the last lever that it is in, from 1. */
static Status check_lever(const Network* network, uint32_t l, double* last) {
  const NetworkLever lever = network->levers.lever[l];
  if (!(lever.stiffness >= 0.0) || !isfinite(lever.stiffness)) {
    return STATUS_BAD_LINK;
  }
  for (uint32_t i = 0; i < lever.n_terms; ++i) {
    const NetworkTerm term = network->levers.term[lever.first + i];
    if (!isfinite(term.weight)) {
      return STATUS_BAD_LINK;
    }
    if (term.point >= network->n_points) {
      return STATUS_NO_SUCH_POINT;
    }
    if (last[term.point] == l + 1.0) {
      return STATUS_SELF_LINK;
    }
    last[term.point] = l + 1.0;
  }
  return STATUS_OK;
}

static Status check_levers(const Network* network, uint32_t* index) {
  memset(network->sum, 0, network->n_points * sizeof(double));
  for (uint32_t l = 0; l < network->levers.n; ++l) {
    const Status status = check_lever(network, l, network->sum);
    if (status) {
      *index = l;
      return status;
    }
  }
  return STATUS_OK;
}

static Status check_points(const Network* network, uint32_t* index) {
  for (uint32_t p = 0; p < network->n_points; ++p) {
    if (!network->is_ground[p] &&
        (!(network->mass_kg[p] > 0.0) || !isfinite(network->mass_kg[p]))) {
      *index = p;
      return STATUS_BAD_MASS;
    }
  }
  return STATUS_OK;
}

/* The representative of a point's part, halving the way to it. */
static uint32_t root_of(uint32_t* parent, uint32_t p) {
  while (parent[p] != p) {
    parent[p] = parent[parent[p]];
    p = parent[p];
  }
  return p;
}

/* The lower of two representatives speaks for both, so that parts come in order. */
static void join(uint32_t* parent, uint32_t a, uint32_t b) {
  const uint32_t root_a = root_of(parent, a);
  const uint32_t root_b = root_of(parent, b);
  parent[root_a > root_b ? root_a : root_b] = root_a > root_b ? root_b : root_a;
}

static void join_linked(const Network* network, const NetworkLinks* links, uint32_t* parent) {
  for (uint32_t l = 0; l < links->n; ++l) {
    const NetworkLink link = links->link[l];
    if (link.value > 0.0 && !network->is_ground[link.from] && !network->is_ground[link.to]) {
      join(parent, link.from, link.to);
    }
  }
}

static void
mark_held(const Network* network, const NetworkLinks* links, uint32_t* parent, bool* is_held) {
  for (uint32_t l = 0; l < links->n; ++l) {
    const NetworkLink link = links->link[l];
    if (link.value > 0.0 && network->is_ground[link.from] != network->is_ground[link.to]) {
      is_held[root_of(parent, network->is_ground[link.from] ? link.to : link.from)] = true;
    }
  }
}

/* Whether a term moves, and pulls. */
static bool is_live(const Network* network, NetworkTerm term) {
  return term.weight != 0.0 && !network->is_ground[term.point];
}

/* Join what levers hold together, and mark what they hold to the ground: what cannot all move by
 * the same. */
static void join_levered(const Network* network, uint32_t* parent) {
  for (uint32_t l = 0; l < network->levers.n; ++l) {
    const NetworkLever lever = network->levers.lever[l];
    const NetworkTerm* const term = network->levers.term + lever.first;
    const NetworkTerm* first = NULL;
    for (uint32_t i = 0; i < lever.n_terms && lever.stiffness > 0.0; ++i) {
      if (is_live(network, term[i])) {
        first = first ? first : &term[i];
        join(parent, first->point, term[i].point);
      }
    }
  }
}

static void mark_levered(const Network* network, uint32_t* parent, bool* is_held) {
  for (uint32_t l = 0; l < network->levers.n; ++l) {
    const NetworkLever lever = network->levers.lever[l];
    const NetworkTerm* const term = network->levers.term + lever.first;
    double sum = 0.0;
    double size = 0.0;
    const NetworkTerm* last = NULL;
    for (uint32_t i = 0; i < lever.n_terms && lever.stiffness > 0.0; ++i) {
      if (is_live(network, term[i])) {
        last = &term[i];
        sum += term[i].weight;
        size += fabs(term[i].weight);
      }
    }
    if (last && fabs(sum) > ROUNDINGS * size) {
      is_held[root_of(parent, last->point)] = true;
    }
  }
}

static void fill_links(const NetworkLinks* links, const uint32_t* row, size_t n, double* matrix) {
  memset(matrix, 0, n * n * sizeof(double));
  for (uint32_t l = 0; l < links->n; ++l) {
    const NetworkLink link = links->link[l];
    const size_t ends[2] = {row[link.from], row[link.to]};
    for (int e = 0; e < 2; ++e) {
      if (ends[e] != UINT32_MAX) {
        matrix[ends[e] + ends[e] * n] += link.value;
      }
    }
    if (ends[0] != UINT32_MAX && ends[1] != UINT32_MAX) {
      matrix[ends[0] + ends[1] * n] -= link.value;
      matrix[ends[1] + ends[0] * n] -= link.value;
    }
  }
}

static void fill_levers(const Network* network, const uint32_t* row, size_t n, double* matrix) {
  for (uint32_t l = 0; l < network->levers.n; ++l) {
    const NetworkLever lever = network->levers.lever[l];
    const NetworkTerm* const term = network->levers.term + lever.first;
    for (uint32_t i = 0; i < lever.n_terms; ++i) {
      const size_t at_i = row[term[i].point];
      for (uint32_t j = 0; j < lever.n_terms && at_i != UINT32_MAX; ++j) {
        const size_t at_j = row[term[j].point];
        if (at_j != UINT32_MAX) {
          matrix[at_i + at_j * n] += lever.stiffness * term[i].weight * term[j].weight;
        }
      }
    }
  }
}

Status network_check(Network* network, NetworkFault* fault) {
  NetworkFault found = {NETWORK_POINT, 0};
  Status status = network->n_masses ? STATUS_OK : STATUS_EMPTY;
  if (!status) {
    status = check_points(network, &found.index);
  }
  if (!status) {
    status = check_links(network, &network->springs, &found.index);
    found.element = NETWORK_SPRING;
  }
  if (!status) {
    status = check_links(network, &network->dampers, &found.index);
    found.element = NETWORK_DAMPER;
  }
  if (!status) {
    status = check_levers(network, &found.index);
    found.element = NETWORK_LEVER;
  }
  if (status && fault) {
    *fault = found;
  }
  network->is_checked = !status;
  return status;
}

Status network_find_free(const Network* network,
                         bool is_by_dampers_too,
                         uint32_t* part,
                         uint32_t* n_free) {
  const size_t n = network->n_points;
  uint32_t* const parent = malloc((n ? n : 1) * sizeof(uint32_t));
  bool* const is_held = calloc(n ? n : 1, sizeof(bool));
  const bool has_room = parent && is_held;
  if (has_room) {
    for (uint32_t p = 0; p < n; ++p) {
      parent[p] = p;
    }
    join_linked(network, &network->springs, parent);
    join_levered(network, parent);
    if (is_by_dampers_too) {
      join_linked(network, &network->dampers, parent);
      mark_held(network, &network->dampers, parent, is_held);
    }
    mark_held(network, &network->springs, parent, is_held);
    mark_levered(network, parent, is_held);
    *n_free = 0;
    for (uint32_t p = 0; p < n; ++p) {
      const uint32_t root = root_of(parent, p);
      if (network->is_ground[p] || is_held[root]) {
        part[p] = UINT32_MAX;
      } else {
        part[p] = root == p ? (*n_free)++ : part[root];
      }
    }
  }
  free(parent);
  free(is_held);
  return has_room ? STATUS_OK : STATUS_NO_MEMORY;
}

Status
network_matrices(const Network* network, double* mass_kg, double* stiffness, double* damping) {
  uint32_t* const row = malloc((network->n_points + (size_t)1) * sizeof(uint32_t));
  if (!row) {
    return STATUS_NO_MEMORY;
  }
  uint32_t n = 0;
  for (uint32_t p = 0; p < network->n_points; ++p) {
    row[p] = UINT32_MAX;
    if (!network->is_ground[p]) {
      mass_kg[n] = network->mass_kg[p];
      row[p] = n++;
    }
  }
  if (stiffness) {
    fill_links(&network->springs, row, n, stiffness);
    fill_levers(network, row, n, stiffness);
  }
  if (damping) {
    fill_links(&network->dampers, row, n, damping);
  }
  free(row);
  return STATUS_OK;
}

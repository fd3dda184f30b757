#include "core/analysis/modes_sparse.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* In the place of a column: none. */
static const uint32_t NONE = UINT32_MAX;

/* The entry of row i in column j, which is there; i ≥ j. */
static double* entry(const Sparse* sparse, uint32_t i, uint32_t j) {
  size_t low = sparse->order.start[j];
  size_t high = sparse->order.start[j + 1];
  while (high - low > 1) {
    const size_t middle = low + (high - low) / 2;
    *(sparse->order.row[middle] <= i ? &low : &high) = middle;
  }
  return &sparse->value[low];
}

static double* diagonal(const Sparse* sparse, uint32_t mass) {
  return &sparse->value[sparse->order.start[sparse->order.place[mass]]];
}

/* Column k from its entry `from` on, times that entry, off the column that is factored. */
static void subtract(const Sparse* sparse, uint32_t k, size_t from) {
  const uint32_t* const row = sparse->order.row;
  const double* const value = sparse->value;
  const size_t end = sparse->order.start[k + 1];
  const double share = value[from];
  double* const sum = sparse->sum;
  if (row[end - 1] - row[from] == end - 1 - from) {
    double* const at = sum + row[from];
    for (size_t e = 0; e < end - from; ++e) {
      at[e] -= share * value[from + e];
    }
  } else {
    for (size_t e = from; e < end; ++e) {
      sum[row[e]] -= share * value[e];
    }
  }
}

/* Column k acts next on the row of its entry `from`, if it has one. */
static void enlist(const Sparse* sparse, uint32_t k, size_t from) {
  sparse->at[k] = from;
  if (from < sparse->order.start[k + 1]) {
    uint32_t* const first = &sparse->first[sparse->order.row[from]];
    sparse->next[k] = *first;
    *first = k;
  }
}

static Status factor_column(const Sparse* sparse, uint32_t j) {
  const size_t start = sparse->order.start[j];
  const size_t end = sparse->order.start[j + 1];
  const uint32_t* const row = sparse->order.row;
  for (size_t e = start; e < end; ++e) {
    sparse->sum[row[e]] = sparse->value[e];
  }
  for (uint32_t k = sparse->first[j]; k != NONE;) {
    const uint32_t next = sparse->next[k];
    subtract(sparse, k, sparse->at[k]);
    enlist(sparse, k, sparse->at[k] + 1);
    k = next;
  }
  if (!(sparse->sum[j] > 0.0)) {
    return STATUS_ILL_SCALED;
  }
  const double root = sqrt(sparse->sum[j]);
  sparse->value[start] = root;
  for (size_t e = start + 1; e < end; ++e) {
    sparse->value[e] = sparse->sum[row[e]] / root;
  }
  enlist(sparse, j, start + 1);
  return STATUS_OK;
}

/* In the order of elimination. */
static void solve(const Sparse* sparse, double* x) {
  const Order* const order = &sparse->order;
  const double* const value = sparse->value;
  for (uint32_t j = 0; j < order->n; ++j) {
    x[j] /= value[order->start[j]];
    for (size_t e = order->start[j] + 1; e < order->start[j + 1]; ++e) {
      x[order->row[e]] -= value[e] * x[j];
    }
  }
  for (uint32_t j = order->n; j > 0; --j) {
    double sum = x[j - 1];
    for (size_t e = order->start[j - 1] + 1; e < order->start[j]; ++e) {
      sum -= value[e] * x[order->row[e]];
    }
    x[j - 1] = sum / value[order->start[j - 1]];
  }
}

Status sparse_init(Sparse* sparse, const Frame* frame) {
  const size_t n = frame->n;
  *sparse = (Sparse){0};
  const Status status = order_init(&sparse->order, frame);
  if (status) {
    return status;
  }
  sparse->value = malloc(sparse->order.start[n] * sizeof(double));
  sparse->sum = malloc(n * sizeof(double));
  sparse->at = malloc(n * sizeof(size_t));
  sparse->first = malloc(2 * n * sizeof(uint32_t));
  if (!sparse->value || !sparse->sum || !sparse->at || !sparse->first) {
    sparse_clear(sparse);
    return STATUS_NO_MEMORY;
  }
  sparse->next = sparse->first + n;
  return STATUS_OK;
}

void sparse_clear(Sparse* sparse) {
  order_clear(&sparse->order);
  free(sparse->value);
  free(sparse->sum);
  free(sparse->at);
  free(sparse->first);
  *sparse = (Sparse){0};
}

static void
fill_lever(const Sparse* sparse, const Frame* frame, FrameLever lever, double stiffness) {
  const FrameTerm* const term = frame->term + lever.first;
  const double value = stiffness * lever.k;
  for (uint32_t i = 0; i < lever.n_terms; ++i) {
    const uint32_t p = sparse->order.place[term[i].mass];
    *diagonal(sparse, term[i].mass) += value * term[i].weight * term[i].weight;
    for (uint32_t j = i + 1; j < lever.n_terms; ++j) {
      const uint32_t q = sparse->order.place[term[j].mass];
      *entry(sparse, p > q ? p : q, p > q ? q : p) += value * term[i].weight * term[j].weight;
    }
  }
}

void sparse_fill(Sparse* sparse, const Frame* frame, double one, double damping, double stiffness) {
  const Order* const order = &sparse->order;
  memset(sparse->value, 0, order->start[order->n] * sizeof(double));
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    const FrameLink link = frame->link[l];
    const double value = damping * link.z + stiffness * link.k;
    const double root_a = frame->root[link.a];
    *diagonal(sparse, link.a) += value / root_a / root_a;
    if (link.b != FRAME_GROUND) {
      const uint32_t p = order->place[link.a];
      const uint32_t q = order->place[link.b];
      const double root_b = frame->root[link.b];
      *diagonal(sparse, link.b) += value / root_b / root_b;
      *entry(sparse, p > q ? p : q, p > q ? q : p) -= value / root_a / root_b;
    }
  }
  for (uint32_t l = 0; l < frame->n_levers; ++l) {
    fill_lever(sparse, frame, frame->lever[l], stiffness);
  }
  for (uint32_t i = 0; i < order->n; ++i) {
    *diagonal(sparse, i) += one;
  }
}

void sparse_tie(Sparse* sparse, uint32_t mass) {
  double* const value = diagonal(sparse, mass);
  *value += *value > 0.0 ? *value : 1.0;
}

Status sparse_factor(Sparse* sparse) {
  Status status = STATUS_OK;
  memset(sparse->first, 0xFF, sparse->order.n * sizeof(uint32_t));
  for (uint32_t j = 0; j < sparse->order.n && !status; ++j) {
    status = factor_column(sparse, j);
  }
  return status;
}

void sparse_solve(const Sparse* sparse, uint32_t n_vectors, double* vectors, double* space) {
  const uint32_t n = sparse->order.n;
  for (uint32_t v = 0; v < n_vectors; ++v) {
    double* const vector = vectors + (size_t)v * n;
    for (uint32_t i = 0; i < n; ++i) {
      space[sparse->order.place[i]] = vector[i];
    }
    solve(sparse, space);
    for (uint32_t i = 0; i < n; ++i) {
      vector[i] = space[sparse->order.place[i]];
    }
  }
}

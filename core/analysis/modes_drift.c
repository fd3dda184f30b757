#include "core/analysis/modes_drift.h"

#include <stdbool.h>
#include <string.h>

/* What u_p is of a mass. */
static double of_mass(const Frame* frame, uint32_t i) {
  return frame->root[i] / frame->part_root[frame->part[i]];
}

static bool is_free(const Frame* frame, uint32_t i) {
  return frame->part[i] != FRAME_GROUND;
}

static uint32_t part_of(const Frame* frame, uint32_t i) {
  return i != FRAME_GROUND ? frame->part[i] : FRAME_GROUND;
}

/* Whether a link reaches from a free part to elsewhere; then p is a free part that it ends at, and
 * q the other, or FRAME_GROUND. */
static bool leaves_part(const Frame* frame, FrameLink link, uint32_t* p, uint32_t* q) {
  const uint32_t a = part_of(frame, link.a);
  const uint32_t b = part_of(frame, link.b);
  *p = a != FRAME_GROUND ? a : b;
  *q = a != FRAME_GROUND ? b : a;
  return a != b;
}

void drift_shape(const Frame* frame, uint32_t p, double* y) {
  for (uint32_t i = 0; i < frame->n; ++i) {
    y[i] = frame->part[i] == p ? of_mass(frame, i) : 0.0;
  }
}

void drift_damping(const Frame* frame, double* damping) {
  memset(damping, 0, frame->n_free * sizeof(double));
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    uint32_t p = 0;
    uint32_t q = 0;
    if (leaves_part(frame, frame->link[l], &p, &q)) {
      damping[p] += frame->link[l].z / frame->part_root[p] / frame->part_root[p];
      if (q != FRAME_GROUND) {
        damping[q] += frame->link[l].z / frame->part_root[q] / frame->part_root[q];
      }
    }
  }
}

void drift_fill_damping(const Frame* frame, double* matrix) {
  const size_t n = frame->n_free;
  memset(matrix, 0, n * n * sizeof(double));
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    uint32_t p = 0;
    uint32_t q = 0;
    if (leaves_part(frame, frame->link[l], &p, &q)) {
      const double z = frame->link[l].z;
      matrix[p + p * n] += z / frame->part_root[p] / frame->part_root[p];
      if (q != FRAME_GROUND) {
        matrix[q + q * n] += z / frame->part_root[q] / frame->part_root[q];
        matrix[p + q * n] -= z / frame->part_root[p] / frame->part_root[q];
        matrix[q + p * n] = matrix[p + q * n];
      }
    }
  }
}

void drift_shares(const Frame* frame, const double* y, double* share) {
  memset(share, 0, frame->n_free * sizeof(double));
  for (uint32_t i = 0; i < frame->n; ++i) {
    if (is_free(frame, i)) {
      share[frame->part[i]] += of_mass(frame, i) * y[i];
    }
  }
}

void drift_add(const Frame* frame, const double* share, double* y) {
  for (uint32_t i = 0; i < frame->n; ++i) {
    if (is_free(frame, i)) {
      y[i] += share[frame->part[i]] * of_mass(frame, i);
    }
  }
}

void drift_remove(const Frame* frame, uint32_t n_vectors, double* vectors, double* space) {
  for (uint32_t v = 0; v < n_vectors && frame->n_free > 0; ++v) {
    double* const y = vectors + (size_t)v * frame->n;
    drift_shares(frame, y, space);
    for (uint32_t p = 0; p < frame->n_free; ++p) {
      space[p] = -space[p];
    }
    drift_add(frame, space, y);
  }
}

Status drift_factor(Sparse* sparse, const Frame* frame) {
  uint32_t n_tied = 0;
  sparse_fill(sparse, frame, 0.0, 0.0, 1.0);
  /* Parts come in the order of their first masses. */
  for (uint32_t i = 0; i < frame->n && n_tied < frame->n_free; ++i) {
    if (frame->part[i] == n_tied) {
      sparse_tie(sparse, i);
      ++n_tied;
    }
  }
  return sparse_factor(sparse);
}

void drift_solve(
    const Sparse* sparse, const Frame* frame, uint32_t n_vectors, double* vectors, double* space) {
  drift_remove(frame, n_vectors, vectors, space);
  sparse_solve(sparse, n_vectors, vectors, space);
  drift_remove(frame, n_vectors, vectors, space);
}

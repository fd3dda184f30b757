#include "core/analysis/shapes.h"

#include "core/analysis/modes_lapack.h"

#include <math.h>
#include <stdlib.h>

static void number_masses(const Network* network, uint32_t* row) {
  uint32_t n = 0;
  for (uint32_t p = 0; p < network->n_points; ++p) {
    row[p] = network->is_ground[p] ? UINT32_MAX : n++;
  }
}

/* K̂ = M^−½ K M^−½ becomes its vectors, and omega its values. */
static Status diagonalise(uint32_t order, double* matrix, double* omega) {
  const int n = (int)order;
  const int n_work = 64 * (n + 1);
  int info = 0;
  double* const work = malloc((size_t)n_work * sizeof(double));
  if (!work) {
    return STATUS_NO_MEMORY;
  }
  dsyev_("V", "L", &n, matrix, &n, omega, work, &n_work, &info);
  free(work);
  return info ? STATUS_NO_CONVERGENCE : STATUS_OK;
}

/* `root` has √m. */
static void scale_both(uint32_t n, const double* root, double* matrix) {
  for (size_t j = 0; j < n; ++j) {
    for (size_t i = 0; i < n; ++i) {
      matrix[i + j * n] /= root[i] * root[j];
    }
  }
}

static double damping_of(const Shapes* shapes, const Network* network, uint32_t k) {
  double sum = 0.0;
  for (uint32_t d = 0; d < network->dampers.n; ++d) {
    const NetworkLink damper = network->dampers.link[d];
    const double apart = shapes_at(shapes, k, damper.to) - shapes_at(shapes, k, damper.from);
    sum += damper.value * apart * apart;
  }
  return sum;
}

static Status solve(const Network* network, Shapes* shapes, double* root) {
  const uint32_t n = shapes->n;
  Status status = network_matrices(network, root, shapes->shape, NULL);
  if (status) {
    return status;
  }
  for (uint32_t i = 0; i < n; ++i) {
    root[i] = sqrt(root[i]);
  }
  scale_both(n, root, shapes->shape);
  status = diagonalise(n, shapes->shape, shapes->omega);
  for (size_t k = 0; k < n && !status; ++k) {
    for (size_t i = 0; i < n; ++i) {
      shapes->shape[i + k * n] /= root[i];
    }
    /* Rounding may leave what drifts below 0. */
    shapes->omega[k] = sqrt(fmax(0.0, shapes->omega[k]));
    shapes->damping[k] = damping_of(shapes, network, (uint32_t)k);
  }
  return status;
}

Status shapes_solve(const Network* network, Shapes* shapes) {
  const size_t n = network->n_masses;
  if (!network->is_checked || n > SHAPES_MOST) {
    return STATUS_BAD_ARGUMENT;
  }
  Shapes found = {.n = (uint32_t)n,
                  .row = malloc(network->n_points * sizeof(uint32_t)),
                  .omega = malloc(n * sizeof(double)),
                  .damping = malloc(n * sizeof(double)),
                  .shape = malloc(n * n * sizeof(double))};
  double* const root = malloc(n * sizeof(double));
  Status status = STATUS_NO_MEMORY;
  if (found.row && found.omega && found.damping && found.shape && root) {
    number_masses(network, found.row);
    status = solve(network, &found, root);
  }
  free(root);
  if (status) {
    shapes_clear(&found);
  } else {
    *shapes = found;
  }
  return status;
}

void shapes_clear(Shapes* shapes) {
  free(shapes->row);
  free(shapes->omega);
  free(shapes->damping);
  free(shapes->shape);
  *shapes = (Shapes){0};
}

double shapes_at(const Shapes* shapes, uint32_t k, uint32_t point) {
  const uint32_t row = shapes->row[point];
  return row == UINT32_MAX ? 0.0 : shapes->shape[row + (size_t)k * shapes->n];
}

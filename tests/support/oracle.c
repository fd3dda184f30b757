#include "tests/support/oracle.h"

#include <assert.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

enum { MAX_MASSES = 1024 };

/* LAPACK: eigenvalues wr + i wi of a, n × n, destroyed; no vectors for 'N'. */
void dgeev_(const char* jobvl,
            const char* jobvr,
            const int* n,
            double* a,
            const int* lda,
            double* wr,
            double* wi,
            double* vl,
            const int* ldvl,
            double* vr,
            const int* ldvr,
            double* work,
            const int* lwork,
            int* info);

static double* zeros(size_t n) {
  double* const values = calloc(n, sizeof(double));
  assert_non_null(values);
  return values;
}

void oracle_eigenvalues(size_t order, double* matrix, double complex* values) {
  const int n = (int)order;
  const int one = 1;
  const int n_work = 8 * n;
  double* const re = zeros(10 * order);
  double* const im = re + order;
  double unused = 0.0;
  int info = 0;
  dgeev_("N", "N", &n, matrix, &n, re, im, &unused, &one, &unused, &one, im + order, &n_work,
         &info);
  assert_int_equal(info, 0);
  for (size_t k = 0; k < order; ++k) {
    values[k] = complex_of(re[k], im[k]);
  }
  free(re);
}

/* y = A x */
static void multiply(const double* matrix, uint32_t n, const double* x, double* y) {
  memset(y, 0, n * sizeof(double));
  for (uint32_t j = 0; j < n; ++j) {
    for (uint32_t i = 0; i < n; ++i) {
      y[i] += matrix[i + (size_t)j * n] * x[j];
    }
  }
}

void oracle_assert_within(
    const char* what, double worst, double limit, const char* file, int line) {
  print_message("  %-58s %10.3g  (allowed %.3g)\n", what, worst, limit);
  if (!(worst <= limit)) {
    print_error("%s: %.17g is more than %.17g\n", what, worst, limit);
    _fail(file, line);
  }
}

void oracle_forces(StringCoefs coefs, uint32_t n, double* stiffness, double* damping) {
  double* const laplacian = zeros((size_t)n * n);
  double* const squared = zeros((size_t)n * n);
  double* const cubed = zeros((size_t)n * n);
  for (uint32_t i = 0; i < n; ++i) {
    laplacian[i + (size_t)i * n] = 2.0;
    if (i + 1 < n) {
      laplacian[i + (size_t)(i + 1) * n] = laplacian[i + 1 + (size_t)i * n] = -1.0;
    }
  }
  for (uint32_t j = 0; j < n; ++j) {
    multiply(laplacian, n, laplacian + (size_t)j * n, squared + (size_t)j * n);
    multiply(laplacian, n, squared + (size_t)j * n, cubed + (size_t)j * n);
  }
  for (size_t m = 0; m < (size_t)n * n; ++m) {
    stiffness[m] = coefs.k1 * laplacian[m] + coefs.k2 * squared[m] + coefs.k3 * cubed[m];
    damping[m] = coefs.z1 * laplacian[m] + (m % (n + 1) == 0 ? coefs.z0 : 0.0);
  }
  free(laplacian);
  free(squared);
  free(cubed);
}

void oracle_poles(StringCoefs coefs, uint32_t n, double complex* poles) {
  const size_t order = 2 * (size_t)n;
  double* const stiffness = zeros((size_t)n * n);
  double* const damping = zeros((size_t)n * n);
  double* const step = zeros(order * order);
  oracle_forces(coefs, n, stiffness, damping);
  for (uint32_t j = 0; j < n; ++j) {
    for (uint32_t i = 0; i < n; ++i) {
      const double one = i == j ? 1.0 : 0.0;
      const double k = stiffness[i + (size_t)j * n];
      const double z = damping[i + (size_t)j * n];
      step[i + j * order] = one - k;
      step[i + n + j * order] = -k;
      step[i + (j + n) * order] = one - z;
      step[i + n + (j + n) * order] = one - z;
    }
  }
  oracle_eigenvalues(order, step, poles);
  free(step);
  free(damping);
  free(stiffness);
}

double oracle_spectral_radius(StringCoefs coefs, uint32_t n) {
  double complex poles[2 * MAX_MASSES];
  double radius = 0.0;
  assert(n <= MAX_MASSES);
  oracle_poles(coefs, n, poles);
  for (uint32_t k = 0; k < 2 * n; ++k) {
    radius = fmax(radius, cabs(poles[k]));
  }
  return radius;
}

void oracle_mass_poles(double a, double g, double complex poles[2]) {
  double step[4] = {1.0 - a, -a, 1.0 - g, 1.0 - g};
  oracle_eigenvalues(2, step, poles);
}

/* y = L x, of n masses between two walls */
static void bend(uint32_t n, const double* x, double* y) {
  for (uint32_t i = 0; i < n; ++i) {
    const double left = i > 0 ? x[i - 1] : 0.0;
    const double right = i + 1 < n ? x[i + 1] : 0.0;
    y[i] = 2.0 * x[i] - left - right;
  }
}

void oracle_step(StringCoefs coefs, uint32_t n, double* x, double* u) {
  double once[MAX_MASSES];
  double twice[MAX_MASSES];
  double pulls[MAX_MASSES];
  assert(n <= MAX_MASSES);
  bend(n, x, once);
  bend(n, once, twice);
  for (uint32_t i = 0; i < n; ++i) {
    pulls[i] = coefs.k1 * x[i] + coefs.k2 * once[i] + coefs.k3 * twice[i] + coefs.z1 * u[i];
  }
  bend(n, pulls, once);
  for (uint32_t i = 0; i < n; ++i) {
    u[i] -= once[i] + coefs.z0 * u[i];
    x[i] += u[i];
  }
}

double oracle_energy(const double* stiffness, uint32_t n, const double* x, const double* u) {
  double force[MAX_MASSES];
  double energy = 0.0;
  assert(n <= MAX_MASSES);
  multiply(stiffness, n, x, force);
  for (uint32_t i = 0; i < n; ++i) {
    energy += 0.5 * (u[i] * u[i] + force[i] * (x[i] - u[i]));
  }
  return energy;
}

double oracle_loss(const double* damping, uint32_t n, const double* u_old, const double* u_new) {
  double force[MAX_MASSES];
  double loss = 0.0;
  assert(n <= MAX_MASSES);
  multiply(damping, n, u_old, force);
  for (uint32_t i = 0; i < n; ++i) {
    loss += 0.5 * (u_new[i] + u_old[i]) * force[i];
  }
  return loss;
}

double oracle_headroom(StringCoefs coefs, uint32_t n) {
  double headroom = HUGE_VAL;
  for (uint32_t k = 1; k <= n; ++k) {
    const double lambda = 2.0 - 2.0 * cos(PI * k / (n + 1.0));
    const double a =
        coefs.k1 * lambda + coefs.k2 * lambda * lambda + coefs.k3 * lambda * lambda * lambda;
    const double g = coefs.z0 + coefs.z1 * lambda;
    headroom = fmin(headroom, a > 0.0 ? 1.0 - 0.25 * (a + 2.0 * g) : -HUGE_VAL);
  }
  return headroom;
}

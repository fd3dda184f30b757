#include "core/excite/finger.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* Masses that the finger is on, those to a side that B reaches, and all that are looked at. */
enum { N_FINGER = 4, N_HALF = N_FINGER / 2, REACH = 3, N_NEAR = N_FINGER + 2 * REACH };

/* What is near the finger: mass `first` + i of the string is at [i]; masses count from 1, and what
 * is at 0 or past N is a wall. */
typedef struct {
  int64_t first;
  int64_t n_masses;
} Near;

static bool is_mass(const Near* near, int64_t i) {
  return near->first + i >= 1 && near->first + i <= near->n_masses;
}

/* L of what is near, which is nought beyond. */
static void curve(const Near* near, const double* in, double* out) {
  for (int64_t i = 0; i < N_NEAR; ++i) {
    const double before = i > 0 ? in[i - 1] : 0.0;
    const double behind = i + 1 < N_NEAR ? in[i + 1] : 0.0;
    out[i] = is_mass(near, i) ? 2.0 * in[i] - before - behind : 0.0;
  }
}

/* B of the place. */
static void weigh(const Near* near, StringCoefs c, const double* place, double* out) {
  double curvature[N_NEAR];
  double flex[N_NEAR];
  double twist[N_NEAR];
  curve(near, place, curvature);
  curve(near, curvature, flex);
  curve(near, flex, twist);
  for (int i = 0; i < N_NEAR; ++i) {
    const double damped = 0.5 * (c.z0 * place[i] + c.z1 * curvature[i]);
    const double pulled = 0.25 * (c.k1 * curvature[i] + c.k2 * flex[i] + c.k3 * twist[i]);
    out[i] = place[i] - damped - pulled;
  }
}

static double product(const double* a, const double* b) {
  double sum = 0.0;
  for (int i = 0; i < N_NEAR; ++i) {
    sum += a[i] * b[i];
  }
  return sum;
}

/* Mass i's share of a finger that is `t` past the middle of them: Lagrange's. */
static double share_of(int i, double t) {
  const double at = t + N_HALF - 1;
  double share = 1.0;
  for (int k = 0; k < N_FINGER; ++k) {
    share *= k != i ? (at - k) / (i - k) : 1.0;
  }
  return share;
}

/* The finger on the masses about it; past a wall the string goes on upside down. */
static void lay(const Near* near, double t, double* place) {
  for (int i = 0; i < N_FINGER; ++i) {
    const int64_t mass = near->first + REACH + i;
    const int64_t wall = mass < 1 ? 0 : near->n_masses + 1;
    const int64_t image = 2 * wall - mass - near->first;
    if (is_mass(near, REACH + i)) {
      place[REACH + i] += share_of(i, t);
    } else if (mass != wall && is_mass(near, image)) {
      place[image] -= share_of(i, t);
    }
  }
}

double finger_act(Chain* chain, double place, double weight) {
  const double at = place * (chain->n_masses + 1.0);
  const double mass = fmin(floor(at), (double)chain->n_masses);
  const Near near = {(int64_t)mass - (N_HALF - 1) - REACH, chain->n_masses};
  double e[N_NEAR] = {0};
  double b[N_NEAR];
  double u[N_NEAR] = {0};
  lay(&near, at - mass, e);
  weigh(&near, chain->now, e, b);
  for (int64_t i = 0; i < N_NEAR; ++i) {
    u[i] = is_mass(&near, i) ? (double)chain_velocity(chain, (uint32_t)(near.first + i - 1)) : 0.0;
  }
  const double inertia = product(e, b);
  if (!(inertia > 0.0)) {
    return 0.0; /* At a wall there is nothing to touch. */
  }
  const double damper = weight * 2.0 * sqrt(chain->now.k1);
  const double momentum = product(b, u);
  const double taken = damper / (inertia + 0.5 * damper) * momentum / inertia;
  for (int64_t i = REACH; i < REACH + N_FINGER; ++i) {
    if (e[i] != 0.0) {
      const uint32_t m = (uint32_t)(near.first + i - 1);
      const double change = -taken * e[i];
      chain_place(chain, m, (float)((double)chain_position(chain, m) + 0.5 * change),
                  (float)(u[i] + change));
    }
  }
  return taken * (momentum - 0.5 * taken * inertia);
}

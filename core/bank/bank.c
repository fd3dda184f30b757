#include "core/bank/bank.h"

#include <math.h>
#include <string.h>

void bank_clear(Bank* bank) {
  memset(bank, 0, sizeof(*bank));
}

void bank_add(Bank* bank, BankMode mode) {
  if (bank->n_added == BANK_MAX_MODES) {
    return;
  }
  const uint32_t k = bank->n_added++;
  bank->a[k] = mode.pole.a;
  bank->g[k] = mode.pole.g;
  bank->in[k] = mode.in;
  bank->out[0][k] = mode.out[0];
  bank->out[1][k] = mode.out[1];
  bank->n_modes = (bank->n_added + BANK_LANES - 1) / BANK_LANES * BANK_LANES;
}

void bank_rest(Bank* bank) {
  memset(bank->x, 0, sizeof(bank->x));
  memset(bank->u, 0, sizeof(bank->u));
}

double bank_level(const Bank* bank) {
  double level = 0.0;
  for (uint32_t k = 0; k < bank->n_modes; ++k) {
    level = fmax(level, fmax(fabs(bank->x[k]), fabs(bank->u[k])));
  }
  return level;
}

/* How fast mode k speeds up. */
static double step(Bank* bank, uint32_t k, double force) {
  const double d = bank->in[k] * force - bank->a[k] * bank->x[k] - bank->g[k] * bank->u[k];
  bank->u[k] += d;
  bank->x[k] += bank->u[k];
  return d;
}

/* Lanes are added one by one, whatever the vectors are. */
static double sum_of(const double lanes[BANK_LANES]) {
  double sum = 0.0;
  for (int i = 0; i < BANK_LANES; ++i) {
    sum += lanes[i];
  }
  return sum;
}

void bank_run(Bank* bank, const float* force, uint32_t n_frames, float* left, float* right) {
  for (uint32_t n = 0; n < n_frames; ++n) {
    double lanes[2][BANK_LANES] = {{0.0}};
    for (uint32_t k = 0; k < bank->n_modes; ++k) {
      const double d = step(bank, k, (double)force[n]);
      lanes[0][k % BANK_LANES] += bank->out[0][k] * d;
      lanes[1][k % BANK_LANES] += bank->out[1][k] * d;
    }
    left[n] += (float)sum_of(lanes[0]);
    right[n] += (float)sum_of(lanes[1]);
  }
}

double bank_push(Bank* bank, double force) {
  double lanes[BANK_LANES] = {0.0};
  for (uint32_t k = 0; k < bank->n_modes; ++k) {
    (void)step(bank, k, force);
    lanes[k % BANK_LANES] += bank->x[k];
  }
  return sum_of(lanes);
}

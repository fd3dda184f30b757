#include "core/bank/bank.h"

#include <assert.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

void bank_clear(Bank* bank) {
  memset(bank, 0, sizeof(*bank));
}

void bank_add(Bank* bank, BankMode mode) {
  assert((uintptr_t)bank->a % BANK_ALIGNMENT == 0);
  if (bank->n_added == BANK_MAX_MODES) {
    return;
  }
  const uint32_t k = bank->n_added++;
  bank->a[k] = mode.pole.a;
  bank->g[k] = mode.pole.g;
  bank->in[k] = mode.in;
  bank->out[0][k] = mode.out[0];
  bank->out[1][k] = mode.out[1];
  bank->kernel = bank->kernel ? bank->kernel : bank_kernel(0);
  bank->n_modes = (bank->n_added + BANK_LANES - 1) / BANK_LANES * BANK_LANES;
}

void bank_rest(Bank* bank) {
  memset(bank->x, 0, sizeof(bank->x));
  memset(bank->u, 0, sizeof(bank->u));
}

static double larger(double level, double value) {
  return fabs(value) > level ? fabs(value) : level;
}

/* Lane by lane, so that the compiler makes vectors of it. */
double bank_level(const Bank* bank) {
  double lanes[BANK_LANES] = {0.0};
  for (uint32_t k = 0; k < bank->n_modes; k += BANK_LANES) {
    for (uint32_t l = 0; l < BANK_LANES; ++l) {
      lanes[l] = larger(larger(lanes[l], bank->x[k + l]), bank->u[k + l]);
    }
  }
  double level = 0.0;
  for (uint32_t l = 0; l < BANK_LANES; ++l) {
    level = larger(level, lanes[l]);
  }
  return level;
}

static BankWork work_of(Bank* bank) {
  return (BankWork){
      .n_groups = bank->n_modes / BANK_LANES,
      .a = bank->a,
      .g = bank->g,
      .in = bank->in,
      .left = bank->out[0],
      .right = bank->out[1],
      .x = bank->x,
      .u = bank->u,
  };
}

void bank_run(Bank* bank, const float* force, uint32_t n_frames, float* left, float* right) {
  if (bank->n_modes > 0) {
    const BankWork work = work_of(bank);
    bank->kernel->run(&work, force, n_frames, left, right);
  }
}

double bank_push(Bank* bank, double force) {
  if (bank->n_modes == 0) {
    return 0.0;
  }
  const BankWork work = work_of(bank);
  return bank->kernel->push(&work, force);
}

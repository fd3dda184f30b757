#include "core/voice/ledger.h"

#include <math.h>

/* How much more energy it may have than was given to it: 1.5 dB. */
static const double MOST_MORE = 1.4;

/* How much more it may have before it is taken for fed. */
static const double MORE = 1.15;

/* What a unit of energy adds to the square. */
static double per_energy(const Chain* chain) {
  const double a = tuning_mode(chain->now, chain->n_masses, 1).a;
  return 4.0 / ((chain->n_masses + 1.0) * (a - 0.25 * a * a));
}

static void age(Ledger* ledger, const Chain* chain, double square) {
  const double radius = fmax(pole_radius(tuning_mode(chain->now, chain->n_masses, 1)),
                             pole_radius(tuning_mode(chain->goal, chain->n_masses, 1)));
  const double left = pow(radius, 2.0 * ledger->n_unseen);
  const double given = fmax(0.0, ledger->given);
  ledger->given = square > MORE * given ? left * given : fmin(given, square);
  ledger->lent *= left;
  ledger->n_unseen = 0;
}

double ledger_square(const Chain* chain) {
  return chain_energy(chain) * per_energy(chain);
}

void ledger_credit(Ledger* ledger, const Chain* chain, double work) {
  ledger->work += work;
  ledger->given += work * per_energy(chain);
}

void ledger_lend(Ledger* ledger, double square) {
  ledger->lent = isfinite(ledger->lent) ? fmax(ledger->lent, square) : square;
}

double ledger_settle(Ledger* ledger, const Chain* chain) {
  const double square = ledger_square(chain);
  age(ledger, chain, square);
  const double most = MOST_MORE * fmax(ledger->given, ledger->lent);
  return square > most ? fmax(most / square, LEDGER_LEAST_KEPT) : 1.0;
}

#include "core/excite/pluck.h"

#include "core/base/maths.h"

#include <math.h>

/* Half the width of the softest finger and of the hardest pick, as fractions of the length. */
static const double SOFTEST = 0.3;
static const double HARDEST = 0.005;

/* Half the width below which a raised cosine would excite the mode that the masses cannot carry
 * [masses]. */
static const double NARROWEST = 2.0;

static double raised_cosine(double distance) {
  return fabs(distance) < 1.0 ? 0.5 + 0.5 * cos(PI * distance) : 0.0;
}

void pluck_add(Chain* chain, Pluck pluck, double angle1) {
  const double length = chain->n_masses + 1.0;
  const double width = fmax(NARROWEST, length * SOFTEST * pow(HARDEST / SOFTEST, pluck.hardness));
  const double centre = fmin(fmax(pluck.place * length, 1.0), (double)chain->n_masses);
  const uint32_t first = (uint32_t)fmax(1.0, ceil(centre - width));
  const uint32_t last = (uint32_t)fmin((double)chain->n_masses, floor(centre + width));
  double sum = 0.0;
  for (uint32_t i = first; i <= last; ++i) {
    sum += raised_cosine((i - centre) / width);
  }
  const double momentum = pluck.amplitude * length * (2.0 / PI) * sin(angle1);
  for (uint32_t i = first; i <= last; ++i) {
    chain_push(chain, i - 1, (float)(momentum / sum * raised_cosine((i - centre) / width)));
  }
}

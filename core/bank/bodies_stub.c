#include "core/bank/bodies.h"
#include <math.h>
const Body* bodies_shipped(BodiesChoice choice) {
  static Body made[BODIES_COUNT];
  if (choice == BODIES_NONE || choice >= BODIES_FILE)
    return 0;
  Body* b = &made[choice];
  if (!b->n_modes) {
    double f = 105;
    unsigned s = 12345u + (unsigned)choice * 77u;
    while (f < 8000 && b->n_modes < 128) {
      s = s * 1664525u + 1013904223u;
      double r = (double)(s >> 8) / 16777216.0;
      s = s * 1664525u + 1013904223u;
      double q = (double)(s >> 8) / 16777216.0;
      b->modes[b->n_modes++] =
          (BodyMode){f, 20 + 20 * r, 0.1 + 0.4 * q, {q > 0.5 ? 1 : -1, r > 0.5 ? 1 : -1}};
      f += 30 + 60 * r + f * 0.01;
    }
    body_level(b);
  }
  return b;
}

#include "core/harp/harp_patch.h"

#include <math.h>

static double fold(double place) {
  const double inside = fabs(place);
  return inside > 1.0 ? 2.0 - inside : inside;
}

void harp_patch_pickups(const HarpPatch* patch, Pickup places[PICKUPS]) {
  const double half = 0.5 * patch->spread;
  const bool is_pair = patch->spread > 0.0;
  places[0] = (Pickup){patch->pickup_type, fold(patch->pickup - half), false};
  places[1] = (Pickup){patch->pickup_type, fold(patch->pickup + half), is_pair};
}

#include "core/play/zones.h"

#include "core/base/maths.h"

/* Channels that two zones can share out between their members. */
enum { BETWEEN_LEADERS = ZONES_CHANNELS - 2 };

void zones_set(Zones* zones, uint32_t leader, uint32_t n_members) {
  const bool is_lower = leader == ZONES_LOWER;
  uint32_t* const n_own = is_lower ? &zones->n_lower : &zones->n_upper;
  uint32_t* const n_other = is_lower ? &zones->n_upper : &zones->n_lower;
  *n_own = n_members;
  if (n_members > 0) {
    *n_other = least(*n_other, BETWEEN_LEADERS - least(n_members, BETWEEN_LEADERS));
  }
}

bool zones_has(const Zones* zones, uint32_t leader, uint32_t channel) {
  return leader == ZONES_LOWER ? zones->n_lower > 0 && channel <= zones->n_lower
                               : zones->n_upper > 0 && channel + zones->n_upper >= ZONES_UPPER;
}

uint32_t zones_leader(const Zones* zones, uint32_t channel) {
  if (zones_has(zones, ZONES_LOWER, channel)) {
    return ZONES_LOWER;
  }
  return zones_has(zones, ZONES_UPPER, channel) ? ZONES_UPPER : channel;
}

uint32_t zones_seat(const Zones* zones, uint32_t channel) {
  if (zones_has(zones, ZONES_LOWER, channel)) {
    return channel == ZONES_LOWER ? ZONES_CHANNELS : channel - ZONES_LOWER - 1;
  }
  if (zones_has(zones, ZONES_UPPER, channel)) {
    return channel == ZONES_UPPER ? ZONES_CHANNELS : ZONES_UPPER - channel - 1;
  }
  return channel;
}

bool zones_agree(const Zones* a, const Zones* b, uint32_t channel) {
  return zones_has(a, ZONES_LOWER, channel) == zones_has(b, ZONES_LOWER, channel) &&
         zones_has(a, ZONES_UPPER, channel) == zones_has(b, ZONES_UPPER, channel);
}

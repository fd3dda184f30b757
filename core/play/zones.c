#include "core/play/zones.h"

/* Channels that two zones can share out between their members. */
enum { BETWEEN_LEADERS = ZONES_CHANNELS - 2 };

static uint32_t least(uint32_t a, uint32_t b) {
  return a < b ? a : b;
}

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

uint32_t zones_hand(const Zones* zones, uint32_t channel) {
  const bool is_in_zone =
      zones_has(zones, ZONES_LOWER, channel) || zones_has(zones, ZONES_UPPER, channel);
  const uint32_t first_outside = zones->n_lower > 0 ? zones->n_lower + 1 : 0;
  return is_in_zone ? channel : first_outside;
}

uint32_t zones_leader(const Zones* zones, uint32_t hand) {
  if (zones_has(zones, ZONES_LOWER, hand)) {
    return ZONES_LOWER;
  }
  return zones_has(zones, ZONES_UPPER, hand) ? ZONES_UPPER : hand;
}

bool zones_agree(const Zones* a, const Zones* b, uint32_t channel) {
  return zones_hand(a, channel) == zones_hand(b, channel) &&
         zones_has(a, ZONES_LOWER, channel) == zones_has(b, ZONES_LOWER, channel) &&
         zones_has(a, ZONES_UPPER, channel) == zones_has(b, ZONES_UPPER, channel);
}

#include "core/harp/harp_members.h"

#include <math.h>

/* A second direction that nobody would hear. */
static const double LEAST_SECOND = 1e-4;

HarpGroup harp_members_group(const HarpPatch* patch) {
  const bool has_second = patch->exciter != EXCITER_BOW && patch->second >= LEAST_SECOND;
  return (HarpGroup){patch->unisons, has_second ? patch->second : 0.0};
}

/* From -1/2 to 1/2. */
static double place_of(uint32_t i, uint32_t n) {
  return n > 1 ? (double)i / (double)(n - 1) - 0.5 : 0.0;
}

void harp_members_place(const HarpPatch* patch, HarpGroup group, HarpMember members[HARP_MEMBERS]) {
  const uint32_t n = group.n_unisons > 1 ? group.n_unisons : 1;
  const double m = group.second;
  const double apart = m > 0.0 ? patch->second_detune : 0.0;
  for (uint32_t i = 0; i < HARP_UNISONS; ++i) {
    const double middle = patch->unison_detune * place_of(i, n);
    const double share = i < n ? 1.0 / (n * (1.0 + m)) : 0.0;
    members[i] = (HarpMember){share, middle - apart * m * m / (1.0 + m * m), 1.0};
    members[HARP_UNISONS + i] =
        (HarpMember){m * share, middle + apart / (1.0 + m * m), patch->second_decay};
  }
}

/* Where a member is after the time. */
typedef struct {
  double share;
  double fall;
  double left; /* e^(−fall) */
  double turn; /* Ahead of the key's own */
  double re, im;
} Turned;

static Turned turn_member(const HarpMember* member, double fall, double turn) {
  const double own = fall / member->decay;
  const double ahead = turn * member->cents * log(2.0) / 1200.0;
  return (Turned){member->share, own, exp(-own), ahead, cos(ahead), sin(ahead)};
}

/* Re (1 − e^(−s))/s */
static double mean_of_falling(const Turned* a, const Turned* b) {
  const double fall = a->fall + b->fall;
  const double turn = a->turn - b->turn;
  const double left = a->left * b->left;
  const double square = fall * fall + turn * turn;
  const double re = left * (a->re * b->re + a->im * b->im);
  const double im = left * (a->im * b->re - a->re * b->im);
  return square < 1e-12 ? 1.0 - 0.5 * fall : (fall * (1.0 - re) + turn * im) / square;
}

/* Of cos(turn t) from −1/2 to 1/2. */
static double mean_of_held(const Turned* a, const Turned* b) {
  const double half = 0.5 * (a->turn - b->turn);
  return fabs(half) < 1e-6 ? 1.0 : sin(half) / half;
}

double harp_members_kept(const HarpMember members[HARP_MEMBERS], double fall, double turn) {
  Turned turned[HARP_MEMBERS];
  uint32_t n = 0;
  double sum = 0.0;
  for (uint32_t i = 0; i < HARP_MEMBERS; ++i) {
    if (members[i].share > 0.0) {
      turned[n++] = turn_member(&members[i], fall, turn);
    }
  }
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t k = 0; k <= i; ++k) {
      const double mean = fall > 0.0 ? mean_of_falling(&turned[i], &turned[k])
                                     : mean_of_held(&turned[i], &turned[k]);
      sum += (k < i ? 2.0 : 1.0) * turned[i].share * turned[k].share * mean;
    }
  }
  return sum;
}

bool harp_members_lie_alike(const HarpPatch* a, const HarpPatch* b) {
  return a->unison_detune == b->unison_detune && a->second_detune == b->second_detune &&
         a->second_decay == b->second_decay;
}

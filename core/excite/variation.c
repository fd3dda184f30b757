#include "core/excite/variation.h"

#include "core/base/chance.h"
#include "core/base/maths.h"

enum { PLACE, HARDNESS, LEVEL };

Pluck variation_of(Variation variation, uint32_t key, uint32_t n_before, Pluck asked) {
  if (variation.amount == 0.0) {
    return asked;
  }
  const uint64_t note = chance_bits(chance_bits(variation.take, key), n_before);
  const double amount = variation.amount;
  const double from_wall = fmin(asked.place, 1.0 - asked.place) *
                           (1.0 + VARIATION_PLACE * amount * chance_even(note, PLACE));
  const double harder = VARIATION_HARDNESS * amount * chance_even(note, HARDNESS);
  const double louder_db = VARIATION_LEVEL_DB * amount * chance_even(note, LEVEL);
  Pluck played = asked;
  played.place = asked.place > 0.5 ? 1.0 - from_wall : from_wall;
  played.hardness = clamp(asked.hardness + harder, 0.0, 1.0);
  played.amplitude = asked.amplitude * pow(10.0, louder_db / 20.0);
  return played;
}

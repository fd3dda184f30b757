#include "core/chain_dither.h"

/* Each of these takes the numbers from 0 to 255 to themselves in another order. */
#define SPREAD(i, lane) ((((i) + 37 * (lane)) * 167 + 91) & 255)
#define FOLD(n) ((n) ^ ((n) >> 4))
#define STIR(n) ((FOLD(n) * 113 + 29) & 255)
#define SHUFFLED(i, lane) FOLD(STIR(STIR(SPREAD((i)&255, lane))))

#define VALUE(i, lane) (((float)SHUFFLED(i, lane) + 0.5f) / 256.0f - 0.5f)
#define PLACE(i)                                                                                   \
  {                                                                                                \
    VALUE(i, 0), VALUE(i, 1), VALUE(i, 2), VALUE(i, 3), VALUE(i, 4), VALUE(i, 5), VALUE(i, 6),     \
        VALUE(i, 7)                                                                                \
  }

#define PLACES4(i) PLACE(i), PLACE((i) + 1), PLACE((i) + 2), PLACE((i) + 3)
#define PLACES16(i) PLACES4(i), PLACES4((i) + 4), PLACES4((i) + 8), PLACES4((i) + 12)
#define PLACES64(i) PLACES16(i), PLACES16((i) + 16), PLACES16((i) + 32), PLACES16((i) + 48)
#define PLACES256(i) PLACES64(i), PLACES64((i) + 64), PLACES64((i) + 128), PLACES64((i) + 192)

_Alignas(CHAIN_ALIGNMENT) const
    float chain_dither[CHAIN_DITHER_PLACES][CHAIN_MAX_LANES] = {PLACES256(0), PLACES256(256)};

/* Any bytes are a mapping that tunes keys, or are refused with a word on which line and why. */
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/scala_claims.h"

#include <stdlib.h>
#include <string.h>

static void claim_degree(int32_t degree) {
  FUZZ_CLAIM(degree == SCALE_UNMAPPED ||
             (degree >= -SCALE_MAX_DEGREE && degree <= SCALE_MAX_DEGREE));
}

static void claim_map(const ScaleMap* map) {
  FUZZ_CLAIM(map->n_entries <= SCALE_MAX_PATTERN);
  FUZZ_CLAIM(map->first_key < SCALE_KEYS && map->last_key < SCALE_KEYS);
  FUZZ_CLAIM(map->middle_key < SCALE_KEYS && map->reference_key < SCALE_KEYS);
  FUZZ_CLAIM(map->reference_hz >= SCALE_MIN_HZ && map->reference_hz <= SCALE_MAX_HZ);
  for (uint32_t i = 0; i < map->n_entries; ++i) {
    claim_degree(map->degrees[i]);
  }
}

/* A scale of a few notes, of none, and the usual one. */
static void claim_tuned(const ScaleMap* map) {
  static const char fifths[] = "fifths\n2\n3/2\n9/4\n";
  static Scale scale;
  ScaleError error;
  scale_equal(&scale);
  scala_claim_tuned(&scale, map);
  FUZZ_CLAIM(!scale_read(fifths, sizeof(fifths) - 1, &scale, &error));
  scala_claim_tuned(&scale, map);
  scale_free(&scale);
  scala_claim_tuned(&scale, map);
}

void fuzz_one(const uint8_t* bytes, size_t n_bytes) {
  static ScaleMap map, before;
  ScaleError error;
  memset(&before, 0x5A, sizeof(before));
  map = before;
  uint8_t* const text = fuzz_copy(bytes, n_bytes);
  const Status status = scale_map_read((const char*)text, n_bytes, &map, &error);
  free(text);
  FUZZ_CLAIM(status == STATUS_OK || status == STATUS_BAD_TEXT);
  if (status) {
    FUZZ_CLAIM(!memcmp(&map, &before, sizeof(map)));
    scala_claim_error(&error, bytes, n_bytes);
  } else {
    claim_map(&map);
    claim_tuned(&map);
    scale_map_free(&map);
  }
}

/* Any bytes are a scale that tunes all keys, or are refused with a word on which line and why. */
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/scala_claims.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void claim_scale(const Scale* scale) {
  FUZZ_CLAIM(scale->n_notes <= SCALE_MAX_NOTES);
  for (uint32_t i = 0; i < scale->n_notes; ++i) {
    const ScalePitch* const pitch = &scale->pitches[i];
    FUZZ_CLAIM(fabs(pitch->cents) <= SCALE_MAX_CENTS);
    FUZZ_CLAIM(pitch->over >= 1.0 && pitch->over <= SCALE_MAX_TERM);
    FUZZ_CLAIM(pitch->under >= 1.0 && pitch->under <= SCALE_MAX_TERM);
  }
}

void fuzz_one(const uint8_t* bytes, size_t n_bytes) {
  static Scale scale, before;
  static ScaleMap map;
  ScaleError error;
  memset(&before, 0x5A, sizeof(before));
  scale = before;
  scale_map_linear(&map);
  uint8_t* const text = fuzz_copy(bytes, n_bytes);
  const Status status = scale_read((const char*)text, n_bytes, &scale, &error);
  free(text);
  FUZZ_CLAIM(status == STATUS_OK || status == STATUS_BAD_TEXT);
  if (status) {
    FUZZ_CLAIM(!memcmp(&scale, &before, sizeof(scale)));
    scala_claim_error(&error, bytes, n_bytes);
  } else {
    claim_scale(&scale);
    scala_claim_tuned(&scale, &map);
    scale_free(&scale);
  }
}

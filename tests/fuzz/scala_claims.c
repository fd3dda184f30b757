#define _POSIX_C_SOURCE 200809L

#include "tests/fuzz/scala_claims.h"

#include "tests/fuzz/fuzz.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

static void claim_text(const char* text, size_t room) {
  const size_t length = strnlen(text, room);
  FUZZ_CLAIM(length > 0 && length < room);
  for (size_t i = 0; i < length; ++i) {
    FUZZ_CLAIM(text[i] >= ' ' && text[i] <= '~');
  }
}

void scala_claim_error(const ScaleError* error, const uint8_t* bytes, size_t n_bytes) {
  unsigned n_lines = 1;
  for (size_t i = 0; i < n_bytes; ++i) {
    n_lines += bytes[i] == '\n' || bytes[i] == '\r';
  }
  FUZZ_CLAIM(error->line >= 1 && error->line <= n_lines);
  claim_text(error->found, sizeof(error->found));
  claim_text(error->expected, sizeof(error->expected));
}

void scala_claim_tuned(const Scale* scale, const ScaleMap* map) {
  static const double a4_hz[] = {400.0, 440.0, 480.0};
  for (int i = 0; i < 3; ++i) {
    double hz[SCALE_KEYS];
    FUZZ_CLAIM(scale_tune(scale, map, a4_hz[i], hz) == STATUS_OK);
    for (int key = 0; key < SCALE_KEYS; ++key) {
      FUZZ_CLAIM(isnan(hz[key]) || (hz[key] >= SCALE_MIN_HZ && hz[key] <= SCALE_MAX_HZ));
    }
  }
}

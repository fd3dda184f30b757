/* Any bytes are a body that a bank can play, or are refused with a word on which line and why. */
#include "core/bank/body_read.h"

#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/scala_claims.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void claim_mode(const BodyMode* mode) {
  FUZZ_CLAIM(mode->f0_hz >= 1.0 && mode->f0_hz <= 1e5);
  FUZZ_CLAIM(mode->q > 0.5 && mode->q <= 1e6);
  FUZZ_CLAIM(mode->mass_kg > 0.0 && isfinite(mode->mass_kg));
  FUZZ_CLAIM(isfinite(mode->radiation[0]) && isfinite(mode->radiation[1]));
}

static void claim_body(const Body* body) {
  FUZZ_CLAIM(body->n_modes > 0 && body->n_modes <= BODY_MAX_MODES);
  for (uint32_t k = 0; k < body->n_modes; ++k) {
    claim_mode(&body->modes[k]);
    FUZZ_CLAIM(k == 0 || body->modes[k].f0_hz >= body->modes[k - 1].f0_hz);
  }
  for (int band = 0; band < BODY_BANDS; ++band) {
    FUZZ_CLAIM(isfinite(body->power[band]) && body->power[band] >= 0.0);
  }
}

/* Both kinds of file complain alike. */
static void claim_error(const BodyError* error, const uint8_t* bytes, size_t n_bytes) {
  ScaleError alike = {.line = error->line};
  FUZZ_CLAIM(memchr(error->found, '\0', sizeof(error->found)));
  FUZZ_CLAIM(memchr(error->expected, '\0', sizeof(error->expected)));
  (void)snprintf(alike.found, sizeof(alike.found), "%s", error->found);
  (void)snprintf(alike.expected, sizeof(alike.expected), "%s", error->expected);
  scala_claim_error(&alike, bytes, n_bytes);
}

void fuzz_one(const uint8_t* bytes, size_t n_bytes) {
  static Body body, before;
  BodyError error;
  memset(&before, 0x5A, sizeof(before));
  memcpy(&body, &before, sizeof(body));
  uint8_t* const text = fuzz_copy(bytes, n_bytes);
  const Status status = body_read((const char*)text, n_bytes, &body, &error);
  free(text);
  FUZZ_CLAIM(status == STATUS_OK || status == STATUS_BAD_TEXT);
  if (status) {
    FUZZ_CLAIM(!memcmp(&body, &before, sizeof(body)));
    claim_error(&error, bytes, n_bytes);
  } else {
    claim_body(&body);
  }
}

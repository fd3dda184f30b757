/* Any bytes are a body that can be played, or are refused with a word on which line and why. */
#include "tests/fuzz/fuzz.h"

#include "core/bank/body_read.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void claim_body(const Body* body) {
  FUZZ_CLAIM(body->n_modes >= 1 && body->n_modes <= BODY_MAX_MODES);
  for (uint32_t k = 0; k < body->n_modes; ++k) {
    const BodyMode* const mode = &body->modes[k];
    FUZZ_CLAIM(k == 0 || mode->f0_hz >= body->modes[k - 1].f0_hz);
    FUZZ_CLAIM(mode->f0_hz >= 1.0 && mode->f0_hz <= 1e5 && mode->q > 0.5 && mode->q <= 1e6);
    FUZZ_CLAIM(mode->mass_kg > 0.0 && isfinite(mode->mass_kg));
    FUZZ_CLAIM(isfinite(mode->radiation[0]) && isfinite(mode->radiation[1]));
  }
  for (int band = 0; band < BODY_BANDS; ++band) {
    FUZZ_CLAIM(body->power[band] >= 0.0 && isfinite(body->power[band]));
  }
}

/* Some pushes at the strings are heard as numbers. */
static void claim_sound(const Body* body) {
  static Bank bank;
  enum { N_FRAMES = 64 };
  float force[N_FRAMES] = {1.0F};
  float heard[2][N_FRAMES] = {{0.0F}};
  body_bank(body, (BodyShape){1.0, 1.0}, 48000.0, &bank);
  bank_run(&bank, force, N_FRAMES, heard[0], heard[1]);
  for (int n = 0; n < N_FRAMES; ++n) {
    FUZZ_CLAIM(!isnan(heard[0][n]) && !isnan(heard[1][n]));
  }
}

static void claim_error(const BodyError* error, const uint8_t* bytes, size_t n_bytes) {
  unsigned n_lines = 1;
  for (size_t i = 0; i < n_bytes; ++i) {
    n_lines += bytes[i] == '\n' ? 1 : 0;
  }
  FUZZ_CLAIM(error->line >= 1 && error->line <= n_lines);
  FUZZ_CLAIM(memchr(error->found, '\0', sizeof(error->found)) && error->found[0]);
  FUZZ_CLAIM(memchr(error->expected, '\0', sizeof(error->expected)) && error->expected[0]);
  for (const char* at = error->found; *at; ++at) {
    FUZZ_CLAIM(*at >= ' ' && *at <= '~');
  }
}

void fuzz_one(const uint8_t* bytes, size_t n_bytes) {
  static Body body, before;
  BodyError error;
  memset(&before, 0x5A, sizeof(before));
  body = before;
  uint8_t* const text = fuzz_copy(bytes, n_bytes);
  const Status status = body_read((const char*)text, n_bytes, &body, &error);
  free(text);
  FUZZ_CLAIM(status == STATUS_OK || status == STATUS_BAD_TEXT);
  if (status) {
    FUZZ_CLAIM(!memcmp(&body, &before, sizeof(body)));
    claim_error(&error, bytes, n_bytes);
  } else {
    claim_body(&body);
    claim_sound(&body);
  }
}

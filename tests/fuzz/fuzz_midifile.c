/* Any bytes are a song whose messages can be played, or are refused with a word on why. */
#include "tests/fuzz/fuzz.h"
#include "tools/formats/smf.h"

#include <stdlib.h>
#include <string.h>

enum { ERROR_SIZE = 512 };

static uint32_t size_of(uint8_t status) {
  const unsigned kind = status & 0xF0U;
  return kind == 0xC0 || kind == 0xD0 ? 2 : 3;
}

static void claim_event(const SmfEvent* event, double after_s, double end_s) {
  FUZZ_CLAIM(event->time_s >= after_s && event->time_s <= end_s);
  FUZZ_CLAIM(event->size > 0 && event->bytes[0] >= 0x80 && event->bytes[0] <= 0xF0);
  FUZZ_CLAIM(event->bytes[0] == 0xF0 ? event->bytes[event->size - 1] == 0xF7
                                     : event->size == size_of(event->bytes[0]));
  for (uint32_t i = 1; i < event->size - (event->bytes[0] == 0xF0); ++i) {
    FUZZ_CLAIM(event->bytes[i] < 0x80);
  }
}

static void claim_song(const Smf* smf) {
  FUZZ_CLAIM(smf->duration_s >= 0.0 && smf->duration_s <= SMF_MAX_LENGTH_S);
  for (size_t i = 0; i < smf->n_events; ++i) {
    claim_event(&smf->events[i], i > 0 ? smf->events[i - 1].time_s : 0.0, smf->duration_s);
  }
  for (unsigned i = 0; i < SMF_N_NOTES; ++i) {
    FUZZ_CLAIM(!*smf->note[i] || strstr(smf->note[i], ": found "));
    FUZZ_CLAIM(!strchr(smf->note[i], '\n') && strlen(smf->note[i]) < SMF_NOTE_SIZE - 1);
  }
}

void fuzz_one(const uint8_t* bytes, size_t n_bytes) {
  char* const error = malloc(ERROR_SIZE);
  const char* const path = fuzz_file(bytes, n_bytes);
  Smf* const smf = smf_new(path, error, ERROR_SIZE);
  if (smf) {
    claim_song(smf);
  } else {
    fuzz_claim_message(error, path, false, bytes, n_bytes);
  }
  smf_free(smf);
  free(error);
}

/* Any bytes are a song whose messages can be played, or are refused with a word on why. */
#include "tests/fuzz/fuzz.h"
#include "tools/formats/midiclean.h"
#include "tools/formats/midifile.h"

#include <stdlib.h>
#include <string.h>

enum { ERROR_SIZE = 512 };

static const double MAX_LENGTH_S = 3600.0;

static uint32_t size_of(uint8_t status) {
  const unsigned kind = status & 0xF0U;
  return kind == 0xC0 || kind == 0xD0 ? 2 : 3;
}

static void claim_event(const MidiEvent* event, double after_s) {
  FUZZ_CLAIM(event->time_s >= after_s && event->time_s <= MAX_LENGTH_S);
  FUZZ_CLAIM(event->size > 0 && event->bytes[0] >= 0x80 && event->bytes[0] <= 0xF0);
  FUZZ_CLAIM(event->bytes[0] == 0xF0 ? event->bytes[event->size - 1] == 0xF7
                                     : event->size == size_of(event->bytes[0]));
  for (uint32_t i = 1; i < event->size - (event->bytes[0] == 0xF0); ++i) {
    FUZZ_CLAIM(event->bytes[i] < 0x80);
  }
}

static void claim_song(const MidiFile* file) {
  for (size_t i = 0; i < file->n_events; ++i) {
    claim_event(&file->events[i], i > 0 ? file->events[i - 1].time_s : 0.0);
  }
}

/* What is clean stays as it is. */
static void claim_clean(const uint8_t* bytes, size_t n_bytes) {
  char error[ERROR_SIZE];
  Bytes once = {0};
  Bytes twice = {0};
  if (midiclean(bytes, n_bytes, &once, error, sizeof(error))) {
    FUZZ_CLAIM(midiclean(once.data, once.size, &twice, error, sizeof(error)));
    FUZZ_CLAIM(once.size == twice.size && !memcmp(once.data, twice.data, once.size));
  }
  bytes_clear(&once);
  bytes_clear(&twice);
}

void fuzz_one(const uint8_t* bytes, size_t n_bytes) {
  char* const error = malloc(ERROR_SIZE);
  const char* const path = fuzz_file(bytes, n_bytes);
  MidiFile* const file = midifile_new(path, error, ERROR_SIZE);
  if (file) {
    claim_song(file);
  } else {
    fuzz_claim_message(error, path, false, bytes, n_bytes);
  }
  midifile_free(file);
  claim_clean(bytes, n_bytes);
  free(error);
}

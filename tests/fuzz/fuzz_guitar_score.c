/* Any score that can be read, played by Hooke Guitar as a host plays it: what goes out is finite
 * and bounded, and nothing sticks. */
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/plug.h"
#include "tools/formats/score.h"

#include <math.h>
#include <stdlib.h>

/* Events, and times between them [s], that are enough. */
enum { PLAYED = 64 };

static const double LONGEST_S = 0.25;
static const double RATE_HZ = 8000.0;

typedef struct {
  LV2_Atom_Sequence head;
  LV2_Atom_Event event;
  GuitarEvent body;
} OneEvent;

static void wait(Plug* plug, double time_s) {
  for (double n = fmin(time_s, LONGEST_S) * RATE_HZ; n >= 1.0; n -= PLUG_FRAMES) {
    plug_run(plug, NULL, n < PLUG_FRAMES ? (uint32_t)n : (uint32_t)PLUG_FRAMES);
  }
}

static void send(Plug* plug, const GuitarEvent* event) {
  OneEvent one = {.event.body = {sizeof(*event), plug_urid(GUITAR_EVENT_URI)}, .body = *event};
  one.head.atom = (LV2_Atom){sizeof(one) - sizeof(LV2_Atom), plug_urid(LV2_ATOM__Sequence)};
  plug_run(plug, &one.head, 1);
  ++plug->n_notes;
}

static void play(const Score* score) {
  Plug* const plug = plug_in(&plug_guitar, RATE_HZ);
  double time_s = 0.0;
  for (size_t i = 0; i < score->n_events && i < PLAYED; ++i) {
    wait(plug, score->events[i].time_s - time_s);
    time_s = score->events[i].time_s;
    send(plug, &score->events[i].event);
  }
  wait(plug, LONGEST_S);
  plug_claim_silence(plug);
}

void fuzz_one(const uint8_t* bytes, size_t n_bytes) {
  char* const error = malloc(SCORE_ERROR_SIZE);
  const char* const path = fuzz_file(bytes, n_bytes);
  Score* const score = score_new(path, error, SCORE_ERROR_SIZE);
  if (score) {
    play(score);
  } else {
    fuzz_claim_message(error, path, true, bytes, n_bytes);
  }
  score_free(score);
  free(error);
}

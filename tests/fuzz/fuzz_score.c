/* Any bytes are a score that a guitar can play, or are refused with a word on which line and why.
 */
#include "core/guitar/guitar_event.h"
#include "plugin/guitar_ports.h"
#include "tests/fuzz/fuzz.h"
#include "tools/formats/score.h"

#include <stdlib.h>
#include <string.h>

/* A strum is up to twelve; more of them than these take longer, and find nothing new. */
enum { PLAYED = 64 };

static void claim_settings(const Score* score) {
  for (size_t i = 0; i < score->n_settings; ++i) {
    const ScoreSetting* const setting = &score->settings[i];
    FUZZ_CLAIM(setting->symbol && strlen(setting->symbol) > 0 && setting->line >= 1);
    FUZZ_CLAIM(!setting->text || strlen(setting->text) < SCORE_MAX_LINE);
  }
  FUZZ_CLAIM(!score->preset || score->preset_line >= 1);
}

static void claim_order(const Score* score) {
  double time_s = 0.0;
  FUZZ_CLAIM(score->n_events >= 1 && score->n_events <= SCORE_MAX_EVENTS);
  for (size_t i = 0; i < score->n_events; ++i) {
    const ScoreEvent* const event = &score->events[i];
    FUZZ_CLAIM(event->time_s >= time_s && event->time_s <= SCORE_MAX_TIME_S);
    FUZZ_CLAIM(event->event.string < SCORE_STRINGS && event->line >= 1);
    time_s = event->time_s;
  }
  FUZZ_CLAIM(score->duration_s == time_s);
}

/* A guitar takes no event that is not in range. */
static void claim_playable(const Score* score) {
  static Guitar* guitar;
  const GuitarPatch patch = guitar_ports_usual();
  guitar = guitar ? guitar : guitar_new(8000.0);
  guitar_set_patch(guitar, &patch, 0);
  guitar_reset(guitar);
  for (size_t i = 0; i < score->n_events && i < PLAYED; ++i) {
    FUZZ_CLAIM(guitar_event_play(guitar, &score->events[i].event));
  }
}

void fuzz_one(const uint8_t* bytes, size_t n_bytes) {
  char* const error = malloc(SCORE_ERROR_SIZE);
  const char* const path = fuzz_file(bytes, n_bytes);
  Score* const score = score_new(path, error, SCORE_ERROR_SIZE);
  if (score) {
    claim_settings(score);
    claim_order(score);
    claim_playable(score);
  } else {
    fuzz_claim_message(error, path, true, bytes, n_bytes);
  }
  score_free(score);
  free(error);
}

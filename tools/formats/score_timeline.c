#include "tools/formats/score_timeline.h"

#include <stdlib.h>

/* A moment, both ways. */
typedef struct {
  double time_s;
  double beats;
} Place;

typedef struct {
  ScoreEvent event;
  size_t order; // In the file
  bool is_stop;
} Entry;

static bool fail_memory(ScoreReader* reader) {
  return scene_text_fail_at(&reader->text, reader->text.line, "out of memory");
}

static Place place_after(const ScoreTempo* tempo, Place from, ScoreSpan span) {
  Place place;
  if (span.is_beats) {
    place.beats = from.beats + span.value;
    place.time_s = score_tempo_time_s(tempo, place.beats);
  } else {
    place.time_s = from.time_s + span.value;
    place.beats = score_tempo_beats(tempo, place.time_s);
  }
  return place;
}

static bool is_in_time(ScoreReader* reader, uint32_t line, const char* what, double value_s) {
  return value_s <= SCORE_MAX_TIME_S ||
         scene_text_fail_at(&reader->text, line, "found a %s of %g s, expected at most %g s", what,
                            value_s, SCORE_MAX_TIME_S);
}

static bool place_moments(ScoreReader* reader, Place* places) {
  const ScoreMoment* const moments = (const ScoreMoment*)(const void*)reader->moments.data;
  const size_t n = reader->moments.size / sizeof(*moments);
  const Place start = {0.0, 0.0};
  Place last = start;
  for (size_t i = 0; i < n; ++i) {
    last = place_after(&reader->tempo, moments[i].is_relative ? last : start, moments[i].at);
    places[i] = last;
    if (!is_in_time(reader, moments[i].line, "time", last.time_s)) {
      return false;
    }
  }
  return true;
}

static bool place_event(
    ScoreReader* reader, const ScorePending* pending, Place from, uint32_t line, Entry* out) {
  const Place start = place_after(&reader->tempo, from, pending->after);
  out->event = (ScoreEvent){start.time_s, line, pending->event};
  out->is_stop = pending->is_stop;
  if (pending->length_at != SCORE_NO_LENGTH) {
    const Place end = place_after(&reader->tempo, start, pending->length);
    const double length_s =
        pending->length.is_beats ? end.time_s - start.time_s : pending->length.value;
    out->event.event.value[pending->length_at] = (float)length_s;
    if (!is_in_time(reader, line, "length", length_s)) {
      return false;
    }
  }
  return is_in_time(reader, line, "time", start.time_s);
}

static bool place_events(ScoreReader* reader, const Place* places, Entry* entries) {
  const ScoreMoment* const moments = (const ScoreMoment*)(const void*)reader->moments.data;
  const ScorePending* const pending = (const ScorePending*)(const void*)reader->pending.data;
  const size_t n = reader->pending.size / sizeof(*pending);
  for (size_t i = 0; i < n; ++i) {
    const uint32_t moment = pending[i].moment;
    entries[i].order = i;
    if (!place_event(reader, &pending[i], places[moment], moments[moment].line, &entries[i])) {
      return false;
    }
  }
  return true;
}

static int compare(const void* a, const void* b) {
  const Entry* const one = a;
  const Entry* const other = b;
  if (one->event.time_s != other->event.time_s) {
    return one->event.time_s < other->event.time_s ? -1 : 1;
  }
  return one->order < other->order ? -1 : 1;
}

/* Take over what acts: the end of a vibrato does unless another one has begun on its string. */
static void fill(Score* score, const Entry* entries, size_t n) {
  uint32_t swinging[SCORE_STRINGS] = {0}; // The line that began it
  for (size_t i = 0; i < n; ++i) {
    const ScoreEvent* const event = &entries[i].event;
    uint32_t* const line = &swinging[event->event.string];
    if (entries[i].is_stop && *line != event->line) {
      continue;
    }
    if (event->event.verb == GUITAR_VIBRATO) {
      *line = event->line;
    }
    score->events[score->n_events++] = *event;
    score->duration_s = event->time_s;
  }
}

static bool make(ScoreReader* reader, Place* places, Entry* entries, size_t n, Score* score) {
  if (!place_moments(reader, places) || !place_events(reader, places, entries)) {
    return false;
  }
  score->events = malloc(n * sizeof(*score->events));
  if (!score->events) {
    return fail_memory(reader);
  }
  qsort(entries, n, sizeof(*entries), compare);
  fill(score, entries, n);
  return true;
}

bool score_timeline_make(ScoreReader* reader, Score* score) {
  const size_t n = reader->pending.size / sizeof(ScorePending);
  Place* const places = calloc(reader->moments.size / sizeof(ScoreMoment) + 1, sizeof(*places));
  Entry* const entries = calloc(n, sizeof(*entries));
  const bool is_ok = places && entries && score_tempo_finish(&reader->tempo)
                         ? make(reader, places, entries, n, score)
                         : fail_memory(reader);
  free(places);
  free(entries);
  return is_ok;
}

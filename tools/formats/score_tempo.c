#include "tools/formats/score_tempo.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

typedef struct {
  ScoreSpan from;
  double beats_per_s;
  size_t order; /* In which they were added */
} Change;

typedef struct {
  double time_s; /* Where it begins, both ways */
  double beats;
  double beats_per_s;
} Piece;

static const double SECONDS_PER_MINUTE = 60.0;

/* Those in seconds before those in beats, each by their moments. */
static int compare(const void* a, const void* b) {
  const Change* const one = a;
  const Change* const other = b;
  if (one->from.is_beats != other->from.is_beats) {
    return one->from.is_beats ? 1 : -1;
  }
  if (one->from.value != other->from.value) {
    return one->from.value < other->from.value ? -1 : 1;
  }
  return one->order < other->order ? -1 : 1;
}

static double time_in(const Piece* piece, double beats) {
  return piece->time_s + (beats - piece->beats) / piece->beats_per_s;
}

static double beats_in(const Piece* piece, double time_s) {
  return piece->beats + (time_s - piece->time_s) * piece->beats_per_s;
}

/* The piece that a change begins, behind the last one; rounding must not turn time back. */
static Piece begin(const Piece* last, const Change* change) {
  Piece piece = {.beats_per_s = change->beats_per_s};
  if (change->from.is_beats) {
    piece.beats = fmax(change->from.value, last->beats);
    piece.time_s = time_in(last, piece.beats);
  } else {
    piece.time_s = fmax(change->from.value, last->time_s);
    piece.beats = beats_in(last, piece.time_s);
  }
  return piece;
}

static bool is_before(const Piece* last, const Change* in_seconds, const Change* in_beats) {
  const double time_s = time_in(last, in_beats->from.value);
  return in_seconds->from.value != time_s ? in_seconds->from.value < time_s
                                          : in_seconds->order < in_beats->order;
}

/* Merge two sorted lists: what is in beats has its time only once all before it is known. */
static bool merge(ScoreTempo* tempo, const Change* changes, size_t n_in_seconds, size_t n) {
  size_t i = 0;
  size_t k = n_in_seconds;
  Piece last = {0.0, 0.0, SCORE_USUAL_TEMPO / SECONDS_PER_MINUTE};
  bool is_ok = bytes_append(&tempo->pieces, &last, sizeof(last));
  while (is_ok && (i < n_in_seconds || k < n)) {
    const bool is_in_seconds =
        k >= n || (i < n_in_seconds && is_before(&last, &changes[i], &changes[k]));
    last = begin(&last, &changes[is_in_seconds ? i++ : k++]);
    is_ok = bytes_append(&tempo->pieces, &last, sizeof(last));
  }
  return is_ok;
}

/* The last piece that begins at a place or before; the first begins at 0. */
static const Piece* find(const ScoreTempo* tempo, double place, bool is_beats) {
  const Piece* const pieces = (const Piece*)(const void*)tempo->pieces.data;
  size_t low = 0;
  size_t high = tempo->pieces.size / sizeof(*pieces);
  while (high - low > 1) {
    const size_t middle = low + (high - low) / 2;
    const double start = is_beats ? pieces[middle].beats : pieces[middle].time_s;
    *(start <= place ? &low : &high) = middle;
  }
  return &pieces[low];
}

bool score_tempo_add(ScoreTempo* tempo, ScoreSpan from, double beats_per_minute) {
  const Change change = {from, beats_per_minute / SECONDS_PER_MINUTE,
                         tempo->changes.size / sizeof(change)};
  return bytes_append(&tempo->changes, &change, sizeof(change));
}

bool score_tempo_finish(ScoreTempo* tempo) {
  Change* const changes = (Change*)(void*)tempo->changes.data;
  const size_t n = tempo->changes.size / sizeof(*changes);
  size_t n_in_seconds = 0;
  for (size_t i = 0; i < n; ++i) {
    n_in_seconds += changes[i].from.is_beats ? 0 : 1;
  }
  if (n > 1) {
    qsort(changes, n, sizeof(*changes), compare);
  }
  return merge(tempo, changes, n_in_seconds, n);
}

double score_tempo_time_s(const ScoreTempo* tempo, double beats) {
  return time_in(find(tempo, beats, true), beats);
}

double score_tempo_beats(const ScoreTempo* tempo, double time_s) {
  return beats_in(find(tempo, time_s, false), time_s);
}

void score_tempo_clear(ScoreTempo* tempo) {
  bytes_clear(&tempo->changes);
  bytes_clear(&tempo->pieces);
}

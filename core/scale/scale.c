#include "core/scale/scale.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { A4_KEY = 69, MIDDLE_C_KEY = 60, NOTES_IN_OCTAVE = 12 };

static const double A4_HZ = 440.0;
static const ScalePitch UNISON = {.cents = 0.0, .over = 1.0, .under = 1.0};

static const ScalePitch EQUAL[NOTES_IN_OCTAVE] = {
    {100.0, 1.0, 1.0}, {200.0, 1.0, 1.0},  {300.0, 1.0, 1.0},  {400.0, 1.0, 1.0},
    {500.0, 1.0, 1.0}, {600.0, 1.0, 1.0},  {700.0, 1.0, 1.0},  {800.0, 1.0, 1.0},
    {900.0, 1.0, 1.0}, {1000.0, 1.0, 1.0}, {1100.0, 1.0, 1.0}, {1200.0, 1.0, 1.0},
};

static int32_t floor_of(int32_t number, int32_t by) {
  return number / by - (number % by < 0 ? 1 : 0);
}

static bool is_degree(int32_t degree) {
  return degree >= -SCALE_MAX_DEGREE && degree <= SCALE_MAX_DEGREE;
}

static bool has_good_entries(const ScaleMap* map) {
  for (uint32_t i = 0; i < map->n_entries; ++i) {
    if (map->degrees[i] != SCALE_UNMAPPED && !is_degree(map->degrees[i])) {
      return false;
    }
  }
  return true;
}

static bool is_good_map(const ScaleMap* map) {
  return map->n_entries <= SCALE_MAX_PATTERN && map->first_key <= map->last_key &&
         map->last_key < SCALE_KEYS && map->middle_key < SCALE_KEYS &&
         map->reference_key < SCALE_KEYS && map->reference_hz >= SCALE_MIN_HZ &&
         map->reference_hz <= SCALE_MAX_HZ && is_degree(map->octave_degree) &&
         has_good_entries(map);
}

static int32_t degree_of(const Scale* scale, const ScaleMap* map, int32_t key) {
  const int32_t from_middle = key - (int32_t)map->middle_key;
  const int32_t n_entries = (int32_t)map->n_entries;
  if (n_entries == 0) {
    return from_middle;
  }
  const int32_t octave = map->octave_degree ? map->octave_degree : (int32_t)scale->n_notes;
  const int32_t pattern = floor_of(from_middle, n_entries);
  const int32_t degree = map->degrees[from_middle - pattern * n_entries];
  return degree == SCALE_UNMAPPED ? SCALE_UNMAPPED : degree + pattern * octave;
}

static ScalePitch pitch_at(const Scale* scale, int32_t degree_in_period) {
  return degree_in_period == 0 ? UNISON : scale->pitches[degree_in_period - 1];
}

/* What over / under loses to rounding would grow with the power, so it is put back. */
static double power(ScalePitch pitch, double exponent) {
  const double ratio = pitch.over / pitch.under;
  const double lost = fma(-ratio, pitch.under, pitch.over) / pitch.over;
  return pow(ratio, exponent) * (1.0 + exponent * lost);
}

/* Cents are summed before they are raised, so that whole octaves and equal steps come out exact. */
static double interval(const Scale* scale, int32_t from_degree, int32_t to_degree) {
  const int32_t n_notes = (int32_t)scale->n_notes;
  if (n_notes == 0) {
    return 1.0;
  }
  const int32_t from_period = floor_of(from_degree, n_notes);
  const int32_t to_period = floor_of(to_degree, n_notes);
  const ScalePitch from = pitch_at(scale, from_degree - from_period * n_notes);
  const ScalePitch to = pitch_at(scale, to_degree - to_period * n_notes);
  const ScalePitch period = scale->pitches[n_notes - 1];
  const double n_periods = (double)(to_period - from_period);
  const double cents = to.cents - from.cents + n_periods * period.cents;
  const double ratio = (to.over * from.under) / (to.under * from.over);
  return exp2(cents / 1200.0) * (ratio * power(period, n_periods));
}

/* The degree of the nearest key from the reference on that has one, `step` by `step`. */
static int32_t nearest_degree(const Scale* scale, const ScaleMap* map, int32_t step) {
  int32_t key = (int32_t)map->reference_key;
  int32_t degree = degree_of(scale, map, key);
  for (uint32_t i = 0; i < map->n_entries && degree == SCALE_UNMAPPED; ++i) {
    key += step;
    degree = degree_of(scale, map, key);
  }
  return degree;
}

/* What a reference is between, which are the same if it has a degree of its own. */
typedef struct {
  int32_t below;
  int32_t above;
} Reference;

static double from_reference(const Scale* scale, Reference reference, int32_t degree) {
  const double below = interval(scale, reference.below, degree);
  return reference.below == reference.above
             ? below
             : sqrt(below) * sqrt(interval(scale, reference.above, degree));
}

static double in_range(double hz) {
  return hz >= SCALE_MIN_HZ && hz <= SCALE_MAX_HZ ? hz : (double)NAN;
}

/* Neither a map nor an A4 of 440 Hz may cost the other a bit. */
static double reference_hz(const ScaleMap* map, double a4_hz) {
  return map->reference_hz == A4_HZ ? a4_hz : map->reference_hz * (a4_hz / A4_HZ);
}

void scale_equal(Scale* scale) {
  *scale = (Scale){.n_notes = NOTES_IN_OCTAVE, .pitches = EQUAL};
}

void scale_map_linear(ScaleMap* map) {
  *map = (ScaleMap){
      .last_key = SCALE_KEYS - 1,
      .middle_key = MIDDLE_C_KEY,
      .reference_key = A4_KEY,
      .reference_hz = A4_HZ,
  };
}

void scale_free(Scale* scale) {
  free(scale->memory);
  *scale = (Scale){.n_notes = 0};
}

void scale_map_free(ScaleMap* map) {
  free(map->degrees);
  map->degrees = NULL;
  map->n_entries = 0;
}

Status scale_tune(const Scale* scale, const ScaleMap* map, double a4_hz, double hz[SCALE_KEYS]) {
  if (scale->n_notes > SCALE_MAX_NOTES || !is_good_map(map) || !(a4_hz > 0.0) || isinf(a4_hz)) {
    return STATUS_BAD_ARGUMENT;
  }
  const Reference reference = {nearest_degree(scale, map, -1), nearest_degree(scale, map, 1)};
  if (reference.below == SCALE_UNMAPPED) {
    return STATUS_BAD_ARGUMENT;
  }
  for (uint32_t key = 0; key < SCALE_KEYS; ++key) {
    const int32_t degree = degree_of(scale, map, (int32_t)key);
    if (key < map->first_key || key > map->last_key) {
      hz[key] = in_range(a4_hz * exp2(((double)key - A4_KEY) / NOTES_IN_OCTAVE));
    } else if (degree == SCALE_UNMAPPED) {
      hz[key] = (double)NAN;
    } else {
      hz[key] = in_range(reference_hz(map, a4_hz) * from_reference(scale, reference, degree));
    }
  }
  return STATUS_OK;
}

#include "core/scale/scale_text.h"

#include <math.h>
#include <stdlib.h>

static bool take_whole(ScaleText* text, double min, double max, double* whole) {
  ScaleNumber number;
  if (!scale_text_number(text, &number) || number.has_point || !scale_text_is_end(text) ||
      !(number.value >= min) || !(number.value <= max)) {
    return false;
  }
  *whole = number.value;
  return true;
}

static bool read_whole(ScaleText* text, const char* what, double min, double max, double* whole) {
  const bool is_there = scale_text_next_value(text);
  return (is_there && take_whole(text, min, max, whole)) ||
         scale_text_fail(text, !is_there, "%s, from %.0f to %.0f", what, min, max);
}

static bool read_count(ScaleText* text, const char* what, uint32_t max, uint32_t* count) {
  double whole = 0.0;
  if (!read_whole(text, what, 0.0, max, &whole)) {
    return false;
  }
  *count = (uint32_t)whole;
  return true;
}

static bool is_term(const ScaleNumber* number) {
  return number->value >= 1.0 && number->value <= SCALE_MAX_TERM;
}

static bool take_ratio(ScaleText* text, ScaleNumber over, ScalePitch* pitch) {
  ScaleNumber under = {.value = 1.0};
  if (scale_text_take(text, '/') && (!scale_text_number(text, &under) || under.has_point)) {
    return false;
  }
  *pitch = (ScalePitch){.over = over.value, .under = under.value};
  return is_term(&over) && is_term(&under) && scale_text_is_end(text);
}

static bool take_cents(ScaleText* text, ScaleNumber cents, ScalePitch* pitch) {
  *pitch = (ScalePitch){.cents = cents.value, .over = 1.0, .under = 1.0};
  return fabs(cents.value) <= SCALE_MAX_CENTS && scale_text_is_end(text);
}

static bool read_pitch(ScaleText* text, uint32_t i, uint32_t n, ScalePitch* pitch) {
  ScaleNumber number;
  const bool is_there = scale_text_next_value(text);
  if (!is_there || !scale_text_number(text, &number)) {
    return scale_text_fail(text, !is_there, "pitch %u of %u, such as 701.955 or 3/2", i, n);
  }
  if (number.has_point) {
    return take_cents(text, number, pitch) ||
           scale_text_fail(text, false, "pitch %u of %u, cents from -%d to %d", i, n,
                           SCALE_MAX_CENTS, SCALE_MAX_CENTS);
  }
  return take_ratio(text, number, pitch) ||
         scale_text_fail(text, false,
                         "pitch %u of %u, a ratio of whole numbers from 1 to 1e30, or cents with "
                         "a point",
                         i, n);
}

static bool is_out_of_memory(ScaleText* text) {
  (void)scale_text_fail(text, false, "a computer with more memory free");
  return false;
}

/* As many as there can be in what is left, at two bytes each, whatever number was promised; and one
 * where there are none. */
static bool take_memory(ScaleText* text, Scale* scale) {
  const size_t n_left = (size_t)(text->end - text->next) / 2 + 1;
  const size_t n_notes = scale->n_notes < n_left ? scale->n_notes : n_left;
  scale->memory = malloc((n_notes > 0 ? n_notes : 1) * sizeof(ScalePitch));
  scale->pitches = scale->memory;
  return scale->memory || is_out_of_memory(text);
}

static bool read_scale(ScaleText* text, Scale* scale) {
  if (!scale_text_next(text)) {
    return scale_text_fail(text, true, "a line that describes the scale");
  }
  if (!read_count(text, "the number of notes", SCALE_MAX_NOTES, &scale->n_notes) ||
      !take_memory(text, scale)) {
    return false;
  }
  for (uint32_t i = 0; i < scale->n_notes; ++i) {
    if (!read_pitch(text, i + 1, scale->n_notes, &scale->memory[i])) {
      return false;
    }
  }
  return true;
}

static bool read_key(ScaleText* text, const char* what, uint32_t* key) {
  return read_count(text, what, SCALE_KEYS - 1, key);
}

static bool read_last_key(ScaleText* text, ScaleMap* map) {
  double key = 0.0;
  if (!read_whole(text, "the last note to retune", map->first_key, SCALE_KEYS - 1, &key)) {
    return false;
  }
  map->last_key = (uint32_t)key;
  return true;
}

static bool read_hz(ScaleText* text, double* hz) {
  ScaleNumber number;
  const bool is_there = scale_text_next_value(text);
  if (!is_there || !scale_text_number(text, &number) || !scale_text_is_end(text) ||
      !(number.value >= SCALE_MIN_HZ) || !(number.value <= SCALE_MAX_HZ)) {
    return scale_text_fail(text, !is_there, "the reference frequency, from 0.001 to 1000000 Hz");
  }
  *hz = number.value;
  return true;
}

static bool read_octave_degree(ScaleText* text, int32_t* degree) {
  double whole = 0.0;
  if (!read_whole(text, "the degree of the formal octave", -SCALE_MAX_DEGREE, SCALE_MAX_DEGREE,
                  &whole)) {
    return false;
  }
  *degree = (int32_t)whole;
  return true;
}

static bool take_entry(ScaleText* text, int32_t* degree) {
  double whole = 0.0;
  if (scale_text_take(text, 'x') || scale_text_take(text, 'X')) {
    *degree = SCALE_UNMAPPED;
    return scale_text_is_end(text);
  }
  if (!take_whole(text, -SCALE_MAX_DEGREE, SCALE_MAX_DEGREE, &whole)) {
    return false;
  }
  *degree = (int32_t)whole;
  return true;
}

static bool read_entries(ScaleText* text, ScaleMap* map) {
  bool is_there = true;
  map->degrees = map->n_entries > 0 ? calloc(map->n_entries, sizeof(int32_t)) : NULL;
  if (!map->degrees && map->n_entries > 0) {
    return is_out_of_memory(text);
  }
  for (uint32_t i = 0; i < map->n_entries; ++i) {
    is_there = is_there && scale_text_next_value(text);
    map->degrees[i] = SCALE_UNMAPPED;
    if (is_there && !take_entry(text, &map->degrees[i])) {
      return scale_text_fail(text, false, "entry %u of %u, a degree from -%d to %d or an x", i + 1,
                             map->n_entries, SCALE_MAX_DEGREE, SCALE_MAX_DEGREE);
    }
  }
  return true;
}

static bool has_degree(const ScaleMap* map) {
  bool has = map->n_entries == 0;
  for (uint32_t i = 0; i < map->n_entries && !has; ++i) {
    has = map->degrees[i] != SCALE_UNMAPPED;
  }
  return has;
}

static bool read_map(ScaleText* text, ScaleMap* map) {
  if (!read_count(text, "the size of the map", SCALE_MAX_PATTERN, &map->n_entries) ||
      !read_key(text, "the first note to retune", &map->first_key) || !read_last_key(text, map) ||
      !read_key(text, "the middle note", &map->middle_key) ||
      !read_key(text, "the reference note", &map->reference_key)) {
    return false;
  }
  return read_hz(text, &map->reference_hz) && read_octave_degree(text, &map->octave_degree) &&
         read_entries(text, map) &&
         (has_degree(map) || scale_text_fail(text, true, "an entry that is a degree and not an x"));
}

Status scale_read(const char* text, size_t n_bytes, Scale* scale, ScaleError* error) {
  ScaleText place;
  Scale read = {.n_notes = 0};
  if (!scale_text_start(&place, text, n_bytes, error) || !read_scale(&place, &read)) {
    scale_free(&read);
    return STATUS_BAD_TEXT;
  }
  *scale = read;
  return STATUS_OK;
}

Status scale_map_read(const char* text, size_t n_bytes, ScaleMap* map, ScaleError* error) {
  ScaleText place;
  ScaleMap read = {.n_entries = 0};
  if (!scale_text_start(&place, text, n_bytes, error) || !read_map(&place, &read)) {
    scale_map_free(&read);
    return STATUS_BAD_TEXT;
  }
  *map = read;
  return STATUS_OK;
}

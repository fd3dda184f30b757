#include "core/bank/body_read.h"

#include "core/base/chance.h"
#include "core/base/maths.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One more digit fits below this. */
static const uint64_t MANTISSA_LIMIT = UINT64_C(1000000000000000000);

/* No exponent is longer. */
enum { LONGEST_EXPONENT = 4, LONGEST_QUOTE = 48 };

/* How near to none a mode by chance is moved where the strings are, of what it is by the mean. */
static const double LEAST_SHARE = 0.2;

/* Of the mean one: so every crowd comes to an end. */
static const double LEAST_DISTANCE = 1e-3;

/* What a number may be. */
typedef struct {
  const char* expected;
  double min;
  double max;
} Range;

static const Range HZ = {"a frequency from 1 to 100000 Hz", 1.0, 1e5};
static const Range Q = {"a Q from 0.51 to 1000000", 0.51, 1e6};
static const Range KG = {"a mass from 1e-9 to 1e9 kg", 1e-9, 1e9};
static const Range RADIATION = {"a radiation from -1e9 to 1e9", -1e9, 1e9};
static const Range SPREAD = {"a radiation from 1e-9 to 1e9", 1e-9, 1e9};
static const Range DENSITY = {"a density from 1e-6 to 10 modes per Hz", 1e-6, 10.0};
static const Range SEED = {"a whole seed from 0 to 1000000000", 0.0, BODY_MAX_SEED};

/* A place in a text. */
typedef struct {
  const char* at;       /* In the line */
  const char* line_end; /* Behind what is read of it */
  const char* next;     /* Where the next line begins */
  const char* end;      /* Behind the text */
  unsigned line;
  Body* body;
  BodyError* error;
} Reader;

/* A word of a line; without length at its end. */
typedef struct {
  const char* begin;
  size_t length;
} Word;

/* Lines and words */

static bool is_blank(char byte) {
  return byte == ' ' || byte == '\t' || byte == '\r';
}

static bool is_digit(const char* at, const char* end) {
  return at != end && *at >= '0' && *at <= '9';
}

static bool next_line(Reader* reader) {
  if (reader->next == reader->end) {
    return false;
  }
  const size_t n_left = (size_t)(reader->end - reader->next);
  const char* const mark = memchr(reader->next, '\n', n_left);
  reader->at = reader->next;
  reader->line_end = mark ? mark : reader->end;
  reader->next = mark ? mark + 1 : reader->end;
  ++reader->line;
  const char* const comment = memchr(reader->at, '#', (size_t)(reader->line_end - reader->at));
  reader->line_end = comment ? comment : reader->line_end;
  return true;
}

static Word next_word(Reader* reader) {
  while (reader->at != reader->line_end && is_blank(*reader->at)) {
    ++reader->at;
  }
  Word word = {.begin = reader->at};
  while (reader->at != reader->line_end && !is_blank(*reader->at)) {
    ++reader->at;
  }
  word.length = (size_t)(reader->at - word.begin);
  return word;
}

static bool is_word(Word word, const char* text) {
  return word.length == strlen(text) && memcmp(word.begin, text, word.length) == 0;
}

/* Messages */

static bool fail(const Reader* reader, const char* found, const char* expected) {
  reader->error->line = reader->line ? reader->line : 1;
  (void)snprintf(reader->error->found, sizeof(reader->error->found), "%s", found);
  (void)snprintf(reader->error->expected, sizeof(reader->error->expected), "%s", expected);
  return false;
}

static bool fail_at(const Reader* reader, Word word, const char* expected) {
  char quote[LONGEST_QUOTE + sizeof("'...'")] = "the end of the line";
  if (word.length > 0) {
    const size_t n_shown = word.length > LONGEST_QUOTE ? LONGEST_QUOTE : word.length;
    char* at = quote;
    *at++ = '\'';
    for (size_t i = 0; i < n_shown; ++i) {
      const char byte = word.begin[i];
      *at++ = byte >= ' ' && byte <= '~' ? byte : '?';
    }
    strcpy(at, n_shown < word.length ? "...'" : "'");
  }
  return fail(reader, quote, expected);
}

/* Numbers */

/* An exponent, and nothing behind it. */
static bool take_exponent(const char* at, const char* end, int* exponent) {
  const bool has_sign = at != end && (*at == '-' || *at == '+');
  const bool is_negative = has_sign && *at == '-';
  int value = 0;
  at += has_sign ? 1 : 0;
  if (!is_digit(at, end) || end - at > LONGEST_EXPONENT) {
    return false;
  }
  for (; is_digit(at, end); ++at) {
    value = 10 * value + (*at - '0');
  }
  *exponent += is_negative ? -value : value;
  return at == end;
}

/* Not strtod(): that goes by the locale, and past the end of a text without NUL.  True to two
 * roundings. */
static bool is_number(Word word, double* number) {
  const char* at = word.begin;
  const char* const end = word.begin + word.length;
  const bool has_sign = at != end && (*at == '-' || *at == '+');
  const bool is_negative = has_sign && *at == '-';
  uint64_t mantissa = 0;
  int exponent = 0;
  bool has_digit = false;
  bool has_point = false;
  at += has_sign ? 1 : 0;
  for (; is_digit(at, end) || (at != end && *at == '.' && !has_point); ++at) {
    if (*at == '.') {
      has_point = true;
      continue;
    }
    const bool is_kept = mantissa < MANTISSA_LIMIT;
    has_digit = true;
    mantissa = is_kept ? 10 * mantissa + (uint64_t)(*at - '0') : mantissa;
    exponent += (is_kept ? 0 : 1) - (has_point ? 1 : 0);
  }
  const bool has_exponent = at != end && (*at == 'e' || *at == 'E');
  if (!has_digit || (has_exponent ? !take_exponent(at + 1, end, &exponent) : at != end)) {
    return false;
  }
  const double power = pow(10.0, fabs((double)exponent));
  const double size = exponent < 0 ? (double)mantissa / power : (double)mantissa * power;
  *number = is_negative ? -size : size;
  return true;
}

static bool take_number(Reader* reader, const Range* range, double* number) {
  const Word word = next_word(reader);
  double value = 0.0;
  if (!is_number(word, &value) || !(value >= range->min) || !(value <= range->max)) {
    return fail_at(reader, word, range->expected);
  }
  *number = value;
  return true;
}

static bool take_keyword(Reader* reader, const char* keyword) {
  char expected[BODY_EXPECTED_SIZE];
  const Word word = next_word(reader);
  (void)snprintf(expected, sizeof(expected), "'%s'", keyword);
  return is_word(word, keyword) || fail_at(reader, word, expected);
}

static bool take_end(Reader* reader) {
  const Word word = next_word(reader);
  return word.length == 0 || fail_at(reader, word, "the end of the line");
}

/* Modes */

static bool add_mode(Reader* reader, BodyMode mode) {
  if (reader->body->n_modes == BODY_MAX_MODES) {
    char found[BODY_FOUND_SIZE];
    (void)snprintf(found, sizeof(found), "a mode at %.6g Hz too", mode.f0_hz);
    return fail(reader, found, "256 modes at most");
  }
  reader->body->modes[reader->body->n_modes++] = mode;
  return true;
}

static bool take_mode(Reader* reader) {
  BodyMode mode = {.f0_hz = 0.0};
  return take_number(reader, &HZ, &mode.f0_hz) && take_number(reader, &Q, &mode.q) &&
         take_number(reader, &KG, &mode.mass_kg) &&
         take_number(reader, &RADIATION, &mode.radiation[0]) &&
         take_number(reader, &RADIATION, &mode.radiation[1]) && take_end(reader) &&
         add_mode(reader, mode);
}

/* What changes from one frequency to the other. */
typedef struct {
  double from;
  double to;
} Slope;

/* Modes by chance. */
typedef struct {
  Slope hz;
  Slope density;
  Slope q;
  Slope mass;
  Slope radiation;
  double seed;
} Crowd;

static double at_share(Slope slope, double share) {
  return slope.from * pow(slope.to / slope.from, share);
}

/* `keyword` FROM [to TO]. */
static bool take_slope(Reader* reader, const char* keyword, const Range* range, Slope* slope) {
  if (!take_keyword(reader, keyword) || !take_number(reader, range, &slope->from)) {
    return false;
  }
  slope->to = slope->from;
  const char* const before = reader->at;
  if (is_word(next_word(reader), "to")) {
    return take_number(reader, range, &slope->to);
  }
  reader->at = before;
  return true;
}

static bool take_seed(Reader* reader, double* seed) {
  const char* const before = reader->at;
  if (!take_number(reader, &SEED, seed)) {
    return false;
  }
  if (*seed != floor(*seed)) {
    reader->at = before;
    return fail_at(reader, next_word(reader), SEED.expected);
  }
  return true;
}

/* Numbers of a crowd, in the order in which they are drawn. */
typedef struct {
  uint64_t seed;
  uint64_t n;
} Draw;

/* Above 0 and up to 1. */
static double draw_even(Draw* draw) {
  return 0.5 - 0.5 * chance_even(draw->seed, draw->n++);
}

/* Box and Muller's. */
static double draw_normal(Draw* draw) {
  const double radius = sqrt(-2.0 * log(draw_even(draw)));
  return radius * cos(2.0 * PI * draw_even(draw));
}

/* One of a crowd at a frequency. */
static BodyMode draw_mode(const Crowd* crowd, double hz, double share, Draw* draw) {
  const double normal = draw_normal(draw);
  const double strings = copysign(fmax(fabs(normal), LEAST_SHARE), normal);
  const double both = draw_normal(draw);
  const double apart = BODY_APART * (1.0 - 2.0 * draw_even(draw));
  const double radiation = at_share(crowd->radiation, share) * both / strings;
  return (BodyMode){
      .f0_hz = hz,
      .q = at_share(crowd->q, share),
      .mass_kg = at_share(crowd->mass, share) / (strings * strings),
      .radiation = {radiation * (1.0 + apart), radiation * (1.0 - apart)},
  };
}

/* Below which frequency there are `n` modes: the density is N (f/F)^p, and so their number is
 * N F ((f/F)^(p+1) − 1)/(p+1). */
static double crowd_hz(const Crowd* crowd, double n) {
  const double octaves = log(crowd->hz.to / crowd->hz.from);
  const double power = log(crowd->density.to / crowd->density.from) / octaves + 1.0;
  const double y = n / (crowd->density.from * crowd->hz.from);
  if (!(power * y > -1.0)) {
    return HUGE_VAL;
  }
  return crowd->hz.from * exp(fabs(power * y) > 1e-9 ? log1p(power * y) / power : y);
}

static bool add_crowd(Reader* reader, const Crowd* crowd) {
  Draw draw = {.seed = (uint64_t)crowd->seed};
  const double octaves = log(crowd->hz.to / crowd->hz.from);
  /* The first lies anywhere in a mean distance. */
  double n = draw_even(&draw);
  double hz = crowd_hz(crowd, n);
  while (hz < crowd->hz.to) {
    const double share = log(hz / crowd->hz.from) / octaves;
    if (!add_mode(reader, draw_mode(crowd, hz, share, &draw))) {
      return false;
    }
    n += fmax(LEAST_DISTANCE, sqrt(-4.0 / PI * log(draw_even(&draw))));
    hz = crowd_hz(crowd, n);
  }
  return true;
}

static bool take_crowd(Reader* reader) {
  Crowd crowd = {.seed = 0.0};
  if (!take_number(reader, &HZ, &crowd.hz.from) ||
      !take_slope(reader, "density", &DENSITY, &crowd.density) ||
      !take_slope(reader, "q", &Q, &crowd.q) || !take_slope(reader, "mass", &KG, &crowd.mass) ||
      !take_slope(reader, "radiation", &SPREAD, &crowd.radiation) ||
      !take_keyword(reader, "seed") || !take_seed(reader, &crowd.seed) ||
      !take_keyword(reader, "to")) {
    return false;
  }
  const char* const before = reader->at;
  if (!take_number(reader, &HZ, &crowd.hz.to)) {
    return false;
  }
  if (!(crowd.hz.to > crowd.hz.from)) {
    char expected[BODY_EXPECTED_SIZE];
    (void)snprintf(expected, sizeof(expected), "a frequency above %.6g Hz", crowd.hz.from);
    reader->at = before;
    return fail_at(reader, next_word(reader), expected);
  }
  return take_end(reader) && add_crowd(reader, &crowd);
}

static bool read_line(Reader* reader) {
  const Word word = next_word(reader);
  if (word.length == 0) {
    return true;
  }
  if (is_word(word, "mode")) {
    return take_mode(reader);
  }
  return is_word(word, "above") ? take_crowd(reader) : fail_at(reader, word, "mode or above");
}

/* The whole */

static bool is_heard(const Body* body) {
  double most = 0.0;
  for (int band = 0; band < BODY_BANDS; ++band) {
    most = fmax(most, body->power[band]);
  }
  return most > 0.0;
}

static bool read_lines(Reader* reader) {
  while (next_line(reader)) {
    if (!read_line(reader)) {
      return false;
    }
  }
  return true;
}

static bool finish(Reader* reader) {
  if (reader->body->n_modes == 0) {
    return fail(reader, "the end of the text", "a line 'mode F Q M LEFT RIGHT'");
  }
  body_sort(reader->body);
  body_level(reader->body);
  return is_heard(reader->body) ||
         fail(reader, "the end of the text", "a mode that is heard, left or right");
}

static bool start(Reader* reader, const char* text, size_t n_bytes) {
  const bool has_mark = n_bytes >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0;
  reader->next = n_bytes > 0 ? text : "";
  reader->end = reader->next + n_bytes;
  reader->next += has_mark ? 3 : 0;
  return n_bytes <= BODY_MAX_BYTES || fail(reader, "a longer text", "one of at most 1048576 bytes");
}

Status body_read(const char* text, size_t n_bytes, Body* body, BodyError* error) {
  Body read = {.n_modes = 0};
  Reader reader = {.body = &read, .error = error};
  if (!start(&reader, text, n_bytes) || !read_lines(&reader) || !finish(&reader)) {
    return STATUS_BAD_TEXT;
  }
  *body = read;
  return STATUS_OK;
}

Status body_read_modes(const char* text, size_t n_bytes, Body* body, BodyError* error) {
  Body read = {.n_modes = 0};
  Reader reader = {.body = &read, .error = error};
  if (!start(&reader, text, n_bytes) || !read_lines(&reader)) {
    return STATUS_BAD_TEXT;
  }
  *body = read;
  return STATUS_OK;
}

static int compare_modes(const void* left, const void* right) {
  const BodyMode* const p = left;
  const BodyMode* const q = right;
  if (p->f0_hz != q->f0_hz) {
    return p->f0_hz < q->f0_hz ? -1 : 1;
  }
  return p->mass_kg < q->mass_kg ? -1 : p->mass_kg > q->mass_kg;
}

void body_sort(Body* body) {
  qsort(body->modes, body->n_modes, sizeof(BodyMode), compare_modes);
}

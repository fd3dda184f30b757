#include "tools/formats/smf.h"

#include "tools/formats/bytes.h"

#include <assert.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SIZE = 16 << 20, MAX_LEADING = 128, CHUNK_HEAD = 8, HEADER_SIZE = 6, RIFF_HEAD = 12 };
enum { SYSEX = 0xF0, ESCAPE = 0xF7, CLOCK = 0xF8, META = 0xFF };
enum { END_OF_TRACK = 0x2F, TEMPO = 0x51 };

static const double USUAL_QUARTER_S = 0.5;

static const char* const notes[SMF_N_NOTES] = {
    [SMF_LEADING] = "other data before MThd, skipped it",
    [SMF_TRACKS] = "another number of tracks than there are, played all of them",
    [SMF_TYPE_0] = "several tracks in a file of type 0, played them together",
    [SMF_PATTERNS] = "a file of type 2, played its patterns one after the other",
    [SMF_CUT] = "a track longer than the file, played what there is of it",
    [SMF_NO_END] = "no End of Track, ended the track with its last event",
    [SMF_RUNNING] = "running status after a meta event or sysex, took the status before it",
    [SMF_DATA] = "a data byte over 0x7f, took it for 0x7f",
    [SMF_REAL_TIME] = "a real-time byte in a track, left it out",
    [SMF_SYSEX] = "a broken system exclusive message, left it out",
};

/* A message, or one of the meta events that the clock needs: a change of tempo, the end of a track.
 */
typedef struct {
  uint64_t tick;
  size_t at; /* Its bytes in Reader.bytes; in the order of the file */
  uint32_t size;
  uint32_t pattern;
} Item;

/* Where something is worth a note, and how often. */
typedef struct {
  size_t n;
  size_t at;
  uint32_t track;
} Place;

typedef struct {
  const char* path;
  char* error;
  size_t error_size;
  Place noted[SMF_N_NOTES];

  /* The file */
  const uint8_t* data;
  size_t size;
  size_t at;
  size_t header_at;
  uint32_t type;
  uint32_t n_announced;     /* Tracks */
  double quarters_per_tick; /* 0: the length of a tick does not depend on the tempo */
  double tick_s;            /* Before any change of tempo */
  /* The track that is read */
  uint32_t track; /* From 1; 0 in the header */
  size_t end;
  uint64_t tick;
  unsigned status; /* Running status, 0 for none */
  bool is_stale;   /* A meta event or sysex came after it */
  bool is_cut;     /* The track is longer than the file */
  bool is_over;    /* Nothing more of it is to be read */
  Bytes sysex;     /* What is there of a system exclusive message */
  size_t sysex_at;

  /* What came of it */
  Bytes items;
  Bytes bytes;
} Reader;

/* Always false. */
__attribute__((format(printf, 3, 4))) static bool
fail(const Reader* self, size_t at, const char* format, ...) {
  char what[160];
  char track[32] = "";
  va_list args;
  va_start(args, format);
  (void)vsnprintf(what, sizeof(what), format, args);
  va_end(args);
  if (self->track) {
    (void)snprintf(track, sizeof(track), "track %u, ", self->track);
  }
  (void)snprintf(self->error, self->error_size, "%s: %sbyte %zu: found %s", self->path, track, at,
                 what);
  return false;
}

static bool fail_memory(const Reader* self) {
  (void)snprintf(self->error, self->error_size, "%s: out of memory", self->path);
  return false;
}

static void note(Reader* self, SmfNote which, size_t at) {
  if (self->noted[which].n++ == 0) {
    self->noted[which].at = at;
    self->noted[which].track = self->track;
  }
}

static uint32_t big_endian(const uint8_t* bytes, unsigned n_bytes) {
  uint32_t value = 0;
  for (unsigned i = 0; i < n_bytes; ++i) {
    value = (value << 8) | bytes[i];
  }
  return value;
}

/* Whether so many bytes are left in the track; where the file is cut, the track is over instead. */
static bool need(Reader* self, size_t n_bytes, const char* what) {
  const size_t left = self->end - self->at;
  if (n_bytes > left && self->is_cut) {
    self->is_over = true;
    self->at = self->end;
    return false;
  }
  return n_bytes <= left ||
         fail(self, self->at, "%zu bytes to the end of the track, expected %zu of %s", left,
              n_bytes, what);
}

/* A number in groups of seven bits, four groups at most. */
static bool read_number(Reader* self, const char* what, uint32_t* number) {
  const size_t start = self->at;
  *number = 0;
  for (unsigned i = 0; i < 4; ++i) {
    if (!need(self, 1, what)) {
      return false;
    }
    const uint8_t byte = self->data[self->at++];
    *number = (*number << 7) | (byte & 0x7FU);
    if (byte < 0x80) {
      return true;
    }
  }
  return fail(self, start, "%s of more than 4 bytes, expected at most 4", what);
}

/* A length, and that many bytes, which the reader then is behind. */
static const uint8_t* read_block(Reader* self, const char* what, uint32_t* size) {
  if (!read_number(self, "a length", size) || !need(self, *size, what)) {
    return NULL;
  }
  self->at += *size;
  return self->data + self->at - *size;
}

static bool add(Reader* self, const uint8_t* bytes, uint32_t size) {
  const Item item = {self->tick, self->bytes.size, size, self->type == 2 ? self->track : 0};
  return (bytes_append(&self->bytes, bytes, size) &&
          bytes_append(&self->items, &item, sizeof(item))) ||
         fail_memory(self);
}

static bool read_meta(Reader* self) {
  const size_t start = self->at;
  uint32_t size = 0;
  if (!need(self, 1, "a meta event")) {
    return false;
  }
  const uint8_t kind = self->data[self->at++];
  const uint8_t* const body = read_block(self, "a meta event", &size);
  if (!body) {
    return false;
  }
  self->is_stale = true;
  self->is_over = kind == END_OF_TRACK;
  if (kind != TEMPO) {
    return true;
  }
  /* Later versions may make a meta event longer, and no tempo is infinite. */
  const uint8_t tempo[] = {META, TEMPO, size > 2 ? body[0] : 0, size > 2 ? body[1] : 0,
                           size > 2 ? body[2] : 0};
  return size < 3 ? fail(self, start, "a tempo of %u bytes, expected 3", size)
                  : big_endian(body, 3) == 0 || add(self, tempo, sizeof(tempo));
}

/* Take real-time bytes out of a message; whether the rest is as it should be. */
static bool clean_sysex(Reader* self) {
  uint8_t* const bytes = self->sysex.data;
  size_t n = 0;
  bool is_clean = true;
  for (size_t i = 0; i < self->sysex.size; ++i) {
    if (bytes[i] >= CLOCK) {
      note(self, SMF_REAL_TIME, self->sysex_at);
      continue;
    }
    is_clean = is_clean && (bytes[i] < 0x80 || i == 0 || i + 1 == self->sysex.size);
    bytes[n++] = bytes[i];
  }
  self->sysex.size = n;
  return is_clean;
}

static bool finish_sysex(Reader* self) {
  const bool is_whole = self->sysex.data[self->sysex.size - 1] == ESCAPE && clean_sysex(self);
  if (!is_whole) {
    note(self, SMF_SYSEX, self->sysex_at);
  }
  const bool is_ok = !is_whole || add(self, self->sysex.data, (uint32_t)self->sysex.size);
  self->sysex.size = 0;
  return is_ok;
}

/* A message may be sent in packets: F0 begins it, F7 goes on with it, and it ends with a byte F7.
 * An F7 that goes on with nothing holds any bytes; a message whole in itself is one. */
static bool read_sysex(Reader* self, uint8_t status) {
  const size_t start = self->at - 1;
  uint32_t size = 0;
  const uint8_t* const body = read_block(self, "a system exclusive message", &size);
  if (!body) {
    return false;
  }
  self->is_stale = true;
  if (status == SYSEX && self->sysex.size > 0 && !finish_sysex(self)) {
    return false;
  }
  if (self->sysex.size == 0) {
    self->sysex_at = start;
    if (status == ESCAPE && (size < 2 || body[0] != SYSEX || body[size - 1] != ESCAPE)) {
      return true;
    }
  }
  if ((status == SYSEX && !bytes_append(&self->sysex, &status, 1)) ||
      !bytes_append(&self->sysex, body, size)) {
    return fail_memory(self);
  }
  return self->sysex.data[self->sysex.size - 1] != ESCAPE || finish_sysex(self);
}

static bool read_channel_message(Reader* self) {
  const unsigned first = self->data[self->at];
  if (first >= 0x80) {
    self->status = first;
    ++self->at;
  } else if (!self->status) {
    return fail(self, self->at, "0x%02x, expected a status byte of 0x80 or more", first);
  } else if (self->is_stale) {
    note(self, SMF_RUNNING, self->at);
  }
  self->is_stale = false;
  const unsigned kind = self->status & 0xF0U;
  const uint32_t size = kind == 0xC0 || kind == 0xD0 ? 2 : 3;
  uint8_t message[3] = {(uint8_t)self->status};
  for (uint32_t n = 1; n < size;) {
    if (!need(self, size - n, "a message")) {
      return false;
    }
    const uint8_t byte = self->data[self->at];
    const bool is_real_time = byte >= CLOCK && byte < META;
    if (byte >= 0x80) {
      note(self, is_real_time ? SMF_REAL_TIME : SMF_DATA, self->at);
    }
    if (!is_real_time) {
      message[n++] = byte < 0x80 ? byte : 0x7F;
    }
    ++self->at;
  }
  return add(self, message, size);
}

static bool read_message(Reader* self) {
  if (!need(self, 1, "a message")) {
    return false;
  }
  const uint8_t byte = self->data[self->at];
  if (byte < SYSEX) {
    return read_channel_message(self);
  }
  ++self->at;
  if (byte == META) {
    return read_meta(self);
  }
  if (byte == SYSEX || byte == ESCAPE) {
    return read_sysex(self, byte);
  }
  if (byte < CLOCK) {
    return fail(self, self->at - 1,
                "status 0x%02x, expected a channel message, sysex or meta event", byte);
  }
  note(self, SMF_REAL_TIME, self->at - 1);
  return true;
}

/* What is broken off does not count, nor does the time before it. */
static bool read_event(Reader* self) {
  const uint64_t tick = self->tick;
  uint32_t delta = 0;
  if (!read_number(self, "a delta time", &delta)) {
    return false;
  }
  self->tick += delta;
  if (read_message(self)) {
    return true;
  }
  self->tick = tick;
  return false;
}

static bool read_events(Reader* self) {
  while (!self->is_over) {
    if (self->at == self->end && !self->is_cut) {
      note(self, SMF_NO_END, self->at);
      return true;
    }
    if (!read_event(self) && !self->is_over) {
      return false;
    }
  }
  return true;
}

static bool read_track(Reader* self) {
  static const uint8_t end[] = {META, END_OF_TRACK};
  self->tick = 0;
  self->status = 0;
  self->is_stale = self->is_over = false;
  if (!read_events(self) || (self->sysex.size > 0 && !finish_sysex(self))) {
    return false;
  }
  /* Where the length of a track is wrong, the next one is behind its end. */
  self->at = self->is_cut ? self->at : self->end;
  return add(self, end, sizeof(end));
}

/* Go through all chunks; what cannot be one ends the file. */
static bool read_tracks(Reader* self) {
  while (self->size - self->at >= CHUNK_HEAD) {
    const uint8_t* const chunk = self->data + self->at;
    const size_t left = self->size - self->at - CHUNK_HEAD;
    const uint32_t length = big_endian(chunk + 4, 4);
    const bool is_track = !memcmp(chunk, "MTrk", 4);
    self->is_cut = length > left;
    self->track += is_track ? 1 : 0;
    if (self->is_cut && !is_track) {
      break;
    }
    if (self->is_cut) {
      note(self, SMF_CUT, self->at + 4);
    }
    self->at += CHUNK_HEAD;
    self->end = self->at + (self->is_cut ? left : length);
    if (is_track && !read_track(self)) {
      return false;
    }
    self->at = is_track ? self->at : self->end;
  }
  return true;
}

/* Where the song begins in a RIFF file, whose numbers have their lowest byte first, and where it
 * ends. */
static size_t unwrap(Reader* self) {
  const uint8_t* const data = self->data;
  if (self->size < RIFF_HEAD || memcmp(data, "RIFF", 4) != 0 || memcmp(data + 8, "RMID", 4) != 0) {
    return 0;
  }
  for (size_t at = RIFF_HEAD; self->size - at >= CHUNK_HEAD;) {
    const size_t left = self->size - at - CHUNK_HEAD;
    const size_t length = data[at + 4] | (size_t)data[at + 5] << 8 | (size_t)data[at + 6] << 16 |
                          (size_t)data[at + 7] << 24;
    if (!memcmp(data + at, "data", 4)) {
      self->size = at + CHUNK_HEAD + (length < left ? length : left);
      return at + CHUNK_HEAD;
    }
    if (length + 1 > left) {
      break;
    }
    at += CHUNK_HEAD + length + length % 2;
  }
  return 0;
}

static bool find_header(Reader* self) {
  const size_t from = unwrap(self);
  for (size_t at = from; at <= from + MAX_LEADING && at + 4 <= self->size; ++at) {
    if (!memcmp(self->data + at, "MThd", 4)) {
      if (at > from) {
        note(self, SMF_LEADING, from);
      }
      self->at = at;
      return true;
    }
  }
  return fail(self, 0, "%s, expected a Standard MIDI File",
              self->size ? "no MThd" : "an empty file");
}

/* Ticks per quarter note; or, with the highest bit set, minus the frames in a second, and ticks per
 * frame. 29 stands for 30 drop frame, of which there are 30000/1001 in a second. */
static bool set_division(Reader* self, size_t at) {
  const unsigned division = big_endian(self->data + at, 2);
  const unsigned frames = 256 - division / 256;
  const unsigned ticks = division % 256;
  const double frames_hz = frames == 29 ? 30000.0 / 1001.0 : (double)frames;
  if (division > 0 && division < 0x8000) {
    self->quarters_per_tick = 1.0 / division;
    self->tick_s = USUAL_QUARTER_S / division;
    return true;
  }
  self->tick_s = 1.0 / (frames_hz * ticks);
  return (ticks > 0 && (frames == 24 || frames == 25 || frames == 29 || frames == 30)) ||
         fail(self, at,
              "division 0x%04x, expected ticks per quarter note, 1 to 0x7fff, or per frame, at 24, "
              "25, 29 or 30 frames a second",
              division);
}

static bool read_header(Reader* self) {
  if (!find_header(self)) {
    return false;
  }
  const size_t at = self->at;
  const size_t left = self->size - at;
  if (left < CHUNK_HEAD + HEADER_SIZE) {
    return fail(self, self->size, "the end of the file, expected a header of %d bytes",
                CHUNK_HEAD + HEADER_SIZE);
  }
  const uint32_t length = big_endian(self->data + at + 4, 4);
  if (length < HEADER_SIZE || length > left - CHUNK_HEAD) {
    return fail(self, at + 4, "a header of %u bytes, expected %d to the %zu left", length,
                HEADER_SIZE, left - CHUNK_HEAD);
  }
  self->header_at = at;
  self->type = big_endian(self->data + at + 8, 2);
  self->n_announced = big_endian(self->data + at + 10, 2);
  self->at += CHUNK_HEAD + length;
  return (self->type <= 2 || fail(self, at + 8, "type %u, expected 0, 1 or 2", self->type)) &&
         set_division(self, at + 12);
}

/* What the header says of tracks is no more than that. */
static bool read_song(Reader* self) {
  if (!read_header(self) || !read_tracks(self)) {
    return false;
  }
  const uint32_t n_tracks = self->track;
  self->track = 0;
  if (n_tracks == 0) {
    return fail(self, self->at, "no track, expected one or more");
  }
  if (n_tracks != self->n_announced && !self->noted[SMF_CUT].n) {
    note(self, SMF_TRACKS, self->header_at + 10);
  }
  if (self->type == 0 && n_tracks > 1) {
    note(self, SMF_TYPE_0, self->header_at + 8);
  }
  if (self->type == 2) {
    note(self, SMF_PATTERNS, self->header_at + 8);
  }
  return true;
}

static int compare(const void* a, const void* b) {
  const Item* const one = (const Item*)a;
  const Item* const other = (const Item*)b;
  if (one->pattern != other->pattern) {
    return one->pattern < other->pattern ? -1 : 1;
  }
  if (one->tick != other->tick) {
    return one->tick < other->tick ? -1 : 1;
  }
  return one->at < other->at ? -1 : 1;
}

/* From ticks to seconds, through all changes of tempo; a pattern begins where the last one ended.
 */
static void place(const Reader* self, const Item* items, size_t n_items, Smf* smf) {
  uint32_t pattern = items[0].pattern;
  double tick_s = self->tick_s;
  double from_s = 0.0; /* Of the change of tempo, or the pattern */
  uint64_t from = 0;
  for (size_t i = 0; i < n_items; ++i) {
    const Item* const item = &items[i];
    const uint8_t* const bytes = smf->bytes + item->at;
    if (item->pattern != pattern) {
      pattern = item->pattern;
      from_s = smf->duration_s;
      from = 0;
      tick_s = self->tick_s;
    }
    smf->duration_s = from_s + (double)(item->tick - from) * tick_s;
    if (bytes[0] != META) {
      smf->events[smf->n_events++] = (SmfEvent){smf->duration_s, item->size, bytes};
    } else if (bytes[1] == TEMPO && self->quarters_per_tick > 0.0) {
      from_s = smf->duration_s;
      from = item->tick;
      tick_s = 1e-6 * big_endian(bytes + 2, 3) * self->quarters_per_tick;
    }
  }
}

static void write_notes(const Reader* self, Smf* smf) {
  for (unsigned i = 0; i < SMF_N_NOTES; ++i) {
    const Place* const noted = &self->noted[i];
    char track[32] = "";
    char count[48] = "";
    if (noted->track) {
      (void)snprintf(track, sizeof(track), "track %u, ", noted->track);
    }
    if (noted->n > 1) {
      (void)snprintf(count, sizeof(count), "; %zu times in all", noted->n);
    }
    if (noted->n > 0) {
      (void)snprintf(smf->note[i], SMF_NOTE_SIZE, "%sbyte %zu: found %s%s", track, noted->at,
                     notes[i], count);
    }
  }
}

/* Takes over the bytes. */
static Smf* make(Reader* self) {
  Item* const items = (Item*)(void*)self->items.data;
  const size_t n_items = self->items.size / sizeof(Item);
  assert(n_items > 0); /* The end of a track is one */
  Smf* const smf = calloc(1, sizeof(Smf));
  if (smf) {
    smf->events = calloc(n_items, sizeof(SmfEvent));
    smf->bytes = self->bytes.data;
    self->bytes = (Bytes){0};
  }
  if (!smf || !smf->events) {
    (void)fail_memory(self);
    smf_free(smf);
    return NULL;
  }
  qsort(items, n_items, sizeof(Item), compare);
  place(self, items, n_items, smf);
  write_notes(self, smf);
  if (!(smf->duration_s <= SMF_MAX_LENGTH_S)) {
    (void)snprintf(self->error, self->error_size,
                   "%s: found an end at %.0f s, expected at most %.0f s", self->path,
                   smf->duration_s, SMF_MAX_LENGTH_S);
    smf_free(smf);
    return NULL;
  }
  return smf;
}

Smf* smf_new(const char* path, char* error, size_t error_size) {
  Bytes file = {0};
  Smf* smf = NULL;
  if (bytes_read(&file, path, MAX_SIZE, error, error_size)) {
    Reader reader = {.path = path,
                     .error = error,
                     .error_size = error_size,
                     .data = file.data,
                     .size = file.size};
    smf = read_song(&reader) ? make(&reader) : NULL;
    bytes_clear(&reader.sysex);
    bytes_clear(&reader.items);
    bytes_clear(&reader.bytes);
  }
  bytes_clear(&file);
  return smf;
}

void smf_free(Smf* smf) {
  if (smf) {
    free(smf->events);
    free(smf->bytes);
    free(smf);
  }
}

#include "tools/formats/midifile.h"

#include "tools/formats/bytes.h"
#include "tools/formats/midiclean.h"

#include <errno.h>
#include <smf.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SIZE = 16 * 1024 * 1024 };

static const double MAX_LENGTH_S = 3600.0;

/* Where the messages gather; places in `bytes` become pointers once it no longer moves. */
typedef struct {
  Bytes events; // Of Gathered
  Bytes bytes;
} Gather;

typedef struct {
  double time_s;
  size_t order;
  size_t at;
  uint32_t size;
} Gathered;

static bool read_all(FILE* stream, Bytes* bytes) {
  uint8_t buffer[4096];
  size_t n_read = 0;
  do {
    n_read = fread(buffer, 1, sizeof(buffer), stream);
    if (bytes->size + n_read > MAX_SIZE) {
      errno = EFBIG;
      return false;
    }
    if (!bytes_append(bytes, buffer, n_read)) {
      errno = ENOMEM;
      return false;
    }
  } while (n_read > 0);
  return !ferror(stream);
}

static bool load_bytes(const char* path, Bytes* bytes) {
  FILE* const stream = fopen(path, "rb");
  if (!stream) {
    return false;
  }
  const bool is_read = read_all(stream, bytes);
  const int reason = errno;
  (void)fclose(stream);
  errno = reason;
  return is_read;
}

static void
ignore_log(const gchar* domain, GLogLevelFlags level, const gchar* message, gpointer data) {
  (void)domain;
  (void)level;
  (void)message;
  (void)data;
}

static smf_t* parse(const Bytes* bytes) {
  const GLogFunc log = g_log_set_default_handler(ignore_log, NULL);
  smf_t* const smf = smf_load_from_memory(bytes->data, (int)bytes->size);
  g_log_set_default_handler(log, NULL);
  return smf;
}

static bool gather(smf_t* smf, Gather* out) {
  smf_rewind(smf);
  for (smf_event_t* event = smf_get_next_event(smf); event; event = smf_get_next_event(smf)) {
    if (!smf_event_is_metadata(event)) {
      const Gathered gathered = {event->time_seconds, out->events.size, out->bytes.size,
                                 (uint32_t)event->midi_buffer_length};
      if (!bytes_append(&out->bytes, event->midi_buffer, gathered.size) ||
          !bytes_append(&out->events, &gathered, sizeof(gathered))) {
        return false;
      }
    }
  }
  return true;
}

static int compare_gathered(const void* a, const void* b) {
  const Gathered* const left = (const Gathered*)a;
  const Gathered* const right = (const Gathered*)b;
  if (left->time_s != right->time_s) {
    return left->time_s < right->time_s ? -1 : 1;
  }
  return left->order < right->order ? -1 : 1;
}

/* Takes over the bytes of `from`. */
static MidiFile* finish(Gather* from) {
  const size_t n_events = from->events.size / sizeof(Gathered);
  MidiFile* const file = calloc(1, sizeof(MidiFile));
  MidiEvent* const events = calloc(n_events + 1, sizeof(MidiEvent));
  if (!file || !events) {
    free(file);
    free(events);
    return NULL;
  }
  Gathered* const gathered = (Gathered*)(void*)from->events.data;
  if (n_events > 1) {
    qsort(gathered, n_events, sizeof(Gathered), compare_gathered);
  }
  for (size_t i = 0; i < n_events; ++i) {
    events[i] =
        (MidiEvent){gathered[i].time_s, gathered[i].size, from->bytes.data + gathered[i].at};
  }
  *file = (MidiFile){events, n_events, from->bytes.data};
  from->bytes = (Bytes){0};
  return file;
}

static MidiFile* convert(smf_t* smf, const char* path, char* error, size_t error_size) {
  Gather gathered = {0};
  MidiFile* const file = gather(smf, &gathered) ? finish(&gathered) : NULL;
  bytes_clear(&gathered.events);
  bytes_clear(&gathered.bytes);
  if (!file) {
    (void)snprintf(error, error_size, "%s: out of memory", path);
    return NULL;
  }
  const double end_s = file->n_events ? file->events[file->n_events - 1].time_s : 0.0;
  if (!(end_s <= MAX_LENGTH_S)) {
    (void)snprintf(error, error_size, "%s: found a message at %.0f s, expected at most %.0f s",
                   path, end_s, MAX_LENGTH_S);
    midifile_free(file);
    return NULL;
  }
  return file;
}

static MidiFile* read_song(const Bytes* bytes, const char* path, char* error, size_t error_size) {
  char why[256] = "";
  Bytes clean = {0};
  MidiFile* file = NULL;
  if (!midiclean(bytes->data, bytes->size, &clean, why, sizeof(why))) {
    (void)snprintf(error, error_size, "%s: %s", path, why);
  } else {
    smf_t* const smf = parse(&clean);
    if (smf) {
      file = convert(smf, path, error, error_size);
      smf_delete(smf);
    } else {
      (void)snprintf(error, error_size, "%s: found what libsmf refuses, expected a song", path);
    }
  }
  bytes_clear(&clean);
  return file;
}

MidiFile* midifile_new(const char* path, char* error, size_t error_size) {
  Bytes bytes = {0};
  MidiFile* file = NULL;
  if (load_bytes(path, &bytes)) {
    file = read_song(&bytes, path, error, error_size);
  } else {
    (void)snprintf(error, error_size, "%s: %s", path, strerror(errno));
  }
  bytes_clear(&bytes);
  return file;
}

void midifile_free(MidiFile* file) {
  if (file) {
    free(file->events);
    free(file->bytes);
    free(file);
  }
}

#define _POSIX_C_SOURCE 200809L

#include "plugin/tuner_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

typedef struct {
  char* bytes;
  size_t n_bytes;
} Text;

/* A pipe would keep its reader waiting, and a directory has no text. */
static bool is_plain_file(const char* path) {
  struct stat status;
  if (stat(path, &status)) {
    return false;
  }
  errno = S_ISDIR(status.st_mode) ? EISDIR : EINVAL;
  return S_ISREG(status.st_mode);
}

/* One byte more than there may be, so that too long a text is seen to be. */
static bool read_stream(FILE* stream, Text* text) {
  text->bytes = malloc(SCALE_MAX_BYTES + 1);
  if (!text->bytes) {
    return false;
  }
  text->n_bytes = fread(text->bytes, 1, SCALE_MAX_BYTES + 1, stream);
  return !ferror(stream);
}

/* errno says why it failed. */
static bool read_text(const char* path, Text* text) {
  FILE* const stream = is_plain_file(path) ? fopen(path, "rb") : NULL;
  if (!stream) {
    return false;
  }
  const bool is_read = read_stream(stream, text);
  const int why = errno;
  (void)fclose(stream);
  errno = why;
  return is_read;
}

static bool complain_of_file(const char* path, const char* expected, TunerFault* fault) {
  (void)snprintf(fault->line, sizeof(fault->line), "%s:1: found no text (%s), expected %s", path,
                 strerror(errno), expected);
  return false;
}

static bool complain_of_text(const char* path, const ScaleError* error, TunerFault* fault) {
  (void)snprintf(fault->line, sizeof(fault->line), "%s:%u: found %s, expected %s", path,
                 error->line, error->found, error->expected);
  return false;
}

bool tuner_file_scale(const char* path, Scale* scale, TunerFault* fault) {
  Text text = {NULL, 0};
  ScaleError error;
  const bool is_read = read_text(path, &text);
  const bool is_good = (is_read || complain_of_file(path, "a Scala scale (.scl)", fault)) &&
                       (!scale_read(text.bytes, text.n_bytes, scale, &error) ||
                        complain_of_text(path, &error, fault));
  free(text.bytes);
  return is_good;
}

bool tuner_file_map(const char* path, ScaleMap* map, TunerFault* fault) {
  Text text = {NULL, 0};
  ScaleError error;
  const bool is_read = read_text(path, &text);
  const bool is_good = (is_read || complain_of_file(path, "a Scala mapping (.kbm)", fault)) &&
                       (!scale_map_read(text.bytes, text.n_bytes, map, &error) ||
                        complain_of_text(path, &error, fault));
  free(text.bytes);
  return is_good;
}

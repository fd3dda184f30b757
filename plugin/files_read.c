#define _POSIX_C_SOURCE 200809L

#include "plugin/files_read.h"

#include "core/bank/body_read.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

/* What cannot be said of files everywhere is not needed there. */
#ifdef _WIN32
enum { HOW_TO_OPEN = O_RDONLY | O_BINARY };
#else
enum { HOW_TO_OPEN = O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC };
#endif

typedef struct {
  char* bytes;
  size_t n_bytes;
} Text;

static bool is_plain(const struct stat* status) {
  errno = S_ISDIR(status->st_mode) ? EISDIR : EINVAL;
  return S_ISREG(status->st_mode);
}

/* Some systems count what is read at once in less than a size. */
enum { MOST_AT_ONCE = 1 << 20 };

/* As many bytes as it says to have: a file of the kernel says that it has none, and may keep who
 * reads it waiting for ever. */
static bool read_all(int file, off_t size, Text* text) {
  text->bytes = malloc((size_t)size + 1);
  bool is_good = text->bytes;
  ssize_t n = 1;
  while (is_good && n > 0 && text->n_bytes < (size_t)size) {
    const size_t left = (size_t)size - text->n_bytes;
    const unsigned part = left < MOST_AT_ONCE ? (unsigned)left : MOST_AT_ONCE;
    n = read(file, text->bytes + text->n_bytes, part);
    is_good = n >= 0;
    text->n_bytes += n > 0 ? (size_t)n : 0;
  }
  return is_good;
}

static bool read_open(int file, Text* text) {
  struct stat status;
  if (fstat(file, &status) || !is_plain(&status)) {
    return false;
  }
  errno = EFBIG;
  return status.st_size <= SCALE_MAX_BYTES && read_all(file, status.st_size, text);
}

/* A device may act when it is opened, so it is not.  errno says why it failed. */
static bool read_text(const char* path, Text* text) {
  struct stat status;
  const int file = !stat(path, &status) && is_plain(&status) ? open(path, HOW_TO_OPEN) : -1;
  if (file < 0) {
    return false;
  }
  const bool is_read = read_open(file, text);
  const int why = errno;
  (void)close(file);
  errno = why;
  return is_read;
}

static void make_printable(FilesFault* fault) {
  for (char* c = fault->line; *c; ++c) {
    *c = (unsigned char)*c < ' ' || *c == 127 ? '?' : *c;
  }
}

/* What is not plain was not opened, so the system has no words for it. */
static const char* reason(int why) {
  return why == EINVAL ? "not a plain file" : strerror(why);
}

static void complain_of_file(const char* path, FilesKind file, FilesFault* fault) {
  static const char* const names[FILES_COUNT] = {
      [FILES_SCALE] = "a Scala scale (.scl)",
      [FILES_MAPPING] = "a Scala mapping (.kbm)",
      [FILES_BODY] = "a table of modes (.body)",
  };
  (void)snprintf(fault->line, sizeof(fault->line), "%s:1: found no text (%s), expected %s", path,
                 reason(errno), names[file]);
}

static void
complain_of_text(const char* path, const ScaleError* error, bool may_quote, FilesFault* fault) {
  (void)snprintf(fault->line, sizeof(fault->line), "%s:%u: %s%s%sexpected %s", path, error->line,
                 may_quote ? "found " : "", may_quote ? error->found : "", may_quote ? ", " : "",
                 error->expected);
}

static bool ends_with(const char* path, const char* ending) {
  const size_t length = strlen(path);
  const size_t n = strlen(ending);
  return length > n && strcasecmp(path + length - n, ending) == 0;
}

/* false: its ending does not say. */
static bool has_known_ending(const char* path, FilesKind* file) {
  static const struct {
    const char* ending;
    FilesKind file;
  } known[] = {{".scl", FILES_SCALE},
               {".ascl", FILES_SCALE},
               {".kbm", FILES_MAPPING},
               {".body", FILES_BODY}};
  for (size_t i = 0; i < sizeof(known) / sizeof(known[0]); ++i) {
    if (ends_with(path, known[i].ending)) {
      *file = known[i].file;
      return true;
    }
  }
  return false;
}

static bool read_body(const Text* text, Body* body, ScaleError* error) {
  BodyError wrong;
  if (!body_read(text->bytes, text->n_bytes, body, &wrong)) {
    return true;
  }
  error->line = wrong.line;
  (void)snprintf(error->found, sizeof(error->found), "%s", wrong.found);
  (void)snprintf(error->expected, sizeof(error->expected), "%s", wrong.expected);
  return false;
}

static bool read_as(const Text* text, FilesKind file, FilesContent* content, ScaleError* error) {
  content->file = file;
  switch (file) {
  case FILES_SCALE:
    content->is_good = !scale_read(text->bytes, text->n_bytes, &content->scale, error);
    break;
  case FILES_MAPPING:
    content->is_good = !scale_map_read(text->bytes, text->n_bytes, &content->map, error);
    break;
  case FILES_BODY:
  case FILES_COUNT:
    content->is_good = read_body(text, &content->body, error);
    break;
  }
  return content->is_good;
}

/* What reads as a mapping may read as a scale of no notes, but not the other way; a body, whose
 * lines begin with words, as neither. */
static void
read_whatever(const Text* text, FilesKind asked, FilesContent* content, ScaleError* error) {
  if (!read_as(text, FILES_MAPPING, content, error) &&
      !read_as(text, FILES_SCALE, content, error) && !read_as(text, FILES_BODY, content, error)) {
    (void)read_as(text, asked, content, error);
  }
}

void files_read(
    const char* path, FilesKind asked, bool may_quote, FilesContent* content, FilesFault* fault) {
  Text text = {NULL, 0};
  ScaleError error;
  FilesKind file = asked;
  const bool is_known = has_known_ending(path, &file);
  *content = (FilesContent){.file = is_known ? file : asked};
  if (!read_text(path, &text)) {
    complain_of_file(path, content->file, fault);
    make_printable(fault);
  } else {
    if (is_known) {
      (void)read_as(&text, file, content, &error);
    } else {
      read_whatever(&text, asked, content, &error);
    }
    if (!content->is_good) {
      complain_of_text(path, &error, may_quote, fault);
      make_printable(fault);
    }
  }
  free(text.bytes);
}

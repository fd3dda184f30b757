#define _XOPEN_SOURCE 700

#include "tools/formats/outfile.h"

#include "tools/formats/unfinished.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
  MAX_LINKS = 40,   /* That lead to each other */
  MAX_NAME = 255,   /* Of a file in a directory, in most file systems [bytes] */
  ENDING_SIZE = 32, /* Of ".PID.part" */
  CHUNK = 1 << 16
};

static bool is_stdout(const struct stat* status) {
  struct stat out;
  return !fstat(STDOUT_FILENO, &out) && out.st_dev == status->st_dev &&
         out.st_ino == status->st_ino;
}

bool outfile_is_stdout(const char* path) {
  struct stat status;
  return !stat(path, &status) && is_stdout(&status);
}

bool outfile_is_stream(const char* path) {
  struct stat status;
  return !stat(path, &status) && !S_ISDIR(status.st_mode) &&
         (!S_ISREG(status.st_mode) || is_stdout(&status));
}

bool outfile_is_same(const char* path, const char* other) {
  struct stat a;
  struct stat b;
  return !stat(path, &a) && !stat(other, &b) && S_ISREG(a.st_mode) && a.st_dev == b.st_dev &&
         a.st_ino == b.st_ino;
}

/* The name in a path. */
static char* name_in(char* path) {
  char* const slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

/* Go where the links from here lead, be there a file or not. 0, or a reason. */
static int follow(char path[OUTFILE_PATH_SIZE]) {
  for (int i = 0; i < MAX_LINKS; ++i) {
    char link[OUTFILE_PATH_SIZE];
    const ssize_t length = readlink(path, link, sizeof(link) - 1);
    if (length < 0) {
      return errno == EINVAL || errno == ENOENT ? 0 : errno;
    }
    link[length] = '\0';
    char* const at = *link == '/' ? path : name_in(path);
    if (strlen(link) >= (size_t)(path + OUTFILE_PATH_SIZE - at)) {
      return ENAMETOOLONG;
    }
    (void)strcpy(at, link);
  }
  return ELOOP;
}

/* Make the unfinished file beside the one that is meant, and say in `part` how it is called. */
static int make_part(Outfile* file, mode_t mode, char part[OUTFILE_PATH_SIZE]) {
  char ending[ENDING_SIZE];
  const int ending_length = snprintf(ending, sizeof(ending), ".%ld.part", (long)getpid());
  const char* const name = name_in(file->path);
  const size_t length = strlen(name);
  const size_t most = MAX_NAME - (size_t)ending_length;
  const size_t shown = (size_t)(name - file->path) + (length < most ? length : most);
  const int n = snprintf(part, OUTFILE_PATH_SIZE, "%.*s%s", (int)shown, file->path, ending);
  if (n < 0 || n >= OUTFILE_PATH_SIZE) {
    return ENAMETOOLONG;
  }
  file->fd = unfinished_open(part, mode);
  return file->fd < 0 ? errno : 0;
}

static int open_file(Outfile* file, const struct stat* old, char part[OUTFILE_PATH_SIZE]) {
  const mode_t mode = old ? old->st_mode & 0777 : 0666;
  int reason = follow(file->path);
  if (!reason && old && access(file->path, W_OK)) {
    reason = errno;
  }
  reason = reason ? reason : make_part(file, mode, part);
  if (!reason && old && fchmod(file->fd, mode)) {
    reason = errno;
    outfile_drop(file);
  }
  return reason;
}

/* Sound files are gone back in, which a pipe is not. */
static int open_stream(Outfile* file) {
  if (access(file->path, W_OK)) {
    return errno;
  }
  FILE* const nameless = tmpfile();
  file->fd = nameless ? dup(fileno(nameless)) : -1;
  const int reason = file->fd < 0 ? errno : 0;
  if (nameless) {
    (void)fclose(nameless);
  }
  return reason;
}

bool outfile_open(Outfile* file, const char* path, char* error, size_t error_size) {
  struct stat status;
  char part[OUTFILE_PATH_SIZE] = "";
  const bool is_there = !stat(path, &status);
  int reason = is_there || errno == ENOENT ? 0 : errno;
  *file = (Outfile){.fd = -1, .is_stream = outfile_is_stream(path)};
  if (strlen(path) >= sizeof(file->path)) {
    reason = ENAMETOOLONG;
  }
  if (!reason) {
    (void)strcpy(file->path, path);
    reason = file->is_stream ? open_stream(file) : open_file(file, is_there ? &status : NULL, part);
  }
  if (reason) {
    (void)snprintf(error, error_size, "%.*s: %s", OUTFILE_PATH_SIZE, reason == EEXIST ? part : path,
                   strerror(reason));
  }
  return !reason;
}

static bool write_all(int fd, const char* bytes, size_t size) {
  while (size > 0) {
    const ssize_t n = write(fd, bytes, size);
    if (n < 0 && errno != EINTR) {
      return false;
    }
    bytes += n > 0 ? n : 0;
    size -= n > 0 ? (size_t)n : 0;
  }
  return true;
}

/* 0, or a reason. */
static int copy(int from, int to) {
  char chunk[CHUNK];
  ssize_t n = lseek(from, 0, SEEK_SET) < 0 ? -1 : read(from, chunk, sizeof(chunk));
  while (n > 0 && write_all(to, chunk, (size_t)n)) {
    n = read(from, chunk, sizeof(chunk));
  }
  return n ? errno : 0;
}

static int pour(const Outfile* file) {
  const int to =
      outfile_is_stdout(file->path) ? dup(STDOUT_FILENO) : open(file->path, O_WRONLY | O_CLOEXEC);
  int reason = to < 0 ? errno : copy(file->fd, to);
  if (to >= 0 && close(to) && !reason) {
    reason = errno;
  }
  return reason;
}

int outfile_finish(Outfile* file) {
  int reason = file->is_stream ? pour(file) : 0;
  if (close(file->fd) && !reason) {
    reason = errno;
  }
  file->fd = -1;
  if (file->is_stream) {
    return reason;
  }
  if (reason) {
    unfinished_remove();
    return reason;
  }
  return unfinished_rename(file->path);
}

void outfile_drop(Outfile* file) {
  (void)close(file->fd);
  file->fd = -1;
  if (!file->is_stream) {
    unfinished_remove();
  }
}

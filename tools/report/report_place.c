#define _POSIX_C_SOURCE 200809L

#include "tools/report/report_place.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The name of the next file in the hidden directory, or NULL. */
static const char* next_name(DIR* list) {
  for (const struct dirent* entry = readdir(list); entry; entry = readdir(list)) {
    if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0) {
      return entry->d_name;
    }
  }
  return NULL;
}

/* List the hidden directory, from its beginning and with a descriptor of its own. */
static DIR* list_part(const ReportPlace* place) {
  const int fd = openat(place->fd, place->name, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  DIR* const list = fd < 0 ? NULL : fdopendir(fd);
  if (fd >= 0 && !list) {
    (void)close(fd);
  }
  return list;
}

static void close_all(ReportPlace* place) {
  if (place->part_fd >= 0) {
    (void)close(place->part_fd);
  }
  if (place->fd >= 0) {
    (void)close(place->fd);
  }
}

void report_place_drop(ReportPlace* place) {
  const int reason = errno;
  DIR* const list = place->part_fd < 0 ? NULL : list_part(place);
  for (const char* name = list ? next_name(list) : NULL; name; name = next_name(list)) {
    (void)unlinkat(place->part_fd, name, 0);
  }
  if (list) {
    (void)closedir(list);
  }
  if (place->fd >= 0) {
    (void)unlinkat(place->fd, place->name, AT_REMOVEDIR);
  }
  close_all(place);
  if (place->is_made) {
    (void)rmdir(place->path);
  }
  errno = reason;
}

bool report_place_open(ReportPlace* place, const char* path) {
  *place = (ReportPlace){.path = path, .fd = -1, .part_fd = -1};
  (void)snprintf(place->name, sizeof(place->name), ".report.%ld.part", (long)getpid());
  place->is_made = !mkdir(path, 0777);
  if (!place->is_made && errno != EEXIST) {
    return false;
  }
  place->fd = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (place->fd >= 0 && !mkdirat(place->fd, place->name, 0777)) {
    place->part_fd = openat(place->fd, place->name, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  }
  if (place->part_fd < 0) {
    report_place_drop(place);
    return false;
  }
  return true;
}

FILE* report_place_file(const ReportPlace* place, const char* name) {
  const int fd = openat(place->part_fd, name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  FILE* const file = fd < 0 ? NULL : fdopen(fd, "w");
  if (fd >= 0 && !file) {
    (void)close(fd);
  }
  return file;
}

bool report_place_close(FILE* file) {
  const bool is_written = !ferror(file);
  return !fclose(file) && is_written;
}

char* report_place_read(const ReportPlace* place, const char* name, size_t* n_bytes) {
  struct stat status = {0};
  const int fd = openat(place->part_fd, name, O_RDONLY | O_CLOEXEC);
  FILE* const file = fd < 0 || fstat(fd, &status) ? NULL : fdopen(fd, "r");
  if (!file) {
    if (fd >= 0) {
      (void)close(fd);
    }
    return NULL;
  }
  const size_t size = (size_t)status.st_size;
  char* bytes = calloc(size + 1, 1);
  if (bytes && fread(bytes, 1, size, file) != size) {
    free(bytes);
    bytes = NULL;
  }
  *n_bytes = size;
  (void)fclose(file);
  return bytes;
}

bool report_place_keep(ReportPlace* place) {
  DIR* const list = list_part(place);
  bool is_moved = list != NULL;
  for (const char* name = list ? next_name(list) : NULL; is_moved && name; name = next_name(list)) {
    is_moved = !renameat(place->part_fd, name, place->fd, name);
  }
  const int reason = errno;
  if (list) {
    (void)closedir(list);
  }
  errno = reason;
  place->is_made = place->is_made && !is_moved;
  report_place_drop(place);
  return is_moved;
}

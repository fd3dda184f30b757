#define _POSIX_C_SOURCE 200809L

#include "tools/host/locate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PATH_SIZE = 4096 };

static const char BUNDLE[] = "hooke.lv2";

/* The bundle in `dir`, if it has a manifest. */
static bool find_in(const char* dir, char* path, size_t size) {
  char bundle[PATH_SIZE];
  char manifest[PATH_SIZE + 16];
  const int length = snprintf(bundle, sizeof(bundle), "%s/%s", dir, BUNDLE);
  if (length < 0 || (size_t)length >= sizeof(bundle) || (size_t)length >= size) {
    return false;
  }
  (void)snprintf(manifest, sizeof(manifest), "%s/manifest.ttl", bundle);
  if (access(manifest, R_OK)) {
    return false;
  }
  memcpy(path, bundle, (size_t)length + 1);
  return true;
}

static bool find_beside_program(char* path, size_t size) {
  char program[PATH_SIZE];
  const ssize_t length = readlink("/proc/self/exe", program, sizeof(program) - 1);
  if (length <= 0) {
    return false;
  }
  program[length] = '\0';
  char* const slash = strrchr(program, '/');
  if (!slash) {
    return false;
  }
  *slash = '\0';
  return find_in(program, path, size);
}

static bool find_installed(char* path, size_t size) {
#ifdef HOOKE_LV2DIR
  return find_in(HOOKE_LV2DIR, path, size);
#else
  (void)path;
  (void)size;
  return false;
#endif
}

bool locate_bundle(char* path, size_t size) {
  return !getenv("LV2_PATH") && (find_beside_program(path, size) || find_installed(path, size));
}

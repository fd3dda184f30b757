/* Every seed of a harness, without libFuzzer. */
#define _POSIX_C_SOURCE 200809L

#include "tests/fuzz/fuzz.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MAX_SEED = 1 << 20, MAX_PATH = 4096 };

static const char* seeds_path(char path[MAX_PATH]) {
  const char* const source = getenv("HOOKE_SOURCE");
  (void)snprintf(path, MAX_PATH, "%s/tests/fuzz/seeds/%s", source ? source : ".", FUZZ_NAME);
  return path;
}

/* Named first, so that a log ends with the one that broke a claim. */
static void replay(const char* directory, const char* name) {
  char path[2 * MAX_PATH];
  static uint8_t bytes[MAX_SEED];
  (void)snprintf(path, sizeof(path), "%s/%s", directory, name);
  FILE* const file = fopen(path, "rb");
  assert_non_null(file);
  const size_t n_bytes = fread(bytes, 1, sizeof(bytes), file);
  assert_true(!ferror(file) && !fclose(file) && n_bytes < MAX_SEED);
  print_message("%s, %zu bytes\n", name, n_bytes);
  uint8_t* const copy = fuzz_copy(bytes, n_bytes);
  fuzz_one(copy, n_bytes);
  free(copy);
}

static void every_seed_is_survived(void** state) {
  (void)state;
  char path[MAX_PATH];
  unsigned n_seeds = 0;
  DIR* const directory = opendir(seeds_path(path));
  assert_non_null(directory);
  for (const struct dirent* entry = readdir(directory); entry; entry = readdir(directory)) {
    if (entry->d_name[0] != '.') {
      replay(path, entry->d_name);
      ++n_seeds;
    }
  }
  assert_int_equal(closedir(directory), 0);
  assert_true(n_seeds > 0);
}

static void no_bytes_at_all_are_survived(void** state) {
  (void)state;
  fuzz_one((const uint8_t*)"", 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(no_bytes_at_all_are_survived),
      cmocka_unit_test(every_seed_is_survived),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

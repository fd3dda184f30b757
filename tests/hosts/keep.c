/* Keep a plugin's state in a directory, as jalv does and as it reads it.

     keep URI PRESET DIRECTORY [SYMBOL=VALUE]... [scale=FILE.scl] */
#include "tests/support/host_inside.h"
#include "tests/support/host_state.h"
#include "tests/support/scale_host.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool set(Host* host, const char* setting) {
  char symbol[64];
  const char* const sign = strchr(setting, '=');
  if (!sign) {
    return false;
  }
  (void)snprintf(symbol, sizeof(symbol), "%.*s", (int)(sign - setting), setting);
  if (!strcmp(symbol, "scale")) {
    scale_set(host, SCALE_PARAMETER, sign + 1);
    return true;
  }
  return host_set(host, symbol, (float)atof(sign + 1));
}

int main(int argc, char** argv) {
  char error[512] = "expected a plugin, a preset and a directory";
  Host* const host = argc < 4 ? NULL : host_new(argv[1], 48000.0, 256, error, sizeof(error));
  if (!host) {
    (void)fprintf(stderr, "keep: %s\n", error);
    return EXIT_FAILURE;
  }
  bool is_kept = host_preset(host, argv[2]);
  for (int i = 4; i < argc; ++i) {
    is_kept = is_kept && set(host, argv[i]);
  }
  is_kept =
      is_kept && host_run(host, 256) && host_run(host, 256) && host_save_state_dir(host, argv[3]);
  host_free(host);
  return is_kept ? EXIT_SUCCESS : EXIT_FAILURE;
}

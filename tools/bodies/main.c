/*
   The program that makes core/bank/bodies.c while Hooke is built: `bodies OUT.c FILE...`, where the
   files are all of presets/bodies/, each named as core/bank/bodies.h has it.
*/
#include "core/bank/bodies.h"
#include "tools/bodies/body_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char* const NAMES[BODIES_COUNT] = {
#define NAME(name, file, text) [BODIES_##name] = file,
    BODIES_LIST(NAME)
#undef NAME
};

/* The part of a path between its directories and its ending. */
static bool is_named(const char* path, const char* name) {
  const char* const slash = strrchr(path, '/');
  const char* const base = slash ? slash + 1 : path;
  const char* const dot = strrchr(base, '.');
  const size_t length = dot ? (size_t)(dot - base) : strlen(base);
  return length == strlen(name) && !strncmp(base, name, length);
}

static const char* find_file(const char* name, int n_files, char** files) {
  const char* found = NULL;
  for (int i = 0; i < n_files; ++i) {
    if (is_named(files[i], name)) {
      if (found) {
        fprintf(stderr, "bodies: found %s and %s, expected one of them\n", found, files[i]);
        return NULL;
      }
      found = files[i];
    }
  }
  if (!found) {
    fprintf(stderr, "bodies: found no %s.scene and no %s.body, expected one of them\n", name, name);
  }
  return found;
}

/* So many digits are the same whatever solver found them. */
static void write_body(FILE* out, const char* path, const Body* body) {
  fprintf(out, "    /* %s */\n    {\n        .n_modes = %uU,\n        .modes =\n            {\n",
          path, (unsigned)body->n_modes);
  for (uint32_t k = 0; k < body->n_modes; ++k) {
    const BodyMode* const mode = &body->modes[k];
    fprintf(out, "                {%.10e, %.10e, %.10e, {%.10e, %.10e}},\n", mode->f0_hz, mode->q,
            mode->mass_kg, mode->radiation[0], mode->radiation[1]);
  }
  fprintf(out, "            },\n        .power = {");
  for (int band = 0; band < BODY_BANDS; ++band) {
    fprintf(out, "%s%.10e", band ? ", " : "", body->power[band]);
  }
  fprintf(out, "},\n    },\n");
}

static bool write_bodies(FILE* out, int n_files, char** files) {
  char error[BODY_FILE_ERROR_SIZE];
  fprintf(out, "/* Made from presets/bodies/. */\n"
               "#include \"core/bank/bodies.h\"\n\n#include <stddef.h>\n\n"
               "static const Body BODIES[BODIES_FILE - 1] = {\n");
  for (int i = BODIES_NONE + 1; i < BODIES_FILE; ++i) {
    Body body;
    const char* const path = find_file(NAMES[i], n_files, files);
    if (!path) {
      return false;
    }
    if (!body_file_read(path, &body, NULL, error, sizeof(error))) {
      fprintf(stderr, "%s\n", error);
      return false;
    }
    write_body(out, NAMES[i], &body);
  }
  fprintf(out,
          "};\n\n"
          "const Body* bodies_shipped(BodiesChoice choice) {\n"
          "  return choice > BODIES_NONE && choice < BODIES_FILE ? &BODIES[choice - 1] : NULL;\n"
          "}\n");
  return true;
}

int main(int argc, char** argv) {
  FILE* const out = argc > 1 ? fopen(argv[1], "w") : NULL;
  if (!out) {
    fprintf(stderr, "usage: bodies OUT.c FILE...\n");
    return EXIT_FAILURE;
  }
  const bool is_written = write_bodies(out, argc - 2, argv + 2);
  if (fclose(out) || !is_written) {
    (void)remove(argv[1]);
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

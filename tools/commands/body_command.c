#define _POSIX_C_SOURCE 200809L

#include "core/bank/body.h"
#include "tools/bodies/body_file.h"
#include "tools/commands/args.h"
#include "tools/commands/commands.h"
#include "tools/formats/outfile.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

const char body_help[] =
    "usage: hooke body [OPTION]... IN.scene|IN.body [OUT.body]\n"
    "\n"
    "Write the modes of a body, the box, board or skin of an instrument: of a scene of plates,\n"
    "membranes, braces and air, reduced to what strings pull at and what is heard, or of a table.\n"
    "With OUT.body they become a table, which the plugins can load.\n"
    "\n"
    "  --csv               a line for each mode, under a line of names\n"
    "\n"
    "Of each mode: its frequency, its Q, its mass where the strings are, what is heard of it on\n"
    "the left and on the right, leveled as the plugins level it, and the gain at its peak from a\n"
    "force at the strings to what is heard.\n";

enum { CSV = ARGS_OPTION };

static const struct option options[] = {{"csv", no_argument, NULL, CSV}, {0}};

typedef struct {
  Args args;
  const char* in;
  const char* out; /* NULL: none */
  bool is_csv;
} Command;

static bool take_operand(Command* self, const char* value) {
  if (self->out) {
    return args_fail(&self->args, false, "found '%s' too, expected one body and one table", value);
  }
  *(self->in ? &self->out : &self->in) = value;
  return true;
}

static bool parse(Command* self) {
  for (int i = args_next(&self->args); i != ARGS_END; i = args_next(&self->args)) {
    if (i == CSV) {
      self->is_csv = true;
    } else if (i != ARGS_OPERAND || !take_operand(self, self->args.value)) {
      return false;
    }
  }
  if (!self->in) {
    return args_fail(&self->args, false,
                     "found no body, expected IN.scene or IN.body; try hooke help body");
  }
  return true;
}

static double peak_db(const Body* body, const BodyMode* mode) {
  return 10.0 * log10(body_gain_square(body, (BodyShape){1.0, 1.0}, mode->f0_hz));
}

static void print_csv(const Body* body) {
  puts("mode,frequency_hz,q,mass_kg,left_kg,right_kg,gain_db");
  for (uint32_t k = 0; k < body->n_modes; ++k) {
    const BodyMode* const mode = &body->modes[k];
    printf("%lu,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", (unsigned long)k + 1, mode->f0_hz, mode->q,
           mode->mass_kg, mode->radiation[0], mode->radiation[1], peak_db(body, mode));
  }
}

static void print_table(const Body* body, const Reduction* reduction) {
  printf(" mode  frequency [Hz]        Q    mass [kg]      left [kg]     right [kg]  gain [dB]\n");
  for (uint32_t k = 0; k < body->n_modes; ++k) {
    const BodyMode* const mode = &body->modes[k];
    printf("%5lu %15.3f %8.2f %12.5g %14.5g %14.5g %10.2f\n", (unsigned long)k + 1, mode->f0_hz,
           mode->q, mode->mass_kg, mode->radiation[0], mode->radiation[1], peak_db(body, mode));
  }
  if (reduction->n_masses == 0) {
    printf("a table of %lu modes\n", (unsigned long)body->n_modes);
    return;
  }
  printf("a network of %lu masses: %lu modes are heard", (unsigned long)reduction->n_masses,
         (unsigned long)reduction->n_heard);
  if (reduction->n_heard > body->n_modes) {
    printf(", the strongest %lu are kept, and what went with the others is %.1f dB below all",
           (unsigned long)body->n_modes, 10.0 * log10(reduction->lost));
  }
  (void)putchar('\n');
}

static void write_modes(FILE* file, const Body* body, const char* in) {
  const char* const slash = strrchr(in, '/');
  fprintf(file, "# Of ");
  for (const char* at = slash ? slash + 1 : in; *at; ++at) {
    (void)fputc(*at < ' ' || *at > '~' ? '?' : *at, file);
  }
  fprintf(file, ", by hooke body.\n");
  for (uint32_t k = 0; k < body->n_modes; ++k) {
    const BodyMode* const mode = &body->modes[k];
    fprintf(file, "mode %.12g %.12g %.12g %.12g %.12g\n", mode->f0_hz, mode->q, mode->mass_kg,
            mode->radiation[0], mode->radiation[1]);
  }
}

/* 0, or a reason. */
static int write_to(Outfile* out, const Body* body, const char* in) {
  FILE* const file = fdopen(dup(out->fd), "w");
  if (!file) {
    return errno;
  }
  write_modes(file, body, in);
  const bool is_lost = ferror(file);
  const int reason = fclose(file) || is_lost ? errno : 0;
  return is_lost && !reason ? EIO : reason;
}

static int write_table(const Command* self, const Body* body) {
  char error[OUTFILE_PATH_SIZE + 256];
  Outfile out;
  if (!outfile_open(&out, self->out, error, sizeof(error))) {
    return args_fail(&self->args, ARGS_FAILURE, "%s", error);
  }
  int reason = write_to(&out, body, self->in);
  if (reason) {
    outfile_drop(&out);
  } else {
    reason = outfile_finish(&out);
  }
  return reason ? args_fail(&self->args, ARGS_FAILURE, "%s: %s", self->out, strerror(reason))
                : ARGS_OK;
}

int body_main(int argc, char** argv) {
  char error[BODY_FILE_ERROR_SIZE] = "";
  Body body;
  Reduction reduction = {0};
  Command self = {
      .args = {.command = "hooke body", .argc = argc, .argv = argv, .options = options}};
  if (!parse(&self)) {
    return ARGS_USAGE;
  }
  if (self.out && outfile_is_same(self.out, self.in)) {
    return args_fail(&self.args, ARGS_USAGE, "found '%s' twice, expected two files", self.in);
  }
  if (!body_file_read(self.in, &body, &reduction, error, sizeof(error))) {
    return args_fail(&self.args, ARGS_FAILURE, "%s", error);
  }
  if (self.is_csv) {
    print_csv(&body);
  } else {
    print_table(&body, &reduction);
  }
  return self.out ? write_table(&self, &body) : ARGS_OK;
}

#define _POSIX_C_SOURCE 200809L

#include "tools/bench/bench.h"
#include "tools/commands/args.h"
#include "tools/commands/commands.h"
#include "tools/commands/near_miss.h"
#include "tools/formats/score.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#ifndef HOOKE_VERSION
#define HOOKE_VERSION "unknown"
#endif

typedef struct {
  const char* name;
  const char* summary;
  const char* help;
  int (*run)(int argc, char** argv);
} Command;

static const Command commands[] = {
    {"render", "play a MIDI file, a score or a scene and write what sounds", render_help,
     render_main},
    {"modes", "say what a scene will sound like, and whether it is stable", modes_help, modes_main},
    {"body", "reduce an instrument's body to the modes that strings and ears have of it", body_help,
     body_main},
    {"tune", "find the masses and springs of a pitch and a decay", tune_help, tune_main},
    {"bench", "measure what strings and instruments cost on this machine", bench_help, bench_main},
};

enum { N_COMMANDS = sizeof(commands) / sizeof(commands[0]), NAMES_SIZE = 128 };

static const Command* find_command(const char* name) {
  for (unsigned i = 0; i < N_COMMANDS; ++i) {
    if (!strcmp(commands[i].name, name)) {
      return &commands[i];
    }
  }
  return NULL;
}

static const Args HOOKE = {.command = "hooke"};

/* All commands there are, as a sentence has them. */
static const char* names(char text[NAMES_SIZE]) {
  *text = '\0';
  for (unsigned i = 0; i < N_COMMANDS; ++i) {
    const size_t length = strlen(text);
    (void)snprintf(text + length, NAMES_SIZE - length, "%s%s",
                   i == 0                ? ""
                   : i + 1 == N_COMMANDS ? " or "
                                         : ", ",
                   commands[i].name);
  }
  return text;
}

static int refuse(const char* name) {
  char text[NAMES_SIZE];
  char hint[NAMES_SIZE];
  NearMiss miss = near_miss_of(name);
  for (unsigned i = 0; i < N_COMMANDS; ++i) {
    near_miss_try(&miss, commands[i].name);
  }
  near_miss_try(&miss, "help");
  near_miss_try(&miss, "--version");
  return args_fail(&HOOKE, ARGS_USAGE, "found '%s', expected a command, %s; try hooke --help%s",
                   name, names(text), near_miss_hint(&miss, hint, sizeof(hint)));
}

static int help_all(void) {
  printf("usage: hooke COMMAND [ARGUMENT]...\n\n");
  for (unsigned i = 0; i < N_COMMANDS; ++i) {
    printf("  %-8s %s\n", commands[i].name, commands[i].summary);
  }
  printf("\nhooke help COMMAND says more, and hooke help score what a score is; hooke --version "
         "says which hooke this is.\n");
  return ARGS_OK;
}

static int help(const char* name) {
  const Command* const command = name ? find_command(name) : NULL;
  if (!name) {
    return help_all();
  }
  if (!command && strcmp(name, "score") != 0) {
    return refuse(name);
  }
  (void)fputs(command ? command->help : score_help, stdout);
  return ARGS_OK;
}

static int run(int argc, char** argv) {
  char text[NAMES_SIZE];
  if (argc < 2) {
    return args_fail(&HOOKE, ARGS_USAGE, "found no command, expected %s; try hooke --help",
                     names(text));
  }
  const char* const word = argv[1];
  if (!strcmp(word, "--version")) {
    (void)puts("hooke " HOOKE_VERSION);
    return ARGS_OK;
  }
  if (!strcmp(word, "--help") || !strcmp(word, "-h") || !strcmp(word, "help")) {
    return argc > 3 ? args_fail(&HOOKE, ARGS_USAGE, "found '%s' too, expected one command", argv[3])
                    : help(argc > 2 ? argv[2] : NULL);
  }
  const Command* const command = find_command(word);
  if (!command) {
    return refuse(word);
  }
  if (argc > 2 && (!strcmp(argv[2], "--help") || !strcmp(argv[2], "-h"))) {
    return help(word);
  }
  return command->run(argc - 1, argv + 1);
}

/* What is said could get lost at last: in a buffer. Of what was lost before one more byte tells
 * why. */
static int finish(int code) {
  const bool is_lost = ferror(stdout);
  if (is_lost) {
    (void)putchar('\n');
  }
  errno = 0;
  if (!fflush(stdout) && !is_lost) {
    return code;
  }
  return args_fail(&HOOKE, ARGS_FAILURE, "could not write all of the answer%s%s", errno ? ": " : "",
                   errno ? strerror(errno) : "");
}

/* No file that is opened may pass for stdout or stderr, where they are closed: what is written to
 * these fails now. */
static void open_standard(void) {
  int fd = open("/dev/null", O_RDONLY);
  while (fd >= 0 && fd <= STDERR_FILENO) {
    fd = open("/dev/null", O_RDONLY);
  }
  if (fd >= 0) {
    (void)close(fd);
  }
}

/* A file that may not grow is told by its write, as a full disk is. */
int main(int argc, char** argv) {
  open_standard();
  (void)signal(SIGXFSZ, SIG_IGN);
  return finish(run(argc, argv));
}

#include "tools/bench/bench.h"
#include "tools/commands/args.h"
#include "tools/commands/commands.h"
#include "tools/formats/score.h"

#include <stdio.h>
#include <string.h>

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
    {"tune", "find the masses and springs of a pitch and a decay", tune_help, tune_main},
    {"bench", "measure what strings and instruments cost on this machine", bench_help, bench_main},
};

enum { N_COMMANDS = sizeof(commands) / sizeof(commands[0]) };

static const Command* find_command(const char* name) {
  for (unsigned i = 0; i < N_COMMANDS; ++i) {
    if (!strcmp(commands[i].name, name)) {
      return &commands[i];
    }
  }
  return NULL;
}

static int refuse(const char* name) {
  (void)fprintf(stderr, "hooke: found '%s', expected a command; try hooke --help\n", name);
  return ARGS_USAGE;
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
  if (!strcmp(name, "score")) {
    return fputs(score_help, stdout) < 0 ? ARGS_FAILURE : ARGS_OK;
  }
  if (!command) {
    return refuse(name);
  }
  (void)fputs(command->help, stdout);
  return ARGS_OK;
}

int main(int argc, char** argv) {
  if (argc < 2) {
    (void)fprintf(stderr, "hooke: found no command, expected one; try hooke --help\n");
    return ARGS_USAGE;
  }
  const char* const word = argv[1];
  if (!strcmp(word, "--version")) {
    return puts("hooke " HOOKE_VERSION) < 0 ? ARGS_FAILURE : ARGS_OK;
  }
  if (!strcmp(word, "--help") || !strcmp(word, "-h") || !strcmp(word, "help")) {
    return help(argc > 2 ? argv[2] : NULL);
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

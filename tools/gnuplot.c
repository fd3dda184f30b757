#define _POSIX_C_SOURCE 200809L

#include "tools/gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

static const char LOG[] = "gnuplot.log";

enum { NOT_STARTED = 127 };

/* In the child: all that it says goes to the log, and nothing is asked. */
static void start(int directory_fd, const char* log, char* const argv[]) {
  const int null = open("/dev/null", O_RDWR);
  const int fd = log ? openat(directory_fd, log, O_WRONLY | O_CREAT | O_TRUNC, 0666) : null;
  const bool is_there = directory_fd < 0 || !fchdir(directory_fd);
  const bool is_quiet = null >= 0 && fd >= 0 && dup2(null, STDIN_FILENO) >= 0 &&
                        dup2(fd, STDOUT_FILENO) >= 0 && dup2(fd, STDERR_FILENO) >= 0;
  if (is_there && is_quiet) {
    (void)execvp(argv[0], argv);
  }
  _exit(NOT_STARTED);
}

/* The exit status, or NOT_STARTED. */
static int call(int directory_fd, const char* log, char* const argv[]) {
  const pid_t child = fork();
  int status = 0;
  if (child == 0) {
    start(directory_fd, log, argv);
  }
  while (child > 0 && waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) {
      return NOT_STARTED;
    }
  }
  return child > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : NOT_STARTED;
}

bool gnuplot_is_there(void) {
  char name[] = "gnuplot";
  char option[] = "--version";
  char* const argv[] = {name, option, NULL};
  return call(-1, NULL, argv) == 0;
}

/* The first line of the log that says something. */
static void read_log(int directory_fd, char* error, size_t error_size) {
  const int fd = openat(directory_fd, LOG, O_RDONLY | O_CLOEXEC);
  FILE* const log = fd < 0 ? NULL : fdopen(fd, "r");
  char line[256] = "no reason given";
  while (log && fgets(line, sizeof(line), log)) {
    line[strcspn(line, "\n")] = '\0';
    if (strchr(line, ':')) {
      break; /* Its others repeat the script and point at a place in it. */
    }
  }
  (void)snprintf(error, error_size, "gnuplot: %s", line);
  if (log) {
    (void)fclose(log);
  }
}

bool gnuplot_run(int directory_fd, char* const names[], char* error, size_t error_size) {
  size_t n = 0;
  while (names[n]) {
    ++n;
  }
  char name[] = "gnuplot";
  char option[] = "-d"; /* Without the user's own settings. */
  char** const argv = calloc(n + 3, sizeof(*argv));
  if (!argv) {
    (void)snprintf(error, error_size, "out of memory");
    return false;
  }
  argv[0] = name;
  argv[1] = option;
  memcpy(argv + 2, names, n * sizeof(*argv));
  const bool is_done = call(directory_fd, LOG, argv) == 0;
  if (!is_done) {
    read_log(directory_fd, error, error_size);
  }
  free((void*)argv);
  return is_done;
}

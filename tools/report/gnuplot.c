#define _POSIX_C_SOURCE 200809L

#include "tools/report/gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

static const char LOG[] = "gnuplot.log";

enum { NOT_STARTED = 127 };

/* In the child: all that it says goes to the log, if there is one, and nothing is asked. */
static void start(int directory_fd, const char* log, const char* option, const char* word) {
  const int null = open("/dev/null", O_RDWR);
  const int fd = log ? openat(directory_fd, log, O_WRONLY | O_CREAT | O_TRUNC, 0666) : null;
  const bool is_there = directory_fd < 0 || !fchdir(directory_fd);
  const bool is_quiet = null >= 0 && fd >= 0 && dup2(null, STDIN_FILENO) >= 0 &&
                        dup2(fd, STDOUT_FILENO) >= 0 && dup2(fd, STDERR_FILENO) >= 0;
  if (is_there && is_quiet) {
    (void)execlp("gnuplot", "gnuplot", option, word, (char*)NULL);
  }
  _exit(NOT_STARTED);
}

/* The exit status, or NOT_STARTED. */
static int call(int directory_fd, const char* log, const char* option, const char* word) {
  const pid_t child = fork();
  int status = 0;
  if (child == 0) {
    start(directory_fd, log, option, word);
  }
  while (child > 0 && waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) {
      return NOT_STARTED;
    }
  }
  return child > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : NOT_STARTED;
}

/* The first line of the log that tells what is wrong: the others repeat the script and point at a
 * place in it. */
static void read_log(int directory_fd, char* error, size_t error_size) {
  const int fd = openat(directory_fd, LOG, O_RDONLY | O_CLOEXEC);
  FILE* const log = fd < 0 ? NULL : fdopen(fd, "r");
  char line[256] = "";
  while (log && !strchr(line, ':') && fgets(line, sizeof(line), log)) {
    line[strcspn(line, "\n")] = '\0';
  }
  (void)snprintf(error, error_size, "gnuplot: %s", *line ? line : "no reason given");
  if (log) {
    (void)fclose(log);
  }
}

bool gnuplot_is_there(void) {
  return call(-1, NULL, "--version", NULL) == 0;
}

bool gnuplot_run(int directory_fd, const char* script, char* error, size_t error_size) {
  const bool is_done = call(directory_fd, LOG, "-d", script) == 0;
  if (!is_done) {
    read_log(directory_fd, error, error_size);
  }
  (void)unlinkat(directory_fd, LOG, 0);
  return is_done;
}

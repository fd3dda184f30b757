#define _XOPEN_SOURCE 700

#include "tools/formats/unfinished.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Those that end a process, unless it is told otherwise. */
static const int DEADLY[] = {SIGHUP,  SIGINT,  SIGQUIT, SIGTERM, SIGPIPE,   SIGALRM,
                             SIGUSR1, SIGUSR2, SIGXCPU, SIGXFSZ, SIGVTALRM, SIGPROF,
                             SIGILL,  SIGABRT, SIGBUS,  SIGFPE,  SIGSEGV,   SIGSYS};
enum { N_DEADLY = sizeof(DEADLY) / sizeof(DEADLY[0]) };

/* A handler of signals is given nothing but their number. */
static char unfinished[PATH_MAX];
static struct sigaction before[N_DEADLY];

/* Then what would have been done is done. */
static void on_signal(int number) {
  (void)unlink(unfinished);
  for (unsigned i = 0; i < N_DEADLY; ++i) {
    if (DEADLY[i] == number) {
      (void)sigaction(number, &before[i], NULL);
    }
  }
  (void)raise(number);
}

static void watch(void) {
  struct sigaction action = {.sa_handler = on_signal};
  (void)sigfillset(&action.sa_mask);
  for (unsigned i = 0; i < N_DEADLY; ++i) {
    (void)sigaction(DEADLY[i], NULL, &before[i]);
    if (before[i].sa_handler != SIG_IGN) {
      (void)sigaction(DEADLY[i], &action, NULL);
    }
  }
}

static void stop_watching(void) {
  for (unsigned i = 0; i < N_DEADLY; ++i) {
    (void)sigaction(DEADLY[i], &before[i], NULL);
  }
}

/* What is between hold() and go_on() is one step for a signal. */
static sigset_t hold(void) {
  sigset_t all;
  sigset_t old;
  (void)sigfillset(&all);
  (void)sigprocmask(SIG_BLOCK, &all, &old);
  return old;
}

static void go_on(sigset_t old) {
  const int reason = errno;
  (void)sigprocmask(SIG_SETMASK, &old, NULL);
  errno = reason;
}

int unfinished_open(const char* path, mode_t mode) {
  if (strlen(path) >= sizeof(unfinished)) {
    errno = ENAMETOOLONG;
    return -1;
  }
  const sigset_t old = hold();
  const int fd = open(path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (fd >= 0) {
    (void)strcpy(unfinished, path);
    watch();
  }
  go_on(old);
  return fd;
}

int unfinished_rename(const char* path) {
  const sigset_t old = hold();
  const int reason = rename(unfinished, path) ? errno : 0;
  if (reason) {
    (void)unlink(unfinished);
  }
  stop_watching();
  go_on(old);
  return reason;
}

void unfinished_remove(void) {
  const sigset_t old = hold();
  (void)unlink(unfinished);
  stop_watching();
  go_on(old);
}

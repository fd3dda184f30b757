/* Which thread is inside of a plugin, and what it did there. */
#define _GNU_SOURCE

#include "tests/hosts/watch.h"

#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/prctl.h>
#include <ucontext.h>

#ifndef PR_SET_SYSCALL_USER_DISPATCH
#define PR_SET_SYSCALL_USER_DISPATCH 59
#endif

/* Not in a library's own block, whose first use takes memory. */
#define QUICK _Thread_local __attribute__((tls_model("initial-exec")))

enum { DISPATCH_ON = 1, LET_PASS = 0, STOP = 1 };

static QUICK int inside;         /* The plugin, from 1 on; 0: none */
static QUICK int is_asked;       /* The kernel, to stop calls of this thread */
static QUICK volatile char gate; /* The kernel reads it at each call */

static atomic_ulong counts[WATCH_PLUGINS][WATCH_KINDS];
static _Atomic(const char*) firsts[WATCH_PLUGINS][WATCH_KINDS];
static atomic_int sees_system;

void watch_fault(WatchKind kind, const char* what) {
  const char* none = NULL;
  if (inside) {
    atomic_fetch_add(&counts[inside - 1][kind], 1);
    (void)atomic_compare_exchange_strong(&firsts[inside - 1][kind], &none, what);
  }
}

unsigned long watch_count(int plugin, WatchKind kind) {
  return atomic_load(&counts[plugin][kind]);
}

const char* watch_first(int plugin, WatchKind kind) {
  const char* const first = atomic_load(&firsts[plugin][kind]);
  return first ? first : "";
}

int watch_sees_system(void) {
  return atomic_load(&sees_system);
}

#if defined(__linux__) && defined(__x86_64__)

/* The call has not been made.  From here to the end of the run calls pass, for the way back from
 * here is one; and the thread goes back to the instruction itself, which is two bytes long. */
static void on_call(int signal, siginfo_t* info, void* context) {
  static char names[WATCH_PLUGINS][32];
  ucontext_t* const where = context;
  (void)signal;
  gate = LET_PASS;
  if (inside && !watch_count(inside - 1, WATCH_SYSTEM)) {
    (void)snprintf(names[inside - 1], sizeof(names[0]), "call %d", info->si_syscall);
    watch_fault(WATCH_SYSTEM, names[inside - 1]);
  } else {
    watch_fault(WATCH_SYSTEM, "");
  }
  where->uc_mcontext.gregs[REG_RIP] -= 2;
}

static void ask(void) {
  struct sigaction action = {.sa_sigaction = on_call, .sa_flags = SA_SIGINFO};
  is_asked = 1;
  if (!sigaction(SIGSYS, &action, NULL) &&
      !prctl(PR_SET_SYSCALL_USER_DISPATCH, DISPATCH_ON, 0L, 0L, &gate)) {
    atomic_store(&sees_system, 1);
  }
}

#else

static void ask(void) {
  is_asked = 1;
}

#endif

void watch_enter(int plugin) {
  if (!is_asked) {
    ask();
  }
  inside = plugin + 1;
  gate = STOP;
}

void watch_leave(void) {
  gate = LET_PASS;
  inside = 0;
}

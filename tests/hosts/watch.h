/** What the real-time watch sees: the parts of a library that is preloaded into a host. */
#ifndef HOOKE_TESTS_HOSTS_WATCH_H
#define HOOKE_TESTS_HOSTS_WATCH_H

/** What the thread that runs a plugin must leave alone. */
typedef enum { WATCH_HEAP, WATCH_LOCK, WATCH_SYSTEM, WATCH_FLOATS, WATCH_KINDS } WatchKind;

enum { WATCH_PLUGINS = 16 };

/**
   Count a fault if the calling thread is inside of a plugin, as one of that plugin's.

   @param what  Its name, which stays where it is; the first of each kind is told
*/
void watch_fault(WatchKind kind, const char* what);

/** The calling thread goes into plugin 0 … WATCH_PLUGINS − 1, from where calls of the kernel are
 * faults as well. */
void watch_enter(int plugin);

/** It is out again. */
void watch_leave(void);

/** A plugin's faults so far, and the first of them by name or "". */
unsigned long watch_count(int plugin, WatchKind kind);
const char* watch_first(int plugin, WatchKind kind);

/** Whether calls of the kernel can be seen here. */
int watch_sees_system(void);

#endif

/** Every way in which the core can fail, in one list.  Thread: any. */
#ifndef HOOKE_CORE_STATUS_H
#define HOOKE_CORE_STATUS_H

/** X(name, text): the text completes "could not …: ". */
#define STATUS_LIST(X)                                                                             \
  X(OK, "no error")                                                                                \
  X(BAD_ARGUMENT, "an argument is out of its range")                                               \
  X(NO_MEMORY, "out of memory")                                                                    \
  X(UNSTABLE, "no stable system of that many masses has this pitch and decay")

#define STATUS_ENUM(name, text) STATUS_##name,
typedef enum { STATUS_LIST(STATUS_ENUM) STATUS_COUNT } Status;
#undef STATUS_ENUM

/** What `status` means, in words; never NULL.  Real-time safe. */
const char* status_text(Status status);

#endif

/** Every way in which the core can fail, in one list.  Thread: any. */
#ifndef HOOKE_CORE_BASE_STATUS_H
#define HOOKE_CORE_BASE_STATUS_H

/** X(name, text): the text completes "could not …: ". */
#define STATUS_LIST(X)                                                                             \
  X(OK, "no error")                                                                                \
  X(BAD_ARGUMENT, "an argument is out of its range")                                               \
  X(NO_MEMORY, "out of memory")                                                                    \
  X(UNSTABLE, "no stable system of that many masses has this pitch and decay")                     \
  X(BAD_MASS, "a mass is not a number above zero")                                                 \
  X(BAD_LINK, "a stiffness or damping is not a number from zero up")                               \
  X(NO_SUCH_POINT, "a spring or damper ends at a point that is not there")                         \
  X(SELF_LINK, "a spring or damper joins a point to itself")                                       \
  X(EMPTY, "there is no mass")                                                                     \
  X(FREE, "it is the drift of a part that hangs on no grounded point")                             \
  X(NO_SUCH_MODE, "there is no such mode")                                                         \
  X(UNREACHABLE, "the pitch lies beyond half the rate, or nothing damps the mode that much")       \
  X(ILL_SCALED, "its numbers differ too widely for the arithmetic")                                \
  X(NO_CONVERGENCE, "an iteration did not converge")                                               \
  X(BAD_TEXT, "a text is not as its format asks")

#define STATUS_ENUM(name, text) STATUS_##name,
typedef enum { STATUS_LIST(STATUS_ENUM) STATUS_COUNT } Status;
#undef STATUS_ENUM

/** What `status` means, in words; never NULL.  Real-time safe. */
const char* status_text(Status status);

#endif

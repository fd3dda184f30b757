/** A player's files, tunings and bodies, and a hosted instrument: what a panel says and hears, and
 * what is written to the log.  What cannot be done here fails the test. */
#ifndef HOOKE_TESTS_SUPPORT_SCALE_HOST_H
#define HOOKE_TESTS_SUPPORT_SCALE_HOST_H

#include "core/bank/bodies.h"
#include "tests/support/strings_host.h"

#include <stdbool.h>
#include <stdint.h>

#define SCALE_PARAMETER STRINGS_URI "#scale"
#define MAPPING_PARAMETER STRINGS_URI "#mapping"
#define BODY_PARAMETER STRINGS_URI "#body"

enum { SCALE_HOST_PATH = 4096 };

/** A path. */
typedef struct {
  char text[SCALE_HOST_PATH];
} ScalePath;

/** The path of a file in tests/scales; the empty path of NULL. */
ScalePath scale_path(const char* file);

/** A new directory for a test's files, and a file written there. */
ScalePath scale_new_directory(void);
ScalePath scale_write(const ScalePath* directory, const char* file, const char* text);

/** The same of a body that Hooke brings along, as a table of its modes. */
ScalePath scale_write_body(const ScalePath* directory, const char* file, BodiesChoice choice);

/** Remove a directory and all in it. */
void scale_remove_directory(const ScalePath* directory);

/** Write a patch:Set of a path, or with a path of NULL a patch:Get; of no parameter if that is
 * NULL.
 * @return Bytes of the atom's body, which lie behind its header at `message` */
uint32_t
scale_message(Host* host, const char* parameter, const char* path, void* message, uint32_t size);

/** Queue a patch:Set of a path. */
void scale_set(Host* host, const char* parameter, const char* path);

/** Queue a patch:Get of one parameter, or of none if NULL. */
void scale_get(Host* host, const char* parameter);

/** Set both to files in tests/scales, NULL: none, and run until they are heard. */
void scale_use(Host* host, const char* scale, const char* mapping);

/** What the last run told of a parameter; false if it did not. */
bool scale_told(Host* host, const char* parameter, ScalePath* path);

/** Whether the last run told that the state has changed. */
bool scale_told_change(Host* host);

/** Pitches of all keys that the files should give, read anew. */
void scale_expected(const char* scale, const char* mapping, double a4_hz, double hz[128]);

/** Play a key and fail the test unless it has that pitch, measured to the promised 0.005 cents. */
void scale_assert_pitch(Host* host, uint32_t key, double hz);

/** The same of key 64: as the files give it for A4 at 440 Hz, NULL: none. */
void scale_assert_heard(Host* host, const char* scale, const char* mapping);

/** What is written to stderr between these two calls, for free(). */
void scale_log_begin(void);
char* scale_log_end(void);

#endif

/** Files and folders that a test needs for a while, where TMPDIR says, or else in /tmp. */
#ifndef HOOKE_TESTS_SUPPORT_TEMPORARY_H
#define HOOKE_TESTS_SUPPORT_TEMPORARY_H

#include <stddef.h>

enum { TEMPORARY_SIZE = 512 };

/** Write a new file with these bytes, to be removed by the caller; the test fails if it cannot be.
 * @param[out] path  TEMPORARY_SIZE bytes */
void temporary_file(const void* data, size_t size, char* path);

/** Make a new folder, to be removed by the caller.  @param[out] path  TEMPORARY_SIZE bytes */
void temporary_folder(char* path);

#endif

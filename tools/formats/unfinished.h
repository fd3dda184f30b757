/**
   A file that is being made: it is gone when a signal ends the process.

   There is one at a time in a process.  One thread.
*/
#ifndef HOOKE_TOOLS_FORMATS_UNFINISHED_H
#define HOOKE_TOOLS_FORMATS_UNFINISHED_H

#include <sys/types.h>

/**
   Make a new file. Until it is renamed or removed, every signal that would end the process, and
   that can be caught and is not ignored, removes it first.

   @return A descriptor to read and write it; below 0 on failure, with the reason in errno.
*/
int unfinished_open(const char* path, mode_t mode);

/** It is finished: give it its name. @return 0, or the reason as errno has it: it is removed then
 */
int unfinished_rename(const char* path);

/** Remove it. */
void unfinished_remove(void);

#endif

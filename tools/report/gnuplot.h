/**
   gnuplot, called as a program.

   Thread: any, while no other changes the environment.
*/
#ifndef HOOKE_TOOLS_REPORT_GNUPLOT_H
#define HOOKE_TOOLS_REPORT_GNUPLOT_H

#include <stdbool.h>
#include <stddef.h>

/** Whether there is a gnuplot in PATH that starts. */
bool gnuplot_is_there(void);

/**
   Run a script, without the user's own settings.

   @param directory_fd  Where it runs and finds its files
   @param script        The script's name in there
   @param[out] error    What it said first, in one line; untouched on success
   @return Whether all was done
*/
bool gnuplot_run(int directory_fd, const char* script, char* error, size_t error_size);

#endif

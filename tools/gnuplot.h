/**
   gnuplot, called as a program.

   Thread: any, while no other changes the environment.
*/
#ifndef HOOKE_TOOLS_GNUPLOT_H
#define HOOKE_TOOLS_GNUPLOT_H

#include <stdbool.h>
#include <stddef.h>

/** Whether there is a gnuplot in PATH that starts. */
bool gnuplot_is_there(void);

/**
   Run scripts, one after the other, in one gnuplot.

   @param directory_fd  Where it runs; the scripts' file names are relative to it
   @param names         The scripts, ended by NULL
   @param[out] error    What it said first, in one line; untouched on success
   @return Whether all was done.  It leaves a file gnuplot.log in the directory.
*/
bool gnuplot_run(int directory_fd, char* const names[], char* error, size_t error_size);

#endif

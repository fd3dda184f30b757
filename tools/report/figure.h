/**
   The figures of [MQ09] that are drawn anew, and maps of the instrument: what each shows, and its
   data and gnuplot commands.

   They are 3 to 5, 8 to 19 and 21; 31 and 32 are maps.
   Thread: any.
*/
#ifndef HOOKE_TOOLS_REPORT_FIGURE_H
#define HOOKE_TOOLS_REPORT_FIGURE_H

#include "core/base/status.h"

#include <stdio.h>

/** One picture.  All texts are UTF-8 in plain words, with no markup. */
typedef struct {
  unsigned number;      /**< In the paper; above 30 it is not of the paper */
  const char* title;    /**< In a few words */
  const char* shows;    /**< What is drawn, in sentences */
  const char* equation; /**< What it is computed by */
  const char*
      source; /**< Whether the subject of the paper's figure is known, or inferred, or none */
  const char* script; /**< gnuplot commands, which find `data`, the name of the data file, set */
  /**
     Write the data file: blocks of rows, each headed by "# name", parted by two empty lines.

     @return STATUS_OK, or STATUS_NO_MEMORY with part of it written; ferror() tells of the file
  */
  Status (*write)(FILE* data);
} Figure;

enum { FIGURE_COUNT = 18 };

/** Figure `index` of FIGURE_COUNT, in the paper's order. */
const Figure* figure_at(unsigned index);

#endif

/**
   What was meant by a word that is none: the name that is nearest to it.
*/
#ifndef HOOKE_TOOLS_COMMANDS_NEAR_MISS_H
#define HOOKE_TOOLS_COMMANDS_NEAR_MISS_H

#include <stddef.h>

/** A word, and the name that is nearest so far; begin with near_miss_of(). */
typedef struct {
  const char* word;
  const char* name; /**< NULL: none is near */
  size_t distance;  /**< From the word to it, or else how far none may be */
} NearMiss;

/** @return A search for what is at most a third of the word's letters away from it */
NearMiss near_miss_of(const char* word);

/** Look at one more name, which is to live as long as the search. A letter that is missing, too
 * much, another one or in its neighbour's place is one step away, and so is all that is missing
 * behind the first three or more; capital or small is none. */
void near_miss_try(NearMiss* miss, const char* name);

/** Write "; did you mean NAME?" into `hint`, or nothing where no name is near. @return `hint` */
const char* near_miss_hint(const NearMiss* miss, char* hint, size_t size);

#endif

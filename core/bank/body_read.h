/**
   A body from the text of a table, a `.body` file: modes that were measured, and those beyond,
   which are known by how many there are.

   One statement a line; `#` begins a comment, and units are SI:

       mode F Q M LEFT RIGHT
           a mode: frequency [Hz], Q, mass where the strings are [kg], and how much of it is heard
           left and right, in any unit that all lines share

       above F density N to N2 q Q to Q2 mass M to M2 radiation R to R2 seed S to F2
           modes by chance from F to F2 [Hz]; N modes per Hz at F and N2 at F2, and so the others:
           on a straight line between the two where both axes are logarithmic.  Where nothing
           changes, `to` and what follows it may be left out

   The same text gives the same modes.  Of those by chance neighbours keep a distance as in a plate
   of no simple shape, sqrt(−4/π ln v) of the mean, v even from 0 to 1 (Wigner); what they do at
   the strings and in the air is normal, b and c, as it is at any place of such a plate:

       M_k = M/b²,   l_k = R c (1 + e)/b,   r_k = R c (1 − e)/b,

   with b kept from 0 by LEAST_SHARE, and e even, at most BODY_APART: so nothing is lost in mono.

   Thread: any.
*/
#ifndef HOOKE_CORE_BANK_BODY_READ_H
#define HOOKE_CORE_BANK_BODY_READ_H

#include "core/bank/body.h"
#include "core/base/status.h"

#include <stddef.h>

enum {
  BODY_MAX_BYTES = 1 << 20,  /**< In a text */
  BODY_FOUND_SIZE = 64,      /**< Room in BodyError [bytes] */
  BODY_EXPECTED_SIZE = 96,   /**< Room in BodyError [bytes] */
  BODY_MAX_SEED = 1000000000 /**< From 0 on */
};

/** What is wrong with a text: "LINE: found FOUND, expected EXPECTED", in printable ASCII. */
typedef struct {
  unsigned line; /**< From 1 */
  char found[BODY_FOUND_SIZE];
  char expected[BODY_EXPECTED_SIZE];
} BodyError;

/**
   Read the text of a .body file: its modes, the lowest first, leveled by body_level().

   @param text        Need not end with NUL nor with the end of a line; may begin with a UTF-8 mark
   @param n_bytes     Of `text`
   @param[out] body   Untouched on failure
   @param[out] error  Written on failure only
   @return STATUS_OK, or STATUS_BAD_TEXT: also for more than BODY_MAX_MODES modes, for none, and
   where none is heard.  Takes no memory, and time in proportion to the text and the modes
*/
Status body_read(const char* text, size_t n_bytes, Body* body, BodyError* error);

/** The same, but for what body_level() and body_sort() do: the modes as they come and as loud as
 * they say, and no power.  There need be none. */
Status body_read_modes(const char* text, size_t n_bytes, Body* body, BodyError* error);

/** Put the modes of a body in order, the lowest first. */
void body_sort(Body* body);

#endif

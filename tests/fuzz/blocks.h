/**
   Blocks for an instrument, made of arbitrary bytes: port values right and wrong, and events right
   and wrong, whenever a host might say that they happen.

   Thread: one.
*/
#ifndef HOOKE_TESTS_FUZZ_BLOCKS_H
#define HOOKE_TESTS_FUZZ_BLOCKS_H

#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/plug.h"

#include <lv2/urid/urid.h>

enum { BLOCKS_BODY = 4608 /**< Most bytes of an event */ };

/** Make the body of an event that is the instrument's own. @return Its bytes */
typedef uint32_t (*BlocksOwn)(FuzzFeed* feed, uint8_t body[BLOCKS_BODY]);

/** Move a control port to where two bytes say, right or wrong. */
void blocks_move_port(Plug* plug, FuzzFeed* feed);

/**
   Play all that bytes say, until they or a bound on the work is over; then all sound off.

   Half of what they could be is played twice, and sounds alike.

   @param own_uri  The type of the events that `own` makes
*/
void blocks_play(
    const PlugKind* kind, const uint8_t* bytes, size_t n_bytes, const char* own_uri, BlocksOwn own);

#endif

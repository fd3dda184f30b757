/** Whatever a host, a player or a script could send to Hooke Guitar, right or wrong. */
#ifndef HOOKE_TESTS_SUPPORT_GUITAR_STORM_H
#define HOOKE_TESTS_SUPPORT_GUITAR_STORM_H

#include "core/guitar/guitar_event.h"
#include "tests/support/random.h"

#include <stdint.h>

enum { GUITAR_STORM_BYTES = 9 };

/** An event of any verb, its values in range but for one in eight, which may be anything. */
GuitarEvent guitar_storm_event(Random* random);

/**
   A MIDI message: notes, wheels, and all controllers that mean something, the choice of parameters
   among them.

   @param[out] bytes  Three of them
*/
void guitar_storm_midi(Random* random, uint8_t bytes[3]);

/** @return How many of `bytes` there are of something that may be no message at all. */
uint32_t guitar_storm_malformed(Random* random, uint8_t bytes[GUITAR_STORM_BYTES]);

/** What is no value for a port, or hardly one. */
double guitar_storm_odd_value(Random* random);

#endif

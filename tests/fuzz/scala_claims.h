/** What the harnesses of Scala's two kinds of file claim of either. */
#ifndef HOOKE_TESTS_FUZZ_SCALA_CLAIMS_H
#define HOOKE_TESTS_FUZZ_SCALA_CLAIMS_H

#include "core/scale/scale.h"

#include <stddef.h>
#include <stdint.h>

/** It names a line of the text, and says something printable of it. */
void scala_claim_error(const ScaleError* error, const uint8_t* bytes, size_t n_bytes);

/** Every key has a pitch in range or none, whatever A4 is. */
void scala_claim_tuned(const Scale* scale, const ScaleMap* map);

#endif

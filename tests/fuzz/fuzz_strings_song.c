/* Whatever is played on Hooke Strings over and over, for seconds: what goes out is finite and
 * bounded, and nothing sticks. */
#include "tests/fuzz/song.h"

void fuzz_one(const uint8_t* bytes, size_t n_bytes) {
  song_play(&plug_strings, bytes, n_bytes);
}

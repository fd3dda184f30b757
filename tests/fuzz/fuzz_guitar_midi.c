/* Whatever bytes Hooke Guitar gets as messages, as a script and as port values, in whatever blocks:
 * what goes out is finite and bounded, and nothing sticks. */
#include "core/guitar/guitar_event.h"
#include "tests/fuzz/blocks.h"

#include <math.h>
#include <string.h>

/* Whole numbers, shares, times, and what is no number or hardly one. */
static float value_of(FuzzFeed* feed) {
  static const float odd[] = {NAN, HUGE_VALF, -HUGE_VALF, 1e30f, 1e-30f, -1e-40f, 48.0f, -48.0f};
  const uint32_t byte = fuzz_byte(feed);
  const float low = (float)(byte % 64);
  switch (byte / 64) {
  case 0:
    return low - 16.0f;
  case 1:
    return low / 63.0f;
  case 2:
    return exp2f((low - 48.0f) / 4.0f);
  default:
    return odd[byte % 8];
  }
}

static uint32_t make_event(FuzzFeed* feed, uint8_t body[BLOCKS_BODY]) {
  GuitarEvent event;
  const uint32_t shape = fuzz_byte(feed);
  event.verb = shape % (GUITAR_N_VERBS + 1);
  event.string = fuzz_byte(feed) % 40;
  for (int i = 0; i < 3; ++i) {
    event.value[i] = value_of(feed);
  }
  memcpy(body, &event, sizeof(event));
  return shape < 240 ? sizeof(event) : shape - 240;
}

void fuzz_one(const uint8_t* bytes, size_t n_bytes) {
  blocks_play(&plug_guitar, bytes, n_bytes, GUITAR_EVENT_URI, make_event);
}

/* Whatever bytes Hooke Strings gets as messages, as words on its files and as port values, in
 * whatever blocks: what goes out is finite and bounded, and nothing sticks. */
#include "tests/fuzz/blocks.h"

#include <lv2/patch/patch.h>

#include <string.h>

#define STRINGS_URI "urn:hooke:strings"

/* Of a value: what stands for a long path; less is its size, and more a word. */
enum { LONG = 31, LONG_PATH = 4200 };

static uint32_t put(uint8_t* body, uint32_t at, const void* from, uint32_t n_bytes) {
  if (n_bytes > 0) {
    memcpy(body + at, from, n_bytes);
  }
  return at + n_bytes;
}

static LV2_URID word(FuzzFeed* feed) {
  static const char* const words[] = {
      LV2_PATCH__Set,      LV2_PATCH__Get,       LV2_PATCH__property,    LV2_PATCH__value,
      LV2_PATCH__subject,  STRINGS_URI "#scale", STRINGS_URI "#mapping", STRINGS_URI,
      LV2_ATOM__URID,      LV2_ATOM__Path,       LV2_ATOM__String,       LV2_ATOM__Int,
      STRINGS_URI "#body",
  };
  enum { N_WORDS = sizeof(words) / sizeof(words[0]) };
  const uint32_t byte = fuzz_byte(feed);
  return byte < 250 ? plug_urid(words[byte % N_WORDS]) : byte;
}

/* A value that is a word, text of any bytes, or a longer path than there can be. */
static uint32_t add_property(FuzzFeed* feed, uint8_t* body, uint32_t at) {
  const LV2_URID key = word(feed);
  const LV2_URID type = word(feed);
  const uint32_t what = fuzz_byte(feed);
  const LV2_URID urid = what > LONG ? word(feed) : 0;
  const uint32_t size = what < LONG ? what : what > LONG ? sizeof(urid) : LONG_PATH;
  const LV2_Atom_Property_Body head = {key, 0, {size, type}};
  if (at + sizeof(head) + size > BLOCKS_BODY) {
    return at;
  }
  at = put(body, at, &head, sizeof(head));
  memset(body + at, 'a', size);
  for (uint32_t i = 0; i < size && what < LONG; ++i) {
    body[at + i] = (uint8_t)fuzz_byte(feed);
  }
  if (what > LONG) {
    memcpy(body + at, &urid, sizeof(urid));
  }
  return (at + size + 7u) & ~7u;
}

/* An object about a player's files, whole or cut short. */
static uint32_t make_object(FuzzFeed* feed, uint8_t body[BLOCKS_BODY]) {
  const LV2_Atom_Object_Body head = {0, word(feed)};
  uint32_t size = put(body, 0, &head, sizeof(head));
  const uint32_t shape = fuzz_byte(feed);
  for (uint32_t i = shape % 4; i > 0; --i) {
    size = add_property(feed, body, size);
  }
  const uint32_t cut = shape >> 2;
  return size > cut ? size - cut : size;
}

void fuzz_one(const uint8_t* bytes, size_t n_bytes) {
  blocks_play(&plug_strings, bytes, n_bytes, LV2_ATOM__Object, make_object);
}

#include "core/play/mts.h"

#include <stddef.h>

/* Bytes of a message before those of its kind: F0, 7E or 7F, the device, and two of which kind. */
enum { HEAD = 5, NOTES = 12, NAME = 16, A4_KEY = 69 };

enum { START = 0xF0, END = 0xF7, LATER = 0x7E, NOW = 0x7F };

static const uint32_t ALL_CHANNELS = 0xFFFF;
static const MtsChange NOTHING = {0, false};

/* What stands between the head and the end. */
typedef struct {
  const uint8_t* bytes;
  uint32_t n;
} Body;

static double equal(uint32_t key) {
  return (double)key - A4_KEY;
}

static uint32_t of_two(const uint8_t* bytes) {
  return (uint32_t)bytes[0] << 7 | bytes[1];
}

static bool is_no_change(const uint8_t* bytes) {
  return bytes[0] == 0x7F && bytes[1] == 0x7F && bytes[2] == 0x7F;
}

static void tune_key(Mts* mts, uint32_t key, const uint8_t* bytes) {
  const double semitones = equal(bytes[0]) + of_two(bytes + 1) / 16384.0;
  for (uint32_t c = 0; c < PERFORMANCE_CHANNELS && !is_no_change(bytes); ++c) {
    mts->keys[c][key] = semitones;
  }
}

static uint32_t dump(Mts* mts, Body body, uint32_t n_before) {
  if (body.n != n_before + NAME + 3 * PERFORMANCE_KEYS + 1) {
    return 0;
  }
  for (uint32_t key = 0; key < PERFORMANCE_KEYS; ++key) {
    tune_key(mts, key, body.bytes + n_before + NAME + 3 * key);
  }
  return ALL_CHANNELS;
}

static uint32_t change_notes(Mts* mts, Body body, uint32_t n_before) {
  if (body.n <= n_before || body.n != n_before + 1 + 4 * (uint32_t)body.bytes[n_before]) {
    return 0;
  }
  for (uint32_t at = n_before + 1; at < body.n; at += 4) {
    tune_key(mts, body.bytes[at], body.bytes + at + 1);
  }
  return ALL_CHANNELS;
}

/* The cents of a note of the octave, in semitones. */
static double cents_of(const uint8_t* bytes, uint32_t width, uint32_t note) {
  const uint8_t* const at = bytes + (size_t)width * note;
  return width == 1 ? ((int)at[0] - 0x40) / 100.0 : ((int)of_two(at) - 0x2000) / 8192.0;
}

static uint32_t tune_octaves(Mts* mts, uint32_t channels, const uint8_t* bytes, uint32_t width) {
  for (uint32_t c = 0; c < PERFORMANCE_CHANNELS; ++c) {
    for (uint32_t key = 0; key < PERFORMANCE_KEYS && channels >> c & 1; ++key) {
      mts->keys[c][key] = equal(key) + cents_of(bytes, width, key % NOTES);
    }
  }
  return channels;
}

static uint32_t change_octaves(Mts* mts, Body body, uint32_t width) {
  if (body.n != 3 + width * NOTES) {
    return 0;
  }
  const uint8_t* const b = body.bytes;
  const uint32_t channels = (b[0] & 0x03u) << 14 | (uint32_t)b[1] << 7 | b[2];
  return tune_octaves(mts, channels, b + 3, width);
}

static uint32_t dump_octaves(Mts* mts, Body body, uint32_t width) {
  const uint32_t n_before = 2 + NAME;
  return body.n == n_before + width * NOTES + 1
             ? tune_octaves(mts, ALL_CHANNELS, body.bytes + n_before, width)
             : 0;
}

static uint32_t tune_master(Mts* mts, Body body, bool is_coarse) {
  if (body.n != 2) {
    return 0;
  }
  if (is_coarse) {
    mts->coarse = (int)body.bytes[1] - 0x40;
  } else {
    mts->fine = ((int)(body.bytes[0] | (uint32_t)body.bytes[1] << 7) - 0x2000) / 8192.0;
  }
  return ALL_CHANNELS;
}

/* F0, the end, and nothing but data between them. */
static bool is_whole(const uint8_t* bytes, uint32_t n_bytes) {
  bool is_data = n_bytes > HEAD && bytes[0] == START && bytes[n_bytes - 1] == END;
  for (uint32_t i = 1; is_data && i + 1 < n_bytes; ++i) {
    is_data = !(bytes[i] & 0x80);
  }
  return is_data;
}

/* What is dumped is followed by its checksum. */
static bool is_sum_right(const uint8_t* bytes, uint32_t n_bytes) {
  uint32_t sum = 0;
  for (uint32_t i = 1; i + 1 < n_bytes; ++i) {
    sum ^= bytes[i];
  }
  return sum == 0;
}

static uint32_t play_dump(Mts* mts, uint32_t id, Body body) {
  switch (id) {
  case 0x01:
    return dump(mts, body, 1);
  case 0x04:
    return dump(mts, body, 2);
  case 0x05:
    return dump_octaves(mts, body, 1);
  case 0x06:
    return dump_octaves(mts, body, 2);
  default:
    return 0;
  }
}

static uint32_t play_change(Mts* mts, bool is_live, uint32_t id, Body body) {
  switch (id) {
  case 0x02:
    return is_live ? change_notes(mts, body, 1) : 0;
  case 0x07:
    return change_notes(mts, body, 2);
  case 0x08:
    return change_octaves(mts, body, 1);
  case 0x09:
    return change_octaves(mts, body, 2);
  default:
    return 0;
  }
}

void mts_reset(Mts* mts) {
  double semitones[PERFORMANCE_KEYS];
  for (uint32_t key = 0; key < PERFORMANCE_KEYS; ++key) {
    semitones[key] = equal(key);
  }
  (void)mts_set_scale(mts, semitones);
  mts->fine = 0.0;
  mts->coarse = 0.0;
}

MtsChange mts_set_scale(Mts* mts, const double semitones[PERFORMANCE_KEYS]) {
  for (uint32_t c = 0; c < PERFORMANCE_CHANNELS; ++c) {
    for (uint32_t key = 0; key < PERFORMANCE_KEYS; ++key) {
      mts->keys[c][key] = semitones[key];
    }
  }
  return (MtsChange){ALL_CHANNELS, true};
}

MtsChange mts_play(Mts* mts, const uint8_t* bytes, uint32_t n_bytes) {
  if (!is_whole(bytes, n_bytes) || (bytes[1] != LATER && bytes[1] != NOW)) {
    return NOTHING;
  }
  const bool is_live = bytes[1] == NOW;
  const uint32_t what = bytes[3];
  const uint32_t id = bytes[4];
  const Body body = {bytes + HEAD, n_bytes - HEAD - 1};
  if (what == 0x04 && is_live && (id == 0x03 || id == 0x04)) {
    return (MtsChange){tune_master(mts, body, id == 0x04), true};
  }
  if (what != 0x08) {
    return NOTHING;
  }
  const bool is_dump = !is_live && is_sum_right(bytes, n_bytes);
  const uint32_t dumped = is_dump ? play_dump(mts, id, body) : 0;
  return (MtsChange){dumped ? dumped : play_change(mts, is_live, id, body), is_live};
}

void mts_pitches(const Mts* mts, uint32_t channel, double semitones[PERFORMANCE_KEYS]) {
  for (uint32_t key = 0; key < PERFORMANCE_KEYS; ++key) {
    semitones[key] = mts->keys[channel][key] + (mts->coarse + mts->fine);
  }
}

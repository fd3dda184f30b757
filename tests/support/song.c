#include "tests/support/song.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static void add_big_endian(Bytes* song, uint32_t value, unsigned n_bytes) {
  for (unsigned i = 0; i < n_bytes; ++i) {
    const uint8_t byte = (uint8_t)(value >> (8 * (n_bytes - 1 - i)));
    assert_true(bytes_append(song, &byte, 1));
  }
}

Bytes song_new(unsigned type, unsigned n_tracks, unsigned division) {
  Bytes song = {0};
  SONG_ADD(&song, "MThd\x00\x00\x00\x06");
  add_big_endian(&song, type, 2);
  add_big_endian(&song, n_tracks, 2);
  add_big_endian(&song, division, 2);
  return song;
}

void song_add(Bytes* song, const char* data, size_t size) {
  assert_true(bytes_append(song, data, size));
}

void song_add_track(Bytes* song, const char* events, size_t size) {
  SONG_ADD(song, "MTrk");
  add_big_endian(song, (uint32_t)size, 4);
  song_add(song, events, size);
}

Bytes song_with_everything(void) {
  Bytes song = song_new(1, 2, SONG_TICKS);
  SONG_ADD_TRACK(&song, "\x00\xff\x51\x03\x0f\x42\x40" SONG_NOTE SONG_NOTE_LATER SONG_END);
  SONG_ADD_TRACK(&song, "\x00\xf0\x05\x7e\x7f\x09\x01\xf7" SONG_NOTE_LATER
                        "\x10\xf7\x01\xf8\x10\xff\x01\x02hi" SONG_END);
  return song;
}

#include "tools/formats/midiclean.h"

#include "tests/support/random.h"
#include "tests/support/song.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

/* The song is freed. */
static void assert_refused(Bytes* song, const char* what) {
  char error[256] = "";
  Bytes out = {0};
  const bool is_clean = midiclean(song->data, song->size, &out, error, sizeof(error));
  bytes_clear(&out);
  bytes_clear(song);
  assert_false(is_clean);
  assert_null(strchr(error, '\n'));
  if (!strstr(error, what)) {
    fail_msg("'%s' does not say '%s'", error, what);
  }
}

static Bytes clean(const Bytes* song) {
  char error[256] = "";
  Bytes out = {0};
  if (!midiclean(song->data, song->size, &out, error, sizeof(error))) {
    fail_msg("%s", error);
  }
  return out;
}

static void assert_same(const Bytes* a, const Bytes* b) {
  assert_int_equal(a->size, b->size);
  assert_memory_equal(a->data, b->data, a->size);
}

static void only_what_an_instrument_needs_is_kept(void** state) {
  (void)state;
  Bytes song = song_new(1, 2, SONG_TICKS);
  SONG_ADD_TRACK(&song, "\x00\xff\x03\x01x" SONG_NOTE "\x10\xff\x51\x03\x0f\x42\x40"
                        "\x10\xff\x51\x03\x00\x00\x00"
                        "\x10\xff\x2f\x00"
                        "left over");
  SONG_ADD(&song, "XFIH\x00\x00\x00\x02??");
  SONG_ADD_TRACK(&song, "\x00\xf0\x03\x43\x12\x00"
                        "\x10\xf7\x02\x43\xf7"
                        "\x10\x90\x3c\x64"
                        "\x10\x3c\x00"
                        "\x00\xf0\x03\x43\x12\xf7" SONG_END);
  SONG_ADD(&song, "left over");
  Bytes expected = song_new(1, 2, SONG_TICKS);
  SONG_ADD_TRACK(&expected, SONG_NOTE "\x10\xff\x51\x03\x0f\x42\x40"
                                      "\x20\xff\x2f\x00");
  SONG_ADD_TRACK(&expected, "\x20\x90\x3c\x64"
                            "\x10\x90\x3c\x00"
                            "\x00\xf0\x03\x43\x12\xf7" SONG_END);
  Bytes cleaned = clean(&song);
  assert_same(&cleaned, &expected);
  bytes_clear(&cleaned);
  bytes_clear(&expected);
  bytes_clear(&song);
}

static void what_is_clean_stays_as_it_is(void** state) {
  (void)state;
  Bytes song = song_with_everything();
  Bytes once = clean(&song);
  Bytes twice = clean(&once);
  assert_same(&twice, &once);
  bytes_clear(&twice);
  bytes_clear(&once);
  bytes_clear(&song);
}

/* 127 and 128, 2^14 and 2^21: where a number takes one byte more. */
static void long_pauses_are_kept(void** state) {
  (void)state;
  Bytes song = song_new(0, 1, SONG_TICKS);
  SONG_ADD_TRACK(&song, "\x7f\x90\x3c\x64"
                        "\x81\x00\x90\x3c\x64"
                        "\xff\x7f\x90\x3c\x64"
                        "\x81\x80\x00\x90\x3c\x64"
                        "\xff\xff\x7f\x90\x3c\x64"
                        "\x81\x80\x80\x00\x90\x3c\x64"
                        "\xff\xff\xff\x7f\x90\x3c\x64" SONG_END);
  Bytes cleaned = clean(&song);
  assert_same(&cleaned, &song);
  bytes_clear(&cleaned);
  bytes_clear(&song);
}

static void another_kind_of_file_is_refused(void** state) {
  (void)state;
  Bytes bytes = {0};
  assert_refused(&bytes, "found an empty file");
  SONG_ADD(&bytes, "M");
  assert_refused(&bytes, "found no MThd");
  SONG_ADD(&bytes, "a letter home, long enough for a header");
  assert_refused(&bytes, "found no MThd");
  SONG_ADD(&bytes, "RIFF\x30\x00\x00\x00RMID"
                   "data");
  assert_refused(&bytes, "found no MThd");
}

static void another_kind_of_song_is_refused(void** state) {
  (void)state;
  Bytes bytes = song_new(2, 1, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, SONG_END);
  assert_refused(&bytes, "byte 8: found type 2, expected 0 or 1");
  bytes = song_new(0, 2, SONG_TICKS);
  assert_refused(&bytes, "byte 10: found 2 tracks");
  bytes = song_new(1, 0, SONG_TICKS);
  assert_refused(&bytes, "byte 10: found 0 tracks");
  bytes = song_new(0, 1, 0xE728);
  assert_refused(&bytes, "byte 12: found division 0xe728");
  bytes = song_new(0, 1, 0);
  assert_refused(&bytes, "byte 12: found division 0x0000");
}

static void a_broken_track_is_refused_with_its_place(void** state) {
  static const struct {
    const char* events;
    size_t size;
    const char* what;
  } broken[] = {
#define BROKEN(events, what) {events, sizeof(events) - 1, "track 1, byte " what}
      BROKEN("", "22: found the end of the track"),
      BROKEN(SONG_NOTE, "26: found the end of the track, expected End of Track"),
      BROKEN("\x00\x40\x40" SONG_END, "23: found 0x40, expected a status byte"),
      BROKEN(SONG_NOTE "\x00\xff\x01\x00\x00\x3c\x64" SONG_END,
             "31: found 0x3c, expected a status byte"),
      BROKEN("\x00\xf4" SONG_END, "23: found status 0xf4"),
      BROKEN("\x00\x90\x3c\xf8" SONG_END, "25: found 0xf8"),
      BROKEN("\x00\x90\x3c", "24: found 1 bytes to the end of the track, expected 2"),
      BROKEN("\x00\xff\x51\x02\x07\xa1" SONG_END, "24: found a tempo of 2 bytes, expected 3"),
      BROKEN("\x00\xf0\xff\x7f\x01\xf7" SONG_END, "26: found 6 bytes"),
      BROKEN("\xff\xff\xff\xff\x7f\x90\x3c\x64" SONG_END, "22: found a delta time of more than"),
  };
  (void)state;
  for (size_t i = 0; i < sizeof(broken) / sizeof(broken[0]); ++i) {
    Bytes bytes = song_new(0, 1, SONG_TICKS);
    song_add_track(&bytes, broken[i].events, broken[i].size);
    assert_refused(&bytes, broken[i].what);
  }
}

static void a_chunk_longer_than_the_file_is_refused(void** state) {
  (void)state;
  Bytes bytes = song_new(0, 1, SONG_TICKS);
  SONG_ADD(&bytes, "MTrk\xff\xff\xff\xff" SONG_NOTE SONG_END);
  assert_refused(&bytes, "byte 18: found a chunk of 4294967295 bytes, expected at most the 8 left");
}

static void a_file_cut_short_anywhere_is_refused(void** state) {
  (void)state;
  const Bytes song = song_with_everything();
  for (size_t size = 0; size < song.size; ++size) {
    Bytes cut = {0};
    assert_true(bytes_append(&cut, song.data, size));
    assert_refused(&cut, "expected");
  }
  Bytes whole = song;
  bytes_clear(&whole);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(only_what_an_instrument_needs_is_kept),
      cmocka_unit_test(what_is_clean_stays_as_it_is),
      cmocka_unit_test(long_pauses_are_kept),
      cmocka_unit_test(another_kind_of_file_is_refused),
      cmocka_unit_test(another_kind_of_song_is_refused),
      cmocka_unit_test(a_broken_track_is_refused_with_its_place),
      cmocka_unit_test(a_chunk_longer_than_the_file_is_refused),
      cmocka_unit_test(a_file_cut_short_anywhere_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

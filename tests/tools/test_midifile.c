#define _POSIX_C_SOURCE 200809L

#include "tools/formats/midifile.h"

#include "tests/support/random.h"
#include "tests/support/song.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/* Where a file was, and what was said about it. */
typedef struct {
  char path[64];
  char error[256];
} Read;

static MidiFile* read_bytes(const uint8_t* data, size_t size, Read* read) {
  strcpy(read->path, "/tmp/hooke_midi_XXXXXX");
  read->error[0] = '\0';
  const int fd = mkstemp(read->path);
  assert_true(fd >= 0);
  assert_int_equal(write(fd, data, size), size);
  assert_int_equal(close(fd), 0);
  MidiFile* const file = midifile_new(read->path, read->error, sizeof(read->error));
  assert_int_equal(unlink(read->path), 0);
  return file;
}

/* Read a song, which is freed; a failure must be one line that begins with the path. */
static MidiFile* read_song(Bytes* bytes, Read* read) {
  MidiFile* const file = read_bytes(bytes->data, bytes->size, read);
  bytes_clear(bytes);
  if (!file) {
    assert_memory_equal(read->error, read->path, strlen(read->path));
    assert_null(strchr(read->error, '\n'));
  }
  return file;
}

static void assert_refused(Bytes* bytes, const char* what) {
  Read read;
  MidiFile* const file = read_song(bytes, &read);
  assert_null(file);
  if (!strstr(read.error, what)) {
    fail_msg("'%s' does not say '%s'", read.error, what);
  }
}

static void
assert_event(const MidiFile* file, size_t i, double time_s, const char* bytes, size_t size) {
  assert_true(i < file->n_events);
  assert_true(fabs(file->events[i].time_s - time_s) < 1e-9);
  assert_int_equal(file->events[i].size, size);
  assert_memory_equal(file->events[i].bytes, bytes, size);
}

/* The smallest song: one note at once and one a quarter later, 120 quarters a minute. */
static void without_a_tempo_a_quarter_lasts_half_a_second(void** state) {
  (void)state;
  Read read;
  Bytes bytes = song_new(0, 1, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, SONG_NOTE SONG_NOTE_LATER SONG_END);
  MidiFile* const file = read_song(&bytes, &read);
  assert_non_null(file);
  assert_int_equal(file->n_events, 2);
  assert_event(file, 0, 0.0, "\x90\x3c\x64", 3);
  assert_event(file, 1, 0.5, "\x90\x3c\x64", 3);
  midifile_free(file);
}

/* A quarter lasts 1 s for 480 ticks, 0.25 s for 240, then 2 s: the notes are at 1 s and 2.125 s. */
static void tempo_changes_of_any_track_move_all_notes(void** state) {
  (void)state;
  Read read;
  Bytes bytes = song_new(1, 2, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, SONG_NOTE SONG_NOTE_LATER SONG_NOTE_LATER SONG_END);
  SONG_ADD_TRACK(&bytes, "\x00\xff\x51\x03\x0f\x42\x40"
                         "\x83\x60\xff\x51\x03\x03\xd0\x90"
                         "\x81\x70\xff\x51\x03\x1e\x84\x80" SONG_END);
  MidiFile* const file = read_song(&bytes, &read);
  assert_non_null(file);
  assert_int_equal(file->n_events, 3);
  assert_event(file, 1, 1.0, "\x90\x3c\x64", 3);
  assert_event(file, 2, 2.125, "\x90\x3c\x64", 3);
  midifile_free(file);
}

static void simultaneous_events_keep_the_order_of_tracks_and_of_the_file(void** state) {
  (void)state;
  Read read;
  Bytes bytes = song_new(1, 2, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, SONG_NOTE_LATER "\x00\x80\x3c\x40"
                                         "\x00\xb0\x40\x7f" SONG_END);
  SONG_ADD_TRACK(&bytes, "\x00\x91\x01\x01"
                         "\x83\x60\x91\x02\x02" SONG_END);
  MidiFile* const file = read_song(&bytes, &read);
  assert_non_null(file);
  assert_int_equal(file->n_events, 5);
  assert_event(file, 0, 0.0, "\x91\x01\x01", 3);
  assert_event(file, 1, 0.5, "\x90\x3c\x64", 3);
  assert_event(file, 2, 0.5, "\x80\x3c\x40", 3);
  assert_event(file, 3, 0.5, "\xb0\x40\x7f", 3);
  assert_event(file, 4, 0.5, "\x91\x02\x02", 3);
  midifile_free(file);
}

static void running_status_is_written_out(void** state) {
  (void)state;
  Read read;
  Bytes bytes = song_new(0, 1, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, "\x00\xc5\x07"
                         "\x60\x08"
                         "\x00\x95\x3c\x64"
                         "\x60\x3c\x00" SONG_END);
  MidiFile* const file = read_song(&bytes, &read);
  assert_non_null(file);
  assert_int_equal(file->n_events, 4);
  assert_event(file, 1, 0.1, "\xc5\x08", 2);
  assert_event(file, 3, 0.2, "\x95\x3c\x00", 3);
  midifile_free(file);
}

/* The text is longer than libsmf can count; the piecewise message would end the process. */
static void what_libsmf_stumbles_over_costs_no_note(void** state) {
  (void)state;
  Read read;
  char text[300];
  memset(text, 'x', sizeof(text));
  Bytes events = {0};
  SONG_ADD(&events, "\x00\xff\x01\x82\x2c");
  song_add(&events, text, sizeof(text));
  SONG_ADD(&events, SONG_NOTE_LATER SONG_END);
  Bytes bytes = song_new(1, 3, SONG_TICKS);
  song_add_track(&bytes, (const char*)events.data, events.size);
  bytes_clear(&events);
  SONG_ADD(&bytes, "XFIH\x00\x00\x00\x02??");
  SONG_ADD_TRACK(&bytes, "\x00\xf0\x03\x43\x12\x00"
                         "\x10\xf7\x02\x43\xf7" SONG_NOTE SONG_END);
  SONG_ADD_TRACK(&bytes, "\x00\xf7\x01\xf8"
                         "\x00\xf7\x00"
                         "\x00\xf0\x00" SONG_NOTE SONG_END);
  SONG_ADD(&bytes, "left over");
  MidiFile* const file = read_song(&bytes, &read);
  assert_non_null(file);
  assert_int_equal(file->n_events, 3);
  midifile_free(file);
}

static void a_whole_system_exclusive_message_is_kept(void** state) {
  (void)state;
  Read read;
  Bytes bytes = song_new(0, 1, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, "\x00\xf0\x05\x7e\x7f\x09\x01\xf7" SONG_END);
  MidiFile* const file = read_song(&bytes, &read);
  assert_non_null(file);
  assert_int_equal(file->n_events, 1);
  assert_event(file, 0, 0.0, "\xf0\x7e\x7f\x09\x01\xf7", 6);
  midifile_free(file);
}

static void a_song_without_notes_is_empty(void** state) {
  (void)state;
  Read read;
  Bytes bytes = song_new(0, 1, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, SONG_END);
  MidiFile* const file = read_song(&bytes, &read);
  assert_non_null(file);
  assert_int_equal(file->n_events, 0);
  midifile_free(file);
}

/* One delta of 2^28 ticks is three days; nine of them pass 2^31 ticks. */
static void a_song_of_days_is_refused(void** state) {
  (void)state;
#define LONG_NOTE "\xff\xff\xff\x7f\x90\x3c\x64"
  Bytes bytes = song_new(0, 1, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, LONG_NOTE SONG_END);
  assert_refused(&bytes, "found a message at 279620 s, expected at most 3600 s");
  bytes = song_new(0, 1, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, LONG_NOTE LONG_NOTE LONG_NOTE LONG_NOTE LONG_NOTE LONG_NOTE LONG_NOTE
                             LONG_NOTE LONG_NOTE SONG_END);
  assert_refused(&bytes, "found tick 2415919095, expected at most 2147483647");
}

static void a_missing_file_and_a_directory_are_refused(void** state) {
  (void)state;
  char error[256] = "";
  assert_null(midifile_new("/nonexistent/song.mid", error, sizeof(error)));
  assert_string_equal(error, "/nonexistent/song.mid: No such file or directory");
  assert_null(midifile_new("/", error, sizeof(error)));
  assert_string_equal(error, "/: Is a directory");
}

/* Read or refused, never a crash; sometimes read, or the damage would prove nothing. */
static void damaged_files_do_no_harm(void** state) {
  (void)state;
  Random random = random_start();
  size_t n_read = 0;
  Bytes bytes = song_with_everything();
  uint8_t damaged[256];
  assert_true(bytes.size <= sizeof(damaged));
  for (int i = 0; i < 3000; ++i) {
    Read read;
    memcpy(damaged, bytes.data, bytes.size);
    for (uint32_t n = 1 + random_below(&random, 4); n > 0; --n) {
      const size_t at = 14 + random_below(&random, (uint32_t)bytes.size - 14);
      damaged[at] = (uint8_t)random_below(&random, 256);
    }
    MidiFile* const file = read_bytes(damaged, bytes.size, &read);
    n_read += file ? 1 : 0;
    midifile_free(file);
  }
  bytes_clear(&bytes);
  assert_in_range(n_read, 100, 2900);
}

static void the_demo_is_a_minute_long(void** state) {
  (void)state;
  const char* const source = getenv("HOOKE_SOURCE");
  if (!source) {
    skip();
    return;
  }
  char path[4096];
  char error[4200] = "";
  assert_true(snprintf(path, sizeof(path), "%s/doc/demo.mid", source) < (int)sizeof(path));
  MidiFile* const file = midifile_new(path, error, sizeof(error));
  assert_string_equal(error, "");
  assert_in_range((uintmax_t)file->events[file->n_events - 1].time_s, 50, 70);
  midifile_free(file);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(without_a_tempo_a_quarter_lasts_half_a_second),
      cmocka_unit_test(tempo_changes_of_any_track_move_all_notes),
      cmocka_unit_test(simultaneous_events_keep_the_order_of_tracks_and_of_the_file),
      cmocka_unit_test(running_status_is_written_out),
      cmocka_unit_test(what_libsmf_stumbles_over_costs_no_note),
      cmocka_unit_test(a_whole_system_exclusive_message_is_kept),
      cmocka_unit_test(a_song_without_notes_is_empty),
      cmocka_unit_test(a_song_of_days_is_refused),
      cmocka_unit_test(a_missing_file_and_a_directory_are_refused),
      cmocka_unit_test(damaged_files_do_no_harm),
      cmocka_unit_test(the_demo_is_a_minute_long),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

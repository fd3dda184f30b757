#define _POSIX_C_SOURCE 200809L

#include "tools/formats/smf.h"

#include "tests/support/random.h"
#include "tests/support/song.h"
#include "tests/support/temporary.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

/* Where a file was, and what was said about it. */
typedef struct {
  char path[TEMPORARY_SIZE];
  char error[256];
} Read;

static Smf* read_bytes(const uint8_t* data, size_t size, Read* read) {
  temporary_file(data, size, read->path);
  read->error[0] = '\0';
  Smf* const smf = smf_new(read->path, read->error, sizeof(read->error));
  assert_int_equal(unlink(read->path), 0);
  return smf;
}

/* Read a song, which is freed; a failure must be one line that begins with the path. */
static Smf* read_song(Bytes* bytes, Read* read) {
  Smf* const smf = read_bytes(bytes->data, bytes->size, read);
  bytes_clear(bytes);
  if (!smf) {
    assert_memory_equal(read->error, read->path, strlen(read->path));
    assert_null(strchr(read->error, '\n'));
  }
  return smf;
}

static Smf* read_good(Bytes* bytes) {
  Read read;
  Smf* const smf = read_song(bytes, &read);
  if (!smf) {
    fail_msg("%s", read.error);
  }
  return smf;
}

static void assert_refused(Bytes* bytes, const char* what) {
  Read read;
  Smf* const smf = read_song(bytes, &read);
  assert_null(smf);
  if (!strstr(read.error, what)) {
    fail_msg("'%s' does not say '%s'", read.error, what);
  }
}

/* Of these kinds there are notes, and of no others. */
static void assert_notes(const Smf* smf, unsigned kinds) {
  for (unsigned i = 0; i < SMF_N_NOTES; ++i) {
    if ((*smf->note[i] != '\0') != ((kinds >> i & 1U) != 0)) {
      fail_msg("note %u is '%s'", i, smf->note[i]);
    }
  }
}

static void assert_event(const Smf* smf, size_t i, double time_s, const char* bytes, size_t size) {
  assert_true(i < smf->n_events);
  assert_true(fabs(smf->events[i].time_s - time_s) < 1e-9);
  assert_int_equal(smf->events[i].size, size);
  assert_memory_equal(smf->events[i].bytes, bytes, size);
}

static void assert_duration(const Smf* smf, double duration_s) {
  if (!(fabs(smf->duration_s - duration_s) < 1e-9)) {
    fail_msg("%.9f s long, expected %.9f", smf->duration_s, duration_s);
  }
}

static void assert_same_song(const Smf* smf, const Smf* expected) {
  assert_int_equal(smf->n_events, expected->n_events);
  assert_duration(smf, expected->duration_s);
  for (size_t i = 0; i < smf->n_events; ++i) {
    const SmfEvent* const event = &expected->events[i];
    assert_event(smf, i, event->time_s, (const char*)event->bytes, event->size);
  }
}

/* What the standard says */

/* The smallest song: one note at once and one a quarter later, 120 quarters a minute. */
static void without_a_tempo_a_quarter_lasts_half_a_second(void** state) {
  (void)state;
  Bytes bytes = song_new(0, 1, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, SONG_NOTE SONG_NOTE_LATER SONG_END);
  Smf* const smf = read_good(&bytes);
  assert_int_equal(smf->n_events, 2);
  assert_event(smf, 0, 0.0, "\x90\x3c\x64", 3);
  assert_event(smf, 1, 0.5, "\x90\x3c\x64", 3);
  assert_notes(smf, 0);
  smf_free(smf);
}

/* A quarter lasts 1 s for 480 ticks, 0.25 s for 240, then 2 s: the notes are at 1 s and 2.125 s. */
static void tempo_changes_of_any_track_move_all_notes(void** state) {
  (void)state;
  Bytes bytes = song_new(1, 2, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, SONG_NOTE SONG_NOTE_LATER SONG_NOTE_LATER SONG_END);
  SONG_ADD_TRACK(&bytes, "\x00\xff\x51\x03\x0f\x42\x40"
                         "\x83\x60\xff\x51\x03\x03\xd0\x90"
                         "\x81\x70\xff\x51\x03\x1e\x84\x80" SONG_END);
  Smf* const smf = read_good(&bytes);
  assert_int_equal(smf->n_events, 3);
  assert_event(smf, 1, 1.0, "\x90\x3c\x64", 3);
  assert_event(smf, 2, 2.125, "\x90\x3c\x64", 3);
  smf_free(smf);
}

/* A quarter of 1 s with a byte to spare, and then one of no length, which is none. */
static void a_tempo_may_be_longer_than_three_bytes_but_not_infinite(void** state) {
  (void)state;
  Bytes bytes = song_new(0, 1, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, "\x00\xff\x51\x04\x0f\x42\x40\x07" SONG_NOTE_LATER
                         "\x00\xff\x51\x03\x00\x00\x00" SONG_NOTE_LATER SONG_END);
  Smf* const smf = read_good(&bytes);
  assert_event(smf, 0, 1.0, "\x90\x3c\x64", 3);
  assert_event(smf, 1, 2.0, "\x90\x3c\x64", 3);
  smf_free(smf);
}

static void simultaneous_events_keep_the_order_of_tracks_and_of_the_file(void** state) {
  (void)state;
  Bytes bytes = song_new(1, 2, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, SONG_NOTE_LATER "\x00\x80\x3c\x40"
                                         "\x00\xb0\x40\x7f" SONG_END);
  SONG_ADD_TRACK(&bytes, "\x00\x91\x01\x01"
                         "\x83\x60\x91\x02\x02" SONG_END);
  Smf* const smf = read_good(&bytes);
  assert_int_equal(smf->n_events, 5);
  assert_event(smf, 0, 0.0, "\x91\x01\x01", 3);
  assert_event(smf, 1, 0.5, "\x90\x3c\x64", 3);
  assert_event(smf, 2, 0.5, "\x80\x3c\x40", 3);
  assert_event(smf, 3, 0.5, "\xb0\x40\x7f", 3);
  assert_event(smf, 4, 0.5, "\x91\x02\x02", 3);
  smf_free(smf);
}

static void running_status_is_written_out(void** state) {
  (void)state;
  Bytes bytes = song_new(0, 1, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, "\x00\xc5\x07"
                         "\x60\x08"
                         "\x00\x95\x3c\x64"
                         "\x60\x3c\x00" SONG_END);
  Smf* const smf = read_good(&bytes);
  assert_int_equal(smf->n_events, 4);
  assert_event(smf, 1, 0.1, "\xc5\x08", 2);
  assert_event(smf, 3, 0.2, "\x95\x3c\x00", 3);
  smf_free(smf);
}

/* 127 and 128, 2^14 and 2^21: where a number takes one byte more. At 1,000 ticks a quarter of 1 s a
 * tick is a millisecond. */
static void long_pauses_are_kept(void** state) {
  (void)state;
  Bytes bytes = song_new(0, 1, 1000);
  SONG_ADD_TRACK(&bytes, "\x00\xff\x51\x03\x0f\x42\x40"
                         "\x7f\x90\x3c\x64"
                         "\x81\x00\x90\x3c\x64"
                         "\xff\x7f\x90\x3c\x64"
                         "\x81\x80\x00\x90\x3c\x64"
                         "\xff\xff\x7f\x90\x3c\x64"
                         "\x81\x80\x80\x00\x90\x3c\x64" SONG_END);
  Smf* const smf = read_good(&bytes);
  const double pauses[] = {127, 128, 16383, 16384, 2097151, 2097152};
  double ticks = 0.0;
  assert_int_equal(smf->n_events, 6);
  for (size_t i = 0; i < 6; ++i) {
    ticks += pauses[i];
    assert_event(smf, i, 1e-3 * ticks, "\x90\x3c\x64", 3);
  }
  smf_free(smf);
}

/* Two quarters at 120 a minute. */
static void a_longer_header_is_passed_over(void** state) {
  (void)state;
  Bytes bytes = {0};
  SONG_ADD(&bytes, "MThd\x00\x00\x00\x08\x00\x00\x00\x01\x01\xe0\x4d\x54");
  SONG_ADD_TRACK(&bytes, SONG_NOTE_LATER "\x83\x60\xff\x2f\x00");
  Smf* const smf = read_good(&bytes);
  assert_event(smf, 0, 0.5, "\x90\x3c\x64", 3);
  assert_duration(smf, 1.0);
  assert_notes(smf, 0);
  smf_free(smf);
}

/* Two quarters at 60 and one at 120, which the second pattern has anew: 2.0 + 0.5 s. */
static void patterns_of_type_2_are_played_one_after_the_other(void** state) {
  (void)state;
  Bytes bytes = song_new(2, 2, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, "\x00\xff\x51\x03\x0f\x42\x40" SONG_NOTE_LATER "\x83\x60\xff\x2f\x00");
  SONG_ADD_TRACK(&bytes, "\x00\x91\x01\x01\x83\x60\xff\x2f\x00");
  Smf* const smf = read_good(&bytes);
  assert_event(smf, 0, 1.0, "\x90\x3c\x64", 3);
  assert_event(smf, 1, 2.0, "\x91\x01\x01", 3);
  assert_duration(smf, 2.5);
  assert_notes(smf, 1U << SMF_PATTERNS);
  smf_free(smf);
}

/* With 25 frames of 40 ticks a tick is a millisecond; 29 stands for 30 drop frame, slower than 30
 * by 1001 / 1000.  The note is at 1,000 ticks, and tempo has no say. */
static void smpte_frames_need_no_tempo(void** state) {
  static const struct {
    unsigned division;
    double time_s;
  } kinds[] = {{0xE728, 1.0},
               {0xE828, 1000.0 / (24 * 40)},
               {0xE250, 1000.0 / (30 * 80)},
               {0xE350, 1001.0 / (30 * 80)},
               {0xE701, 40.0}};
  (void)state;
  for (size_t i = 0; i < sizeof(kinds) / sizeof(kinds[0]); ++i) {
    Bytes bytes = song_new(0, 1, kinds[i].division);
    SONG_ADD_TRACK(&bytes, "\x00\xff\x51\x03\x0f\x42\x40\x87\x68\x90\x3c\x64" SONG_END);
    Smf* const smf = read_good(&bytes);
    assert_event(smf, 0, kinds[i].time_s, "\x90\x3c\x64", 3);
    assert_duration(smf, kinds[i].time_s);
    smf_free(smf);
  }
}

/* The wrapped file is of 34 bytes: 0x22. */
#define WRAPPED                                                                                    \
  "MThd\x00\x00\x00\x06\x00\x00\x00\x01\x01\xe0"                                                   \
  "MTrk\x00\x00\x00\x0c" SONG_NOTE "\x83\x60\xff\x2f\x00\x00\x00\x00"

static void a_riff_file_is_the_file_inside(void** state) {
  (void)state;
  Bytes plain = {0};
  Bytes wrapped = {0};
  SONG_ADD(&plain, WRAPPED);
  SONG_ADD(&wrapped, "RIFF\x3a\x00\x00\x00RMID"
                     "LIST\x03\x00\x00\x00"
                     "ab\x00\x00"
                     "data\x22\x00\x00\x00" WRAPPED "data\x04\x00\x00\x00????");
  Smf* const one = read_good(&plain);
  Smf* const other = read_good(&wrapped);
  assert_int_equal(one->n_events, 1);
  assert_same_song(other, one);
  assert_notes(other, 0);
  smf_free(one);
  smf_free(other);
}

/* 8 quarters at 120. */
static void the_latest_end_of_track_is_the_end(void** state) {
  (void)state;
  Bytes bytes = song_new(1, 3, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, SONG_NOTE SONG_END);
  SONG_ADD_TRACK(&bytes, "\x9e\x00\xff\x2f\x00");
  SONG_ADD_TRACK(&bytes, SONG_NOTE_LATER SONG_END);
  Smf* const smf = read_good(&bytes);
  assert_event(smf, 1, 0.5, "\x90\x3c\x64", 3);
  assert_duration(smf, 4.0);
  smf_free(smf);
}

/* A text of 300 bytes, a chunk of another kind, and what is behind the end of a track and a file.
 */
static void what_is_not_played_costs_no_note(void** state) {
  (void)state;
  char text[300];
  memset(text, 'x', sizeof(text));
  Bytes events = {0};
  SONG_ADD(&events, "\x00\xff\x01\x82\x2c");
  song_add(&events, text, sizeof(text));
  SONG_ADD(&events, SONG_NOTE_LATER SONG_END "left over");
  Bytes bytes = song_new(1, 2, SONG_TICKS);
  song_add_track(&bytes, (const char*)events.data, events.size);
  bytes_clear(&events);
  SONG_ADD(&bytes, "XFIH\x00\x00\x00\x02??");
  SONG_ADD_TRACK(&bytes, "\x00\xf7\x01\xf8"
                         "\x00\xf7\x00" SONG_NOTE SONG_END);
  SONG_ADD(&bytes, "left over");
  Smf* const smf = read_good(&bytes);
  assert_int_equal(smf->n_events, 2);
  assert_event(smf, 1, 0.5, "\x90\x3c\x64", 3);
  assert_notes(smf, 0);
  smf_free(smf);
}

static void a_system_exclusive_message_is_kept(void** state) {
  (void)state;
  Bytes bytes = song_new(0, 1, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, "\x00\xf0\x05\x7e\x7f\x09\x01\xf7"
                         "\x83\x60\xf7\x06\xf0\x7e\x7f\x09\x01\xf7" SONG_END);
  Smf* const smf = read_good(&bytes);
  assert_int_equal(smf->n_events, 2);
  assert_event(smf, 0, 0.0, "\xf0\x7e\x7f\x09\x01\xf7", 6);
  assert_event(smf, 1, 0.5, "\xf0\x7e\x7f\x09\x01\xf7", 6);
  assert_notes(smf, 0);
  smf_free(smf);
}

/* The standard's own example: 43 12 00, then 43 12 00 43 12 00, then 43 12 00 F7, 200 and 100 ticks
 * apart, of which there are 960 in a second. */
static void a_message_in_packets_is_put_together(void** state) {
  (void)state;
  Bytes bytes = song_new(0, 1, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, "\x00\xf0\x03\x43\x12\x00"
                         "\x81\x48\xf7\x06\x43\x12\x00\x43\x12\x00"
                         "\x64\xf7\x04\x43\x12\x00\xf7" SONG_NOTE SONG_END);
  Smf* const smf = read_good(&bytes);
  assert_int_equal(smf->n_events, 2);
  assert_event(smf, 0, 300.0 / 960, "\xf0\x43\x12\x00\x43\x12\x00\x43\x12\x00\x43\x12\x00\xf7", 14);
  assert_notes(smf, 0);
  smf_free(smf);
}

static void a_song_without_notes_is_empty(void** state) {
  (void)state;
  Bytes bytes = song_new(0, 1, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, SONG_END);
  Smf* const smf = read_good(&bytes);
  assert_int_equal(smf->n_events, 0);
  assert_duration(smf, 0.0);
  smf_free(smf);
}

/* 0x0141eb00 ticks, of which there are 960 in a second, are 6.1 hours, and 0x0fffffff 77.7. */
static void a_song_of_hours_is_read_and_one_of_days_refused(void** state) {
  (void)state;
  Bytes bytes = song_new(0, 1, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, "\x8a\x87\xd6\x00\x90\x3c\x64" SONG_END);
  Smf* const smf = read_good(&bytes);
  assert_event(smf, 0, 0x0141EB00 / 960.0, "\x90\x3c\x64", 3);
  smf_free(smf);
#define LONG_NOTE "\xff\xff\xff\x7f\x90\x3c\x64"
  bytes = song_new(0, 1, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, LONG_NOTE SONG_END);
  assert_refused(&bytes, "found an end at 279620 s, expected at most 86400 s");
  bytes = song_new(0, 1, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, LONG_NOTE LONG_NOTE LONG_NOTE LONG_NOTE LONG_NOTE LONG_NOTE LONG_NOTE
                             LONG_NOTE LONG_NOTE SONG_END);
  assert_refused(&bytes, "found an end at 2516582 s");
}

/* What is not as it should be, and what it is taken for */

/* Tracks of one file, with and without a blemish. */
static void a_blemish_changes_nothing_but_is_noted(void** state) {
  static const struct {
    SmfNote note;
    const char* events;
    size_t size;
    const char* clean;
    size_t clean_size;
    const char* said;
  } blemishes[] = {
#define BLEMISH(note, events, clean, said)                                                         \
  {note, events, sizeof(events) - 1, clean, sizeof(clean) - 1, said}
      BLEMISH(SMF_RUNNING, SONG_NOTE "\x10\xff\x01\x01x\x10\x3c\x00" SONG_END,
              SONG_NOTE "\x10\xff\x01\x01x\x10\x90\x3c\x00" SONG_END,
              "track 1, byte 32: found running status after a meta event or sysex"),
      BLEMISH(SMF_RUNNING,
              SONG_NOTE
              "\x10\xf0\x02\x01\xf7\x10\x3c\x00\x10\x3e\x64\x00\xff\x01\x00\x00\x40\x64" SONG_END,
              SONG_NOTE
              "\x10\xf0\x02\x01\xf7\x10\x90\x3c\x00\x10\x90\x3e\x64\x00\x90\x40\x64" SONG_END,
              "the status before it; 2 times in all"),
      BLEMISH(SMF_NO_END, SONG_NOTE SONG_NOTE_LATER, SONG_NOTE SONG_NOTE_LATER SONG_END,
              "track 1, byte 31: found no End of Track"),
      BLEMISH(SMF_NO_END, "", SONG_END, "track 1, byte 22: found no End of Track"),
      BLEMISH(SMF_DATA, "\x00\x90\x3c\x80\x00\xb0\xff\x00" SONG_END,
              "\x00\x90\x3c\x7f\x00\xb0\x7f\x00" SONG_END,
              "track 1, byte 25: found a data byte over 0x7f, took it for 0x7f; 2 times in all"),
      BLEMISH(SMF_REAL_TIME, SONG_NOTE "\x10\xf8\x10\x90\xfe\x3c\xf8\xf8\x00" SONG_END,
              SONG_NOTE "\x20\x90\x3c\x00" SONG_END,
              "track 1, byte 27: found a real-time byte in a track, left it out; 4 times in all"),
      BLEMISH(SMF_REAL_TIME, "\x00\xf0\x04\x01\xf8\x02\xf7" SONG_END,
              "\x00\xf0\x03\x01\x02\xf7" SONG_END, "track 1, byte 23: found a real-time byte"),
      BLEMISH(SMF_SYSEX, "\x00\xf0\x03\x01\x90\xf7" SONG_NOTE SONG_END, SONG_NOTE SONG_END,
              "track 1, byte 23: found a broken system exclusive message"),
      BLEMISH(SMF_SYSEX, "\x00\xf0\x00\x00\xf0\x02\x01\xf7\x10\xf0\x01\x01" SONG_END,
              "\x00\xf0\x02\x01\xf7\x10\xff\x2f\x00", "left it out; 2 times in all"),
  };
  (void)state;
  for (size_t i = 0; i < sizeof(blemishes) / sizeof(blemishes[0]); ++i) {
    Bytes bytes = song_new(0, 1, SONG_TICKS);
    Bytes clean_bytes = song_new(0, 1, SONG_TICKS);
    song_add_track(&bytes, blemishes[i].events, blemishes[i].size);
    song_add_track(&clean_bytes, blemishes[i].clean, blemishes[i].clean_size);
    Smf* const smf = read_good(&bytes);
    Smf* const clean = read_good(&clean_bytes);
    assert_notes(clean, 0);
    assert_notes(smf, 1U << blemishes[i].note);
    if (!strstr(smf->note[blemishes[i].note], blemishes[i].said)) {
      fail_msg("'%s' does not say '%s'", smf->note[blemishes[i].note], blemishes[i].said);
    }
    assert_same_song(smf, clean);
    smf_free(smf);
    smf_free(clean);
  }
}

/* Two tracks, a note on at once and one a quarter later, behind any header. */
static Bytes two_tracks(unsigned type, unsigned n_tracks) {
  Bytes bytes = song_new(type, n_tracks, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, SONG_NOTE SONG_END);
  SONG_ADD_TRACK(&bytes, SONG_NOTE_LATER SONG_END);
  return bytes;
}

static void what_the_header_says_of_tracks_does_not_count(void** state) {
  static const struct {
    unsigned type;
    unsigned n_tracks;
    unsigned notes;
  } headers[] = {{1, 0, 1U << SMF_TRACKS},
                 {1, 1, 1U << SMF_TRACKS},
                 {1, 65535, 1U << SMF_TRACKS},
                 {0, 2, 1U << SMF_TYPE_0},
                 {0, 1, 1U << SMF_TYPE_0 | 1U << SMF_TRACKS}};
  (void)state;
  Bytes clean_bytes = two_tracks(1, 2);
  Smf* const clean = read_good(&clean_bytes);
  assert_notes(clean, 0);
  assert_int_equal(clean->n_events, 2);
  for (size_t i = 0; i < sizeof(headers) / sizeof(headers[0]); ++i) {
    Bytes bytes = two_tracks(headers[i].type, headers[i].n_tracks);
    Smf* const smf = read_good(&bytes);
    assert_same_song(smf, clean);
    assert_notes(smf, headers[i].notes);
    smf_free(smf);
  }
  smf_free(clean);
}

static void up_to_128_bytes_before_the_header_are_skipped(void** state) {
  (void)state;
  static const char other[129] = "An envelope, as another system puts around its files";
  Bytes clean_bytes = two_tracks(1, 2);
  Smf* const clean = read_good(&clean_bytes);
  for (size_t n = 1; n <= sizeof(other); n += n < 128 ? 127 : 1) {
    Bytes song = two_tracks(1, 2);
    Bytes bytes = {0};
    song_add(&bytes, other, n);
    song_add(&bytes, (const char*)song.data, song.size);
    bytes_clear(&song);
    if (n > 128) {
      assert_refused(&bytes, "found no MThd");
      break;
    }
    Smf* const smf = read_good(&bytes);
    assert_same_song(smf, clean);
    assert_notes(smf, 1U << SMF_LEADING);
    smf_free(smf);
  }
  smf_free(clean);
}

/* Each event of this song is a quarter after the last, so of what is left of it the length says how
 * much that is; up to the head of its track it is no song. */
static void a_track_cut_off_is_played_up_to_there(void** state) {
  (void)state;
  enum { HEAD = 22, N_EVENTS = 3, EVENT = 5 };
  Bytes bytes = song_new(0, 1, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, SONG_NOTE_LATER SONG_NOTE_LATER SONG_NOTE_LATER SONG_END);
  for (size_t size = 0; size < bytes.size; ++size) {
    Bytes cut = {0};
    song_add(&cut, (const char*)bytes.data, size);
    if (size < HEAD) {
      assert_refused(&cut, "expected");
      continue;
    }
    const size_t n_whole =
        size - HEAD < (size_t)N_EVENTS * EVENT ? (size - HEAD) / EVENT : N_EVENTS;
    Smf* const smf = read_good(&cut);
    assert_int_equal(smf->n_events, n_whole);
    assert_duration(smf, 0.5 * (double)n_whole);
    assert_notes(smf, 1U << SMF_CUT);
    assert_non_null(strstr(smf->note[SMF_CUT], "track 1, byte 18: found a track longer"));
    smf_free(smf);
  }
  bytes_clear(&bytes);
}

/* The tracks that are not there any more are no other matter. */
static void of_a_file_cut_off_nothing_else_is_said(void** state) {
  (void)state;
  Bytes bytes = two_tracks(1, 3);
  --bytes.size;
  Smf* const smf = read_good(&bytes);
  assert_int_equal(smf->n_events, 2);
  assert_notes(smf, 1U << SMF_CUT);
  smf_free(smf);
}

static void a_track_has_no_status_from_the_one_before(void** state) {
  (void)state;
  Bytes bytes = song_new(1, 2, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, SONG_NOTE SONG_END);
  SONG_ADD_TRACK(&bytes, "\x00\x3c\x00" SONG_END);
  assert_refused(&bytes, "track 2, byte 39: found 0x3c, expected a status byte");
  bytes = song_new(1, 2, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, SONG_NOTE SONG_END);
  SONG_ADD_TRACK(&bytes, SONG_NOTE "\x00\x3c\x00" SONG_END);
  Smf* const smf = read_good(&bytes);
  assert_notes(smf, 0);
  smf_free(smf);
}

/* The second track is found behind the end of the first. */
static void a_length_that_is_wrong_costs_no_note(void** state) {
  (void)state;
  Bytes clean_bytes = two_tracks(1, 2);
  Smf* const clean = read_good(&clean_bytes);
  Bytes bytes = two_tracks(1, 2);
  assert_non_null(bytes.data);
  memset(bytes.data + 18, 0xFF, 4);
  Smf* const smf = read_good(&bytes);
  assert_same_song(smf, clean);
  assert_notes(smf, 1U << SMF_CUT);
  smf_free(smf);
  smf_free(clean);
}

/* What is refused */

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
  SONG_ADD(&bytes, "RIFF\x30\x00\x00\x00RMIDLIST\xff\xff\xff\xff");
  assert_refused(&bytes, "found no MThd");
}

static void another_kind_of_song_is_refused(void** state) {
  static const unsigned divisions[] = {0, 0x8000, 0xE700, 0xE628, 0xFF28, 0xE9FF, 0x8040};
  (void)state;
  Bytes bytes = song_new(3, 1, SONG_TICKS);
  SONG_ADD_TRACK(&bytes, SONG_END);
  assert_refused(&bytes, "byte 8: found type 3, expected 0, 1 or 2");
  bytes = song_new(1, 1, SONG_TICKS);
  assert_refused(&bytes, "byte 14: found no track, expected one or more");
  for (size_t i = 0; i < sizeof(divisions) / sizeof(divisions[0]); ++i) {
    char what[64];
    (void)snprintf(what, sizeof(what), "byte 12: found division 0x%04x, expected", divisions[i]);
    bytes = song_new(0, 1, divisions[i]);
    assert_refused(&bytes, what);
  }
  SONG_ADD(&bytes, "MThd\x00\x00\x00\x05\x00\x00\x00\x01\x01\xe0");
  assert_refused(&bytes, "byte 4: found a header of 5 bytes, expected 6");
  SONG_ADD(&bytes, "MThd\x80\x00\x00\x06\x00\x00\x00\x01\x01\xe0");
  assert_refused(&bytes, "byte 4: found a header of 2147483654 bytes, expected 6 to the 6 left");
}

static void a_broken_track_is_refused_with_its_place(void** state) {
  static const struct {
    const char* events;
    size_t size;
    const char* what;
  } broken[] = {
#define BROKEN(events, what) {events, sizeof(events) - 1, "track 1, byte " what}
      BROKEN("\x00\x40\x40" SONG_END, "23: found 0x40, expected a status byte"),
      BROKEN("\x00\xf4" SONG_END, "23: found status 0xf4"),
      BROKEN("\x00\x90\x3c", "24: found 1 bytes to the end of the track, expected 2 of a message"),
      BROKEN("\x00\x90", "24: found 0 bytes to the end of the track, expected 2 of a message"),
      BROKEN("\x00\xff\x51\x02\x07\xa1" SONG_END, "24: found a tempo of 2 bytes, expected 3"),
      BROKEN("\x00\xf0\xff\x7f\x01\xf7" SONG_END, "26: found 6 bytes"),
      BROKEN("\xff\xff\xff\xff\x7f\x90\x3c\x64" SONG_END, "22: found a delta time of more than"),
      BROKEN("\x80", "23: found 0 bytes to the end of the track, expected 1 of a delta time"),
  };
  (void)state;
  for (size_t i = 0; i < sizeof(broken) / sizeof(broken[0]); ++i) {
    Bytes bytes = song_new(0, 1, SONG_TICKS);
    song_add_track(&bytes, broken[i].events, broken[i].size);
    assert_refused(&bytes, broken[i].what);
  }
}

static void a_missing_file_and_a_directory_are_refused(void** state) {
  (void)state;
  char error[256] = "";
  assert_null(smf_new("/nonexistent/song.mid", error, sizeof(error)));
  assert_string_equal(error, "/nonexistent/song.mid: No such file or directory");
  assert_null(smf_new("/", error, sizeof(error)));
  assert_string_equal(error, "/: Is a directory");
}

static void a_file_without_end_is_refused(void** state) {
  (void)state;
  char error[256] = "";
  assert_null(smf_new("/dev/zero", error, sizeof(error)));
  assert_string_equal(error, "/dev/zero: found more than 16 MiB, expected at most that");
}

/* However large */

static double now_s(void) {
  struct timespec now = {0};
  (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* A controller a tick, as many as that. */
static double time_of_controllers(size_t n) {
  Bytes events = {0};
  for (size_t i = 0; i < n; ++i) {
    SONG_ADD(&events, "\x01\xb0\x07\x40");
  }
  SONG_ADD(&events, SONG_END);
  Bytes bytes = song_new(0, 1, SONG_TICKS);
  song_add_track(&bytes, (const char*)events.data, events.size);
  bytes_clear(&events);
  const double start_s = now_s();
  Smf* const smf = read_good(&bytes);
  const double took_s = now_s() - start_s;
  assert_int_equal(smf->n_events, n);
  assert_event(smf, n - 1, (double)n / 960, "\xb0\x07\x40", 3);
  smf_free(smf);
  return took_s;
}

/* A note in each, of which the later tracks have the earlier ones. */
static double time_of_tracks(uint32_t n) {
  Bytes bytes = song_new(1, n, SONG_TICKS);
  for (uint32_t i = n; i > 0; --i) {
    const char events[] = {(char)(0x80 | (i >> 14)),
                           (char)(0x80 | (i >> 7)),
                           (char)(i & 0x7F),
                           (char)0x90,
                           0x3C,
                           0x64,
                           0,
                           (char)0xFF,
                           0x2F,
                           0};
    song_add_track(&bytes, events, sizeof(events));
  }
  const double start_s = now_s();
  Smf* const smf = read_good(&bytes);
  const double took_s = now_s() - start_s;
  assert_int_equal(smf->n_events, n);
  assert_event(smf, 0, 1.0 / 960, "\x90\x3c\x64", 3);
  assert_event(smf, n - 1, n / 960.0, "\x90\x3c\x64", 3);
  assert_notes(smf, 0);
  smf_free(smf);
  return took_s;
}

/* Square time would be 31 s and 46 s here, and 64 times as much for 8 times as many. */
static void large_songs_are_read_in_no_time(void** state) {
  (void)state;
  const double few_s = time_of_controllers(62500);
  const double many_s = time_of_controllers(500000);
  const double tracks_s = time_of_tracks(60000);
  print_message("62,500 controllers %.3f s, 500,000 %.3f s; 60,000 tracks %.3f s\n", few_s, many_s,
                tracks_s);
  assert_true(many_s < 2.0 && tracks_s < 2.0);
  assert_true(many_s < 24 * few_s + 0.1);
}

/* Read or refused, never a crash; sometimes read, or the damage would prove nothing. What is read
 * is in order, and ends. */
static void damaged_files_do_no_harm(void** state) {
  (void)state;
  Random random = random_start();
  size_t n_read = 0;
  Bytes bytes = song_with_everything();
  uint8_t damaged[256];
  assert_true(bytes.size <= sizeof(damaged));
  for (int i = 0; i < 5000; ++i) {
    Read read;
    memcpy(damaged, bytes.data, bytes.size);
    for (uint32_t n = 1 + random_below(&random, 4); n > 0; --n) {
      damaged[random_below(&random, (uint32_t)bytes.size)] = (uint8_t)random_below(&random, 256);
    }
    Smf* const smf = read_bytes(damaged, bytes.size - random_below(&random, 8), &read);
    for (size_t k = 0; smf && k < smf->n_events; ++k) {
      assert_true(smf->events[k].time_s <= smf->duration_s);
      assert_true(k == 0 || smf->events[k].time_s >= smf->events[k - 1].time_s);
    }
    n_read += smf ? 1 : 0;
    smf_free(smf);
  }
  bytes_clear(&bytes);
  print_message("%zu of 5000 were read\n", n_read);
  assert_in_range(n_read, 100, 4900);
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
  Smf* const smf = smf_new(path, error, sizeof(error));
  assert_string_equal(error, "");
  assert_in_range((uintmax_t)smf->duration_s, 50, 70);
  assert_notes(smf, 0);
  smf_free(smf);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(without_a_tempo_a_quarter_lasts_half_a_second),
      cmocka_unit_test(tempo_changes_of_any_track_move_all_notes),
      cmocka_unit_test(a_tempo_may_be_longer_than_three_bytes_but_not_infinite),
      cmocka_unit_test(simultaneous_events_keep_the_order_of_tracks_and_of_the_file),
      cmocka_unit_test(running_status_is_written_out),
      cmocka_unit_test(long_pauses_are_kept),
      cmocka_unit_test(a_longer_header_is_passed_over),
      cmocka_unit_test(patterns_of_type_2_are_played_one_after_the_other),
      cmocka_unit_test(smpte_frames_need_no_tempo),
      cmocka_unit_test(a_riff_file_is_the_file_inside),
      cmocka_unit_test(the_latest_end_of_track_is_the_end),
      cmocka_unit_test(what_is_not_played_costs_no_note),
      cmocka_unit_test(a_system_exclusive_message_is_kept),
      cmocka_unit_test(a_message_in_packets_is_put_together),
      cmocka_unit_test(a_song_without_notes_is_empty),
      cmocka_unit_test(a_song_of_hours_is_read_and_one_of_days_refused),
      cmocka_unit_test(a_blemish_changes_nothing_but_is_noted),
      cmocka_unit_test(what_the_header_says_of_tracks_does_not_count),
      cmocka_unit_test(up_to_128_bytes_before_the_header_are_skipped),
      cmocka_unit_test(a_track_cut_off_is_played_up_to_there),
      cmocka_unit_test(of_a_file_cut_off_nothing_else_is_said),
      cmocka_unit_test(a_track_has_no_status_from_the_one_before),
      cmocka_unit_test(a_length_that_is_wrong_costs_no_note),
      cmocka_unit_test(another_kind_of_file_is_refused),
      cmocka_unit_test(another_kind_of_song_is_refused),
      cmocka_unit_test(a_broken_track_is_refused_with_its_place),
      cmocka_unit_test(a_missing_file_and_a_directory_are_refused),
      cmocka_unit_test(a_file_without_end_is_refused),
      cmocka_unit_test(large_songs_are_read_in_no_time),
      cmocka_unit_test(damaged_files_do_no_harm),
      cmocka_unit_test(the_demo_is_a_minute_long),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

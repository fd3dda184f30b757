/**
   Standard MIDI Files put together in memory, byte by byte, right or wrong.
*/
#ifndef HOOKE_TESTS_SUPPORT_SONG_H
#define HOOKE_TESTS_SUPPORT_SONG_H

#include "tools/formats/bytes.h"

#include <stddef.h>
#include <stdint.h>

enum { SONG_TICKS = 480 }; // In a quarter note

/* Events as they stand in a track, each behind the time since the one before. */
#define SONG_END "\x00\xff\x2f\x00"
#define SONG_NOTE "\x00\x90\x3c\x64"
#define SONG_NOTE_LATER "\x83\x60\x90\x3c\x64" // After a quarter note

/** @return A file's header alone; every function here fails the test when memory is out. */
Bytes song_new(unsigned type, unsigned n_tracks, unsigned division);

/** Add bytes as they are. */
void song_add(Bytes* song, const char* data, size_t size);

/** Add a track of these events. */
void song_add_track(Bytes* song, const char* events, size_t size);

/** The same for literals, which may have zeros in them. */
#define SONG_ADD(song, literal) song_add(song, literal, sizeof(literal) - 1)
#define SONG_ADD_TRACK(song, literal) song_add_track(song, literal, sizeof(literal) - 1)

/** Two tracks with a tempo, notes and system exclusive messages, whole and in pieces. */
Bytes song_with_everything(void);

#endif

/**
   A song through a host into a sound file.
*/
#ifndef HOOKE_TOOLS_HOST_PLAY_H
#define HOOKE_TOOLS_HOST_PLAY_H

#include "tools/formats/smf.h"
#include "tools/formats/soundfile.h"
#include "tools/host/host.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** An event of a song. */
typedef struct {
  double time_s;    ///< From the start [s], ≥ 0
  const void* body; ///< Of its atom, as long-lived as the song
  uint32_t size;    ///< [bytes]
} PlayEvent;

/** What is played. */
typedef struct {
  const char* type_uri; ///< Of the atoms that are sent
  const void* song;
  size_t n_events;
  double duration_s;                              ///< To its end [s], not before the last event
  PlayEvent (*event)(const void* song, size_t i); ///< The i-th in order of time
} PlaySong;

/** How to play. */
typedef struct {
  double rate_hz;      ///< The host's [Hz]
  uint32_t block;      ///< Frames in a run [frames], 1 … max_block of the host
  double tail_s;       ///< Sound after the end [s]; below 0: until silent, at most PLAY_MAX_TAIL_S
  bool shows_progress; ///< On stderr
} PlayHow;

/** What came of it. */
typedef struct {
  uint64_t n_frames; ///< Written [frames]
  float peak;        ///< Greatest magnitude of a sample, full scale is 1
  double run_s;      ///< Time spent in the plugin [s]
} PlayResult;

/** @return The file as play() takes it, good as long as the file is */
PlaySong play_midi(const Smf* file);

/** The longest tail when none is asked for [s]. */
#define PLAY_MAX_TAIL_S 10.0

/**
   Play a song, each event on the frame nearest to its time.

   The sound is as long as the song and its tail, but has one frame at least. Silence is a quarter
   of a second below −100 dBFS after the song's end; the frame where it is full is the last one.
   What a song has at its very end is only heard in a tail. Nothing here depends on the block but
   the plugin.
   @param sound        Where the sound goes
   @param[out] result  Undefined on failure
   @param[out] error   One line, on failure
   @param error_size   Room in `error` [bytes]
   @return false if a run or a write fails, the sound is not finite, memory is out, or SIGINT or
   SIGTERM, if blocked by the caller, is pending.
*/
bool play(Host* host,
          const PlaySong* song,
          const PlayHow* how,
          SoundFile* sound,
          PlayResult* result,
          char* error,
          size_t error_size);

#endif

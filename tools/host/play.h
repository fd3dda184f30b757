/**
   What sounds, block by block to where it goes: a song through a host, or anything else.
*/
#ifndef HOOKE_TOOLS_HOST_PLAY_H
#define HOOKE_TOOLS_HOST_PLAY_H

#include "tools/formats/smf.h"
#include "tools/host/host.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { PLAY_ERROR_SIZE = 512 };

/** What sounds. */
typedef struct {
  void* self;
  /** Write the next frames, left and right in turn, and say why in `error` where that fails. */
  bool (*run)(void* self, uint64_t at, uint32_t n, float* frames, char error[PLAY_ERROR_SIZE]);
  double rate_hz;
  uint32_t block;      /**< Most frames that are asked for at once [frames], > 0 */
  uint64_t n_frames;   /**< To its end */
  uint64_t n_tail;     /**< Most frames behind that */
  bool ends_silent;    /**< Whether a tail is over once it is silent */
  bool shows_progress; /**< On stderr */
} PlaySource;

/** Where it goes. */
typedef struct {
  void* self;
  /** Take frames, left and right in turn, and say why in `error` where that fails. */
  bool (*write)(void* self, const float* frames, uint32_t n, char error[PLAY_ERROR_SIZE]);
} PlaySink;

/** What came of it. */
typedef struct {
  uint64_t n_frames;           /**< Written [frames] */
  float peak;                  /**< Greatest magnitude of a sample, full scale is 1 */
  uint64_t n_over;             /**< Samples above full scale, on both sides */
  bool is_cut;                 /**< It was to end in silence, and did not */
  double run_s;                /**< Time spent in the source [s] */
  char error[PLAY_ERROR_SIZE]; /**< One line, on failure */
} PlayResult;

/**
   Play a source to its end.

   The sound is as long as the source and its tail, but has one frame at least. Silence is a quarter
   of a second in the tail, 80 dB below the loudest sample so far; the frame where it is full is the
   last one.
   @param[out] result  All but the error is undefined on failure
   @return false if a run or a write fails, the sound is not finite, or memory is out.
*/
bool play(const PlaySource* source, const PlaySink* sink, PlayResult* result);

/** A source, and what it is multiplied by. */
typedef struct {
  const PlaySource* source;
  double gain;
} PlayGain;

/** @return The source with its gain, good as long as both are */
PlaySource play_amplified(PlayGain* gain);

/** An event of a song. */
typedef struct {
  double time_s;    /**< From the start [s], ≥ 0 */
  const void* body; /**< Of its atom, as long-lived as the song */
  uint32_t size;    /**< [bytes] */
} PlayEvent;

/** A song, and a host to play it. */
typedef struct {
  Host* host;
  double rate_hz;       /**< The host's [Hz] */
  const char* type_uri; /**< Of the atoms that are sent */
  const void* events;
  size_t n_events;
  PlayEvent (*event)(const void* events, size_t i); /**< The i-th in order of time */
  double duration_s; /**< To its end [s], not before the last event */
  size_t n_sent;     /**< Events sent so far */
} PlaySong;

/** @return The events of a file as those of a song, good as long as the file is */
PlaySong play_smf(const Smf* smf);

/**
   @param song    Its host is run, in blocks of at most what the host was made for, and each event
   sent on the frame nearest to its time; what it has at its very end is only heard in a tail.
   Nothing here depends on the block but the plugin.
   @param tail_s  Sound after the end [s]; below 0: until silent, at most a minute
   @return The source that the song is, good as long as it is
*/
PlaySource play_song(PlaySong* song, uint32_t block, double tail_s);

#endif

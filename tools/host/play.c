#define _POSIX_C_SOURCE 200809L

#include "tools/host/play.h"

#include <lv2/midi/midi.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static const float SILENCE = 1e-5F; // −100 dBFS
static const double SILENCE_S = 0.25;

typedef struct {
  Host* host;
  const PlaySong* song;
  const PlayHow* how;
  SoundFile* sound;
  PlayResult* result;
  char* error;
  size_t error_size;

  float* frames;     // A block, left and right in turn
  const float* left; // The host's outputs
  const float* right;
  size_t next_event;
  uint64_t at;           // [frames]
  uint64_t song_frames;  // To its end
  uint64_t end;          // Where to stop at the latest
  uint64_t needed_quiet; // Silent frames that end it
  uint64_t quiet;        // Silent frames in a row
  bool is_done;
} Play;

__attribute__((format(printf, 2, 3))) static bool fail(const Play* play, const char* format, ...) {
  va_list args;
  va_start(args, format);
  (void)vsnprintf(play->error, play->error_size, format, args);
  va_end(args);
  return false;
}

static uint64_t to_frames(double time_s, double rate_hz) {
  return (uint64_t)llround(time_s * rate_hz);
}

static double now_s(void) {
  struct timespec now = {0};
  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static bool is_interrupted(void) {
  sigset_t pending;
  return !sigpending(&pending) &&
         (sigismember(&pending, SIGINT) == 1 || sigismember(&pending, SIGTERM) == 1);
}

static bool queue_events(Play* play, uint32_t n) {
  for (; play->next_event < play->song->n_events; ++play->next_event) {
    const PlayEvent event = play->song->event(play->song->song, play->next_event);
    const uint64_t frame = to_frames(event.time_s, play->how->rate_hz);
    if (frame >= play->at + n) {
      break;
    }
    if (!host_atom(play->host, (uint32_t)(frame - play->at), play->song->type_uri, event.body,
                   event.size)) {
      return fail(play, "%s", host_error(play->host));
    }
  }
  return true;
}

static bool run(Play* play, uint32_t n) {
  const double start_s = now_s();
  const bool is_run = host_run(play->host, n);
  play->result->run_s += now_s() - start_s;
  return is_run || fail(play, "%s", host_error(play->host));
}

/* Take over one frame of the outputs: n-th of the block. */
static bool take_frame(Play* play, uint32_t i) {
  const float left = play->left[i];
  const float right = play->right[i];
  const uint64_t frame = play->at + i;
  if (!isfinite(left) || !isfinite(right)) {
    return fail(play, "found sound that is not finite at %.6f s, expected numbers",
                (double)frame / play->how->rate_hz);
  }
  float* const out = play->frames + 2 * (size_t)i;
  out[0] = left;
  out[1] = right;
  const float loudest = fmaxf(fabsf(left), fabsf(right));
  play->result->peak = fmaxf(play->result->peak, loudest);
  play->quiet = frame >= play->song_frames && loudest < SILENCE ? play->quiet + 1 : 0;
  play->is_done = play->quiet >= play->needed_quiet || frame + 1 >= play->end;
  return true;
}

static bool play_block(Play* play) {
  const uint64_t left = play->end - play->at;
  const uint32_t n = left < play->how->block ? (uint32_t)left : play->how->block;
  if (!queue_events(play, n) || !run(play, n)) {
    return false;
  }
  uint32_t n_taken = 0;
  while (n_taken < n && !play->is_done) {
    if (!take_frame(play, n_taken++)) {
      return false;
    }
  }
  if (!soundfile_write(play->sound, play->frames, n_taken)) {
    return fail(play, "sound not written: the disk is full, or a WAV file would pass 4 GiB");
  }
  play->at += n_taken;
  return true;
}

static void show_progress(const Play* play, int* shown) {
  const double done = (double)play->at / (double)play->song_frames;
  const int percent = done < 1.0 ? (int)(100.0 * done) : 100;
  if (play->how->shows_progress && percent != *shown) {
    (void)fprintf(stderr, "\r%3d %%", percent);
    *shown = percent;
  }
}

static bool play_all(Play* play) {
  int shown = -1;
  bool is_ok = true;
  while (is_ok && !play->is_done) {
    is_ok = is_interrupted() ? fail(play, "interrupted") : play_block(play);
    show_progress(play, &shown);
  }
  if (shown >= 0) {
    (void)fprintf(stderr, "\r     \r");
  }
  play->result->n_frames = play->at;
  return is_ok;
}

static void plan_end(Play* play) {
  const PlaySong* const song = play->song;
  const bool has_tail = play->how->tail_s >= 0;
  const double tail_s = has_tail ? play->how->tail_s : PLAY_MAX_TAIL_S;
  play->song_frames = to_frames(song->duration_s, play->how->rate_hz);
  play->end = play->song_frames + to_frames(tail_s, play->how->rate_hz);
  play->end += play->end == 0;
  play->needed_quiet = has_tail ? UINT64_MAX : to_frames(SILENCE_S, play->how->rate_hz);
}

static PlayEvent midi_event(const void* song, size_t i) {
  const SmfEvent* const event = &((const Smf*)song)->events[i];
  return (PlayEvent){event->time_s, event->bytes, event->size};
}

PlaySong play_midi(const Smf* file) {
  return (PlaySong){LV2_MIDI__MidiEvent, file, file->n_events, file->duration_s, midi_event};
}

bool play(Host* host,
          const PlaySong* song,
          const PlayHow* how,
          SoundFile* sound,
          PlayResult* result,
          char* error,
          size_t error_size) {
  Play self = {.host = host,
               .song = song,
               .how = how,
               .sound = sound,
               .result = result,
               .error = error,
               .error_size = error_size};
  *result = (PlayResult){0};
  self.left = host_output(host, 0);
  self.right = host_n_outputs(host) > 1 ? host_output(host, 1) : self.left;
  if (!self.left) {
    return fail(&self, "found no audio output, expected one or two");
  }
  self.frames = calloc(how->block, 2 * sizeof(float));
  if (!self.frames) {
    return fail(&self, "out of memory");
  }
  plan_end(&self);
  const bool is_ok = play_all(&self);
  free(self.frames);
  return is_ok;
}

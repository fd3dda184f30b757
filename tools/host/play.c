#define _POSIX_C_SOURCE 200809L

#include "tools/host/play.h"

#include <lv2/midi/midi.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static const float SILENCE = 1e-4F; /* −80 dB, of the loudest that there was */
static const double SILENCE_S = 0.25;
static const double MAX_TAIL_S = 60.0;

/* Always false. */
__attribute__((format(printf, 2, 3))) static bool
fail(char error[PLAY_ERROR_SIZE], const char* format, ...) {
  va_list args;
  va_start(args, format);
  (void)vsnprintf(error, PLAY_ERROR_SIZE, format, args);
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

typedef struct {
  const PlaySource* source;
  PlayResult* result;
  float* frames;
  uint64_t end;   /* Where to stop at the latest */
  uint64_t quiet; /* Silent frames in a row */
  int shown;      /* Progress [percent]; below 0: none yet */
  bool is_done;
} Play;

/* 1 for what is above full scale, or else 0. */
static uint64_t over(float sample) {
  return fabsf(sample) > 1.0F;
}

/* Take the frames of a block up to the last one of all; how many there are. */
static uint32_t take_frames(Play* self, uint32_t n) {
  const PlaySource* const source = self->source;
  const uint64_t needed_quiet =
      source->ends_silent ? to_frames(SILENCE_S, source->rate_hz) : UINT64_MAX;
  uint32_t i = 0;
  while (i < n && !self->is_done) {
    const uint64_t frame = self->result->n_frames + i;
    const float* const pair = self->frames + 2 * (size_t)i++;
    if (!isfinite(pair[0]) || !isfinite(pair[1])) {
      (void)fail(self->result->error, "found sound that is not finite at %.6f s, expected numbers",
                 (double)frame / source->rate_hz);
      return 0;
    }
    const float loudest = fmaxf(fabsf(pair[0]), fabsf(pair[1]));
    self->result->peak = fmaxf(self->result->peak, loudest);
    self->result->n_over += over(pair[0]) + over(pair[1]);
    const bool is_quiet = loudest <= SILENCE * self->result->peak;
    self->quiet = frame >= source->n_frames && is_quiet ? self->quiet + 1 : 0;
    self->is_done = self->quiet >= needed_quiet || frame + 1 >= self->end;
  }
  return i;
}

static bool play_block(Play* self, const PlaySink* sink) {
  const PlaySource* const source = self->source;
  PlayResult* const result = self->result;
  const uint64_t left = self->end - result->n_frames;
  const uint32_t n = left < source->block ? (uint32_t)left : source->block;
  const double start_s = now_s();
  if (!source->run(source->self, result->n_frames, n, self->frames, result->error)) {
    return false;
  }
  result->run_s += now_s() - start_s;
  const uint32_t n_taken = take_frames(self, n);
  result->n_frames += n_taken;
  return n_taken > 0 && sink->write(sink->self, self->frames, n_taken, result->error);
}

static void show_progress(Play* self) {
  const double done = (double)self->result->n_frames / (double)self->source->n_frames;
  const int percent = done < 1.0 ? (int)(100.0 * done) : 100;
  if (self->source->shows_progress && percent != self->shown) {
    (void)fprintf(stderr, "\r%3d %%", percent);
    self->shown = percent;
  }
}

bool play(const PlaySource* source, const PlaySink* sink, PlayResult* result) {
  Play self = {.source = source, .result = result, .shown = -1};
  *result = (PlayResult){0};
  self.end = source->n_frames + source->n_tail;
  self.end += self.end == 0;
  self.frames = calloc(source->block, 2 * sizeof(float));
  if (!self.frames) {
    return fail(result->error, "out of memory");
  }
  bool is_ok = true;
  while (is_ok && !self.is_done) {
    is_ok = play_block(&self, sink);
    show_progress(&self);
  }
  result->is_cut = source->ends_silent && self.quiet == 0;
  if (self.shown >= 0) {
    (void)fprintf(stderr, "\r     \r");
  }
  free(self.frames);
  return is_ok;
}

static bool
run_louder(void* self, uint64_t at, uint32_t n, float* frames, char error[PLAY_ERROR_SIZE]) {
  const PlayGain* const gain = (const PlayGain*)self;
  if (!gain->source->run(gain->source->self, at, n, frames, error)) {
    return false;
  }
  for (size_t i = 0; i < 2 * (size_t)n; ++i) {
    frames[i] = (float)(gain->gain * (double)frames[i]);
  }
  return true;
}

PlaySource play_amplified(PlayGain* gain) {
  PlaySource source = *gain->source;
  source.self = gain;
  source.run = run_louder;
  return source;
}

static bool send_events(PlaySong* song, uint64_t at, uint32_t n) {
  for (; song->n_sent < song->n_events; ++song->n_sent) {
    const PlayEvent event = song->event(song->events, song->n_sent);
    const uint64_t frame = to_frames(event.time_s, song->rate_hz);
    if (frame >= at + n) {
      break;
    }
    if (!host_atom(song->host, (uint32_t)(frame - at), song->type_uri, event.body, event.size)) {
      return false;
    }
  }
  return true;
}

static bool
run_song(void* self, uint64_t at, uint32_t n, float* frames, char error[PLAY_ERROR_SIZE]) {
  PlaySong* const song = (PlaySong*)self;
  const float* const left = host_output(song->host, 0);
  const float* const second = host_output(song->host, 1);
  const float* const right = second ? second : left;
  if (!left) {
    return fail(error, "found no audio output, expected one or two");
  }
  if (!send_events(song, at, n) || !host_run(song->host, n)) {
    return fail(error, "%s", host_error(song->host));
  }
  for (uint32_t i = 0; i < n; ++i) {
    frames[2 * (size_t)i] = left[i];
    frames[2 * (size_t)i + 1] = right[i];
  }
  return true;
}

PlaySource play_song(PlaySong* song, uint32_t block, double tail_s) {
  const bool has_tail = tail_s >= 0.0;
  return (PlaySource){.self = song,
                      .run = run_song,
                      .rate_hz = song->rate_hz,
                      .block = block,
                      .n_frames = to_frames(song->duration_s, song->rate_hz),
                      .n_tail = to_frames(has_tail ? tail_s : MAX_TAIL_S, song->rate_hz),
                      .ends_silent = !has_tail};
}

static PlayEvent smf_event(const void* events, size_t i) {
  const SmfEvent* const event = (const SmfEvent*)events + i;
  return (PlayEvent){event->time_s, event->bytes, event->size};
}

PlaySong play_smf(const Smf* smf) {
  return (PlaySong){.type_uri = LV2_MIDI__MidiEvent,
                    .events = smf->events,
                    .n_events = smf->n_events,
                    .event = smf_event,
                    .duration_s = smf->duration_s};
}

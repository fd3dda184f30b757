#include "tools/host/tape.h"

#include <errno.h>
#include <string.h>

static bool fail(char error[PLAY_ERROR_SIZE]) {
  (void)snprintf(error, PLAY_ERROR_SIZE, "temporary file: %s", strerror(errno));
  return false;
}

bool tape_init(Tape* tape, char error[PLAY_ERROR_SIZE]) {
  *tape = (Tape){.file = tmpfile()};
  return tape->file || fail(error);
}

void tape_clear(Tape* tape) {
  if (tape->file) {
    (void)fclose(tape->file);
  }
  *tape = (Tape){0};
}

static bool record(void* self, const float* frames, uint32_t n, char error[PLAY_ERROR_SIZE]) {
  Tape* const tape = (Tape*)self;
  tape->frames += n;
  return fwrite(frames, 2 * sizeof(*frames), n, tape->file) == n || fail(error);
}

PlaySink tape_sink(Tape* tape) {
  return (PlaySink){tape, record};
}

static bool
replay(void* self, uint64_t at, uint32_t n, float* frames, char error[PLAY_ERROR_SIZE]) {
  (void)at;
  return fread(frames, 2 * sizeof(*frames), n, ((Tape*)self)->file) == n || fail(error);
}

PlaySource tape_source(Tape* tape, const PlaySource* played) {
  errno = 0;
  rewind(tape->file);
  return (PlaySource){.self = tape,
                      .run = replay,
                      .rate_hz = played->rate_hz,
                      .block = played->block,
                      .n_frames = tape->frames};
}

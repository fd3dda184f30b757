#define _POSIX_C_SOURCE 200809L

#include "tools/commands/sound_out.h"

#include "tools/formats/escape.h"
#include "tools/formats/outfile.h"
#include "tools/formats/soundfile.h"
#include "tools/host/tape.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { ERROR_SIZE = 4608 };

/* Below this people turn the volume up in vain [dBFS]. */
static const double FAINT_DB = -40.0;

static double to_db(double factor) {
  return 20.0 * log10(factor);
}

static double from_db(double db) {
  return pow(10.0, db / 20.0);
}

/* Always ARGS_FAILURE. */
static int fail(const SoundOut* out, const char* why) {
  return args_fail(out->args, ARGS_FAILURE, "%s: %s", out->path, why);
}

static bool write_frames(void* self, const float* frames, uint32_t n, char error[PLAY_ERROR_SIZE]) {
  SoundFile* const sound = (SoundFile*)self;
  if (soundfile_write(sound, frames, n)) {
    return true;
  }
  (void)snprintf(error, PLAY_ERROR_SIZE, "sound not written: %s", soundfile_error(sound));
  return false;
}

static bool play_amplified_into(SoundFile* sound,
                                const PlaySource* source,
                                double gain_db,
                                PlayResult* result) {
  const PlaySink sink = {sound, write_frames};
  PlayGain gain = {source, from_db(gain_db)};
  const PlaySource louder = play_amplified(&gain);
  return play(gain_db != 0.0 ? &louder : source, &sink, result);
}

/* The peak is known at the end, so play it onto a tape first. */
static bool play_normalized_into(SoundFile* sound,
                                 const PlaySource* source,
                                 double peak_db,
                                 PlayResult* result) {
  Tape tape;
  if (!tape_init(&tape, result->error)) {
    return false;
  }
  const PlaySink sink = tape_sink(&tape);
  bool is_ok = play(source, &sink, result);
  if (is_ok) {
    const PlayResult first = *result;
    const PlaySource taped = tape_source(&tape, source);
    const double gain_db = first.peak > 0.0F ? peak_db - to_db((double)first.peak) : 0.0;
    is_ok = play_amplified_into(sound, &taped, gain_db, result);
    result->run_s = first.run_s;
    result->is_cut = first.is_cut;
  }
  tape_clear(&tape);
  return is_ok;
}

/* What would be too long is refused before the first frame. */
static bool
play_into(const SoundOut* out, SoundFile* sound, const PlaySource* source, PlayResult* result) {
  if (!soundfile_has_room(sound, source->n_frames)) {
    (void)snprintf(result->error, sizeof(result->error),
                   "found a length of %.0f s, expected a WAV file below 4 GiB",
                   (double)source->n_frames / source->rate_hz);
    return false;
  }
  return out->normalizes ? play_normalized_into(sound, source, out->peak_db, result)
                         : play_amplified_into(sound, source, out->gain_db, result);
}

static int write_file(const SoundOut* out, const PlaySource* source, PlayResult* result) {
  char error[ERROR_SIZE] = "";
  SoundFile* const sound =
      soundfile_new(out->path, (int)source->rate_hz, out->bits, error, sizeof(error));
  if (!sound) {
    return args_fail(out->args, ARGS_FAILURE, "%s", error);
  }
  if (!play_into(out, sound, source, result)) {
    soundfile_free(sound);
    return fail(out, result->error);
  }
  const int reason = soundfile_finish(sound);
  return reason ? fail(out, strerror(reason)) : ARGS_OK;
}

static void warn(const SoundOut* out, const PlayResult* result) {
  const double peak_db = to_db((double)result->peak);
  if (result->n_over > 0 && soundfile_clips(out->path, out->bits)) {
    args_fail(out->args, 0, "%s: clipped %llu samples, the loudest %.1f dB above full scale",
              out->path, (unsigned long long)result->n_over, peak_db);
  }
  if (result->peak > 0.0F && peak_db < FAINT_DB) {
    args_fail(out->args, 0, "%s: found a peak of %.1f dBFS, which is hardly heard; try --normalize",
              out->path, peak_db);
  }
  if (result->is_cut) {
    args_fail(out->args, 0, "%s: cut while it rings; --tail S goes on for S seconds", out->path);
  }
}

static void report(const SoundOut* out, double rate_hz, const PlayResult* result) {
  const double duration_s = (double)result->n_frames / rate_hz;
  char peak[32] = "silent";
  if (result->peak > 0) {
    (void)snprintf(peak, sizeof(peak), "peak %.1f dBFS", to_db((double)result->peak));
  }
  FILE* const stream = outfile_is_stdout(out->path) ? stderr : stdout;
  escape_print(stream, out->path);
  (void)fprintf(stream, ": %.2f s, %s, %.1f times as fast as real time\n", duration_s, peak,
                duration_s / fmax(result->run_s, 1e-9));
}

int sound_out_write(const SoundOut* out, PlaySource source) {
  PlayResult result;
  source.shows_progress = !out->is_quiet && isatty(STDERR_FILENO);
  const int code = write_file(out, &source, &result);
  if (!code && !out->is_quiet) {
    report(out, source.rate_hz, &result);
    warn(out, &result);
  }
  return code;
}

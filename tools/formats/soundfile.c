#define _POSIX_C_SOURCE 200809L

#include "tools/formats/soundfile.h"

#include "tools/formats/bytes.h"
#include "tools/formats/outfile.h"

#include <errno.h>
#include <math.h>
#include <sndfile.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

enum { ENCODER_SIZE = 8 << 20 }; /* Of memory that an encoder may take [bytes] */

static const uint64_t MAX_WAV_BYTES = UINT32_MAX - 4096;

struct SoundFile {
  SNDFILE* sound;
  Outfile file;
  int reason; /* Why something could not be written, as errno has it; 0: all could */
  uint64_t bytes_left;
  unsigned bytes_per_frame;
};

typedef struct {
  const char* ending;
  int format; /* Without depth */
  unsigned usual_bits;
  unsigned max_bits;
  double max_rate_hz; /* 0: there is no bound */
  const char* rates;
} Kind;

static const Kind kinds[] = {
    {".wav", SF_FORMAT_WAV, 32, 32, 0.0, NULL},
    {".flac", SF_FORMAT_FLAC, 24, 24, 655350.0, "at most 655350 Hz for .flac, above 65535 in tens"},
    {".ogg", SF_FORMAT_OGG | SF_FORMAT_VORBIS, 0, 0, 200000.0, "at most 200000 Hz for .ogg"},
};

/* A pipe or a device needs no ending: it gets a WAV file. */
static const Kind* find_kind(const char* path) {
  const char* const slash = strrchr(path, '/');
  const char* const name = slash ? slash + 1 : path;
  const char* const ending = strrchr(name, '.');
  for (size_t i = 0; ending && ending != name && i < sizeof(kinds) / sizeof(kinds[0]); ++i) {
    if (!strcasecmp(ending, kinds[i].ending)) {
      return &kinds[i];
    }
  }
  return outfile_is_stream(path) ? &kinds[0] : NULL;
}

static bool is_directory(const char* path) {
  struct stat status;
  return !stat(path, &status) && S_ISDIR(status.st_mode);
}

static int kind_format(const Kind* kind, unsigned bits) {
  switch (bits ? bits : kind->usual_bits) {
  case 16:
    return kind->format | SF_FORMAT_PCM_16;
  case 24:
    return kind->format | SF_FORMAT_PCM_24;
  case 32:
    return kind->format | SF_FORMAT_FLOAT;
  default:
    return kind->format;
  }
}

/* FLAC has 16 bits for a rate in Hz, or in tens of them. */
const char* soundfile_refuse_rate(const char* path, double rate_hz) {
  const Kind* const kind = find_kind(path);
  if (!kind || kind->max_rate_hz == 0.0) {
    return NULL;
  }
  const bool is_odd =
      kind->format == SF_FORMAT_FLAC && rate_hz > 65535.0 && fmod(rate_hz, 10.0) != 0.0;
  return rate_hz > kind->max_rate_hz || is_odd ? kind->rates : NULL;
}

const char* soundfile_refuse(const char* path, unsigned bits) {
  const Kind* const kind = find_kind(path);
  if (is_directory(path)) {
    return "found a directory, expected a file that ends in .wav, .flac or .ogg";
  }
  if (!kind) {
    return "found another ending, expected .wav, .flac or .ogg";
  }
  if (bits && bits != 16 && bits != 24 && bits != 32) {
    return "found another depth, expected 16, 24 or 32 bits";
  }
  if (bits > kind->max_bits) {
    return kind->max_bits ? "found 32 bits, expected 16 or 24 for .flac"
                          : "found a depth in bits, expected none for .ogg";
  }
  return NULL;
}

/* The PEAK chunk bears the time of day: without it the same sound is the same file. */
static void configure(SNDFILE* sound, const Kind* kind) {
  double quality = 0.8;
  (void)sf_command(sound, SFC_SET_ADD_PEAK_CHUNK, NULL, SF_FALSE);
  (void)sf_command(sound, SFC_SET_CLIPPING, NULL, SF_TRUE);
  if (!kind->max_bits) {
    (void)sf_command(sound, SFC_SET_VBR_ENCODING_QUALITY, &quality, sizeof(quality));
  }
}

/* What libsndfile writes with: it tells nobody why a file cannot be written. */

static sf_count_t on_length(void* user) {
  struct stat status;
  return fstat(((const SoundFile*)user)->file.fd, &status) ? -1 : (sf_count_t)status.st_size;
}

static sf_count_t on_seek(sf_count_t offset, int from, void* user) {
  return (sf_count_t)lseek(((const SoundFile*)user)->file.fd, (off_t)offset, from);
}

static sf_count_t on_read(void* bytes, sf_count_t size, void* user) {
  return (sf_count_t)read(((const SoundFile*)user)->file.fd, bytes, (size_t)size);
}

static sf_count_t on_write(const void* bytes, sf_count_t size, void* user) {
  SoundFile* const file = (SoundFile*)user;
  sf_count_t done = 0;
  while (done < size && !file->reason) {
    const ssize_t n = write(file->file.fd, (const char*)bytes + done, (size_t)(size - done));
    done += n > 0 ? n : 0;
    file->reason = n > 0 || errno == EINTR ? 0 : errno;
  }
  return done;
}

static sf_count_t on_tell(void* user) {
  return on_seek(0, SEEK_CUR, user);
}

static bool open_sound(
    SoundFile* file, const char* path, int rate_hz, unsigned bits, char* error, size_t size) {
  SF_VIRTUAL_IO io = {on_length, on_seek, on_read, on_write, on_tell};
  const Kind* const kind = find_kind(path);
  SF_INFO info = {.samplerate = rate_hz, .channels = 2, .format = kind_format(kind, bits)};
  if (kind->format != SF_FORMAT_WAV && !bytes_are_free(ENCODER_SIZE)) {
    (void)snprintf(error, size, "%s: out of memory", path);
    return false;
  }
  file->sound = sf_open_virtual(&io, SFM_WRITE, &info, file);
  if (!file->sound) {
    (void)snprintf(error, size, "%s: %s at %d Hz", path,
                   file->reason ? strerror(file->reason) : sf_strerror(NULL), rate_hz);
    return false;
  }
  configure(file->sound, kind);
  file->bytes_left = kind->format == SF_FORMAT_WAV ? MAX_WAV_BYTES : UINT64_MAX;
  file->bytes_per_frame = (bits ? bits : 32) / 8 * 2;
  return true;
}

SoundFile*
soundfile_new(const char* path, int rate_hz, unsigned bits, char* error, size_t error_size) {
  const char* const refusal = soundfile_refuse(path, bits);
  if (refusal) {
    (void)snprintf(error, error_size, "%s: %s", path, refusal);
    return NULL;
  }
  SoundFile* const file = calloc(1, sizeof(SoundFile));
  if (!file) {
    (void)snprintf(error, error_size, "%s: out of memory", path);
    return NULL;
  }
  if (!outfile_open(&file->file, path, error, error_size)) {
    free(file);
    return NULL;
  }
  if (!open_sound(file, path, rate_hz, bits, error, error_size)) {
    soundfile_free(file);
    return NULL;
  }
  return file;
}

bool soundfile_clips(const char* path, unsigned bits) {
  const Kind* const kind = find_kind(path);
  bits = bits || !kind ? bits : kind->usual_bits;
  return bits == 16 || bits == 24;
}

bool soundfile_has_room(const SoundFile* file, uint64_t n_frames) {
  return n_frames <= file->bytes_left / file->bytes_per_frame;
}

const char* soundfile_error(const SoundFile* file) {
  return file->reason ? strerror(file->reason) : sf_strerror(file->sound);
}

bool soundfile_write(SoundFile* file, const float* frames, uint32_t n_frames) {
  if (!soundfile_has_room(file, n_frames)) {
    file->reason = EFBIG;
    return false;
  }
  file->bytes_left -= (uint64_t)n_frames * file->bytes_per_frame;
  return sf_writef_float(file->sound, frames, n_frames) == (sf_count_t)n_frames && !file->reason;
}

int soundfile_finish(SoundFile* file) {
  const bool is_closed = !sf_close(file->sound);
  int reason = file->reason || is_closed ? file->reason : EIO;
  if (reason) {
    outfile_drop(&file->file);
  } else {
    reason = outfile_finish(&file->file);
  }
  free(file);
  return reason;
}

void soundfile_free(SoundFile* file) {
  if (file) {
    (void)sf_close(file->sound);
    outfile_drop(&file->file);
    free(file);
  }
}

#define _POSIX_C_SOURCE 200809L

#include "tools/formats/soundfile.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <sndfile.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

static const uint64_t MAX_WAV_BYTES = UINT32_MAX - 4096;

struct SoundFile {
  SNDFILE* sound;
  char* path;
  char* part; /* The temporary name */
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

static const Kind* find_kind(const char* path) {
  const char* const slash = strrchr(path, '/');
  const char* const name = slash ? slash + 1 : path;
  const char* const ending = strrchr(name, '.');
  for (size_t i = 0; ending && ending != name && i < sizeof(kinds) / sizeof(kinds[0]); ++i) {
    if (!strcasecmp(ending, kinds[i].ending)) {
      return &kinds[i];
    }
  }
  return NULL;
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

static char* part_name(const char* path) {
  const size_t size = strlen(path) + 32;
  char* const part = malloc(size);
  if (part) {
    (void)snprintf(part, size, "%s.%ld.part", path, (long)getpid());
  }
  return part;
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

static bool is_directory(const char* path) {
  struct stat status;
  return !stat(path, &status) && S_ISDIR(status.st_mode);
}

/* Open the temporary file, which must be a new one. */
static bool open_part(SoundFile* file, int rate_hz, unsigned bits, char* error, size_t error_size) {
  const Kind* const kind = find_kind(file->path);
  const bool is_place = !is_directory(file->path);
  const int fd = is_place ? open(file->part, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666) : -1;
  if (fd < 0) {
    (void)snprintf(error, error_size, "%s: %s", file->path, strerror(is_place ? errno : EISDIR));
    return false;
  }
  SF_INFO info = {.samplerate = rate_hz, .channels = 2, .format = kind_format(kind, bits)};
  file->sound = sf_open_fd(fd, SFM_WRITE, &info, SF_TRUE);
  if (!file->sound) {
    (void)snprintf(error, error_size, "%s: %s at %d Hz", file->path, sf_strerror(NULL), rate_hz);
    (void)unlink(file->part);
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
  if (file) {
    file->path = strdup(path);
    file->part = part_name(path);
  }
  if (!file || !file->path || !file->part) {
    (void)snprintf(error, error_size, "%s: out of memory", path);
  } else if (open_part(file, rate_hz, bits, error, error_size)) {
    return file;
  }
  soundfile_free(file);
  return NULL;
}

bool soundfile_has_room(const SoundFile* file, uint64_t n_frames) {
  return n_frames <= file->bytes_left / file->bytes_per_frame;
}

bool soundfile_write(SoundFile* file, const float* frames, uint32_t n_frames) {
  if (!soundfile_has_room(file, n_frames)) {
    return false;
  }
  file->bytes_left -= (uint64_t)n_frames * file->bytes_per_frame;
  return sf_writef_float(file->sound, frames, n_frames) == (sf_count_t)n_frames;
}

bool soundfile_finish(SoundFile* file) {
  const bool is_closed = !sf_close(file->sound);
  file->sound = NULL;
  const bool is_done = is_closed && !rename(file->part, file->path);
  if (!is_done) {
    (void)unlink(file->part);
  }
  soundfile_free(file);
  return is_done;
}

void soundfile_free(SoundFile* file) {
  if (!file) {
    return;
  }
  if (file->sound) {
    (void)sf_close(file->sound);
    (void)unlink(file->part);
  }
  free(file->path);
  free(file->part);
  free(file);
}

#include "tests/support/mpe_files.h"

#include "tests/support/scale_host.h"
#include "tools/formats/smf.h"

#include <sndfile.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

enum { PATH_SIZE = 4096 };

static void find(char path[PATH_SIZE], const char* name) {
  const char* const source = getenv("HOOKE_SOURCE");
  assert_non_null(source);
  assert_true(snprintf(path, PATH_SIZE, "%s/tests/mpe/%s.mid", source, name) < PATH_SIZE);
}

Host* mpe_open(void) {
  Host* const host = strings_open(MPE_RATE, MPE_BLOCK);
  strings_set_plain(host);
  return host;
}

static void queue(Host* host, const Smf* file) {
  for (size_t i = 0; i < file->n_events; ++i) {
    const SmfEvent* const event = &file->events[i];
    const uint32_t frame = (uint32_t)lround(event->time_s * MPE_RATE);
    assert_true(host_midi(host, frame, event->bytes, event->size));
  }
}

Sound mpe_play(Host* host, const char* name, double seconds, uint32_t block) {
  char path[PATH_SIZE];
  char error[1024] = "";
  find(path, name);
  Smf* const file = smf_new(path, error, sizeof(error));
  if (!file) {
    fail_msg("%s", error);
  }
  Sound sound = sound_new((size_t)(seconds * MPE_RATE));
  strings_restart(host);
  queue(host, file);
  smf_free(file);
  strings_run(host, &sound, 0, sound.n_frames, block);
  return sound;
}

static Sound read_wav(const char* path) {
  SF_INFO info = {0};
  SNDFILE* const file = sf_open(path, SFM_READ, &info);
  assert_non_null(file);
  assert_int_equal(info.channels, 2);
  Sound sound = sound_new((size_t)info.frames);
  for (size_t i = 0; i < sound.n_frames; ++i) {
    float frame[2];
    assert_int_equal(sf_readf_float(file, frame, 1), 1);
    sound.left[i] = frame[0];
    sound.right[i] = frame[1];
  }
  sf_close(file);
  return sound;
}

Sound mpe_render(const char* name) {
  char wav[2 * PATH_SIZE];
  char command[4 * PATH_SIZE];
  const ScalePath directory = scale_new_directory();
  (void)snprintf(wav, sizeof(wav), "%s/song.wav", directory.text);
  const int n =
      snprintf(command, sizeof(command),
               "\"$HOOKE_BIN\" render --quiet --rate %d --tail 1 --set spread=0 --set sense=0 "
               "--set pickup=0.45 --set pluck=0.4 \"$HOOKE_SOURCE/tests/mpe/%s.mid\" '%s'",
               MPE_RATE, name, wav);
  assert_true(n > 0 && (size_t)n < sizeof(command));
  assert_int_equal(system(command), 0);
  const Sound sound = read_wav(wav);
  scale_remove_directory(&directory);
  return sound;
}

ToneError mpe_measure(const Sound* sound, double from_s, double to_s, Tone asked) {
  const double settled_s = from_s + 0.005 + 2.0 / asked.f0_hz;
  return strings_measure(sound, MPE_RATE, (size_t)lround(settled_s * MPE_RATE),
                         (size_t)lround(to_s * MPE_RATE), asked);
}

#include "tests/support/strings_host.h"

#include "tests/support/host_inside.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const double MOST_CENTS = 0.005;
static const double MOST_DECAY_ERROR = 2e-4;

static int bend_value(double bend) {
  const double value = round(8192.0 + bend / 2.0 * 8192.0);
  return (int)fmin(fmax(value, 0.0), 16383.0);
}

Sound sound_new(size_t n_frames) {
  const Sound sound = {
      .left = calloc(n_frames + 1, sizeof(float)),
      .right = calloc(n_frames + 1, sizeof(float)),
      .n_frames = n_frames,
  };
  assert_non_null(sound.left);
  assert_non_null(sound.right);
  return sound;
}

void sound_free(Sound* sound) {
  free(sound->left);
  free(sound->right);
  *sound = (Sound){0};
}

bool sound_is_same(const Sound* a, const Sound* b) {
  const size_t size = a->n_frames * sizeof(float);
  return a->n_frames == b->n_frames && !memcmp(a->left, b->left, size) &&
         !memcmp(a->right, b->right, size);
}

double sound_distance(const Sound* a, const Sound* b) {
  double ab = 0.0;
  double aa = 0.0;
  double bb = 0.0;
  for (size_t i = 0; i < a->n_frames; ++i) {
    ab += (double)a->left[i] * (double)b->left[i];
    aa += (double)a->left[i] * (double)a->left[i];
    bb += (double)b->left[i] * (double)b->left[i];
  }
  return 1.0 - ab / sqrt(aa * bb);
}

Host* strings_open(double rate_hz, uint32_t max_block) {
  char error[256] = "";
  Host* const host = host_new(STRINGS_URI, rate_hz, max_block, error, sizeof(error));
  if (!host) {
    fail_msg("%s", error);
  }
  return host;
}

void strings_set(Host* host, const char* symbol, double value) {
  if (!host_set(host, symbol, (float)value)) {
    fail_msg("%s", host_error(host));
  }
}

void strings_set_plain(Host* host) {
  strings_set(host, "spread", 0.0);
  strings_set(host, "sense", 0.0);
  strings_set(host, "pickup", 0.45);
  strings_set(host, "pluck", 0.4);
}

void strings_restart(Host* host) {
  host_deactivate(host);
  host_activate(host);
}

void strings_midi(Host* host, size_t frame, unsigned status, unsigned data1, unsigned data2) {
  const uint8_t bytes[3] = {(uint8_t)status, (uint8_t)data1, (uint8_t)data2};
  const bool has_one = (status & 0xF0) == 0xC0 || (status & 0xF0) == 0xD0;
  assert_true(host_midi(host, (uint32_t)frame, bytes, has_one ? 2 : 3));
}

void strings_note_on(Host* host, size_t frame, uint32_t key, uint32_t velocity) {
  strings_midi(host, frame, 0x90, key, velocity);
}

void strings_note_off(Host* host, size_t frame, uint32_t key) {
  strings_midi(host, frame, 0x80, key, 64);
}

void strings_controller(Host* host, size_t frame, uint32_t controller, uint32_t value) {
  strings_midi(host, frame, 0xB0, controller, value);
}

void strings_bend(Host* host, size_t frame, double bend) {
  const int value = bend_value(bend);
  strings_midi(host, frame, 0xE0, (unsigned)value & 0x7F, (unsigned)value >> 7);
}

double strings_bend_made(double bend) {
  return (bend_value(bend) - 8192) / 8192.0 * 2.0;
}

void strings_run(Host* host, Sound* sound, size_t from, size_t to, uint32_t block) {
  assert_true(to <= sound->n_frames);
  for (size_t at = from; at < to;) {
    const size_t n = to - at < block ? to - at : block;
    if (!host_run(host, (uint32_t)n)) {
      fail_msg("%s", host_error(host));
    }
    memcpy(sound->left + at, host_output(host, 0), n * sizeof(float));
    memcpy(sound->right + at, host_output(host, 1), n * sizeof(float));
    at += n;
  }
}

Tone strings_tone(const Host* host, uint32_t key, double bend) {
  const double octaves = ((double)key - 69.0) / 12.0;
  const double damping = (double)host_get(host, "damping");
  const double tracking = (double)host_get(host, "tracking");
  return (Tone){
      .f0_hz = (double)host_get(host, "tuning") * exp2(octaves + bend / 12.0),
      .tau_s = 1.0 / (damping * exp2(tracking * octaves)),
  };
}

Tone strings_released_tone(const Host* host, uint32_t key, double bend) {
  Tone tone = strings_tone(host, key, bend);
  const double tracking = (double)host_get(host, "release_tracking");
  const double release_s = (double)host_get(host, "release");
  const double tracked_s = release_s * exp2(-tracking * ((double)key - 69.0) / 12.0);
  tone.tau_s = fmin(tone.tau_s, fmax(tracked_s, fmin(release_s, 0.005)));
  return tone;
}

ToneError strings_measure(const Sound* sound, double rate_hz, size_t from, size_t to, Tone asked) {
  Tone heard = {0};
  assert_true(from < to && to <= sound->n_frames);
  if (!measure_tone(sound->left + from, to - from, rate_hz, asked, &heard)) {
    return (ToneError){HUGE_VAL, HUGE_VAL};
  }
  return (ToneError){
      .cents = fabs(measure_cents(heard.f0_hz, asked.f0_hz)),
      .decay = fabs(heard.tau_s / asked.tau_s - 1.0),
  };
}

ToneError strings_worse(ToneError a, ToneError b) {
  return (ToneError){fmax(a.cents, b.cents), fmax(a.decay, b.decay)};
}

void strings_assert_exact(const char* what, ToneError error) {
  print_message("%s\n", what);
  assert_within("  pitch [cents]", error.cents, MOST_CENTS);
  assert_within("  decay", error.decay, MOST_DECAY_ERROR);
}

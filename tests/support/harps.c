#include "tests/support/harps.h"

#include "tests/support/settings.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

const char* harps_exciter(Exciter exciter) {
  static const char* const names[] = {"pluck", "strike", "bow"};
  return names[exciter];
}

const char* harps_pickup_type(PickupType sense) {
  static const char* const names[] = {"displacement", "velocity", "force"};
  return names[sense];
}

HarpPatch harps_patch(uint32_t way) {
  const Setting setting = settings_default();
  HarpPatch patch = settings_patch(&setting);
  patch.exciter = (Exciter)(way / HARPS_N_SENSES);
  patch.pickup_type = (PickupType)(way % HARPS_N_SENSES);
  return patch;
}

Harp* harps_new(double rate_hz, const HarpPatch* patch) {
  Harp* const harp = harp_new(rate_hz);
  assert_non_null(harp);
  harp_set_patch(harp, patch, 0);
  return harp;
}

void harps_restart(Harp* harp, const HarpPatch* patch) {
  harp_reset(harp);
  harp_set_patch(harp, patch, 0);
}

void harps_run(Harp* harp, size_t n_frames, float* left, float* right) {
  enum { MOST = 4096 };
  float out[2][MOST];
  for (size_t done = 0; done < n_frames;) {
    const size_t n = n_frames - done < MOST ? n_frames - done : MOST;
    harp_run(harp, (uint32_t)n, left ? left + done : out[0], right ? right + done : out[1]);
    done += n;
  }
}

double harps_largest_step(const float* samples, size_t n) {
  double largest = 0.0;
  for (size_t i = 0; i < n; ++i) {
    largest = fmax(largest, fabs((double)samples[i] - (double)samples[(ptrdiff_t)i - 1]));
  }
  return largest;
}

Tone harps_tone(const HarpPatch* patch, uint32_t key, double bend_semitones) {
  const double octaves = ((double)key - 69.0) / 12.0;
  return (Tone){
      .f0_hz = patch->string.tuning_hz * exp2(octaves + bend_semitones / 12.0),
      .tau_s = 1.0 / (patch->string.damping_per_s * exp2(patch->string.tracking * octaves)),
  };
}

HarpPatch harps_touched_patch(uint32_t way) {
  HarpPatch patch = harps_patch(way);
  patch.vibrato_hz = 5.0;
  patch.spread = 0.0;
  return patch;
}

Tone harps_string_tone(const HarpString* string) {
  assert_true(string->voice.is_awake && string->voice.chain.n_gliding == 0);
  return pole_tone(string->voice.rate_hz,
                   tuning_mode(string->voice.chain.now, string->voice.chain.n_masses, 1));
}

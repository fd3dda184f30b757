/** Somebody who plays for hours: chords, tunes, pedals, wheels, programs, presets and controls that
 * move, in blocks of any size, all of it again from the same seed.  What cannot be done here fails
 * the test. */
#ifndef HOOKE_TESTS_SUPPORT_SOAK_H
#define HOOKE_TESTS_SUPPORT_SOAK_H

#include "tests/support/random.h"
#include "tests/support/strings_host.h"

enum { SOAK_RATE = 48000, SOAK_BLOCK = 2048, SOAK_MOST_HOSTS = 2, SOAK_KEYS = 128 };

/** One player before one or two instances of a plugin, which get the same to the frame. */
typedef struct {
  Host* hosts[SOAK_MOST_HOSTS];   /**< The second may be NULL */
  double cost_s[SOAK_MOST_HOSTS]; /**< Processor time that the runs of a host took [s] */
  double sound_energy;            /**< Sum of the squares of the first host's left side */
  double unlike_energy;           /**< The same of the difference to the second host */
  double peak;                    /**< The largest sample of all hosts so far */
  uint64_t n_notes;

  Random random;
  uint32_t lowest_key;
  uint32_t n_keys;
  uint32_t n_channels;
  uint64_t n_runs; /**< Of two hosts */
  uint64_t now;    /**< The frames so far */
  uint64_t next_note;
  uint64_t up_at[SOAK_KEYS]; /**< The frame on which a key goes up; 0: it is up */
  uint8_t channel_of[SOAK_KEYS];
  uint32_t moving_port; /**< It goes to `aim` by and by; UINT32_MAX: none does */
  double aim;
} Soak;

/** A player of `plugin_uri` with one host, its presets read and each loaded once. */
Soak soak_start(const char* plugin_uri);

/** Another host of the plugin, its presets loaded once too. */
Host* soak_open(const char* plugin_uri);

/** Bring all to where every minute begins: silence, controllers at rest, the controls at their
 * defaults. */
void soak_sit_down(Soak* soak);

/** Play for `seconds` from `seed`, let go of keys and pedals, and fail unless every string comes to
 * rest of itself within two seconds more. */
void soak_play(Soak* soak, uint64_t seed, double seconds);

/** After soak_play(), all sound off while keys and the pedal are down: fail unless there are exact
 * zeros a second later, and again two seconds after a key that is struck and let go: no pedal holds
 * it. */
void soak_silence(Soak* soak);

void soak_stop(Soak* soak);

#endif

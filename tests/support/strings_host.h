/** Hooke Strings in a host, for the tests that play it.  What cannot be done here fails the test.
 */
#ifndef HOOKE_TESTS_SUPPORT_STRINGS_HOST_H
#define HOOKE_TESTS_SUPPORT_STRINGS_HOST_H

#include "core/string/pole.h"
#include "tools/host/host.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define STRINGS_URI "urn:hooke:strings"

enum { STRINGS_PEDAL = 64, STRINGS_SOUND_OFF = 120, STRINGS_RESET = 121, STRINGS_NOTES_OFF = 123 };

/** What was heard. */
typedef struct {
  float* left;
  float* right;
  size_t n_frames;
} Sound;

/** A sound of `n_frames` zeros, for sound_free(). */
Sound sound_new(size_t n_frames);

void sound_free(Sound* sound);

/** Whether two sounds are the same, bit by bit, on both sides. */
bool sound_is_same(const Sound* a, const Sound* b);

/** How unlike the left sides of two sounds of one length are, at any loudness: 1 − their
 * correlation, so 2 for opposites. */
double sound_distance(const Sound* a, const Sound* b);

/** The plugin at its defaults, for host_free(). */
Host* strings_open(double rate_hz, uint32_t max_block);

/** Set a port, in range or not. */
void strings_set(Host* host, const char* symbol, double value);

/** Both pickups in one place, and plucks near the middle: the fundamental is easily measured. */
void strings_set_plain(Host* host);

/** Bring the instrument to rest. */
void strings_restart(Host* host);

/* Messages, on their frame from the start of the next run; they may lie many runs ahead. */

/** A program change or a channel's pressure has no `data2`. */
void strings_midi(Host* host, size_t frame, unsigned status, unsigned data1, unsigned data2);
void strings_note_on(Host* host, size_t frame, uint32_t key, uint32_t velocity);
void strings_note_off(Host* host, size_t frame, uint32_t key);
void strings_controller(Host* host, size_t frame, uint32_t controller, uint32_t value);

/** @param bend  In semitones, −2 to 2; the nearest of the 16384 that there are. */
void strings_bend(Host* host, size_t frame, double bend);

/** The bend that strings_bend() really makes. */
double strings_bend_made(double bend);

/** Run from frame `from` to frame `to` of the sound in blocks of `block`. */
void strings_run(Host* host, Sound* sound, size_t from, size_t to, uint32_t block);

/** What a key is to sound like as the ports now are: the formulas of the manual. */
Tone strings_tone(const Host* host, uint32_t key, double bend);

/** The same with the key up. */
Tone strings_released_tone(const Host* host, uint32_t key, double bend);

/** The errors of a tone that was heard. */
typedef struct {
  double cents;
  double decay; /**< As a fraction */
} ToneError;

/** Measure a stretch of the left side against what was asked; infinite if it cannot be measured. */
ToneError strings_measure(const Sound* sound, double rate_hz, size_t from, size_t to, Tone asked);

/** The worse of both errors, each. */
ToneError strings_worse(ToneError a, ToneError b);

/** Print the error beside what the instrument promises, 0.005 cents and 0.02 % of the decay; fail
 * if it is more. */
void strings_assert_exact(const char* what, ToneError error);

#endif

/**
   One string of the guitar: where it is stopped and bent, what touches it, and how it is read.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_GUITAR_GUITAR_STRING_H
#define HOOKE_CORE_GUITAR_GUITAR_STRING_H

#include "core/guitar/guitar_patch.h"
#include "core/voice/onset.h"
#include "core/voice/voice.h"

#include <stdbool.h>
#include <stdint.h>

/** Damping that a palm of weight w adds is GUITAR_PALM_PER_S w² [1/s], and GUITAR_PALM_LOSS the
 * share of it that sits between the masses. */
#define GUITAR_PALM_PER_S 40.0
#define GUITAR_PALM_LOSS 0.02

/** Fraction of the sounding length, from the bridge, beyond which nothing is plucked or read: the
 * finger that stops the string is near. */
#define GUITAR_FARTHEST 0.9

enum { GUITAR_MIX_FRAMES = 256 /**< Frames that are mixed at a time */ };

/** Gains of the pickups over at most GUITAR_MIX_FRAMES frames. */
typedef struct {
  bool is_read[GUITAR_PICKUPS]; /**< false: its gain is 0 in all of them */
  float gain[GUITAR_PICKUPS][GUITAR_MIX_FRAMES];
} GuitarGains;

/** What damps a string. */
typedef enum {
  GUITAR_RINGING, /**< Nothing but the palm */
  GUITAR_DAMPED,  /**< A finger: it dies with the patch's release */
  GUITAR_CHOKED   /**< A hand: it is gone in a moment */
} GuitarDamper;

/** Zero is one that is asleep and has no memory. */
typedef struct {
  Voice voice;              /**< It slides to the fret where it is stopped, from the capo */
  const GuitarPatch* patch; /**< The guitar's */
  Pickups pickups;
  Line weight;     /**< Of what magnets hear, so that it is as loud at every pitch */
  Onset onset;     /**< What hides from the body that the string was pulled aside */
  Pole onset_pole; /**< The mass of that */
  GuitarDamper damper;
  double open;       /**< MIDI note of the open string */
  double detuning;   /**< Of the string at the capo, against equal temperament [semitones] */
  double fret;       /**< Where it was last put, from the capo, as a number of keys */
  uint32_t channel;  /**< Whose pitches its frets have */
  uint32_t n_fade;   /**< Frames that the next fade of the pickups takes */
  uint32_t n_open;   /**< Masses of the open string that it was strung as */
  uint32_t n_damped; /**< Frames until what damps it lifts; 0: it does not lift by itself */
} GuitarString;

/** Lay a string at rest over `memory`, chain_size(GUITAR_MAX_MASSES) bytes.
 * @param patch  The caller's */
void guitar_string_init(
    GuitarString* string, const GuitarPatch* patch, double rate_hz, uint32_t phase, void* memory);

/** Silence it at once; open, unbent, untouched. */
void guitar_string_reset(GuitarString* string);

/** Masses of a string that has `n_open` when it is open and is stopped `frets` ≥ 0 from the nut:
 * the nearest, M + 1 = round((N + 1) 2^(−frets/12)), at least 1. */
uint32_t guitar_string_masses(uint32_t n_open, double frets);

/** A place on the open string, as a fraction of what sounds, at most GUITAR_FARTHEST. */
double guitar_string_place(const GuitarString* string, double place);

/** The fret where it is stopped, or is being slid to. */
double guitar_string_fretted(const GuitarString* string);

/** Bring what rings to the patch in `n_glide` frames, and no faster than by a gesture. */
void guitar_string_follow(GuitarString* string, uint32_t n_glide);

/** Go to a fret in `n_frames`; a string that is asleep is there at once if that is a gesture. */
void guitar_string_slide(GuitarString* string, double fret, uint32_t n_frames);

/** Bend in `n_frames`. */
void guitar_string_bend(GuitarString* string, double semitones, uint32_t n_frames);

/** Swing about the pitch: `depth` [semitones], `rate` [cycles per frame]. */
void guitar_string_vibrato(GuitarString* string, double depth, double rate);

/**
   Before it is plucked again: leave its motion to `tail`, where a plectrum that stops a string
   chokes it, and be at rest, at the fret that it was going to in a gesture.  A string that is
   asleep stays as it is, and so does one whose last tail has not died away to a hundredth yet.

   @param tail  Of the same kind, used for nothing else
*/
void guitar_string_leave(GuitarString* string, GuitarString* tail);

/** Pull it and let it go, whatever damps it; `pluck.place` is a fraction of the sounding length.
 * What it pulls the body by follows in a millisecond or two, see core/voice/onset.h. */
void guitar_string_pluck(GuitarString* string, Pluck pluck);

/** Let it be damped for `n_frames`; 0: until it is plucked, or damped otherwise.  What is choked
 * stays so until it is plucked or rings by order. */
void guitar_string_damp(GuitarString* string, GuitarDamper damper, uint32_t n_frames);

/** Touch it for `n_frames`; `place` is a fraction of the sounding length. */
void guitar_string_touch(GuitarString* string, double place, uint32_t n_frames);

/** Lift what touches it, in a gesture. */
void guitar_string_untouch(GuitarString* string);

/** Silence it if it holds what is not a number, see voice_mend(). */
void guitar_string_mend(GuitarString* string);

/** Whether anything is read of it, by pickups or the body. */
bool guitar_string_is_heard(const GuitarString* string);

/**
   Run it for `n_frames`, at most GUITAR_MIX_FRAMES.

   @param out   What the pickups read is added to it: velocities, weighed such that the fundamental
   is as large as in the displacement
   @param pull  What it pulls at the bridge by is added to it; NULL: there is no body
*/
void guitar_string_run(
    GuitarString* string, const GuitarGains* gains, uint32_t n_frames, float* out, float* pull);

#endif

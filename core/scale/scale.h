/**
   Microtuning: the frequency of every MIDI key, from the text of Scala's scale (.scl) and keyboard
   mapping (.kbm) files.

   A scale gives its degrees 1 to n as intervals above degree 0, which is 1/1 and not in the text.
   Degree n is the period, often an octave, by which the scale goes on up and down:

       interval(d) = interval(d mod n) · period^⌊d / n⌋

   A map gives a degree to every key, and a frequency to one of them.  With the pattern of s entries
   laid from the middle key m on, and the formal octave o, itself a degree,

       degree(key) = entry((key − m) mod s) + o ⌊(key − m) / s⌋,    or key − m if s is 0,

   so that a pattern's copies use notes of the scale even where o is no multiple of n.  Then

       hz(key) = f_ref · (A4 / 440) · interval(degree(key)) / interval(degree(reference key)).

   A reference key that the map leaves out lies halfway, in cents, between the nearest keys below
   and above that have a degree, however far they are.

   The texts.  Lines end with LF, CR LF or CR; one that begins with '!' is a comment.  In a scale
   the first line describes it and may be empty.  After that, and in maps everywhere, empty lines
   are skipped, what stands behind a value is ignored, and so are the lines behind the last one
   needed. The decimal sign is a point in every locale.

   Thread: any but the audio thread; reading takes memory.
*/
#ifndef HOOKE_CORE_SCALE_SCALE_H
#define HOOKE_CORE_SCALE_SCALE_H

#include "core/base/status.h"

#include <stddef.h>
#include <stdint.h>

enum {
  SCALE_KEYS = 128,            /**< Of MIDI */
  SCALE_MAX_BYTES = 1 << 24,   /**< In a text */
  SCALE_MAX_NOTES = 1 << 23,   /**< In a scale: more than a text has room for */
  SCALE_MAX_PATTERN = 1000000, /**< Entries of a map */
  SCALE_MAX_DEGREE = 1000000,  /**< In a map, up and down */
  SCALE_MAX_CENTS = 120000,    /**< Of a pitch, up and down */
  SCALE_UNMAPPED = INT32_MIN,  /**< The degree of a key without one */
  SCALE_FOUND_SIZE = 64,       /**< Room in ScaleError [bytes] */
  SCALE_EXPECTED_SIZE = 96     /**< Room in ScaleError [bytes] */
};

/** Largest number above or below the slash of a ratio. */
#define SCALE_MAX_TERM 1e30

/** What lies outside is no pitch of a key [Hz]. */
#define SCALE_MIN_HZ 1e-3
#define SCALE_MAX_HZ 1e6

/** An interval, 2^(cents / 1200) · over / under. */
typedef struct {
  double cents; /**< 0 for a ratio */
  double over;  /**< > 0; 1 for cents */
  double under; /**< > 0; 1 for cents */
} ScalePitch;

/** A scale; all zeros is one without notes. */
typedef struct {
  uint32_t n_notes;          /**< 0 to SCALE_MAX_NOTES; 0: every degree is 1/1 */
  const ScalePitch* pitches; /**< Of degrees 1 to n_notes, in any order, the period last */
  ScalePitch* memory;        /**< Where they lie, owned; NULL: in no memory of the scale's own */
} Scale;

/** A keyboard mapping. */
typedef struct {
  uint32_t n_entries;     /**< Keys in the pattern; 0: every key is a degree */
  uint32_t first_key;     /**< Keys below are not retuned */
  uint32_t last_key;      /**< Keys above are not retuned */
  uint32_t middle_key;    /**< Where the pattern begins */
  uint32_t reference_key; /**< To have reference_hz; need be neither retuned nor mapped */
  double reference_hz;    /**< SCALE_MIN_HZ to SCALE_MAX_HZ */
  int32_t octave_degree;  /**< Between a pattern and the next; 0: the scale's period */
  int32_t* degrees;       /**< Of each entry, or SCALE_UNMAPPED; owned */
} ScaleMap;

/** What is wrong with a text: "LINE: found FOUND, expected EXPECTED", in printable ASCII. */
typedef struct {
  unsigned line; /**< From 1 */
  char found[SCALE_FOUND_SIZE];
  char expected[SCALE_EXPECTED_SIZE];
} ScaleError;

/** Twelve equal notes to the octave; takes no memory. */
void scale_equal(Scale* scale);

/** Every key a degree, degree 0 at key 60, and 440 Hz at key 69; takes no memory. */
void scale_map_linear(ScaleMap* map);

/** Free what a scale, or a map, has read, and leave it without notes or entries. */
void scale_free(Scale* scale);
void scale_map_free(ScaleMap* map);

/**
   Read the text of a .scl file.

   Pitches are cents if they have a point, and ratios otherwise; cents may be below zero, and
   pitches may come in any order.  A scale of 0 notes has no period: every degree of it is 1/1.

   @param text        Need not end with NUL nor with the end of a line; may begin with a UTF-8 mark
   @param n_bytes     Of `text`
   @param[out] scale  The caller's, to scale_free(); what was in it is not freed.  Untouched on
   failure
   @param[out] error  Written on failure only
   @return STATUS_OK, or STATUS_BAD_TEXT, also if there is no memory for it
*/
Status scale_read(const char* text, size_t n_bytes, Scale* scale, ScaleError* error);

/**
   Read the text of a .kbm file.

   Entries that are missing at the end are unmapped.  Degrees may lie outside the scale, above and
   below.  A pattern that has no degree at all is an error.

   Parameters and failures as for scale_read(), and scale_map_free().
*/
Status scale_map_read(const char* text, size_t n_bytes, ScaleMap* map, ScaleError* error);

/**
   Tune all keys.

   The frequency of a map holds when the instrument's A4 is at 440 Hz, and follows it in proportion:
   the reference key has map->reference_hz · a4_hz / 440.  With scale_map_linear(), key 69 so has
   a4_hz itself.  Keys outside first_key to last_key are not retuned: they keep twelve equal notes
   to the octave from a4_hz at key 69.  With scale_equal() and scale_map_linear() the result is
   a4_hz · exp2((key − 69) / 12) to the last bit.

   @param a4_hz    What the instrument's control says [Hz], > 0
   @param[out] hz  Of every key; NAN for one that is unmapped or comes to lie outside SCALE_MIN_HZ
   to SCALE_MAX_HZ.  True to a few roundings.  Untouched on failure
   @return STATUS_OK, or STATUS_BAD_ARGUMENT if a number is out of its range or no key is mapped
*/
Status scale_tune(const Scale* scale, const ScaleMap* map, double a4_hz, double hz[SCALE_KEYS]);

#endif

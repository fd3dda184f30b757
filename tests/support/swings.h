/** A note of either instrument while something swings: what a player, a host or a file can throw
 * from one end to the other, in time with the string or at random. */
#ifndef HOOKE_TESTS_SUPPORT_SWINGS_H
#define HOOKE_TESTS_SUPPORT_SWINGS_H

#include "tests/support/plugins.h"
#include "tests/support/random.h"
#include "tests/support/strings_host.h"

#include <stdbool.h>
#include <stdint.h>

/** Something that swings; ports between two values, all else between its own ends. */
typedef struct {
  const char* name;
  void (*go)(Host* host, uint32_t key, double to); /**< To an end: -1, 1, or between */
  bool has[N_PLUGINS];                             /**< Whose it is, by plugin */
  bool has_ranges;                                 /**< It is set by how far the wheel goes */
} Swing;

extern const Swing swings[];
extern const uint32_t swings_count;

/** A note, and how something swings meanwhile. */
typedef struct {
  const Swing* swing;
  double rate_hz;
  uint32_t key;
  double seconds;
  double period;   /**< There and back [frames]; 0: it stays at `end` */
  double end;      /**< -1 to 1 */
  double repeat_s; /**< Between notes [s]; 0: one is played */
  Random* random;  /**< NULL: in time; else when and where to is drawn */
} SwingTrial;

/** What was heard of it. */
typedef struct {
  double rms; /**< Of the loudest window of some periods */
  double peak;
} SwingHeard;

/** Set how far the wheel goes [semitones]. */
void swings_set_range(Host* host, uint32_t semitones);

/** Play from silence, and fail the test if what comes out is not finite. */
SwingHeard swings_play(Host* host, const SwingTrial* trial);

#endif

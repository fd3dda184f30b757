/**
   An instrument's presets as MIDI selects them: a bank by controllers 0 and 32, and a program in it
   by program change.  The tables are made from presets/ when Hooke is built.

   Thread: audio; real-time safe.
*/
#ifndef HOOKE_PLUGIN_PROGRAMS_H
#define HOOKE_PLUGIN_PROGRAMS_H

#include "plugin/midi.h"

#include <stdbool.h>
#include <stdint.h>

enum { PROGRAMS_CHANNELS = 16 };

/** The presets, in the order of their banks and of their numbers there. */
typedef struct {
  uint32_t n_ports;      /**< How many ports each sets, and they are the same for all */
  const uint32_t* ports; /**< Their indices, rising */
  uint32_t n_banks;
  const uint32_t* firsts; /**< Where each bank begins, and behind the last where that ends */
  const float* values;    /**< For each preset those of its ports */
} ProgramTable;

extern const ProgramTable strings_programs;
extern const ProgramTable guitar_programs;

/** What is known of banks: 128 · controller 0 + controller 32, each channel's own; all zero is a
 * valid start. */
typedef struct {
  uint32_t banks[PROGRAMS_CHANNELS];
} ProgramChoice;

/** Whether a message is for here: a program change, or a bank. */
bool programs_are_chosen_by(const MidiMessage* message);

/**
   Hear a message; one that chooses a bank is heard from the next program change on.

   @return The values of the preset that it selects, `n_ports` of them; NULL if it selects none, for
   it is something else, or there is no such bank or program
*/
const float*
programs_hear(ProgramChoice* choice, const ProgramTable* table, const MidiMessage* message);

#endif

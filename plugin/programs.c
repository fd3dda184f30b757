#include "plugin/programs.h"

#include <stddef.h>

static void choose_bank(uint32_t* bank, const MidiMessage* message) {
  if (message->number == MIDI_BANK_UPPER) {
    *bank = message->value << 7 | (*bank & 0x7F);
  } else if (message->number == MIDI_BANK_LOWER) {
    *bank = (*bank & ~0x7Fu) | message->value;
  }
}

static const float* find(const ProgramTable* table, uint32_t bank, uint32_t program) {
  if (bank >= table->n_banks || program >= table->firsts[bank + 1] - table->firsts[bank]) {
    return NULL;
  }
  return table->values + (size_t)(table->firsts[bank] + program) * table->n_ports;
}

bool programs_are_chosen_by(const MidiMessage* message) {
  const bool is_bank = message->number == MIDI_BANK_UPPER || message->number == MIDI_BANK_LOWER;
  return message->kind == MIDI_PROGRAM || (message->kind == MIDI_CONTROLLER && is_bank);
}

const float*
programs_hear(ProgramChoice* choice, const ProgramTable* table, const MidiMessage* message) {
  uint32_t* const bank = &choice->banks[message->channel];
  if (message->kind == MIDI_CONTROLLER) {
    choose_bank(bank, message);
  }
  return message->kind == MIDI_PROGRAM ? find(table, *bank, message->number) : NULL;
}

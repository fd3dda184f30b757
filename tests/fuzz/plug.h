/**
   An instrument of the bundle, driven through its own descriptor by a host of a few lines: quicker
   than one that looks for bundles, and its buffers are as large as they have to be and no larger.

   Thread: one.
*/
#ifndef HOOKE_TESTS_FUZZ_PLUG_H
#define HOOKE_TESTS_FUZZ_PLUG_H

#include "plugin/ports.h"

#include <lv2/atom/atom.h>
#include <lv2/core/lv2.h>
#include <lv2/state/state.h>
#include <lv2/urid/urid.h>
#include <lv2/worker/worker.h>

#include <stdbool.h>
#include <stdint.h>

enum { PLUG_FRAMES = 512 /**< Most in a block */, PLUG_MAX_NOTIFY = 8192 /**< [bytes] */ };

/** What is to be known of an instrument. */
typedef struct {
  const LV2_Descriptor* descriptor;
  const PortRange* controls;
  uint32_t n_controls;
  uint32_t meters;  /**< Index of the port `sounding`; `mass_count` and `headroom` follow */
  double most_peak; /**< Of its output, unless many notes are piled up */
} PlugKind;

typedef struct {
  const PlugKind* kind;
  double rate_hz;
  LV2_Handle handle;
  const LV2_State_Interface* state;   /**< NULL: it has none */
  const LV2_Worker_Interface* worker; /**< NULL: it has none */
  LV2_Worker_Schedule schedule;
  bool is_worker_busy; /**< Whether work, and moving a port, is refused */
  float values[PORTS_MAX];
  uint32_t n_room; /**< Of the notify port, behind its atom header [bytes] */
  float* left;     /**< Of the last block */
  float* right;
  double peak;      /**< Since it was activated */
  uint32_t n_notes; /**< Notes that make `peak` larger */
  uint64_t hash;    /**< Of all samples since it was activated */
} Plug;

extern const PlugKind plug_strings;
extern const PlugKind plug_guitar;

/** A small number for a URI, the same one each time. */
LV2_URID plug_urid(const char* uri);

/** The instrument of one kind at one rate, activated, its ports at their defaults and without
    files; there is one, and it lives as long as the program. */
Plug* plug_in(const PlugKind* kind, double rate_hz);

/** As new, and as it was when it was plugged in. */
void plug_reset(Plug* plug);

/** Run a block, at most PLUG_FRAMES; what comes out is finite and bounded, no string is near its
    limit, and what is told is a whole sequence.
    @param control  The control port; NULL: not connected */
void plug_run(Plug* plug, const LV2_Atom_Sequence* control, uint32_t n_frames);

/** Masses that ring. */
double plug_masses(const Plug* plug);

/** Send all sound off to every channel: silence follows, in exact zeros. */
void plug_claim_silence(Plug* plug);

#endif

/**
   What lies over the ports, as state: a text under a name of the instrument's, and nothing if there
   is none.  A state that has nothing takes away what there was.

   Thread: any but the audio thread, one at a time, also while that runs.
*/
#ifndef HOOKE_PLUGIN_OVERLAY_STATE_H
#define HOOKE_PLUGIN_OVERLAY_STATE_H

#include "plugin/overlay.h"
#include "plugin/programs.h"

#include <lv2/state/state.h>
#include <lv2/urid/urid.h>

/** What it is called. */
typedef struct {
  LV2_URID overlay;
  LV2_URID atom_String;
} OverlayUrids;

LV2_State_Status overlay_state_save(Overlay* overlay,
                                    const OverlayUrids* urids,
                                    LV2_State_Store_Function store,
                                    LV2_State_Handle handle);

/** @param programs  Whose ports may have something over them
 * @return LV2_STATE_ERR_BAD_TYPE if something else stands there; it is as if it did not */
LV2_State_Status overlay_state_restore(Overlay* overlay,
                                       const OverlayUrids* urids,
                                       const ProgramTable* programs,
                                       LV2_State_Retrieve_Function retrieve,
                                       LV2_State_Handle handle);

#endif

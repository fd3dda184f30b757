/**
   The files that a player gives an instrument, as state: each a path under its parameter's name,
   empty if there is none.  It may come back as an atom:String, for a host may keep the type of what
   it was given first.

   Files are read by restore() itself, for hosts that restore a session pass no worker; what is
   playing meanwhile goes on.  What a state does not say stays as it is, and a path whose file is
   missing or broken is kept.

   Thread: any but the audio thread, also while that runs.
*/
#ifndef HOOKE_PLUGIN_FILES_STATE_H
#define HOOKE_PLUGIN_FILES_STATE_H

#include "plugin/files.h"

#include <lv2/state/state.h>

/** As LV2_State_Interface has it. */
LV2_State_Status files_state_save(Files* files,
                                  LV2_State_Store_Function store,
                                  LV2_State_Handle handle,
                                  const LV2_Feature* const* features);

/** The same.  @return LV2_STATE_ERR_BAD_TYPE if something else stands there; it is as if it did not
 */
LV2_State_Status files_state_restore(Files* files,
                                     LV2_State_Retrieve_Function retrieve,
                                     LV2_State_Handle handle,
                                     const LV2_Feature* const* features);

#endif

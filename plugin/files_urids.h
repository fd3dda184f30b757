/** Names that a player's files need, as numbers. */
#ifndef HOOKE_PLUGIN_FILES_URIDS_H
#define HOOKE_PLUGIN_FILES_URIDS_H

#include "plugin/files_store.h"

#include <lv2/urid/urid.h>

/** What an instrument calls itself and its parameters. */
typedef struct {
  const char* plugin;
  const char* files[FILES_COUNT]; /**< Each a parameter whose range is atom:Path */
} FilesNames;

typedef struct {
  LV2_URID plugin;
  LV2_URID files[FILES_COUNT];
  LV2_URID atom_Blank, atom_Object, atom_Path, atom_Resource, atom_String, atom_URID;
  LV2_URID log_Error, log_Note;
  LV2_URID patch_Get, patch_Set, patch_property, patch_subject, patch_value;
  LV2_URID state_StateChanged;
} FilesUrids;

FilesUrids files_urids(const LV2_URID_Map* map, const FilesNames* names);

#endif

#include "plugin/files_urids.h"

#include <lv2/atom/atom.h>
#include <lv2/log/log.h>
#include <lv2/patch/patch.h>
#include <lv2/state/state.h>

static LV2_URID urid(const LV2_URID_Map* map, const char* uri) {
  return map->map(map->handle, uri);
}

FilesUrids files_urids(const LV2_URID_Map* map, const FilesNames* names) {
  return (FilesUrids){
      .plugin = urid(map, names->plugin),
      .files = {urid(map, names->files[FILES_SCALE]), urid(map, names->files[FILES_MAPPING]),
                urid(map, names->files[FILES_BODY])},
      .atom_Blank = urid(map, LV2_ATOM__Blank),
      .atom_Object = urid(map, LV2_ATOM__Object),
      .atom_Path = urid(map, LV2_ATOM__Path),
      .atom_Resource = urid(map, LV2_ATOM__Resource),
      .atom_String = urid(map, LV2_ATOM__String),
      .atom_URID = urid(map, LV2_ATOM__URID),
      .log_Error = urid(map, LV2_LOG__Error),
      .log_Note = urid(map, LV2_LOG__Note),
      .patch_Get = urid(map, LV2_PATCH__Get),
      .patch_Set = urid(map, LV2_PATCH__Set),
      .patch_property = urid(map, LV2_PATCH__property),
      .patch_subject = urid(map, LV2_PATCH__subject),
      .patch_value = urid(map, LV2_PATCH__value),
      .state_StateChanged = urid(map, LV2_STATE__StateChanged),
  };
}

/**
   What the host offers a plugin when it is instantiated, and when its state is saved or restored.
*/
#ifndef HOOKE_TOOLS_HOST_HOST_FEATURES_H
#define HOOKE_TOOLS_HOST_HOST_FEATURES_H

#include "tools/host/host_worker.h"
#include "tools/host/urids.h"

#include <lv2/core/lv2.h>
#include <lv2/log/log.h>
#include <lv2/options/options.h>
#include <lv2/urid/urid.h>
#include <lv2/worker/worker.h>
#include <stdbool.h>
#include <stdint.h>

enum { HOST_N_FEATURES = 7, HOST_N_OPTIONS = 5 };

/** The features and what they point at; must not move once initialised. */
typedef struct {
  Urids urids;
  bool is_silent;
  int32_t min_block;
  int32_t max_block;
  float rate_hz;

  LV2_URID_Map map;
  LV2_URID_Unmap unmap;
  LV2_Log_Log log;
  LV2_Worker_Schedule schedule;
  LV2_Options_Option options[HOST_N_OPTIONS]; ///< The last is all zero, as the extension wants

  LV2_Feature features[HOST_N_FEATURES];
  const LV2_Feature* offered[HOST_N_FEATURES + 1]; ///< At instantiate(), NULL-terminated
  const LV2_Feature* preset[4];                    ///< At restore() for a preset: with the worker
  const LV2_Feature* session[3]; ///< At save(), and at restore() for a session: without
} HostFeatures;

/**
   Set every feature up.

   @param features   Zeroed
   @param worker     Where scheduled work goes
   @param rate_hz    Sample rate [Hz], > 0
   @param max_block  Most frames in a run [frames], > 0
   @param is_bare    Offer urid:map alone at instantiate()
   @param is_silent  Drop what the plugin logs
   @return false when memory is out.
*/
bool host_features_init(HostFeatures* features,
                        HostWorker* worker,
                        double rate_hz,
                        uint32_t max_block,
                        bool is_bare,
                        bool is_silent);

/** @return true if a plugin that requires the feature `uri` can be instantiated. */
bool host_features_offer(const HostFeatures* features, const char* uri);

/** Free the URIs. */
void host_features_clear(HostFeatures* features);

#endif

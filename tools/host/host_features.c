#include "tools/host/host_features.h"

#include <lv2/atom/atom.h>
#include <lv2/buf-size/buf-size.h>
#include <lv2/parameters/parameters.h>
#include <lv2/state/state.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static LV2_URID on_map(LV2_URID_Map_Handle handle, const char* uri) {
  return urids_map((Urids*)handle, uri);
}

static const char* on_unmap(LV2_URID_Unmap_Handle handle, LV2_URID urid) {
  return urids_unmap((const Urids*)handle, urid);
}

LV2_LOG_FUNC(3, 0)
static int on_vprintf(LV2_Log_Handle handle, LV2_URID type, const char* format, va_list args) {
  (void)type;
  const HostFeatures* const features = (const HostFeatures*)handle;
  return features->is_silent ? 0 : vfprintf(stderr, format, args);
}

LV2_LOG_FUNC(3, 4)
static int on_printf(LV2_Log_Handle handle, LV2_URID type, const char* format, ...) {
  va_list args;
  va_start(args, format);
  const int n_printed = on_vprintf(handle, type, format, args);
  va_end(args);
  return n_printed;
}

static LV2_Options_Option
option(HostFeatures* features, const char* key, const char* type, const void* value) {
  return (LV2_Options_Option){.context = LV2_OPTIONS_INSTANCE,
                              .key = urids_map(&features->urids, key),
                              .size = 4,
                              .type = urids_map(&features->urids, type),
                              .value = value};
}

static bool init_options(HostFeatures* self, double rate_hz, uint32_t max_block) {
  self->rate_hz = (float)rate_hz;
  self->max_block = max_block < INT32_MAX ? (int32_t)max_block : INT32_MAX;
  const LV2_Options_Option options[HOST_N_OPTIONS - 1] = {
      option(self, LV2_PARAMETERS__sampleRate, LV2_ATOM__Float, &self->rate_hz),
      option(self, LV2_BUF_SIZE__minBlockLength, LV2_ATOM__Int, &self->min_block),
      option(self, LV2_BUF_SIZE__maxBlockLength, LV2_ATOM__Int, &self->max_block),
      option(self, LV2_BUF_SIZE__nominalBlockLength, LV2_ATOM__Int, &self->max_block)};
  memcpy(self->options, options, sizeof(options));
  for (unsigned i = 0; i < HOST_N_OPTIONS - 1; ++i) {
    if (!options[i].key || !options[i].type) {
      return false;
    }
  }
  return true;
}

/* The order is a contract within this file: the first two go to every call, the third to presets
 * too. */
static void init_list(HostFeatures* self, bool is_bare) {
  const LV2_Feature features[HOST_N_FEATURES] = {{LV2_URID__map, &self->map},
                                                 {LV2_STATE__threadSafeRestore, NULL},
                                                 {LV2_WORKER__schedule, &self->schedule},
                                                 {LV2_URID__unmap, &self->unmap},
                                                 {LV2_LOG__log, &self->log},
                                                 {LV2_OPTIONS__options, self->options},
                                                 {LV2_BUF_SIZE__boundedBlockLength, NULL}};
  memcpy(self->features, features, sizeof(features));
  for (unsigned i = 0; i < (is_bare ? 1 : HOST_N_FEATURES); ++i) {
    self->offered[i] = &self->features[i];
  }
  for (unsigned i = 0; i < 3; ++i) {
    self->preset[i] = &self->features[i];
  }
  for (unsigned i = 0; i < 2; ++i) {
    self->session[i] = &self->features[i];
  }
}

bool host_features_init(HostFeatures* features,
                        HostWorker* worker,
                        double rate_hz,
                        uint32_t max_block,
                        bool is_bare,
                        bool is_silent) {
  features->is_silent = is_silent;
  features->map = (LV2_URID_Map){&features->urids, on_map};
  features->unmap = (LV2_URID_Unmap){&features->urids, on_unmap};
  features->log = (LV2_Log_Log){features, on_printf, on_vprintf};
  features->schedule = (LV2_Worker_Schedule){worker, host_worker_schedule};
  init_list(features, is_bare);
  return init_options(features, rate_hz, max_block);
}

bool host_features_offer(const HostFeatures* features, const char* uri) {
  for (unsigned i = 0; features->offered[i]; ++i) {
    if (!strcmp(features->offered[i]->URI, uri)) {
      return true;
    }
  }
  return !strcmp(uri, LV2_CORE__isLive);
}

void host_features_clear(HostFeatures* features) {
  urids_clear(&features->urids);
}

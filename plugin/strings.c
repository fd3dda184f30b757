/* Hooke Strings, the LV2 plugin: a harp behind ports and MIDI, and no physics. */
#include "core/harp/harp.h"
#include "core/harp/harp_performance.h"
#include "plugin/bundle.h"
#include "plugin/instrument.h"
#include "plugin/strings_ports.h"

#include <stddef.h>

#define STRINGS_URI "urn:hooke:strings"

static void* new_harp(double rate_hz) {
  return harp_new(rate_hz);
}

static void free_harp(void* harp) {
  harp_free(harp);
}

static void reset(void* harp) {
  harp_reset(harp);
}

static void set(void* harp, const Controls* controls, uint32_t n_frames) {
  const HarpPatch patch = strings_ports_patch(controls);
  harp_set_patch(harp, &patch, n_frames);
}

static void set_body(void* harp, const Body* body) {
  harp_set_body(harp, body);
}

static Performance perform(void* harp) {
  return harp_performance(harp);
}

static void run(void* harp, uint32_t n_frames, float* left, float* right) {
  harp_run(harp, n_frames, left, right);
}

static VoiceReport report(const void* harp) {
  return harp_report(harp);
}

static const InstrumentKind kind = {
    .n_ports = STRINGS_N_PORTS,
    .meters = STRINGS_PORT_SOUNDING,
    .stability_used = STRINGS_PORT_STABILITY_USED,
    .limiter = STRINGS_PORT_LIMITER,
    .new = new_harp,
    .free = free_harp,
    .reset = reset,
    .read = strings_ports_read,
    .set = set,
    .set_body = set_body,
    .perform = perform,
    .run = run,
    .report = report,
    .files = {STRINGS_URI, {STRINGS_URI "#scale", STRINGS_URI "#mapping", STRINGS_URI "#body"}},
};

static LV2_Handle instantiate(const LV2_Descriptor* descriptor,
                              double rate,
                              const char* bundle_path,
                              const LV2_Feature* const* features) {
  (void)descriptor;
  (void)bundle_path;
  return instrument_new(&kind, rate, features);
}

const LV2_Descriptor strings_descriptor = {
    .URI = STRINGS_URI,
    .instantiate = instantiate,
    .connect_port = instrument_connect_port,
    .activate = instrument_activate,
    .run = instrument_run,
    .cleanup = instrument_cleanup,
    .extension_data = instrument_extension,
};

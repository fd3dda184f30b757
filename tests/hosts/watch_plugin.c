/* The way into each plugin of a host that finds them with lilv: what it does there is watched, and
 * told when the plugin is freed, a line a plugin, in the file that HOOKE_WATCH_LOG names. */
#define _GNU_SOURCE

#include "tests/hosts/watch.h"

#include <lilv/lilv.h>
#include <lv2/atom/util.h>
#include <lv2/worker/worker.h>

#include <dlfcn.h>
#include <math.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

enum { MOST_FEATURES = 64, CONTROL = 0, FIRST_OUTPUT = 2, N_OUTPUTS = 2 };

/* The bits by which small numbers count as zero. */
enum { FLUSH_BITS = 0x8040 };

typedef struct {
  LV2_Handle handle;
  const LV2_Descriptor* real;
  LV2_Descriptor shown;
  const LV2_Worker_Schedule* host; /* Its worker */
  LV2_Worker_Schedule schedule;    /* The one that is shown */
  LV2_Feature feature;
  const LV2_Atom_Sequence* control;
  const float* outputs[N_OUTPUTS];
  unsigned long n_runs;
  unsigned long n_empty;
  unsigned long n_works;
  unsigned long n_silent; /* Frames since the last that was not 0 */
  uint32_t longest;
  unsigned long n_notes;
  int64_t place; /* Of the first note in its run [frames] */
  double peak;
} Plugin;

static Plugin plugins[WATCH_PLUGINS];
static atomic_int n_plugins;

static Plugin* find(LV2_Handle handle) {
  int i = WATCH_PLUGINS - 1;
  while (i > 0 && plugins[i].handle != handle) {
    --i;
  }
  return &plugins[i];
}

static int number_of(const Plugin* self) {
  return (int)(self - plugins);
}

static unsigned flushing(void) {
#if defined(__x86_64__)
  return _mm_getcsr() & FLUSH_BITS;
#else
  return 0;
#endif
}

/* What one plugin leaves changed would reach the others. */
static void restore_flushing(unsigned bits) {
#if defined(__x86_64__)
  _mm_setcsr((_mm_getcsr() & ~(unsigned)FLUSH_BITS) | bits);
#else
  (void)bits;
#endif
}

static void listen(Plugin* self, uint32_t n_frames) {
  for (uint32_t i = 0; i < n_frames; ++i) {
    ++self->n_silent;
    for (int k = 0; k < N_OUTPUTS; ++k) {
      const double sample = self->outputs[k] ? fabs((double)self->outputs[k][i]) : 0.0;
      self->n_silent = sample > 0.0 ? 0 : self->n_silent;
      self->peak = sample <= self->peak ? self->peak : sample; /* A NaN stays */
    }
  }
}

static void count_notes(Plugin* self) {
  if (!self->control) {
    return;
  }
  LV2_ATOM_SEQUENCE_FOREACH(self->control, event) {
    const uint8_t* const bytes = (const uint8_t*)(event + 1);
    if (event->body.size == 3 && (bytes[0] & 0xF0) == 0x90 && bytes[2] > 0) {
      self->place = self->n_notes ? self->place : event->time.frames;
      ++self->n_notes;
    }
  }
}

static void run(LV2_Handle handle, uint32_t n_frames) {
  Plugin* const self = find(handle);
  const unsigned before = flushing();
  count_notes(self);
  watch_enter(number_of(self));
  self->real->run(handle, n_frames);
  if (flushing() != before) {
    watch_fault(WATCH_FLOATS, "run");
    restore_flushing(before);
  }
  watch_leave();
  ++self->n_runs;
  self->n_empty += n_frames == 0;
  self->longest = n_frames > self->longest ? n_frames : self->longest;
  listen(self, n_frames);
}

static void connect_port(LV2_Handle handle, uint32_t port, void* data) {
  Plugin* const self = find(handle);
  if (port == CONTROL) {
    self->control = data;
  }
  if (port >= FIRST_OUTPUT && port < FIRST_OUTPUT + N_OUTPUTS) {
    self->outputs[port - FIRST_OUTPUT] = data;
  }
  watch_enter(number_of(self));
  self->real->connect_port(handle, port, data);
  watch_leave();
}

/* Ardour calls these two on its audio thread. */
static void activate(LV2_Handle handle) {
  Plugin* const self = find(handle);
  watch_enter(number_of(self));
  self->real->activate(handle);
  watch_leave();
}

static void deactivate(LV2_Handle handle) {
  Plugin* const self = find(handle);
  watch_enter(number_of(self));
  self->real->deactivate(handle);
  watch_leave();
}

static void tell(const Plugin* self) {
  static const char* const names[] = {"heap", "lock", "system", "floats"};
  const char* const path = getenv("HOOKE_WATCH_LOG");
  FILE* const log = path ? fopen(path, "a") : NULL;
  if (!log) {
    return;
  }
  (void)fprintf(log,
                "%s runs=%lu empty=%lu longest=%u works=%lu notes=%lu place=%ld peak=%g silent=%lu",
                self->real->URI, self->n_runs, self->n_empty, self->longest, self->n_works,
                self->n_notes, (long)self->place, self->peak, self->n_silent);
  for (WatchKind kind = 0; kind < WATCH_KINDS; ++kind) {
    (void)fprintf(log, " %s=%lu", names[kind], watch_count(number_of(self), kind));
  }
  for (WatchKind kind = 0; kind < WATCH_KINDS; ++kind) {
    (void)fprintf(log, " %s", watch_first(number_of(self), kind));
  }
  (void)fprintf(log, "%s\n", watch_sees_system() ? "" : " blind");
  (void)fclose(log);
}

static void cleanup(LV2_Handle handle) {
  Plugin* const self = find(handle);
  tell(self);
  self->real->cleanup(handle);
  self->handle = NULL;
}

/* What the host does when it is asked for work is its own affair, and may be the work itself. */
static LV2_Worker_Status
schedule(LV2_Worker_Schedule_Handle handle, uint32_t size, const void* data) {
  Plugin* const self = handle;
  watch_leave();
  ++self->n_works;
  const LV2_Worker_Status status = self->host->schedule_work(self->host->handle, size, data);
  watch_enter(number_of(self));
  return status;
}

/* The host's features, but for its worker. */
static void
show_features(Plugin* self, const LV2_Feature* const* features, const LV2_Feature* shown[]) {
  int n = 0;
  for (; features && features[n] && n < MOST_FEATURES; ++n) {
    shown[n] = features[n];
    if (!strcmp(features[n]->URI, LV2_WORKER__schedule)) {
      self->host = features[n]->data;
      self->schedule = (LV2_Worker_Schedule){self, schedule};
      self->feature = (LV2_Feature){LV2_WORKER__schedule, &self->schedule};
      shown[n] = &self->feature;
    }
  }
  shown[n] = NULL;
}

static void show(Plugin* self, LilvInstance* instance) {
  self->real = instance->lv2_descriptor;
  self->shown = *self->real;
  self->shown.run = run;
  self->shown.connect_port = connect_port;
  self->shown.activate = self->real->activate ? activate : NULL;
  self->shown.deactivate = self->real->deactivate ? deactivate : NULL;
  self->shown.cleanup = cleanup;
  self->handle = instance->lv2_handle;
  instance->lv2_descriptor = &self->shown;
}

__attribute__((visibility("default"))) LilvInstance* lilv_plugin_instantiate(
    const LilvPlugin* plugin, double rate_hz, const LV2_Feature* const* features) {
  LilvInstance* (*real)(const LilvPlugin*, double, const LV2_Feature* const*) = NULL;
  void* const found = dlsym(RTLD_NEXT, "lilv_plugin_instantiate");
  memcpy(&real, &found, sizeof(real));
  const int i = atomic_fetch_add(&n_plugins, 1);
  if (i >= WATCH_PLUGINS) {
    return real(plugin, rate_hz, features);
  }
  const LV2_Feature* shown[MOST_FEATURES + 1];
  show_features(&plugins[i], features, shown);
  LilvInstance* const instance = real(plugin, rate_hz, shown);
  if (instance) {
    show(&plugins[i], instance);
  }
  return instance;
}

/* What the host says is read while it runs. */
__attribute__((constructor)) static void speak_at_once(void) {
  (void)setvbuf(stdout, NULL, _IOLBF, 0);
}

#include "tests/fuzz/plug.h"

#include "plugin/bundle.h"
#include "plugin/guitar_ports.h"
#include "plugin/strings_ports.h"
#include "tests/fuzz/fuzz.h"

#include <lv2/log/log.h>
#include <lv2/midi/midi.h>
#include <lv2/urid/urid.h>

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_URIS = 64, MAX_RATES = 8, CHANNELS = 16, LINE = 16384 };

/* A choked string is let go within 0.1 s; what a bow has left standing on a side goes after it. */
static const double SILENT_AFTER_S = 0.25;

/* A pluck's peak is 0.25, and level at most 12 dB: a note is 1 at the most.  What slides to a lower
 * pitch swings wider, and a course is a second string. */
static const double PEAK_OF_NOTE = 4.0;

static const PortRange strings_controls[] = {STRINGS_CONTROL_PORTS(PORT_RANGE)};
static const PortRange guitar_controls[] = {GUITAR_CONTROL_PORTS(PORT_RANGE)};

const PlugKind plug_strings = {
    .descriptor = &strings_descriptor,
    .controls = strings_controls,
    .n_controls = sizeof(strings_controls) / sizeof(strings_controls[0]),
    .meters = STRINGS_PORT_SOUNDING,
    .most_peak = 16.0,
};

const PlugKind plug_guitar = {
    .descriptor = &guitar_descriptor,
    .controls = guitar_controls,
    .n_controls = sizeof(guitar_controls) / sizeof(guitar_controls[0]),
    .meters = GUITAR_PORT_SOUNDING,
    .most_peak = 51.0,
};

static LV2_URID map_uri(LV2_URID_Map_Handle handle, const char* uri) {
  static char uris[MAX_URIS][128];
  static uint32_t n_uris;
  (void)handle;
  for (uint32_t i = 0; i < n_uris; ++i) {
    if (!strcmp(uris[i], uri)) {
      return i + 1;
    }
  }
  FUZZ_CLAIM(n_uris < MAX_URIS && strlen(uri) < sizeof(uris[0]));
  strcpy(uris[n_uris], uri);
  return ++n_uris;
}

LV2_URID plug_urid(const char* uri) {
  return map_uri(NULL, uri);
}

/* A line of the log is whole, whatever is in it. */
__attribute__((format(printf, 3, 0))) static int
print_line(LV2_Log_Handle handle, LV2_URID type, const char* format, va_list arguments) {
  static char line[LINE];
  (void)handle;
  FUZZ_CLAIM(type > 0);
  const int length = vsnprintf(line, sizeof(line), format, arguments);
  FUZZ_CLAIM(length > 0 && length < LINE && line[length - 1] == '\n');
  return length;
}

__attribute__((format(printf, 3, 4))) static int
print(LV2_Log_Handle handle, LV2_URID type, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int length = print_line(handle, type, format, arguments);
  va_end(arguments);
  return length;
}

static LV2_Worker_Status
no_response(LV2_Worker_Respond_Handle handle, uint32_t n, const void* data) {
  (void)handle;
  (void)n;
  (void)data;
  return LV2_WORKER_SUCCESS;
}

/* At once, as a host that renders may, and from memory of just that size. */
static LV2_Worker_Status
schedule(LV2_Worker_Schedule_Handle handle, uint32_t n_bytes, const void* data) {
  const Plug* const plug = handle;
  if (plug->is_worker_busy) {
    return LV2_WORKER_ERR_NO_SPACE;
  }
  uint8_t* const copy = fuzz_copy(data, n_bytes);
  (void)plug->worker->work(plug->handle, no_response, NULL, n_bytes, copy);
  free(copy);
  return LV2_WORKER_SUCCESS;
}

static const void* extension(const PlugKind* kind, const char* uri) {
  return kind->descriptor->extension_data ? kind->descriptor->extension_data(uri) : NULL;
}

static void instantiate(Plug* plug) {
  LV2_URID_Map map = {NULL, map_uri};
  static LV2_Log_Log log = {NULL, print, print_line};
  plug->schedule = (LV2_Worker_Schedule){plug, schedule};
  const LV2_Feature work = {LV2_WORKER__schedule, &plug->schedule};
  const LV2_Feature features[] = {{LV2_URID__map, &map}, {LV2_LOG__log, &log}, work};
  const LV2_Feature* const list[] = {&features[0], &features[1], &features[2], NULL};
  const LV2_Descriptor* const descriptor = plug->kind->descriptor;
  plug->handle = descriptor->instantiate(descriptor, plug->rate_hz, "", list);
  FUZZ_CLAIM(plug->handle);
  plug->state = extension(plug->kind, LV2_STATE__interface);
  plug->worker = extension(plug->kind, LV2_WORKER__interface);
  for (uint32_t i = 0; i < PORTS_MAX; ++i) {
    descriptor->connect_port(plug->handle, i, &plug->values[i]);
  }
}

/* To have no file is a state as well. */
static const void* retrieve_nothing(
    LV2_State_Handle handle, uint32_t key, size_t* n_bytes, uint32_t* type, uint32_t* flags) {
  (void)handle;
  *n_bytes = 1;
  *type = plug_urid(LV2_ATOM__String);
  *flags = LV2_STATE_IS_POD;
  return key == plug_urid("urn:hooke:strings#scale") ||
                 key == plug_urid("urn:hooke:strings#mapping") ||
                 key == plug_urid("urn:hooke:strings#body")
             ? ""
             : NULL;
}

void plug_reset(Plug* plug) {
  static const LV2_Feature* const none[] = {NULL};
  for (uint32_t i = 0; i < plug->kind->n_controls; ++i) {
    plug->values[plug->kind->controls[i].index] = plug->kind->controls[i].default_value;
  }
  plug->is_worker_busy = false;
  plug->n_room = PLUG_MAX_NOTIFY;
  plug->peak = 0.0;
  plug->n_notes = 0;
  plug->hash = 0;
  if (plug->state) {
    FUZZ_CLAIM(!plug->state->restore(plug->handle, retrieve_nothing, NULL, 0, none));
  }
  plug->kind->descriptor->activate(plug->handle);
}

Plug* plug_in(const PlugKind* kind, double rate_hz) {
  static Plug* plugs[MAX_RATES];
  uint32_t i = 0;
  while (i < MAX_RATES && plugs[i] && (plugs[i]->rate_hz != rate_hz || plugs[i]->kind != kind)) {
    ++i;
  }
  FUZZ_CLAIM(i < MAX_RATES);
  if (!plugs[i]) {
    plugs[i] = calloc(1, sizeof(Plug));
    FUZZ_CLAIM(plugs[i]);
    *plugs[i] = (Plug){.kind = kind, .rate_hz = rate_hz};
    instantiate(plugs[i]);
  }
  plug_reset(plugs[i]);
  return plugs[i];
}

static void hear(Plug* plug, const float* samples, uint32_t n_frames) {
  for (uint32_t i = 0; i < n_frames; ++i) {
    uint32_t bits = 0;
    FUZZ_CLAIM(isfinite(samples[i]));
    plug->peak = fmax(plug->peak, fabs((double)samples[i]));
    memcpy(&bits, &samples[i], sizeof(bits));
    plug->hash = (plug->hash ^ bits) * UINT64_C(0x100000001B3);
  }
  FUZZ_CLAIM(plug->peak <= fmax(plug->kind->most_peak, PEAK_OF_NOTE * plug->n_notes));
}

/* Every event lies within the sequence, and the sequence within its room. */
static void claim_told(const LV2_Atom_Sequence* notify, uint32_t n_room) {
  const uint32_t n_bytes = notify->atom.size;
  FUZZ_CLAIM(n_bytes <= n_room);
  if (n_room < sizeof(LV2_Atom_Sequence_Body)) {
    FUZZ_CLAIM(n_bytes == 0);
    return;
  }
  const uint8_t* const body = (const uint8_t*)(notify + 1);
  uint32_t at = 0;
  while (at < n_bytes - sizeof(LV2_Atom_Sequence_Body)) {
    LV2_Atom_Event event;
    memcpy(&event, body + at, sizeof(event));
    FUZZ_CLAIM(event.time.frames == 0 && event.body.type > 0);
    at += (uint32_t)sizeof(event) + ((event.body.size + 7u) & ~7u);
  }
  FUZZ_CLAIM(at == n_bytes - sizeof(LV2_Atom_Sequence_Body));
}

static float* frames(uint32_t n_frames) {
  float* const memory = malloc((n_frames > 0 ? n_frames : 1) * sizeof(float));
  FUZZ_CLAIM(memory);
  memset(memory, 0xFF, n_frames * sizeof(float));
  return memory;
}

static void connect(const Plug* plug, uint32_t port, void* data) {
  plug->kind->descriptor->connect_port(plug->handle, port, data);
}

static void run_into(Plug* plug,
                     const LV2_Atom_Sequence* control,
                     LV2_Atom_Sequence* notify,
                     uint32_t n_frames) {
  plug->left = frames(n_frames);
  plug->right = frames(n_frames);
  connect(plug, PORT_CONTROL, (void*)(uintptr_t)control);
  connect(plug, PORT_NOTIFY, notify);
  connect(plug, PORT_OUT_LEFT, plug->left);
  connect(plug, PORT_OUT_RIGHT, plug->right);
  plug->kind->descriptor->run(plug->handle, n_frames);
  hear(plug, plug->left, n_frames);
  hear(plug, plug->right, n_frames);
  free(plug->left);
  free(plug->right);
}

void plug_run(Plug* plug, const LV2_Atom_Sequence* control, uint32_t n_frames) {
  FUZZ_CLAIM(n_frames <= PLUG_FRAMES && plug->n_room <= PLUG_MAX_NOTIFY);
  const size_t size = sizeof(LV2_Atom) + plug->n_room;
  LV2_Atom_Sequence* const notify = malloc(size);
  FUZZ_CLAIM(notify);
  memset(notify, 0xFF, size);
  notify->atom = (LV2_Atom){plug->n_room, 0};
  run_into(plug, control, notify, n_frames);
  claim_told(notify, plug->n_room);
  free(notify);
  const float headroom = plug->values[plug->kind->meters + 2];
  FUZZ_CLAIM(headroom >= 0.0f && headroom <= 1.0f);
}

double plug_masses(const Plug* plug) {
  return (double)plug->values[plug->kind->meters + 1];
}

typedef struct {
  LV2_Atom_Event head;
  uint8_t bytes[8];
} Message;

typedef struct {
  LV2_Atom_Sequence sequence;
  Message messages[CHANNELS];
} Silence;

static void send_sound_off(Plug* plug) {
  Silence silence = {
      .sequence.atom = {sizeof(Silence) - sizeof(LV2_Atom), plug_urid(LV2_ATOM__Sequence)}};
  for (unsigned i = 0; i < CHANNELS; ++i) {
    silence.messages[i] = (Message){.head.body = {3, plug_urid(LV2_MIDI__MidiEvent)},
                                    .bytes = {(uint8_t)(0xB0 | i), 120, 0}};
  }
  plug_run(plug, &silence.sequence, PLUG_FRAMES);
}

void plug_claim_silence(Plug* plug) {
  plug->values[PORT_ENABLED] = 1.0f;
  send_sound_off(plug);
  const float* const sounding = &plug->values[plug->kind->meters];
  const double n_frames = SILENT_AFTER_S * plug->rate_hz + 4 * PLUG_FRAMES;
  for (double at = 0.0; at < n_frames && (*sounding > 0.0f || plug->peak > 0.0);
       at += PLUG_FRAMES) {
    plug->peak = 0.0;
    plug_run(plug, NULL, PLUG_FRAMES);
  }
  FUZZ_CLAIM(*sounding == 0.0f && plug->peak == 0.0);
  plug_run(plug, NULL, PLUG_FRAMES);
  FUZZ_CLAIM(*sounding == 0.0f && plug->peak == 0.0);
}

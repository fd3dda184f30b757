/* A program change asks the host to move its ports, where the host offers that, so that its panel
 * shows what is heard; and what is heard does not depend on whether it does. */
#include "tests/support/measure.h"
#include "tests/support/programs.h"

#include "plugin/port_request.h"
#include "plugin/ports.h"

#include <lv2/atom/atom.h>
#include <lv2/midi/midi.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { BLOCK = 256, N_BLOCKS = 16, N_FRAMES = N_BLOCKS * BLOCK, MOST_FEATURES = 16 };

typedef enum { REFUSES, MOVES_AT_ONCE, MOVES_LATER, OFFERS_NOTHING, N_HOSTS } Willing;

/* A host of one instance that may move its ports when it is asked. */
typedef struct {
  Willing willing;
  Host* world;
  LilvInstance* instance;
  PortRequest request;
  uint32_t n_ports;
  float ports[PORTS_MAX];
  float asked[PORTS_MAX]; /* NAN: it was not asked to move that one */
  unsigned n_asked;
} Asked;

static PortRequestStatus on_request(void* handle, uint32_t port, float value) {
  Asked* const host = handle;
  ++host->n_asked;
  assert_true(port < host->n_ports);
  host->asked[port] = value;
  if (host->willing == MOVES_AT_ONCE) {
    host->ports[port] = value;
  }
  return host->willing == REFUSES ? PORT_REQUEST_UNKNOWN : PORT_REQUEST_SUCCESS;
}

static void instantiate(Asked* host) {
  const LV2_Feature feature = {PORT_REQUEST_URI, &host->request};
  const LV2_Feature* features[MOST_FEATURES] = {NULL};
  const LV2_Feature* const* const offered = host_features(host->world);
  size_t n = 0;
  for (; offered[n]; ++n) {
    features[n] = offered[n];
  }
  features[n] = host->willing == OFFERS_NOTHING ? NULL : &feature;
  host->request = (PortRequest){host, on_request};
  host->instance = lilv_plugin_instantiate(host_plugin(host->world), PROGRAMS_RATE, features);
  assert_non_null(host->instance);
}

static void open_asked(Asked* host, int plugin, Willing willing) {
  *host = (Asked){.willing = willing, .world = programs_open(plugin)};
  instantiate(host);
  host->n_ports = host_n_ports(host->world);
  for (uint32_t i = 0; i < host->n_ports; ++i) {
    host->ports[i] = host_get(host->world, host_port_symbol(host->world, i));
    host->asked[i] = NAN;
    lilv_instance_connect_port(host->instance, i, i < PORT_ENABLED ? NULL : &host->ports[i]);
  }
  lilv_instance_activate(host->instance);
}

static void close_asked(Asked* host) {
  lilv_instance_free(host->instance);
  host_free(host->world);
}

/* Three messages at the start of a block. */
typedef struct {
  LV2_Atom_Sequence head;
  struct {
    LV2_Atom_Event event;
    uint8_t bytes[8];
  } messages[3];
} Messages;

static Messages program_and_note(Host* world, PresetPlace place) {
  const uint8_t bytes[3][3] = {
      {0xB0, 32, (uint8_t)place.bank}, {0xC0, (uint8_t)place.program, 0}, {0x90, 45, 100}};
  Messages messages = {
      .head.atom = {sizeof(messages) - sizeof(LV2_Atom), host_map(world, LV2_ATOM__Sequence)}};
  for (int i = 0; i < 3; ++i) {
    messages.messages[i].event.body =
        (LV2_Atom){i == 1 ? 2 : 3, host_map(world, LV2_MIDI__MidiEvent)};
    memcpy(messages.messages[i].bytes, bytes[i], 3);
  }
  return messages;
}

static void move_later(Asked* host) {
  for (uint32_t i = 0; i < host->n_ports && host->willing == MOVES_LATER; ++i) {
    host->ports[i] = isnan(host->asked[i]) ? host->ports[i] : host->asked[i];
  }
}

/* A block at the defaults, a program change with a note in the next, and the ports moved later. */
static Sound play(Asked* host, PresetPlace place) {
  Sound sound = sound_new(N_FRAMES);
  Messages messages = program_and_note(host->world, place);
  for (int i = 0; i < N_BLOCKS; ++i) {
    lilv_instance_connect_port(host->instance, PORT_CONTROL, i == 1 ? &messages : NULL);
    lilv_instance_connect_port(host->instance, PORT_OUT_LEFT, sound.left + i * BLOCK);
    lilv_instance_connect_port(host->instance, PORT_OUT_RIGHT, sound.right + i * BLOCK);
    if (i == 4) {
      move_later(host);
    }
    lilv_instance_run(host->instance, BLOCK);
  }
  assert_true(measure_peak(sound.left, N_FRAMES) > 1e-3);
  return sound;
}

/* All those of the preset that are elsewhere, once, and no other. */
static void the_host_is_asked_for_what_differs(void** state) {
  (void)state;
  for (int p = 0; p < PROGRAMS_PLUGINS; ++p) {
    Asked host;
    open_asked(&host, p, REFUSES);
    for (uint32_t k = 0; k < host_n_presets(host.world); ++k) {
      Asked asked;
      open_asked(&asked, p, REFUSES);
      assert_true(host_preset(host.world, host_preset_uri(host.world, k)));
      Sound sound = play(&asked, presets_place(host.world, k));
      unsigned n_differ = 0;
      for (uint32_t i = 0; i < host.n_ports; ++i) {
        const float wanted = host_get(host.world, host_port_symbol(host.world, i));
        const bool differs = host_port_is_control_input(host.world, i) && wanted != asked.ports[i];
        assert_int_equal(differs, !isnan(asked.asked[i]));
        assert_true(!differs || asked.asked[i] == wanted);
        n_differ += differs;
      }
      assert_int_equal(asked.n_asked, n_differ);
      sound_free(&sound);
      close_asked(&asked);
    }
    close_asked(&host);
  }
}

static void nothing_is_asked_of_the_host_without_a_program(void** state) {
  (void)state;
  Asked host;
  open_asked(&host, 0, REFUSES);
  Sound sound = play(&host, (PresetPlace){0, 127});
  assert_int_equal(host.n_asked, 0);
  sound_free(&sound);
  close_asked(&host);
}

/* What lies over no port is not kept. */
static unsigned n_kept(const Asked* host) {
  LV2_URID_Map* const map = host_features(host->world)[0]->data;
  assert_string_equal(host_features(host->world)[0]->URI, LV2_URID__map);
  LilvState* const state = lilv_state_new_from_instance(
      host_plugin(host->world), host->instance, map, NULL, NULL, NULL, NULL, NULL, NULL, 0, NULL);
  assert_non_null(state);
  const unsigned n = lilv_state_get_num_properties(state);
  lilv_state_free(state);
  return n;
}

static void it_sounds_the_same_whether_the_host_does_it(void** state) {
  (void)state;
  Sound sounds[N_HOSTS];
  for (Willing w = 0; w < N_HOSTS; ++w) {
    Asked host;
    open_asked(&host, 1, w);
    sounds[w] = play(&host, programs_place(host.world, "Nylon Fingers"));
    assert_true(sound_is_same(&sounds[0], &sounds[w]));
    assert_int_equal(n_kept(&host), w == REFUSES || w == OFFERS_NOTHING);
    close_asked(&host);
  }
  for (int w = 0; w < N_HOSTS; ++w) {
    sound_free(&sounds[w]);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_host_is_asked_for_what_differs),
      cmocka_unit_test(nothing_is_asked_of_the_host_without_a_program),
      cmocka_unit_test(it_sounds_the_same_whether_the_host_does_it),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

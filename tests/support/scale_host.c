#define _POSIX_C_SOURCE 200809L

#include "tests/support/scale_host.h"

#include "tests/support/host_inside.h"
#include "tests/support/scala.h"
#include "tests/support/temporary.h"

#include <lv2/atom/forge.h>
#include <lv2/atom/util.h>
#include <lv2/patch/patch.h>
#include <lv2/state/state.h>

#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static int kept_stderr = -1;
static FILE* caught_stderr;

static LV2_URID map_uri(LV2_URID_Map_Handle handle, const char* uri) {
  return host_map(handle, uri);
}

static ScalePath join(const char* directory, const char* file) {
  ScalePath path;
  const int length = snprintf(path.text, sizeof(path.text), "%s/%s", directory, file);
  assert_true(length > 0 && (size_t)length < sizeof(path.text));
  return path;
}

ScalePath scale_path(const char* file) {
  const char* const source = getenv("HOOKE_SOURCE");
  assert_non_null(source);
  const ScalePath directory = join(source, "tests/scales");
  return file ? join(directory.text, file) : (ScalePath){""};
}

ScalePath scale_new_directory(void) {
  ScalePath path;
  temporary_folder(path.text);
  return path;
}

ScalePath scale_write(const ScalePath* directory, const char* file, const char* text) {
  const ScalePath path = join(directory->text, file);
  FILE* const stream = fopen(path.text, "wb");
  assert_non_null(stream);
  assert_int_equal(fwrite(text, 1, strlen(text), stream), strlen(text));
  assert_int_equal(fclose(stream), 0);
  return path;
}

ScalePath scale_write_body(const ScalePath* directory, const char* file, BodiesChoice choice) {
  enum { MOST_OF_LINE = 160 };
  static char text[BODY_MAX_MODES * MOST_OF_LINE];
  const Body* const body = bodies_shipped(choice);
  size_t n = 0;
  assert_non_null(body);
  for (uint32_t k = 0; k < body->n_modes; ++k) {
    const BodyMode* const mode = &body->modes[k];
    n += (size_t)snprintf(text + n, sizeof(text) - n, "mode %.17g %.17g %.17g %.17g %.17g\n",
                          mode->f0_hz, mode->q, mode->mass_kg, mode->radiation[0],
                          mode->radiation[1]);
    assert_true(n < sizeof(text));
  }
  return scale_write(directory, file, text);
}

void scale_remove_directory(const ScalePath* directory) {
  DIR* const listing = opendir(directory->text);
  assert_non_null(listing);
  for (struct dirent* entry = readdir(listing); entry; entry = readdir(listing)) {
    if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0) {
      assert_int_equal(remove(join(directory->text, entry->d_name).text), 0);
    }
  }
  assert_int_equal(closedir(listing), 0);
  assert_int_equal(rmdir(directory->text), 0);
}

uint32_t
scale_message(Host* host, const char* parameter, const char* path, void* message, uint32_t size) {
  LV2_URID_Map map = {host, map_uri};
  LV2_Atom_Forge forge;
  LV2_Atom_Forge_Frame frame;
  lv2_atom_forge_init(&forge, &map);
  lv2_atom_forge_set_buffer(&forge, message, size);
  lv2_atom_forge_object(&forge, &frame, 0, host_map(host, path ? LV2_PATCH__Set : LV2_PATCH__Get));
  if (parameter) {
    lv2_atom_forge_key(&forge, host_map(host, LV2_PATCH__property));
    lv2_atom_forge_urid(&forge, host_map(host, parameter));
  }
  if (path) {
    lv2_atom_forge_key(&forge, host_map(host, LV2_PATCH__value));
    assert_true(lv2_atom_forge_path(&forge, path, (uint32_t)strlen(path)) != 0);
  }
  lv2_atom_forge_pop(&forge, &frame);
  return ((const LV2_Atom*)message)->size;
}

static void send(Host* host, const char* parameter, const char* path) {
  _Alignas(8) uint8_t message[SCALE_HOST_PATH + 512];
  const uint32_t size = scale_message(host, parameter, path, message, sizeof(message));
  assert_true(host_atom(host, 0, LV2_ATOM__Object, message + sizeof(LV2_Atom), size));
}

void scale_set(Host* host, const char* parameter, const char* path) {
  send(host, parameter, path);
}

void scale_get(Host* host, const char* parameter) {
  send(host, parameter, NULL);
}

void scale_use(Host* host, const char* scale, const char* mapping) {
  const ScalePath paths[2] = {scale_path(scale), scale_path(mapping)};
  scale_set(host, SCALE_PARAMETER, paths[0].text);
  scale_set(host, MAPPING_PARAMETER, paths[1].text);
  assert_true(host_run(host, 16));
  assert_true(host_run(host, 16));
}

/* The object of that class in the last run's events, about a parameter if that is not NULL. */
static const LV2_Atom_Object* find(Host* host, const char* class, const char* parameter) {
  const LV2_Atom_Sequence* const events = host_notify(host);
  if (events->atom.type != host_map(host, LV2_ATOM__Sequence)) {
    return NULL;
  }
  LV2_ATOM_SEQUENCE_FOREACH(events, event) {
    const LV2_Atom_Object* const object = (const LV2_Atom_Object*)(const void*)&event->body;
    const LV2_Atom_URID* property = NULL;
    assert_int_equal(event->time.frames, 0);
    assert_int_equal(object->atom.type, host_map(host, LV2_ATOM__Object));
    lv2_atom_object_get(object, host_map(host, LV2_PATCH__property), &property, 0);
    const bool is_about = !parameter || (property && property->body == host_map(host, parameter));
    if (is_about && object->body.otype == host_map(host, class)) {
      return object;
    }
  }
  return NULL;
}

bool scale_told(Host* host, const char* parameter, ScalePath* path) {
  const LV2_Atom_Object* const object = find(host, LV2_PATCH__Set, parameter);
  const LV2_Atom* value = NULL;
  const LV2_Atom_URID* subject = NULL;
  if (!object) {
    return false;
  }
  lv2_atom_object_get(object, host_map(host, LV2_PATCH__value), &value,
                      host_map(host, LV2_PATCH__subject), &subject, 0);
  assert_non_null(value);
  assert_non_null(subject);
  assert_int_equal(value->type, host_map(host, LV2_ATOM__Path));
  assert_int_equal(subject->body,
                   host_map(host, lilv_node_as_uri(lilv_plugin_get_uri(host_plugin(host)))));
  assert_true(value->size > 0 && value->size <= sizeof(path->text));
  memcpy(path->text, value + 1, value->size);
  assert_int_equal(path->text[value->size - 1], '\0');
  return true;
}

bool scale_told_change(Host* host) {
  return find(host, LV2_STATE__StateChanged, NULL);
}

void scale_expected(const char* scale, const char* mapping, double a4_hz, double hz[128]) {
  Scale read_scale;
  ScaleMap read_map;
  scale_equal(&read_scale);
  scale_map_linear(&read_map);
  if (scale) {
    scala_scale_file(scale, &read_scale);
  }
  if (mapping) {
    scala_map_file(mapping, &read_map);
  }
  assert_int_equal(scale_tune(&read_scale, &read_map, a4_hz, hz), STATUS_OK);
  scale_free(&read_scale);
  scale_map_free(&read_map);
}

void scale_assert_pitch(Host* host, uint32_t key, double hz) {
  enum { RATE = 48000, N_FRAMES = RATE / 2, BLOCK = 256 };
  Sound sound = sound_new(N_FRAMES);
  strings_set_plain(host);
  strings_restart(host);
  strings_note_on(host, 0, key, 127);
  strings_run(host, &sound, 0, N_FRAMES, BLOCK);
  Tone asked = strings_tone(host, key, 0.0);
  asked.f0_hz = hz;
  strings_assert_exact("key", strings_measure(&sound, RATE, RATE / 100, N_FRAMES, asked));
  sound_free(&sound);
}

void scale_assert_heard(Host* host, const char* scale, const char* mapping) {
  double hz[128];
  scale_expected(scale, mapping, 440.0, hz);
  scale_assert_pitch(host, 64, hz[64]);
}

void scale_log_begin(void) {
  (void)fflush(stderr);
  caught_stderr = tmpfile();
  assert_non_null(caught_stderr);
  kept_stderr = dup(STDERR_FILENO);
  assert_true(dup2(fileno(caught_stderr), STDERR_FILENO) >= 0);
}

char* scale_log_end(void) {
  enum { MOST = 65536 };
  (void)fflush(stderr);
  assert_true(dup2(kept_stderr, STDERR_FILENO) >= 0);
  assert_int_equal(close(kept_stderr), 0);
  char* const text = calloc(MOST, 1);
  assert_non_null(text);
  rewind(caught_stderr);
  (void)fread(text, 1, MOST - 1, caught_stderr);
  (void)fclose(caught_stderr);
  (void)fputs(text, stdout);
  return text;
}

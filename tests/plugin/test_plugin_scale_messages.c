/* What a panel says of a player's files, and what it is told. */
#include "tests/support/host_inside.h"
#include "tests/support/host_state.h"
#include "tests/support/scale_host.h"

#include <lv2/atom/forge.h>
#include <lv2/log/log.h>
#include <lv2/patch/patch.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 256 };

static const char SCALE[] = "19-equal.scl";
static const char MAPPING[] = "white-keys.kbm";

static void run(Host* host) {
  assert_true(host_run(host, BLOCK));
}

static void assert_told(Host* host, const char* parameter, const char* path) {
  ScalePath told;
  assert_true(scale_told(host, parameter, &told));
  assert_string_equal(told.text, path);
}

static void assert_silent(Host* host) {
  assert_int_equal(host_notify(host)->atom.size, sizeof(LV2_Atom_Sequence_Body));
}

static void who_asks_is_answered_once(void** state) {
  (void)state;
  const ScalePath scale = scale_path(SCALE);
  Host* const host = strings_open(RATE, BLOCK);
  ScalePath told;
  run(host);
  assert_silent(host);
  scale_get(host, NULL);
  run(host);
  assert_told(host, SCALE_PARAMETER, "");
  assert_told(host, MAPPING_PARAMETER, "");
  assert_told(host, BODY_PARAMETER, "");
  run(host);
  assert_silent(host);
  scale_use(host, SCALE, NULL);
  run(host);
  assert_silent(host);
  scale_get(host, SCALE_PARAMETER);
  run(host);
  assert_told(host, SCALE_PARAMETER, scale.text);
  assert_false(scale_told(host, MAPPING_PARAMETER, &told));
  assert_false(scale_told(host, BODY_PARAMETER, &told));
  assert_false(scale_told_change(host));
  scale_get(host, STRINGS_URI "#nothing");
  run(host);
  assert_silent(host);
  host_free(host);
}

static void what_is_set_is_told_and_is_a_change(void** state) {
  (void)state;
  const ScalePath mapping = scale_path(MAPPING);
  Host* const host = strings_open(RATE, BLOCK);
  scale_set(host, MAPPING_PARAMETER, mapping.text);
  run(host);
  assert_silent(host);
  assert_int_equal(host_worker(host)->n_works, 1);
  run(host);
  assert_told(host, MAPPING_PARAMETER, mapping.text);
  assert_true(scale_told_change(host));
  scale_assert_heard(host, NULL, MAPPING);
  assert_int_equal(host_worker(host)->n_works, 1);
  host_free(host);
}

/* A session knows what it restores; its panel does not. */
static void what_is_restored_is_told_but_no_change(void** state) {
  (void)state;
  const ScalePath scale = scale_path(SCALE);
  Host* const host = strings_open(RATE, BLOCK);
  scale_use(host, SCALE, NULL);
  LilvState* const saved = host_save_state(host);
  assert_non_null(saved);
  host_restore_state(host, saved);
  run(host);
  assert_told(host, SCALE_PARAMETER, scale.text);
  assert_false(scale_told_change(host));
  lilv_state_free(saved);
  host_free(host);
}

static void what_has_no_room_is_told_when_it_has(void** state) {
  (void)state;
  const ScalePath scale = scale_path(SCALE);
  Host* const host = strings_open(RATE, BLOCK);
  assert_true(host_set_notify_capacity(host, 8));
  scale_use(host, SCALE, MAPPING);
  for (int i = 0; i < 10; ++i) {
    run(host);
    assert_silent(host);
  }
  scale_assert_heard(host, SCALE, MAPPING);
  assert_true(host_set_notify_capacity(host, 2048));
  run(host);
  assert_told(host, SCALE_PARAMETER, scale.text);
  assert_true(scale_told_change(host));
  run(host);
  assert_silent(host);
  host_free(host);
}

/* Whatever the room, messages are whole, and at the end all have been told.  A change takes 8 bytes
 * for the sequence, 16 for the event and 8 for the object. */
static void messages_are_whole_or_not_there(void** state) {
  (void)state;
  int n_changes = 0;
  for (uint32_t room = 0; room < 420; room += 4) {
    Host* const host = strings_open(RATE, BLOCK);
    ScalePath told;
    assert_true(host_set_notify_capacity(host, room));
    scale_set(host, SCALE_PARAMETER, scale_path(SCALE).text);
    run(host);
    run(host);
    const bool has_scale = room >= 8 && scale_told(host, SCALE_PARAMETER, &told);
    assert_true(room < 32 || has_scale || scale_told(host, MAPPING_PARAMETER, &told) ||
                scale_told_change(host));
    n_changes += room >= 8 && scale_told_change(host) ? 1 : 0;
    assert_true(host_set_notify_capacity(host, 4096));
    run(host);
    assert_true(has_scale || scale_told(host, SCALE_PARAMETER, &told));
    host_free(host);
  }
  assert_true(n_changes > 50);
}

static void work_may_be_done_inside_run(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  host_worker(host)->mode = HOST_WORK_IN_RUN;
  assert_true(host_set_freewheel(host, true));
  scale_use(host, SCALE, MAPPING);
  assert_int_equal(host_worker(host)->n_works, 2);
  assert_int_equal(host_worker(host)->n_failed, 0);
  assert_true(scale_told_change(host));
  scale_assert_heard(host, SCALE, MAPPING);
  host_free(host);
}

static void a_worker_without_room_is_asked_again(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  host_worker(host)->mode = HOST_WORK_REFUSED;
  scale_use(host, "just-major.scl", MAPPING);
  scale_use(host, SCALE, MAPPING);
  scale_assert_heard(host, NULL, NULL);
  host_worker(host)->mode = HOST_WORK_AFTER_RUN;
  run(host);
  assert_int_equal(host_worker(host)->n_works, 2);
  scale_assert_heard(host, SCALE, MAPPING);
  assert_int_equal(host_worker(host)->n_works, 2);
  host_free(host);
}

static void without_a_worker_a_wish_is_refused(void** state) {
  (void)state;
  const HostConfig config = {.rate_hz = RATE, .max_block = BLOCK, .is_bare = true};
  char error[256] = "";
  Host* const host = host_new_with(STRINGS_URI, &config, error, sizeof(error));
  assert_non_null(host);
  scale_set(host, SCALE_PARAMETER, scale_path(SCALE).text);
  scale_set(host, BODY_PARAMETER, "/some/where.body");
  run(host);
  assert_told(host, SCALE_PARAMETER, "");
  assert_told(host, BODY_PARAMETER, "");
  assert_false(scale_told_change(host));
  scale_assert_pitch(host, 69, 440.0);
  host_free(host);
}

/* The log says so beforehand: where a wish is heard nothing may be written. */
static void without_a_worker_the_log_says_so(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  const LV2_Feature* features[16] = {0};
  size_t n_features = 0;
  for (const LV2_Feature* const* f = host_features(host); *f; ++f) {
    if (strcmp((*f)->URI, LV2_WORKER__schedule) != 0) {
      features[n_features++] = *f;
    }
  }
  scale_log_begin();
  LilvInstance* const instance = lilv_plugin_instantiate(host_plugin(host), RATE, features);
  char* const said = scale_log_end();
  assert_non_null(instance);
  assert_non_null(strstr(said, "work:schedule"));
  assert_non_null(strstr(said, "patch:Set"));
  free(said);
  lilv_instance_free(instance);
  host_free(host);
}

static void a_path_that_is_too_long_is_refused(void** state) {
  (void)state;
  static char path[SCALE_HOST_PATH + 100];
  Host* const host = strings_open(RATE, BLOCK);
  scale_use(host, SCALE, NULL);
  run(host);
  for (size_t length = SCALE_HOST_PATH - 1; length <= SCALE_HOST_PATH; ++length) {
    const unsigned n_works = host_worker(host)->n_works;
    const bool is_taken = length < SCALE_HOST_PATH;
    memset(path, 'x', length);
    path[0] = '/';
    path[length] = '\0';
    scale_set(host, MAPPING_PARAMETER, path);
    run(host);
    assert_int_equal(host_worker(host)->n_works, n_works + is_taken);
    if (!is_taken) {
      path[SCALE_HOST_PATH - 1] = '\0';
      assert_told(host, MAPPING_PARAMETER, path);
    }
    run(host);
  }
  host_free(host);
}

/* A patch:Set whose parts can be made wrong. */
typedef struct {
  const char *type, *class, *subject, *property, *value_type;
} Wish;

static const Wish good = {LV2_ATOM__Object, LV2_PATCH__Set, STRINGS_URI, SCALE_PARAMETER,
                          LV2_ATOM__Path};

static LV2_URID map_uri(LV2_URID_Map_Handle handle, const char* uri) {
  return host_map(handle, uri);
}

static uint32_t write_wish(Host* host, const Wish* wish, uint8_t* message, uint32_t size) {
  const ScalePath path = scale_path(SCALE);
  LV2_URID_Map map = {host, map_uri};
  LV2_Atom_Forge forge;
  LV2_Atom_Forge_Frame frame;
  lv2_atom_forge_init(&forge, &map);
  lv2_atom_forge_set_buffer(&forge, message, size);
  lv2_atom_forge_object(&forge, &frame, 7, host_map(host, wish->class));
  lv2_atom_forge_key(&forge, host_map(host, LV2_PATCH__subject));
  lv2_atom_forge_urid(&forge, host_map(host, wish->subject));
  lv2_atom_forge_key(&forge, host_map(host, LV2_PATCH__property));
  lv2_atom_forge_urid(&forge, host_map(host, wish->property));
  lv2_atom_forge_key(&forge, host_map(host, LV2_PATCH__value));
  lv2_atom_forge_atom(&forge, (uint32_t)strlen(path.text) + 1, host_map(host, wish->value_type));
  lv2_atom_forge_write(&forge, path.text, (uint32_t)strlen(path.text) + 1);
  lv2_atom_forge_pop(&forge, &frame);
  return ((const LV2_Atom*)(const void*)message)->size;
}

static unsigned n_works_of(const Wish* wish) {
  _Alignas(8) uint8_t message[SCALE_HOST_PATH + 512];
  Host* const host = strings_open(RATE, BLOCK);
  const uint32_t size = write_wish(host, wish, message, sizeof(message));
  assert_true(host_atom(host, 0, wish->type, message + sizeof(LV2_Atom), size));
  run(host);
  const unsigned n_works = host_worker(host)->n_works;
  host_free(host);
  return n_works;
}

static void what_is_not_for_it_is_not_heard(void** state) {
  (void)state;
  Wish wrong[5] = {good, good, good, good, good};
  wrong[0].type = LV2_ATOM__Chunk;
  wrong[1].class = LV2_PATCH__Put;
  wrong[2].subject = "urn:hooke:guitar";
  wrong[3].property = STRINGS_URI "#scales";
  wrong[4].value_type = LV2_ATOM__URID;
  assert_int_equal(n_works_of(&good), 1);
  for (size_t i = 0; i < 5; ++i) {
    assert_int_equal(n_works_of(&wrong[i]), 0);
  }
  Wish other = good;
  other.type = LV2_ATOM__Blank;
  assert_int_equal(n_works_of(&other), 1);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(who_asks_is_answered_once),
      cmocka_unit_test(what_is_set_is_told_and_is_a_change),
      cmocka_unit_test(what_is_restored_is_told_but_no_change),
      cmocka_unit_test(what_has_no_room_is_told_when_it_has),
      cmocka_unit_test(messages_are_whole_or_not_there),
      cmocka_unit_test(work_may_be_done_inside_run),
      cmocka_unit_test(a_worker_without_room_is_asked_again),
      cmocka_unit_test(without_a_worker_a_wish_is_refused),
      cmocka_unit_test(without_a_worker_the_log_says_so),
      cmocka_unit_test(a_path_that_is_too_long_is_refused),
      cmocka_unit_test(what_is_not_for_it_is_not_heard),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Buffers as hosts hand them over: at odd places, too small, and with sequences that lie.  Each is
 * as long as it says, so that a memory checker sees a byte too far. */
#include "plugin/strings_ports.h"
#include "tests/support/host_inside.h"
#include "tests/support/scale_host.h"

#include <lv2/atom/atom.h>
#include <lv2/midi/midi.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 192, N_BLOCKS = 30, N_FRAMES = N_BLOCKS * BLOCK };

static void play_piece(Host* host) {
  strings_note_on(host, 3, 45, 100);
  strings_note_on(host, 700, 52, 80);
  strings_note_off(host, 2000, 45);
}

/* The host's own buffers are aligned; these are so by four bytes alone. */
static void buffers_need_no_more_than_four_bytes_alignment(void** state) {
  (void)state;
  Sound aligned = sound_new(N_FRAMES);
  Host* const host = strings_open(RATE, BLOCK);
  play_piece(host);
  strings_run(host, &aligned, 0, N_FRAMES, BLOCK);
  for (size_t shift = 1; shift < 4; ++shift) {
    float* const memory = aligned_alloc(64, 2 * (BLOCK + 16) * sizeof(float));
    float* const left = memory + shift;
    float* const right = memory + BLOCK + 16 + shift;
    host_connect(host, PORT_OUT_LEFT, left);
    host_connect(host, PORT_OUT_RIGHT, right);
    strings_restart(host);
    play_piece(host);
    for (int i = 0; i < N_BLOCKS; ++i) {
      assert_true(host_run(host, BLOCK));
      assert_memory_equal(left, aligned.left + i * BLOCK, BLOCK * sizeof(float));
      assert_memory_equal(right, aligned.right + i * BLOCK, BLOCK * sizeof(float));
    }
    free(memory);
  }
  sound_free(&aligned);
  host_free(host);
}

/* A sequence of one note on of `key`, then one of another that says it has `claimed` bytes; the
 * memory ends after `size` bytes of body, which is what the sequence says of itself. */
typedef struct {
  uint8_t* memory;
  LV2_Atom* atom;
} Sequence;

static Sequence make_sequence(Host* host, uint32_t size, uint32_t claimed, size_t shift) {
  const LV2_URID midi = host_map(host, LV2_MIDI__MidiEvent);
  const LV2_Atom head = {size, host_map(host, LV2_ATOM__Sequence)};
  const LV2_Atom_Sequence_Body body = {0, 0};
  const LV2_Atom_Event first = {{0}, {3, midi}};
  const LV2_Atom_Event second = {{0}, {claimed, midi}};
  const uint8_t notes[2][8] = {{0x90, 60, 100}, {0x90, 72, 100}};
  uint8_t whole[8 + 8 + 24 + 24];
  memcpy(whole, &head, 8);
  memcpy(whole + 8, &body, 8);
  memcpy(whole + 16, &first, 16);
  memcpy(whole + 32, notes[0], 8);
  memcpy(whole + 40, &second, 16);
  memcpy(whole + 56, notes[1], 8);
  assert_true(8 + size <= sizeof(whole));
  const Sequence sequence = {.memory = malloc(shift + 8 + size)};
  assert_non_null(sequence.memory);
  memcpy(sequence.memory + shift, whole, 8 + size);
  return (Sequence){sequence.memory, (LV2_Atom*)(void*)(sequence.memory + shift)};
}

static float run_sequence(Host* host, Sequence sequence) {
  strings_restart(host);
  host_connect(host, PORT_CONTROL, sequence.atom);
  lilv_instance_run(host_instance(host), BLOCK);
  free(sequence.memory);
  host_reconnect(host);
  return host_get(host, "sounding");
}

/* What begins within the sequence and is whole is played; the padding of the last may be missing.
 */
static void a_sequence_cut_short_is_played_as_far_as_it_is_whole(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  for (size_t shift = 0; shift <= 4; shift += 4) {
    for (uint32_t size = 0; size <= 56; ++size) {
      const float n_whole = size >= 8 + 24 + 16 + 3 ? 2.0f : size >= 8 + 16 + 3 ? 1.0f : 0.0f;
      assert_true(run_sequence(host, make_sequence(host, size, 3, shift)) == n_whole);
    }
  }
  host_free(host);
}

static void an_event_that_claims_too_much_is_the_end(void** state) {
  static const uint32_t claims[] = {9,          17,         1000,       0x7FFFFFFF, 0x80000000,
                                    0xFFFFFFEF, 0xFFFFFFF0, 0xFFFFFFF8, 0xFFFFFFFC, 0xFFFFFFFF};
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  for (size_t i = 0; i < sizeof(claims) / sizeof(claims[0]); ++i) {
    assert_true(run_sequence(host, make_sequence(host, 56, claims[i], 4)) == 1.0f);
  }
  host_free(host);
}

static void what_is_no_sequence_is_not_read(void** state) {
  static const char* const types[] = {LV2_ATOM__Chunk, LV2_ATOM__Float, LV2_MIDI__MidiEvent};
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  for (size_t i = 0; i < sizeof(types) / sizeof(types[0]); ++i) {
    const Sequence sequence = make_sequence(host, 56, 3, 0);
    sequence.atom->type = host_map(host, types[i]);
    assert_true(run_sequence(host, sequence) == 0.0f);
  }
  host_free(host);
}

/* A path is read whole or not at all; the padding behind it may be missing. */
static void a_message_cut_short_is_not_heard(void** state) {
  (void)state;
  static _Alignas(8) uint8_t message[SCALE_HOST_PATH + 256];
  const char path[] = "/nowhere/a.scl";
  Host* const host = strings_open(RATE, BLOCK);
  const uint32_t size = scale_message(host, SCALE_PARAMETER, path, message, sizeof(message));
  host_worker(host)->mode = HOST_WORK_AFTER_RUN;
  for (uint32_t cut = 0; cut <= size; ++cut) {
    const unsigned n_works = host_worker(host)->n_works;
    assert_true(host_atom(host, 0, LV2_ATOM__Object, message + sizeof(LV2_Atom), cut));
    assert_true(host_run(host, BLOCK));
    const bool is_whole = cut + 1 >= size;
    assert_int_equal(host_worker(host)->n_works, n_works + (is_whole ? 1 : 0));
  }
  host_free(host);
}

/* An empty sequence if it has room for one, and else an empty atom; never a byte beyond the room.
 */
static void notify_writes_no_more_than_there_is_room_for(void** state) {
  enum { GUARD = 16 };
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  const LV2_URID sequence_type = host_map(host, LV2_ATOM__Sequence);
  const LV2_URID chunk = host_map(host, LV2_ATOM__Chunk);
  uint8_t guard[GUARD];
  memset(guard, 0xA5, GUARD);
  for (uint32_t room = 0; room <= 32; ++room) {
    uint8_t* const memory = malloc(4 + 8 + room + GUARD);
    assert_non_null(memory);
    const LV2_Atom before = {room, chunk};
    LV2_Atom after;
    memcpy(memory + 4, &before, 8);
    memcpy(memory + 4 + 8 + room, guard, GUARD);
    host_connect(host, PORT_NOTIFY, memory + 4);
    host_activate(host);
    lilv_instance_run(host_instance(host), BLOCK);
    memcpy(&after, memory + 4, 8);
    assert_memory_equal(memory + 4 + 8 + room, guard, GUARD);
    assert_int_equal(after.size, room >= 8 ? 8 : 0);
    assert_int_equal(after.type, room >= 8 ? sequence_type : 0);
    free(memory);
  }
  host_free(host);
}

/* The same where a checker sees it: the room ends where the memory does. */
static void notify_stays_in_its_memory(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  for (uint32_t room = 0; room <= 16; ++room) {
    assert_true(host_set_notify_capacity(host, room));
    assert_true(host_run(host, BLOCK));
  }
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(buffers_need_no_more_than_four_bytes_alignment),
      cmocka_unit_test(a_sequence_cut_short_is_played_as_far_as_it_is_whole),
      cmocka_unit_test(an_event_that_claims_too_much_is_the_end),
      cmocka_unit_test(what_is_no_sequence_is_not_read),
      cmocka_unit_test(a_message_cut_short_is_not_heard),
      cmocka_unit_test(notify_writes_no_more_than_there_is_room_for),
      cmocka_unit_test(notify_stays_in_its_memory),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

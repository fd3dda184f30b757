/* Events of a script, as atoms of the control port, act at their frame and to the letter, and what
 * is none is ignored. */
#include "tests/support/guitar_host.h"
#include "tests/support/measure.h"

#include <lv2/midi/midi.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 256, N_FRAMES = 60 * BLOCK };

/* At odd frames, and two at one. */
static const struct {
  size_t frame;
  GuitarEvent event;
} script[] = {
    {0, {GUITAR_FRET, 4, {3.0f}}},
    {1, {GUITAR_PLUCK, 4, {0.7f, 0.2f, 0.9f}}},
    {333, {GUITAR_PLUCK, 1, {-0.6f, NAN, NAN}}},
    {999, {GUITAR_VIBRATO, 1, {0.4f, 6.0f}}},
    {2500, {GUITAR_HAMMER, 4, {5.0f, 0.5f}}},
    {4097, {GUITAR_SLIDE, 4, {12.0f, 0.05f}}},
    {4097, {GUITAR_BEND, 1, {1.5f, 0.03f}}},
    {6001, {GUITAR_PALM, 0, {0.3f}}},
    {7003, {GUITAR_PLUCK, 5, {1.0f, NAN, 0.2f}}},
    {7003, {GUITAR_TOUCH, 5, {0.5f, 0.02f}}},
    {9001, {GUITAR_DAMP, 4, {0.05f}}},
    {9500, {GUITAR_LET_RING, 4, {0.0f}}},
    {9999, {GUITAR_PALM, 0, {0.0f}}},
};

enum { N_SCRIPT = sizeof(script) / sizeof(script[0]) };

static void assert_same_and_free(Sound* a, Sound* b) {
  assert_true(measure_peak(a->left, a->n_frames) > 0.01);
  assert_true(sound_is_same(a, b));
  sound_free(a);
  sound_free(b);
}

/* Without the event `left_out`, if there is that one. */
static Sound play_ourselves(const Host* host, size_t left_out) {
  Duo duo = duo_new(host, RATE);
  Sound sound = sound_new(N_FRAMES);
  size_t done = 0;
  for (size_t i = 0; i < N_SCRIPT; ++i) {
    duo_run(&duo, &sound, done, script[i].frame);
    done = script[i].frame;
    if (i != left_out) {
      assert_true(guitar_event_play(duo.guitar, &script[i].event));
    }
  }
  duo_run(&duo, &sound, done, N_FRAMES);
  duo_free(&duo);
  return sound;
}

static Sound play_script(Host* host) {
  Sound sound = sound_new(N_FRAMES);
  strings_restart(host);
  for (size_t i = 0; i < N_SCRIPT; ++i) {
    guitar_send(host, script[i].frame, script[i].event);
  }
  strings_run(host, &sound, 0, N_FRAMES, BLOCK);
  return sound;
}

static void a_script_is_played_to_the_letter(void** state) {
  (void)state;
  Host* const host = guitar_open(RATE, BLOCK);
  Sound heard = play_script(host);
  for (size_t i = 0; i < N_SCRIPT; ++i) {
    Sound without = play_ourselves(host, i);
    assert_false(sound_is_same(&heard, &without)); /* Every event is heard */
    sound_free(&without);
  }
  Sound wanted = play_ourselves(host, SIZE_MAX);
  assert_same_and_free(&heard, &wanted);
  host_free(host);
}

/* A chord is whole when its frame is over: the events of that frame come before it, wherever they
 * stand. */
static void events_come_before_the_notes_of_their_frame(void** state) {
  (void)state;
  const GuitarEvent slide = {GUITAR_SLIDE, 0, {5.0f, 0.01f}};
  Host* const host = guitar_open(RATE, BLOCK);
  Sound sounds[2] = {sound_new(N_FRAMES), sound_new(N_FRAMES)};
  Sound own = sound_new(N_FRAMES);
  Duo duo = duo_new(host, RATE);
  duo_run(&duo, &own, 0, 77);
  assert_true(guitar_event_play(duo.guitar, &slide));
  guitarist_note_on(duo.guitarist, 0, 64, 100);
  duo_run(&duo, &own, 77, N_FRAMES);
  for (int i = 0; i < 2; ++i) {
    strings_restart(host);
    if (i == 0) {
      guitar_send(host, 77, slide);
    }
    strings_note_on(host, 77, 64, 100);
    if (i == 1) {
      guitar_send(host, 77, slide);
    }
    strings_run(host, &sounds[i], 0, N_FRAMES, BLOCK);
    assert_true(sound_is_same(&own, &sounds[i]));
  }
  assert_same_and_free(&sounds[0], &sounds[1]);
  sound_free(&own);
  duo_free(&duo);
  host_free(host);
}

/* One pluck, then something that is no event of a script, in a body of `size` bytes. */
static Sound play_odd(Host* host, const char* type, const void* body, uint32_t size) {
  Sound sound = sound_new(N_FRAMES);
  strings_restart(host);
  guitar_send(host, 3, (GuitarEvent){GUITAR_PLUCK, 2, {0.5f, NAN, NAN}});
  if (type) {
    assert_true(host_atom(host, 700, type, body, size));
  }
  strings_run(host, &sound, 0, N_FRAMES, BLOCK);
  return sound;
}

static void what_is_no_event_of_a_script_is_ignored(void** state) {
  (void)state;
  const GuitarEvent good[2] = {{GUITAR_PLUCK, 0, {1.0f, NAN, NAN}},
                               {GUITAR_PLUCK, 0, {1.0f, NAN, NAN}}};
  const GuitarEvent bad[] = {
      {GUITAR_N_VERBS, 0, {1.0f, NAN, NAN}}, {UINT32_MAX, 0, {1.0f, NAN, NAN}},
      {GUITAR_PLUCK, 6, {1.0f, NAN, NAN}},   {GUITAR_PLUCK, 8, {1.0f, NAN, NAN}},
      {GUITAR_PLUCK, 0, {NAN, NAN, NAN}},    {GUITAR_PLUCK, UINT32_MAX, {1.0f, NAN, NAN}},
      {GUITAR_PLUCK, 0, {1e9f, NAN, NAN}},   {GUITAR_SLIDE, 2, {NAN, 0.1f, 0.0f}},
  };
  Host* const host = guitar_open(RATE, BLOCK);
  Sound alone = play_odd(host, NULL, NULL, 0);
  for (uint32_t size = 0; size <= sizeof(good); ++size) {
    Sound sound = play_odd(host, GUITAR_EVENT_URI, good, size);
    assert_int_equal(sound_is_same(&alone, &sound), size != sizeof(GuitarEvent));
    sound_free(&sound);
  }
  for (size_t i = 0; i < sizeof(bad) / sizeof(bad[0]); ++i) {
    Sound sound = play_odd(host, GUITAR_EVENT_URI, &bad[i], sizeof(GuitarEvent));
    assert_true(sound_is_same(&alone, &sound));
    sound_free(&sound);
  }
  Sound sound = play_odd(host, LV2_ATOM__Chunk, good, sizeof(GuitarEvent));
  assert_same_and_free(&alone, &sound);
  host_free(host);
}

/* A harp has no frets: it takes no scripts, and they change nothing. */
static void strings_ignores_scripts(void** state) {
  (void)state;
  const GuitarEvent event = {GUITAR_PLUCK, 0, {1.0f, NAN, NAN}};
  Host* const host = strings_open(RATE, BLOCK);
  assert_true(host_atom(host, 5, GUITAR_EVENT_URI, &event, sizeof(event)));
  assert_true(host_run(host, BLOCK));
  assert_true(host_get(host, "sounding") == 0.0f);
  host_free(host);
}

/* A sequence of a note and an event of a script, `shift` bytes past a good place. */
static size_t write_sequence(Host* host, uint8_t* to) {
  const GuitarEvent event = {GUITAR_PLUCK, 3, {0.8f, NAN, NAN}};
  const LV2_Atom_Event note_head = {{10}, {3, host_map(host, LV2_MIDI__MidiEvent)}};
  const LV2_Atom_Event event_head = {{99}, {sizeof(event), host_map(host, GUITAR_EVENT_URI)}};
  const uint8_t note[8] = {0x90, 64, 100};
  uint8_t body[8 + 24 + 16 + 24] = {0};
  memcpy(body + 8, &note_head, 16);
  memcpy(body + 24, note, 8);
  memcpy(body + 32, &event_head, 16);
  memcpy(body + 48, &event, sizeof(event));
  const LV2_Atom head = {sizeof(body), host_map(host, LV2_ATOM__Sequence)};
  memcpy(to, &head, 8);
  memcpy(to + 8, body, sizeof(body));
  return 8 + sizeof(body);
}

static void events_may_lie_at_any_place_in_memory(void** state) {
  (void)state;
  Host* const host = guitar_open(RATE, BLOCK);
  Sound sounds[2] = {sound_new(BLOCK), sound_new(BLOCK)};
  for (size_t shift = 0; shift < 8; ++shift) {
    uint8_t bytes[128];
    const size_t size = write_sequence(host, bytes);
    uint8_t* const memory = malloc(shift + size); /* Ends where it ends, for a checker to see */
    assert_non_null(memory);
    memcpy(memory + shift, bytes, size);
    strings_restart(host);
    host_connect(host, 0, memory + shift);
    lilv_instance_run(host_instance(host), BLOCK);
    memcpy(sounds[shift > 0].left, host_output(host, 0), BLOCK * sizeof(float));
    memcpy(sounds[shift > 0].right, host_output(host, 1), BLOCK * sizeof(float));
    assert_true(host_get(host, "sounding") == 2.0f);
    assert_true(shift == 0 || sound_is_same(&sounds[0], &sounds[1]));
    host_reconnect(host);
    free(memory);
  }
  sound_free(&sounds[0]);
  sound_free(&sounds[1]);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_script_is_played_to_the_letter),
      cmocka_unit_test(events_come_before_the_notes_of_their_frame),
      cmocka_unit_test(what_is_no_event_of_a_script_is_ignored),
      cmocka_unit_test(strings_ignores_scripts),
      cmocka_unit_test(events_may_lie_at_any_place_in_memory),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

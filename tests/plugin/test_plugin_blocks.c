/* However a host cuts time into blocks, the same samples come out, to the last bit. */
#include "tests/support/random.h"
#include "tests/support/strings_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>

#include <cmocka.h>

enum { RATE = 48000, N_FRAMES = 3 * RATE / 2, LARGEST = 4096, N_CUTS = 5, MOVED = 20011 };

/* The loops of the string are chosen by these, and every loop must not care. */
typedef struct {
  const char* name;
  double damping, loss, stiffness, spread, masses;
} Scene;

static const Scene scenes[] = {
    {"defaults", 0.6, 0.01, 1e-6, 0.1, 256.0},
    {"one pickup", 0.6, 0.01, 1e-6, 0.0, 256.0},
    {"bending", 2.0, 0.1, 2e-3, 0.3, 200.0},
    {"compensated", 0.02, 1e-5, 1e-6, 0.1, 256.0},
    {"compensated and bending", 0.02, 1e-5, 1e-4, 0.5, 91.0},
    {"few masses", 10.0, 1.0, 0.1, 0.2, 3.0},
};

enum { N_SCENES = sizeof(scenes) / sizeof(scenes[0]) };

static Host* open_scene(const Scene* scene) {
  Host* const host = strings_open(RATE, LARGEST);
  strings_set(host, "damping", scene->damping);
  strings_set(host, "loss", scene->loss);
  strings_set(host, "stiffness", scene->stiffness);
  strings_set(host, "spread", scene->spread);
  strings_set(host, "masses", scene->masses);
  return host;
}

/* A piece with everything in it; `delay` moves one of its events. */
static void play_piece(Host* host, size_t delay) {
  strings_note_on(host, 0, 40, 100);
  strings_note_on(host, 1, 52, 127);
  strings_note_on(host, 1, 59, 1);
  strings_bend(host, 4097, 0.71);
  strings_controller(host, 9000, STRINGS_PEDAL, 127);
  strings_note_off(host, 9001, 40);
  strings_note_on(host, 12345, 40, 60);
  strings_note_off(host, 12346, 40);
  strings_bend(host, 12400, 1.5);
  strings_bend(host, 12405, -2.0);
  strings_note_on(host, MOVED + delay, 88, 110);
  strings_controller(host, 25600, STRINGS_PEDAL, 0);
  strings_note_off(host, 30000, 52);
  strings_controller(host, 40959, STRINGS_SOUND_OFF, 0);
  strings_note_on(host, 40960, 30, 90);
  strings_note_on(host, 45001, 31, 90);
  strings_controller(host, 50000, STRINGS_RESET, 0);
  strings_controller(host, 60000, STRINGS_NOTES_OFF, 0);
}

static Sound render(const Scene* scene, uint32_t block, size_t delay) {
  Host* const host = open_scene(scene);
  Sound sound = sound_new(N_FRAMES);
  play_piece(host, delay);
  strings_run(host, &sound, 0, N_FRAMES, block);
  host_free(host);
  return sound;
}

/* Blocks of any size, a tenth of them empty, often small, never twice alike. */
static Sound render_randomly(const Scene* scene, Random* random) {
  Host* const host = open_scene(scene);
  Sound sound = sound_new(N_FRAMES);
  play_piece(host, 0);
  for (size_t at = 0; at < N_FRAMES;) {
    const uint32_t wanted = (uint32_t)random_log_between(random, 1.0, LARGEST + 1.0);
    const size_t n = wanted < N_FRAMES - at ? wanted : N_FRAMES - at;
    if (random_below(random, 10) == 0) {
      assert_true(host_run(host, 0));
    }
    strings_run(host, &sound, at, at + n, LARGEST);
    at += n;
  }
  host_free(host);
  return sound;
}

static void block_size_does_not_change_the_sound(void** state) {
  static const uint32_t blocks[] = {1, 16, 17, 64, 1024};
  (void)state;
  for (int s = 0; s < N_SCENES; ++s) {
    Sound whole = render(&scenes[s], LARGEST, 0);
    for (size_t i = 0; i < sizeof(blocks) / sizeof(blocks[0]); ++i) {
      Sound cut = render(&scenes[s], blocks[i], 0);
      print_message("%s, %u frames\n", scenes[s].name, blocks[i]);
      assert_true(sound_is_same(&whole, &cut));
      sound_free(&cut);
    }
    sound_free(&whole);
  }
}

static void random_blocks_do_not_change_the_sound(void** state) {
  (void)state;
  Random random = random_start();
  for (int s = 0; s < N_SCENES; ++s) {
    Sound whole = render(&scenes[s], LARGEST, 0);
    for (int i = 0; i < N_CUTS; ++i) {
      Sound cut = render_randomly(&scenes[s], &random);
      assert_true(sound_is_same(&whole, &cut));
      sound_free(&cut);
    }
    sound_free(&whole);
  }
}

/* The control: nothing is heard before the event, and all is different after it. */
static void an_event_a_frame_later_changes_the_sound_there(void** state) {
  (void)state;
  for (int s = 0; s < N_SCENES; ++s) {
    Sound a = render(&scenes[s], LARGEST, 0);
    Sound b = render(&scenes[s], LARGEST, 1);
    size_t first = 0;
    while (first < N_FRAMES && a.left[first] == b.left[first] && a.right[first] == b.right[first]) {
      ++first;
    }
    print_message("%s: moved at %d, first heard at %zu\n", scenes[s].name, MOVED, first);
    assert_true(first >= MOVED && first < MOVED + 64);
    sound_free(&a);
    sound_free(&b);
  }
}

/* The first frame that a note moves is its own: the events of a block are neither early nor late.
 */
static void a_note_starts_on_its_frame(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, 64);
  Sound sound = sound_new(256);
  strings_set(host, "masses", 1.0);
  for (size_t frame = 0; frame < 130; ++frame) {
    strings_restart(host);
    strings_note_on(host, frame, 69, 127);
    strings_run(host, &sound, 0, 256, 64);
    for (size_t i = 0; i < frame; ++i) {
      assert_true(sound.left[i] == 0.0f && sound.right[i] == 0.0f);
    }
    assert_true(sound.left[frame] != 0.0f && sound.right[frame] != 0.0f);
  }
  sound_free(&sound);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(block_size_does_not_change_the_sound),
      cmocka_unit_test(random_blocks_do_not_change_the_sound),
      cmocka_unit_test(an_event_a_frame_later_changes_the_sound_there),
      cmocka_unit_test(a_note_starts_on_its_frame),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

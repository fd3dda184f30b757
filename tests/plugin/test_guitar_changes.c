/* Ports that move while the guitar sounds, and between its sounds. */
#include "tests/support/guitar_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 480, N_FRAMES = 40 * BLOCK };

/* A patch that changes takes the block, and at least 5 ms, whatever rings. */
static void a_change_takes_the_block_and_5_ms_at_least(void** state) {
  static const struct {
    uint32_t block, n_glide;
  } cases[] = {{480, 480}, {241, 241}, {240, 241}, {96, 241}, {1, 241}};
  (void)state;
  for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); ++i) {
    Host* const host = guitar_open(RATE, BLOCK);
    Sound heard = sound_new(N_FRAMES);
    Sound wanted = sound_new(N_FRAMES);
    Duo duo = duo_new(host, RATE);
    strings_note_on(host, 0, 45, 100);
    guitarist_note_on(duo.guitarist, 0, 45, 100);
    strings_run(host, &heard, 0, 4800, 480);
    duo_run(&duo, &wanted, 0, 4800);
    strings_set(host, "damping", 8.0);
    strings_set(host, "pickup", 0.3);
    strings_set(host, "string5", 47.0);
    const GuitarPatch patch = guitar_patch_of(host);
    guitar_set_patch(duo.guitar, &patch, cases[i].n_glide);
    guitarist_set_patch(duo.guitarist, &patch);
    strings_run(host, &heard, 4800, 4800 + cases[i].block, cases[i].block);
    strings_run(host, &heard, 4800 + cases[i].block, N_FRAMES, 480);
    duo_run(&duo, &wanted, 4800, N_FRAMES);
    assert_true(sound_is_same(&heard, &wanted));
    duo_free(&duo);
    sound_free(&heard);
    sound_free(&wanted);
    host_free(host);
  }
}

/* A change that was under way is over when the plugin is activated. */
static void activation_begins_with_the_ports_as_they_are(void** state) {
  (void)state;
  Sound sounds[2];
  for (int i = 0; i < 2; ++i) {
    Host* const host = guitar_open(RATE, BLOCK);
    assert_true(i == 0 || host_run(host, BLOCK));
    strings_set(host, "level", -20.0);
    strings_set(host, "blend", 0.0);
    strings_set(host, "width", 1.0);
    assert_true(i == 0 || host_run(host, 1));
    strings_restart(host);
    strings_note_on(host, 10, 45, 100);
    sounds[i] = sound_new(N_FRAMES);
    strings_run(host, &sounds[i], 0, N_FRAMES, BLOCK);
    host_free(host);
  }
  assert_true(sound_is_same(&sounds[0], &sounds[1]));
  sound_free(&sounds[0]);
  sound_free(&sounds[1]);
}

/* How it is to be played is for notes to come. */
static void what_rings_does_not_hear_how_it_will_be_played(void** state) {
  static const struct {
    const char* symbol;
    double value;
  } how[] = {{"strum", 50.0}, {"legato", 90.0}, {"harmonic", 1.0}, {"freewheel", 1.0}};
  (void)state;
  for (size_t i = 0; i < sizeof(how) / sizeof(how[0]); ++i) {
    Sound sounds[2] = {sound_new(N_FRAMES), sound_new(N_FRAMES)};
    for (int k = 0; k < 2; ++k) {
      Host* const host = guitar_open(RATE, BLOCK);
      strings_note_on(host, 0, 45, 100);
      strings_note_on(host, 0, 52, 100);
      strings_note_on(host, 0, 64, 100);
      strings_controller(host, 100, 1, 127);
      guitar_send(host, 4700, (GuitarEvent){GUITAR_SLIDE, 4, {5.0f, 0.2f, 0.0f}});
      guitar_send(host, 4710, (GuitarEvent){GUITAR_BEND, 3, {1.0f, 0.1f, 0.0f}});
      strings_note_off(host, 4720, 64);
      strings_run(host, &sounds[k], 0, 4800, BLOCK);
      strings_set(host, how[i].symbol, k ? how[i].value : (double)host_get(host, how[i].symbol));
      strings_run(host, &sounds[k], 4800, N_FRAMES, BLOCK);
      host_free(host);
    }
    assert_true(sound_is_same(&sounds[0], &sounds[1]));
    sound_free(&sounds[0]);
    sound_free(&sounds[1]);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_change_takes_the_block_and_5_ms_at_least),
      cmocka_unit_test(activation_begins_with_the_ports_as_they_are),
      cmocka_unit_test(what_rings_does_not_hear_how_it_will_be_played),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

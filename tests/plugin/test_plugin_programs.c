/* A program change sounds as its preset does that the host loads, and a bank holds until another.
 */
#include "tests/support/measure.h"
#include "tests/support/programs.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { BLOCK = PROGRAMS_BLOCK, CHANGED = 192, N_FRAMES = 16 * BLOCK };

/* The shortest glide is as long as the one of any smaller block. */
enum { SMALL = 64 };

static void assert_same_and_free(Host* a, Host* b) {
  programs_assert_same(a, b);
  host_free(a);
  host_free(b);
}

/* From its very first frame on. */
static void each_program_sounds_as_its_preset(void** state) {
  (void)state;
  for (int p = 0; p < PROGRAMS_PLUGINS; ++p) {
    Host* const list = programs_open(p);
    for (uint32_t k = 0; k < host_n_presets(list); ++k) {
      Host* const preset = programs_open(p);
      Host* const program = programs_open(p);
      print_message("%s\n", host_preset_label(list, k));
      assert_true(host_preset(preset, host_preset_uri(list, k)));
      programs_select(program, 0, presets_place(list, k));
      assert_same_and_free(preset, program);
    }
    host_free(list);
  }
}

static void begin(Host* host) {
  strings_note_on(host, 0, 45, 100);
  strings_note_on(host, 10, 57, 80);
  strings_note_on(host, CHANGED + 100, 52, 100);
}

static Sound load_in_mid_note(int plugin, const char* uri) {
  Host* const host = programs_open(plugin);
  Sound sound = sound_new(N_FRAMES);
  begin(host);
  strings_run(host, &sound, 0, CHANGED, SMALL);
  assert_true(host_preset(host, uri));
  strings_run(host, &sound, CHANGED, N_FRAMES, SMALL);
  host_free(host);
  return sound;
}

static Sound change_in_mid_note(int plugin, PresetPlace place, uint32_t block) {
  Host* const host = programs_open(plugin);
  Sound sound = sound_new(N_FRAMES);
  begin(host);
  programs_select(host, CHANGED, place);
  strings_run(host, &sound, 0, N_FRAMES, block);
  host_free(host);
  return sound;
}

/* It glides there as ports do, at its frame and whatever the blocks, in the first one too. */
static void a_program_in_mid_note_glides_as_its_preset(void** state) {
  (void)state;
  for (int p = 0; p < PROGRAMS_PLUGINS; ++p) {
    Host* const list = programs_open(p);
    for (uint32_t k = 0; k < host_n_presets(list); ++k) {
      Sound loaded = load_in_mid_note(p, host_preset_uri(list, k));
      Sound changed = change_in_mid_note(p, presets_place(list, k), BLOCK);
      Sound small = change_in_mid_note(p, presets_place(list, k), 7);
      assert_true(measure_peak(loaded.left, N_FRAMES) > 1e-3);
      assert_true(sound_is_same(&loaded, &changed));
      assert_true(sound_is_same(&loaded, &small));
      sound_free(&loaded);
      sound_free(&changed);
      sound_free(&small);
    }
    host_free(list);
  }
}

/* What is struck at the same frame, before it, glides too. */
static void a_note_before_its_program_is_not_lost(void** state) {
  const uint8_t note_on[3] = {0x90, 50, 100};
  (void)state;
  for (int p = 0; p < PROGRAMS_PLUGINS; ++p) {
    const char* const label = p ? "Banjo" : "Koto";
    Host* const preset = programs_open(p);
    Host* const program = programs_open(p);
    assert_true(host_midi_raw(preset, 0, note_on, 3));
    strings_note_on(program, 0, 50, 100);
    assert_true(host_run(preset, 0) && host_preset(preset, label));
    programs_select(program, 0, programs_place(program, label));
    Sound loaded = sound_new(N_FRAMES);
    Sound changed = sound_new(N_FRAMES);
    strings_run(preset, &loaded, 0, N_FRAMES, SMALL);
    strings_run(program, &changed, 0, N_FRAMES, BLOCK);
    assert_true(measure_peak(loaded.left, N_FRAMES) > 1e-3);
    assert_true(sound_is_same(&loaded, &changed));
    sound_free(&loaded);
    sound_free(&changed);
    host_free(preset);
    host_free(program);
  }
}

/* Once time has passed, if only in silence, it glides, and a note within that hears it. */
static void a_program_after_silence_glides_too(void** state) {
  (void)state;
  for (int p = 0; p < PROGRAMS_PLUGINS; ++p) {
    const char* const label = p ? "Palm-Muted" : "Koto";
    Host* const preset = programs_open(p);
    Host* const program = programs_open(p);
    Sound loaded = sound_new(N_FRAMES);
    Sound changed = sound_new(N_FRAMES);
    strings_note_on(preset, SMALL + 10, 50, 100);
    strings_note_on(program, SMALL + 10, 50, 100);
    strings_run(preset, &loaded, 0, SMALL, SMALL);
    assert_true(host_preset(preset, label));
    programs_select(program, SMALL, programs_place(program, label));
    strings_run(preset, &loaded, SMALL, N_FRAMES, SMALL);
    strings_run(program, &changed, 0, N_FRAMES, BLOCK);
    assert_true(measure_peak(loaded.left, N_FRAMES) > 1e-3);
    assert_true(sound_is_same(&loaded, &changed));
    sound_free(&loaded);
    sound_free(&changed);
    host_free(preset);
    host_free(program);
  }
}

/* Two hosts at what a preset of this label says. */
static void open_preset(int plugin, const char* label, Host** preset, Host** program) {
  *preset = programs_open(plugin);
  *program = programs_open(plugin);
  assert_true(host_preset(*preset, label));
}

static void a_bank_is_heard_from_the_next_program_on(void** state) {
  (void)state;
  Host* preset;
  Host* program;
  open_preset(0, "Default", &preset, &program);
  const PresetPlace harp = programs_place(program, "Concert Harp");
  strings_controller(program, 0, 0, 0);
  strings_controller(program, 0, 32, harp.bank);
  programs_assert_same(preset, program);
  assert_true(host_preset(preset, "Concert Harp"));
  programs_change(program, 0, 0, harp.program);
  assert_true(host_run(preset, SMALL) && host_run(program, SMALL));
  programs_assert_same(preset, program);
  assert_true(host_preset(preset, "Koto"));
  programs_change(program, 0, 0, programs_place(program, "Koto").program);
  assert_true(host_run(preset, SMALL) && host_run(program, SMALL));
  assert_same_and_free(preset, program);
}

static void at_first_a_program_is_of_the_first_bank(void** state) {
  (void)state;
  Host* preset;
  Host* program;
  open_preset(1, "Clean Bridge", &preset, &program);
  assert_int_equal(programs_place(program, "Clean Bridge").bank, 0);
  programs_change(program, 0, 5, programs_place(program, "Clean Bridge").program);
  assert_same_and_free(preset, program);
}

static void each_channel_has_its_own_bank(void** state) {
  (void)state;
  Host* preset;
  Host* program;
  open_preset(0, "Koto", &preset, &program);
  const PresetPlace koto = programs_place(program, "Koto");
  strings_midi(program, 0, 0xB0 | 3, 32, koto.bank);
  programs_change(program, 0, 3, koto.program);
  assert_same_and_free(preset, program);
  open_preset(0, "Nylon Guitar", &preset, &program);
  assert_int_equal(programs_place(program, "Nylon Guitar").program, koto.program);
  strings_midi(program, 0, 0xB0 | 3, 32, koto.bank);
  programs_change(program, 0, 2, koto.program);
  assert_same_and_free(preset, program);
}

/* The bank is 128 times the upper controller and the lower one. */
static void what_there_is_not_is_ignored(void** state) {
  static const struct {
    uint32_t upper, lower, program;
  } cases[] = {{0, 0, 127}, {0, 127, 0}, {0, 1, 100}, {0, 0, 100},
               {1, 0, 1},   {127, 2, 1}, {0, 8, 0}};
  (void)state;
  for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); ++i) {
    Host* preset;
    Host* program;
    open_preset(0, "Concert Harp", &preset, &program);
    programs_select(program, 0, programs_place(program, "Concert Harp"));
    strings_controller(program, 0, 0, cases[i].upper);
    strings_controller(program, 0, 32, cases[i].lower);
    programs_change(program, 0, 0, cases[i].program);
    assert_same_and_free(preset, program);
  }
}

/* Neither a reset of controllers nor what is no whole message. */
static void a_bank_outlasts_other_messages(void** state) {
  (void)state;
  Host* preset;
  Host* program;
  open_preset(0, "Koto", &preset, &program);
  const PresetPlace koto = programs_place(program, "Koto");
  const uint8_t long_change[3] = {0xC0, 0, 0};
  strings_controller(preset, 0, STRINGS_RESET, 0);
  strings_controller(program, 0, 32, koto.bank);
  strings_controller(program, 0, STRINGS_RESET, 0);
  assert_true(host_run(preset, SMALL) && host_run(program, SMALL));
  programs_change(program, 0, 0, koto.program);
  assert_true(host_midi(program, 1, long_change, 3));
  assert_true(host_run(preset, BLOCK) && host_run(program, BLOCK));
  strings_restart(preset);
  strings_restart(program);
  assert_same_and_free(preset, program);
}

/* What no preset sets is not touched, and a mute stays one. */
static void other_ports_stay_as_they_are(void** state) {
  (void)state;
  Host* preset;
  Host* program;
  open_preset(1, "Electric Bass", &preset, &program);
  programs_select(program, 0, programs_place(program, "Electric Bass"));
  Host* const both[] = {preset, program};
  for (int i = 0; i < 2; ++i) {
    strings_set(both[i], "tuning", 415.0);
    strings_set(both[i], "strum", 20.0);
    strings_set(both[i], "limiter", 0.0);
  }
  programs_assert_same(preset, program);
  strings_set(program, "enabled", 0.0);
  programs_select(program, 3, programs_place(program, "Banjo"));
  Sound dying = programs_play(program);
  Sound dead = programs_play(program);
  assert_true(measure_peak(dead.left, dead.n_frames) == 0.0);
  sound_free(&dying);
  sound_free(&dead);
  host_free(preset);
  host_free(program);
}

/* A program is a setting, and a bank a gesture. */
static void a_program_outlasts_a_restart_and_a_bank_does_not(void** state) {
  (void)state;
  Host* preset;
  Host* program;
  open_preset(0, "Koto", &preset, &program);
  const PresetPlace koto = programs_place(program, "Koto");
  programs_select(program, 0, koto);
  assert_true(host_run(program, BLOCK));
  strings_restart(program);
  programs_assert_same(preset, program);
  strings_restart(program);
  strings_restart(preset);
  programs_change(program, 0, 0, koto.program);
  assert_true(host_preset(preset, "Nylon Guitar"));
  assert_same_and_free(preset, program);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_program_sounds_as_its_preset),
      cmocka_unit_test(a_program_in_mid_note_glides_as_its_preset),
      cmocka_unit_test(a_note_before_its_program_is_not_lost),
      cmocka_unit_test(a_program_after_silence_glides_too),
      cmocka_unit_test(a_bank_is_heard_from_the_next_program_on),
      cmocka_unit_test(at_first_a_program_is_of_the_first_bank),
      cmocka_unit_test(each_channel_has_its_own_bank),
      cmocka_unit_test(what_there_is_not_is_ignored),
      cmocka_unit_test(a_bank_outlasts_other_messages),
      cmocka_unit_test(other_ports_stay_as_they_are),
      cmocka_unit_test(a_program_outlasts_a_restart_and_a_bank_does_not),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

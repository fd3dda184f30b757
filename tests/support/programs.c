#include "tests/support/programs.h"

#include "tests/support/guitar_host.h"
#include "tests/support/measure.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { N_FRAMES = 24 * PROGRAMS_BLOCK };

Host* programs_open(int plugin) {
  return plugin ? guitar_open(PROGRAMS_RATE, PROGRAMS_BLOCK)
                : strings_open(PROGRAMS_RATE, PROGRAMS_BLOCK);
}

void programs_change(Host* host, size_t frame, unsigned channel, uint32_t program) {
  const uint8_t bytes[2] = {(uint8_t)(0xC0 | channel), (uint8_t)program};
  assert_true(host_midi(host, (uint32_t)frame, bytes, 2));
}

void programs_select(Host* host, size_t frame, PresetPlace place) {
  strings_controller(host, frame, 0, 0);
  strings_controller(host, frame, 32, place.bank);
  programs_change(host, frame, 0, place.program);
}

PresetPlace programs_place(Host* host, const char* label) {
  for (uint32_t k = 0; k < host_n_presets(host); ++k) {
    if (!strcmp(host_preset_label(host, k), label)) {
      return presets_place(host, k);
    }
  }
  fail_msg("there is no preset %s", label);
  return (PresetPlace){0, 0};
}

Sound programs_play(Host* host) {
  Sound sound = sound_new(N_FRAMES);
  strings_note_on(host, 0, 45, 100);
  strings_note_on(host, N_FRAMES / 2, 62, 90);
  strings_run(host, &sound, 0, N_FRAMES, PROGRAMS_BLOCK);
  return sound;
}

static bool are_same(Host* a, Host* b) {
  Sound of_a = programs_play(a);
  Sound of_b = programs_play(b);
  const bool answer = sound_is_same(&of_a, &of_b);
  assert_true(measure_peak(of_a.left, N_FRAMES) > 1e-3);
  sound_free(&of_a);
  sound_free(&of_b);
  return answer;
}

void programs_assert_same(Host* a, Host* b) {
  assert_true(are_same(a, b));
}

void programs_assert_other(Host* a, Host* b) {
  assert_false(are_same(a, b));
}

ProgramPair programs_open_pair(int plugin) {
  static const char* const labels[PROGRAMS_PLUGINS] = {"Koto", "Banjo"};
  ProgramPair pair = {programs_open(plugin), programs_open(plugin), {0, 0}};
  pair.place = programs_place(pair.program, labels[plugin]);
  assert_true(host_preset(pair.preset, labels[plugin]));
  programs_select(pair.program, 0, pair.place);
  programs_run(pair);
  return pair;
}

void programs_close_pair(ProgramPair pair) {
  host_free(pair.preset);
  host_free(pair.program);
}

void programs_run(ProgramPair pair) {
  assert_true(host_run(pair.preset, PROGRAMS_BLOCK) && host_run(pair.program, PROGRAMS_BLOCK));
}

void programs_set(ProgramPair pair, const char* symbol, double value) {
  strings_set(pair.preset, symbol, value);
  strings_set(pair.program, symbol, value);
}

void programs_assert_pair(ProgramPair pair) {
  programs_run(pair);
  programs_assert_same(pair.preset, pair.program);
}

#include "tests/support/plugins.h"

#include "tests/support/guitar_host.h"
#include "tests/support/measure.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { N_FRAMES = 24 * PLUGINS_BLOCK };

Host* plugins_open(int plugin) {
  return plugin ? guitar_open(PLUGINS_RATE, PLUGINS_BLOCK)
                : strings_open(PLUGINS_RATE, PLUGINS_BLOCK);
}

Sound plugins_play(Host* host) {
  Sound sound = sound_new(N_FRAMES);
  strings_note_on(host, 0, 45, 100);
  strings_note_on(host, N_FRAMES / 2, 62, 90);
  strings_run(host, &sound, 0, N_FRAMES, PLUGINS_BLOCK);
  return sound;
}

void plugins_assert_same(Host* a, Host* b) {
  Sound of_a = plugins_play(a);
  Sound of_b = plugins_play(b);
  assert_true(measure_peak(of_a.left, N_FRAMES) > 1e-3);
  assert_true(sound_is_same(&of_a, &of_b));
  sound_free(&of_a);
  sound_free(&of_b);
}

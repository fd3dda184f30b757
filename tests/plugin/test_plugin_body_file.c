/* A body from a file is heard as one of Hooke's own: through a host, of both plugins. */
#include "tests/support/guitar_host.h"
#include "tests/support/host_state.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/scale_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 256, N_FRAMES = 64 * BLOCK, CHANGE = 24 * BLOCK };

/* A file's body is leveled anew, which moves it by the rounding of a double; what is heard is
 * rounded to floats, and its peak is less than 1. */
static const double MOST_UNLIKE = 1e-6;

static const char* parameter_of(bool is_guitar) {
  return is_guitar ? GUITAR_URI "#body" : BODY_PARAMETER;
}

static Host* open_with(bool is_guitar, BodiesChoice choice) {
  Host* const host = is_guitar ? guitar_open(RATE, BLOCK) : strings_open(RATE, BLOCK);
  strings_set(host, "body", choice);
  strings_set(host, "body_mix", 1.0);
  return host;
}

/* Nothing has sounded; the file is read in a run of no frames. */
static Host* open_file(bool is_guitar, const ScalePath* path) {
  Host* const host = open_with(is_guitar, BODIES_FILE);
  assert_true(host_set_file(host, parameter_of(is_guitar), path->text));
  return host;
}

static Sound play(Host* host, size_t from, size_t to) {
  Sound sound = sound_new(N_FRAMES);
  strings_run(host, &sound, from, to, BLOCK);
  return sound;
}

/* A note of each of two voices. */
static Sound note_of(Host* host) {
  strings_note_on(host, 0, 45, 100);
  strings_note_on(host, 3000, 61, 80);
  Sound sound = play(host, 0, N_FRAMES);
  host_free(host);
  return sound;
}

static double unlike(const Sound* a, const Sound* b) {
  double most = 0.0;
  for (size_t i = 0; i < a->n_frames; ++i) {
    most = fmax(most, fabs((double)a->left[i] - (double)b->left[i]));
    most = fmax(most, fabs((double)a->right[i] - (double)b->right[i]));
  }
  return most;
}

static void a_file_is_heard_as_the_body_that_it_is(void** state) {
  const ScalePath directory = scale_new_directory();
  (void)state;
  for (int is_guitar = 0; is_guitar < 2; ++is_guitar) {
    for (BodiesChoice choice = BODIES_NONE + 1; choice < BODIES_FILE; ++choice) {
      const ScalePath path = scale_write_body(&directory, "a.body", choice);
      Sound of_file = note_of(open_file(is_guitar, &path));
      Sound shipped = note_of(open_with(is_guitar, choice));
      Sound none = note_of(open_with(is_guitar, BODIES_NONE));
      assert_within("of a peak", unlike(&of_file, &shipped), MOST_UNLIKE);
      assert_true(is_guitar || unlike(&of_file, &none) > 0.01);
      sound_free(&of_file);
      sound_free(&shipped);
      sound_free(&none);
    }
  }
  scale_remove_directory(&directory);
}

/* Missing, broken, cut short, too large, or of too many modes: none, and the log says why, once. */
static void what_is_no_body_sounds_as_none(void** state) {
  enum { TOO_MANY = BODY_MAX_MODES + 1, TOO_LARGE = (1 << 20) + 1 };
  static char many[TOO_MANY * 32];
  static char large[TOO_LARGE + 1];
  const struct {
    const char* file;
    const char* text; /* NULL: there is no such file */
    const char* said;
  } wrong[] = {
      {"no.body", NULL,
       "no.body:1: found no text (No such file or directory), expected a table of modes (.body)"},
      {"word.body", "# mine\nmode 100 20 0.1 1 1\nmood 200 20 0.1 1 1\n",
       "word.body:3: found 'mood', expected "},
      {"cut.body", "mode 100 20 0.1 1 1\nmode 200 2",
       "cut.body:2: found the end of the line, expected a mass from"},
      {"empty.body", "", "empty.body:1: found "},
      {"deaf.body", "mode 100 20 0.1 0 0\n", "deaf.body:1: found "},
      {"q.body", "mode 100 nan 0.1 1 1\n", "q.body:1: found 'nan', expected a Q from"},
      {"many.body", many, "many.body:257: found a mode at "},
      {"large.body", large, "large.body:1: found a longer text, expected one of at most"},
      {"letter", "Dear all,\n", "letter:1: found 'Dear', expected "},
  };
  const ScalePath directory = scale_new_directory();
  (void)state;
  for (int i = 0; i < TOO_MANY; ++i) {
    strcat(many + 20 * i, "mode 100 20 .1 1  1\n");
  }
  memset(large, '\n', TOO_LARGE);
  for (int is_guitar = 0; is_guitar < 2; ++is_guitar) {
    Sound none = note_of(open_with(is_guitar, BODIES_NONE));
    const ScalePath good = scale_write_body(&directory, "good.body", BODIES_VIOLIN);
    for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); ++i) {
      ScalePath path = scale_write(&directory, wrong[i].file, wrong[i].text ? wrong[i].text : "");
      ScalePath told;
      assert_true(wrong[i].text || !remove(path.text));
      Host* const host = open_file(is_guitar, &good);
      scale_log_begin();
      assert_true(host_set_file(host, parameter_of(is_guitar), path.text));
      char* const said = scale_log_end();
      assert_non_null(strstr(said, wrong[i].said));
      assert_ptr_equal(strchr(said, '\n'), said + strlen(said) - 1);
      free(said);
      scale_get(host, parameter_of(is_guitar));
      assert_true(host_run(host, 0) && scale_told(host, parameter_of(is_guitar), &told));
      assert_string_equal(told.text, path.text);
      Sound sound = note_of(host);
      assert_true(sound_is_same(&sound, &none));
      sound_free(&sound);
    }
    sound_free(&none);
  }
  scale_remove_directory(&directory);
}

/* As it goes there when the port moves, though no port does. */
static void what_sounds_goes_to_the_new_body(void** state) {
  const ScalePath directory = scale_new_directory();
  (void)state;
  for (int is_guitar = 0; is_guitar < 2; ++is_guitar) {
    const ScalePath before = scale_write_body(&directory, "before.body", BODIES_VIOLIN);
    const ScalePath after = scale_write_body(&directory, "after.body", BODIES_GRAND);
    Sound sounds[2];
    for (int i = 0; i < 2; ++i) {
      Host* const host = i ? open_with(is_guitar, BODIES_VIOLIN) : open_file(is_guitar, &before);
      sounds[i] = sound_new(N_FRAMES);
      strings_note_on(host, 0, 45, 100);
      strings_run(host, &sounds[i], 0, CHANGE, BLOCK);
      if (i) {
        strings_set(host, "body", BODIES_GRAND);
      } else {
        assert_true(host_set_file(host, parameter_of(is_guitar), after.text));
      }
      strings_run(host, &sounds[i], CHANGE, N_FRAMES, BLOCK);
      host_free(host);
    }
    assert_within("of a peak", unlike(&sounds[0], &sounds[1]), MOST_UNLIKE);
    sound_free(&sounds[0]);
    sound_free(&sounds[1]);
  }
  scale_remove_directory(&directory);
}

/* Not a bit is another, though the body rings: of what was there already, of a scale that is loaded
 * beside it, and of a body while another is chosen. */
static void what_is_no_new_body_is_not_heard(void** state) {
  const ScalePath directory = scale_new_directory();
  const ScalePath path = scale_write_body(&directory, "a.body", BODIES_BANJO);
  const ScalePath copy = scale_write_body(&directory, "copy.body", BODIES_BANJO);
  const ScalePath mapping = scale_write(&directory, "a.kbm", "0\n0\n127\n60\n69\n440\n0\n");
  const ScalePath other = scale_write_body(&directory, "other.body", BODIES_CELLO);
  const struct {
    BodiesChoice choice;
    const ScalePath* file; /* NULL: a session's */
  } again[] = {{BODIES_FILE, &path},
               {BODIES_FILE, &copy},
               {BODIES_FILE, &mapping},
               {BODIES_FILE, NULL},
               {BODIES_HARP, &other}};
  (void)state;
  for (int is_guitar = 0; is_guitar < 2; ++is_guitar) {
    for (size_t i = 0; i < sizeof(again) / sizeof(again[0]); ++i) {
      Sound sounds[2];
      for (int k = 0; k < 2; ++k) {
        Host* const host = open_file(is_guitar, &path);
        strings_set(host, "body", again[i].choice);
        sounds[k] = sound_new(N_FRAMES);
        strings_note_on(host, 0, 45, 100);
        strings_run(host, &sounds[k], 0, CHANGE, BLOCK);
        LilvState* const saved = host_save_state(host);
        if (k && again[i].file) {
          assert_true(host_set_file(host, parameter_of(is_guitar), again[i].file->text));
        } else if (k) {
          host_restore_state(host, saved);
        }
        strings_run(host, &sounds[k], CHANGE, N_FRAMES, BLOCK);
        lilv_state_free(saved);
        host_free(host);
      }
      assert_true(sound_is_same(&sounds[0], &sounds[1]));
      sound_free(&sounds[0]);
      sound_free(&sounds[1]);
    }
  }
  scale_remove_directory(&directory);
}

/* Stop, start and bypass are no reason to forget; an empty path is. */
static void it_keeps_its_body_until_it_is_taken_away(void** state) {
  const ScalePath directory = scale_new_directory();
  const ScalePath path = scale_write_body(&directory, "a.body", BODIES_CELLO);
  const ScalePath empty = {""};
  (void)state;
  for (int is_guitar = 0; is_guitar < 2; ++is_guitar) {
    Host* const kept = open_file(is_guitar, &path);
    Host* const taken = open_file(is_guitar, &path);
    for (int i = 0; i < 3; ++i) {
      strings_restart(kept);
      strings_set(kept, "enabled", i == 1 ? 0.0 : 1.0);
      assert_true(host_run(kept, 0) && host_run(kept, 64));
    }
    strings_restart(kept);
    assert_true(host_set_file(taken, parameter_of(is_guitar), empty.text));
    Sound sounds[] = {note_of(kept), note_of(open_with(is_guitar, BODIES_CELLO)), note_of(taken),
                      note_of(open_with(is_guitar, BODIES_NONE))};
    assert_within("of a peak", unlike(&sounds[0], &sounds[1]), MOST_UNLIKE);
    assert_true(sound_is_same(&sounds[2], &sounds[3]));
    for (int i = 0; i < 4; ++i) {
      sound_free(&sounds[i]);
    }
  }
  scale_remove_directory(&directory);
}

/* Ports and property, by a directory that lilv writes and reads. */
static void a_session_brings_its_body_back(void** state) {
  (void)state;
  for (int is_guitar = 0; is_guitar < 2; ++is_guitar) {
    const ScalePath directory = scale_new_directory();
    const ScalePath session = scale_new_directory();
    const ScalePath path = scale_write_body(&directory, "a.body", BODIES_VIOLIN);
    ScalePath told;
    Host* const before = open_file(is_guitar, &path);
    assert_true(host_save_state_dir(before, session.text));
    Host* const after = open_with(is_guitar, BODIES_NONE);
    LilvState* const saved = host_load_state_dir(after, session.text);
    assert_non_null(saved);
    host_restore_state(after, saved);
    lilv_state_free(saved);
    assert_true(host_run(after, 0));
    assert_true(scale_told(after, parameter_of(is_guitar), &told));
    assert_int_equal(strncmp(told.text, session.text, strlen(session.text)), 0);
    Sound sounds[] = {note_of(before), note_of(after)};
    assert_true(sound_is_same(&sounds[0], &sounds[1]));
    sound_free(&sounds[0]);
    sound_free(&sounds[1]);
    scale_remove_directory(&session);
    scale_remove_directory(&directory);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_file_is_heard_as_the_body_that_it_is),
      cmocka_unit_test(what_is_no_body_sounds_as_none),
      cmocka_unit_test(what_sounds_goes_to_the_new_body),
      cmocka_unit_test(what_is_no_new_body_is_not_heard),
      cmocka_unit_test(it_keeps_its_body_until_it_is_taken_away),
      cmocka_unit_test(a_session_brings_its_body_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* The same notes, wheels, pedals and scripts give the same samples, however the frames are cut into
 * blocks; right or wrong, in both modes. */
#include "tests/support/guitar_host.h"
#include "tests/support/guitar_storm.h"
#include "tests/support/measure.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { RATE = 48000, LARGEST = 1000, N_FRAMES = 24000, N_EVENTS = 300 };

/* What is sent and how the guitar is set. */
typedef struct {
  bool has_midi, has_script;
  double mode, strum, harmonic, course;
} Piece;

static const Piece pieces[] = {
    {true, false, 0.0, 0.0, 0.0, 0.0},  {true, false, 1.0, 0.0, 0.0, 0.0},
    {true, false, 0.0, 23.0, 0.0, 0.6}, {true, false, 0.0, 0.0, 1.0, 0.0},
    {true, false, 1.0, 7.0, 3.0, 0.3},  {false, true, 0.0, 0.0, 0.0, 0.0},
    {false, true, 0.0, 0.0, 0.0, 1.0},  {true, true, 0.0, 11.0, 0.0, 0.0},
    {true, true, 1.0, 40.0, 2.0, 0.5},  {true, true, 1.0, 0.0, 0.0, 0.0},
};

enum { N_PIECES = sizeof(pieces) / sizeof(pieces[0]) };

/* Some events share a frame, for frames in which much happens have an order. */
static void send_all(Host* host, const Piece* piece, Random random) {
  size_t frame = 0;
  for (uint32_t i = 0; i < N_EVENTS; ++i) {
    const bool is_script = piece->has_script && (!piece->has_midi || random_below(&random, 2));
    frame += random_below(&random, 3) > 0 ? random_below(&random, 2 * N_FRAMES / N_EVENTS) : 0;
    if (frame >= N_FRAMES) {
      return;
    }
    if (is_script) {
      guitar_send(host, frame, guitar_storm_event(&random));
    } else {
      uint8_t bytes[3];
      guitar_storm_midi(&random, bytes);
      assert_true(host_midi(host, (uint32_t)frame, bytes, 3));
    }
  }
}

/* In blocks of `block`; 0: of any, empty ones among them. */
static void run_cut(Host* host, Sound* sound, uint32_t block, Random random) {
  if (block > 0) {
    strings_run(host, sound, 0, N_FRAMES, block);
    return;
  }
  for (size_t at = 0; at < N_FRAMES;) {
    const size_t wanted = (size_t)random_log_between(&random, 1.0, LARGEST + 1.0);
    const size_t n = wanted < N_FRAMES - at ? wanted : N_FRAMES - at;
    assert_true(random_below(&random, 4) > 0 || host_run(host, 0));
    strings_run(host, sound, at, at + n, LARGEST);
    at += n;
  }
}

static Sound play(Host* host, const Piece* piece, Random random, uint32_t block) {
  Sound sound = sound_new(N_FRAMES);
  strings_set(host, "mode", piece->mode);
  strings_set(host, "strum", piece->strum);
  strings_set(host, "harmonic", piece->harmonic);
  strings_set(host, "course", piece->course);
  strings_restart(host);
  send_all(host, piece, random);
  run_cut(host, &sound, block, random);
  return sound;
}

static void blocks_do_not_change_the_sound(void** state) {
  static const uint32_t blocks[] = {1, 7, 64, 0, 0};
  (void)state;
  Random random = random_start();
  Host* const host = guitar_open(RATE, LARGEST);
  for (uint32_t i = 0; i < N_PIECES; ++i) {
    Sound whole = play(host, &pieces[i], random, LARGEST);
    assert_true(measure_peak(whole.left, N_FRAMES) > 0.05);
    for (uint32_t b = 0; b < sizeof(blocks) / sizeof(blocks[0]); ++b) {
      Sound cut = play(host, &pieces[i], random, blocks[b]);
      if (!sound_is_same(&whole, &cut)) {
        fail_msg("piece %u differs in blocks of %u and of %u", i, LARGEST, blocks[b]);
      }
      sound_free(&cut);
    }
    sound_free(&whole);
    (void)random_below(&random, 2);
  }
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(blocks_do_not_change_the_sound),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

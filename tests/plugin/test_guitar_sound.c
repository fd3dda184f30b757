/* Whatever hands do to the guitar, heard through its host, nothing clicks. */
#include "tests/support/guitar_host.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 256, N_STRINGS = 6, CC_VIBRATO = 1, CC_PALM = 67 };

static const uint32_t open_notes[N_STRINGS] = {64, 59, 55, 50, 45, 40};

/* What the instrument promises of pitch. */

static Tone asked_of(const Host* host, uint32_t string, double fret) {
  const double octaves = ((double)open_notes[string] + fret - 69.0) / 12.0;
  return (Tone){(double)host_get(host, "tuning") * exp2(octaves),
                1.0 / ((double)host_get(host, "damping") *
                       exp2((double)host_get(host, "tracking") * octaves))};
}

/* A note is held so long that its pitch can be told, and a gesture is over so soon [frames]. */
enum { HOLD = 14400, AFTER = 2400, GESTURE = 192, SLIDE = 1920 };

/* Who moves the hands. */
typedef enum { BY_SCRIPT, BY_ONE_CHANNEL, BY_CHANNELS, N_PLAYERS } Player;

static uint32_t channel_of(Player player, uint32_t string) {
  return player == BY_CHANNELS ? string : 0;
}

static void start(Host* host, Player player) {
  strings_set(host, "mode", player == BY_CHANNELS ? 1.0 : 0.0);
  strings_restart(host);
}

static double force_of(uint32_t velocity) {
  return velocity / 127.0 * (velocity / 127.0);
}

static void pluck(Host* host, Player player, size_t at, uint32_t string, uint32_t fret) {
  if (player == BY_SCRIPT) {
    guitar_send(host, at, (GuitarEvent){GUITAR_FRET, string, {(float)fret}});
    guitar_send(host, at, (GuitarEvent){GUITAR_PLUCK, string, {1.0f, NAN, NAN}});
  } else {
    strings_midi(host, at, 0x90 | channel_of(player, string), open_notes[string] + fret, 127);
  }
}

/* How a finger falls on what rings, and pulls off again half as hard. */
typedef struct {
  Player player;
  uint32_t string, low, high, velocity;
} Finger;

static void fall(Host* host, const Finger* f, size_t at) {
  if (f->player == BY_SCRIPT) {
    const float force = (float)force_of(f->velocity);
    guitar_send(host, at, (GuitarEvent){GUITAR_HAMMER, f->string, {(float)f->high, force}});
  } else {
    strings_midi(host, at, 0x90 | channel_of(f->player, f->string), open_notes[f->string] + f->high,
                 f->velocity);
  }
}

static void lift(Host* host, const Finger* f, size_t at) {
  if (f->player == BY_SCRIPT) {
    const float force = (float)(0.5 * force_of(f->velocity));
    guitar_send(host, at, (GuitarEvent){GUITAR_HAMMER, f->string, {(float)f->low, force}});
  } else {
    strings_midi(host, at, 0x80 | channel_of(f->player, f->string), open_notes[f->string] + f->high,
                 64);
  }
}

/* The largest step from sample to sample, and the largest change of it. */
typedef struct {
  double step, turn;
} Edge;

static Edge edge_of(const Sound* sound, size_t from, size_t to) {
  const float* const s = sound->left;
  Edge edge = {0};
  for (size_t i = from + 2; i < to; ++i) {
    const double step = (double)s[i] - (double)s[i - 1];
    edge.step = fmax(edge.step, fabs(step));
    edge.turn = fmax(edge.turn, fabs(step - ((double)s[i - 1] - (double)s[i - 2])));
  }
  return edge;
}

static Edge larger(Edge a, Edge b) {
  return (Edge){fmax(a.step, b.step), fmax(a.turn, b.turn)};
}

static double over(Edge a, Edge b) {
  return fmax(a.step / b.step, a.turn / b.turn);
}

/* What a hardest pluck makes. */
static Edge edge_of_pluck(Host* host, Player player, uint32_t string, uint32_t fret) {
  Sound sound = sound_new(HOLD);
  start(host, player);
  pluck(host, player, 10, string, fret);
  strings_run(host, &sound, 0, HOLD, BLOCK);
  const Edge edge = edge_of(&sound, 0, HOLD);
  sound_free(&sound);
  return edge;
}

/* A finger that falls on what rings of its hardest pluck, and goes again, over such a pluck. */
static double try_finger(Host* host, const Finger* f) {
  const size_t at[2] = {HOLD + 11 * f->string + 37 * f->high, 2 * HOLD + 13 * f->string};
  Sound sound = sound_new(3 * HOLD);
  const Edge most = larger(edge_of_pluck(host, f->player, f->string, f->low),
                           edge_of_pluck(host, f->player, f->string, f->high));
  start(host, f->player);
  pluck(host, f->player, 10, f->string, f->low);
  fall(host, f, at[0]);
  lift(host, f, at[1]);
  strings_run(host, &sound, 0, sound.n_frames, BLOCK);
  const Edge edge =
      larger(edge_of(&sound, at[0] - 2, at[0] + AFTER), edge_of(&sound, at[1] - 2, at[1] + AFTER));
  /* It fell on what rang, and what rings goes on below it. */
  assert_true(
      strings_measure(&sound, RATE, at[0] + 480, at[1], asked_of(host, f->string, f->high)).cents <
      1.0);
  assert_true(
      strings_measure(&sound, RATE, at[1] + 480, sound.n_frames, asked_of(host, f->string, f->low))
          .cents < 1.0);
  sound_free(&sound);
  return over(edge, most);
}

/* A finger that falls without force is not heard; one of full force is 0.4 of a pluck, and added to
 * what rings. */
static void fingers_make_no_more_than_a_pluck(void** state) {
  static const uint32_t frets[][2] = {{0, 1}, {0, 5}, {3, 7}, {5, 7}, {12, 15}, {17, 22}};
  double worst[2] = {0};
  (void)state;
  Host* const host = guitar_open(RATE, BLOCK);
  strings_set(host, "legato", 127.0);
  strings_set(host, "hardness", 0.4); /* As the finger's */
  for (uint32_t i = 0; i < 36 * N_PLAYERS; ++i) {
    const uint32_t* const pair = frets[i / N_STRINGS % 6];
    Finger finger = {(Player)(i / 36), i % N_STRINGS, pair[0], pair[1], 1};
    if (finger.player == BY_ONE_CHANNEL && finger.high > finger.low + 2) {
      finger.high = finger.low + 2; /* Farther notes are plucked there. */
    }
    worst[0] = fmax(worst[0], try_finger(host, &finger));
    finger.velocity = 127;
    worst[1] = fmax(worst[1], try_finger(host, &finger));
  }
  /* What rang keeps its amplitude at the higher fret, where it is read at another part of it. */
  assert_within("largest edge without force, of a pluck's", worst[0], 1.1);
  assert_within("with all of it", worst[1], 1.4);
  host_free(host);
}

/* What else is done to a string that rings. */
typedef enum {
  DO_NOTE_OFF,
  DO_ALL_NOTES_OFF,
  DO_PALM,
  DO_VIBRATO,
  DO_BEND_UP,
  DO_BEND_DOWN,
  DO_SLIDE,
  DO_FRET,
  DO_TOUCH,
  DO_CAPO,
  DO_LEVEL,
  DO_SOUND_OFF,
  N_DEEDS
} Deed;

static const char* const deeds[N_DEEDS] = {"note off", "all notes off", "palm",  "vibrato",
                                           "bend up",  "bend down",     "slide", "fret",
                                           "touch",    "capo",          "level", "all sound off"};

static void act(Host* host, Deed deed, size_t at, uint32_t channel, uint32_t string) {
  const uint32_t cc = 0xB0 | channel;
  switch (deed) {
  case DO_NOTE_OFF:
    strings_midi(host, at, 0x80 | channel, open_notes[string] + 2, 64);
    break;
  case DO_ALL_NOTES_OFF:
    strings_midi(host, at, cc, STRINGS_NOTES_OFF, 0);
    break;
  case DO_PALM:
    strings_midi(host, at, cc, CC_PALM, 127);
    break;
  case DO_VIBRATO:
    strings_midi(host, at, cc, CC_VIBRATO, 127);
    break;
  case DO_BEND_UP:
  case DO_BEND_DOWN:
    strings_midi(host, at, 0xE0 | channel, 0, deed == DO_BEND_UP ? 127 : 0);
    break;
  case DO_SLIDE:
    guitar_send(host, at, (GuitarEvent){GUITAR_SLIDE, string, {9.0f, (float)SLIDE / RATE}});
    break;
  case DO_FRET:
    guitar_send(host, at, (GuitarEvent){GUITAR_FRET, string, {5.0f}});
    break;
  case DO_TOUCH:
    guitar_send(host, at, (GuitarEvent){GUITAR_TOUCH, string, {0.5f, 0.02f}});
    break;
  case DO_CAPO:
  case DO_LEVEL:
  case DO_SOUND_OFF:
  case N_DEEDS:
    strings_midi(host, at, cc, STRINGS_SOUND_OFF, 0);
    break;
  }
}

/* The edges while it is done, over those of a hardest pluck, or of what then goes on to ring:
 * partials that a bend brought nearer in phase are no click. */
static double try_deed(Host* host, Deed deed, Player player, uint32_t string, uint32_t when) {
  const size_t at = 2 * AFTER + 37 * when;
  const size_t done = at + 3 * GESTURE + (deed == DO_SLIDE ? SLIDE : 0);
  Sound sound = sound_new(at + 3 * AFTER);
  start(host, player);
  pluck(host, player, 10, string, 2);
  strings_run(host, &sound, 0, at, BLOCK);
  if (deed == DO_CAPO) {
    strings_set(host, "capo", 5.0);
  } else if (deed == DO_LEVEL) {
    strings_set(host, "level", -20.0);
  } else {
    act(host, deed, 2, channel_of(player, string), string);
  }
  strings_run(host, &sound, at, sound.n_frames, BLOCK);
  strings_set(host, "capo", 0.0);
  strings_set(host, "level", 0.0);
  Edge most =
      larger(edge_of_pluck(host, player, string, 2), edge_of_pluck(host, player, string, 9));
  most = larger(most, edge_of(&sound, done, sound.n_frames));
  const double worst = over(edge_of(&sound, at - 2, done), most);
  sound_free(&sound);
  return worst;
}

static void nothing_else_makes_more_than_a_pluck(void** state) {
  double worst = 0.0;
  (void)state;
  Host* const host = guitar_open(RATE, BLOCK);
  strings_set(host, "hardness", 0.2); /* Soft, so that clicks are heard, */
  strings_set(host, "damping", 0.05); /* and what rings on stays as loud. */
  strings_set(host, "loss", 1e-5);
  for (Deed deed = 0; deed < N_DEEDS; ++deed) {
    double most = 0.0;
    for (uint32_t i = 0; i < 6 * N_STRINGS; ++i) {
      const Player player = i % 2 ? BY_CHANNELS : BY_ONE_CHANNEL;
      most = fmax(most, try_deed(host, deed, player, i % N_STRINGS, i / N_STRINGS));
    }
    print_message("  %-14s %.3f of a pluck's\n", deeds[deed], most);
    worst = fmax(worst, most);
  }
  /* While what a pickup reads fades from one place to another both are heard: a little more. */
  /* What slides up keeps its amplitude, too. */
  assert_within("largest edge, of a pluck's", worst, 1.1);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(fingers_make_no_more_than_a_pluck),
      cmocka_unit_test(nothing_else_makes_more_than_a_pluck),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

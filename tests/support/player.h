/** Somebody who sends MIDI messages to an instrument that writes down what comes of them. */
#ifndef HOOKE_TESTS_SUPPORT_PLAYER_H
#define HOOKE_TESTS_SUPPORT_PLAYER_H

#include "core/play/channels.h"
#include "tests/support/recorder.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

/* Controllers, in the tests' own words. */
enum {
  CC_VIBRATO = 1,
  CC_BREATH = 2,
  CC_DATA = 6,
  CC_VOLUME = 7,
  CC_EXPRESSION = 11,
  CC_DATA_LOWER = 38,
  CC_SUSTAIN = 64,
  CC_SOSTENUTO = 66,
  CC_SOFT = 67,
  CC_BRIGHTNESS = 74,
  CC_INCREMENT = 96,
  CC_DECREMENT = 97,
  CC_NRPN_LOWER = 98,
  CC_NRPN_UPPER = 99,
  CC_RPN_LOWER = 100,
  CC_RPN_UPPER = 101,
  CC_SOUND_OFF = 120,
  CC_RESET = 121,
  CC_NOTES_OFF = 123,
};

typedef struct {
  Recorder* recorder;
  Channels channels;
} Player;

static inline Player player_new(void) {
  Player player = {.recorder = calloc(1, sizeof(Recorder))};
  assert_non_null(player.recorder);
  player.channels.to = recorder_performance(player.recorder);
  channels_reset(&player.channels);
  return player;
}

static inline void player_free(Player* player) {
  free(player->recorder);
}

/** Forget what was done so far. */
static inline void player_forget(Player* player) {
  player->recorder->n_calls = 0;
}

/** Channels are counted from 1, as musicians do. */
static inline void send(Player* player, unsigned kind, unsigned channel, unsigned a, unsigned b) {
  const uint8_t bytes[3] = {(uint8_t)(kind | (channel - 1)), (uint8_t)a, (uint8_t)b};
  channels_play(&player->channels, bytes, kind == 0xC0 || kind == 0xD0 ? 2 : 3, false);
}

static inline void on(Player* player, unsigned channel, unsigned key) {
  send(player, 0x90, channel, key, 100);
}

static inline void off(Player* player, unsigned channel, unsigned key) {
  send(player, 0x80, channel, key, 64);
}

static inline void control(Player* player, unsigned channel, unsigned number, unsigned value) {
  send(player, 0xB0, channel, number, value);
}

/** From −8192 to 8191. */
static inline void wheel(Player* player, unsigned channel, int value) {
  const unsigned bits = (unsigned)(value + 8192);
  send(player, 0xE0, channel, bits & 0x7F, bits >> 7);
}

static inline void press(Player* player, unsigned channel, unsigned value) {
  send(player, 0xD0, channel, value, 0);
}

static inline void choose(Player* player, unsigned channel, unsigned parameter) {
  control(player, channel, CC_RPN_UPPER, parameter >> 7);
  control(player, channel, CC_RPN_LOWER, parameter & 0x7F);
}

static inline void
set_parameter(Player* player, unsigned channel, unsigned parameter, unsigned value) {
  choose(player, channel, parameter);
  control(player, channel, CC_DATA, value);
}

/** A zone, led by channel 1 or 16. */
static inline void zone(Player* player, unsigned leader, unsigned n_members) {
  set_parameter(player, leader, 6, n_members);
}

/** How often something was done by a channel. */
static inline uint32_t count(const Player* player, uint32_t verb, uint32_t channel) {
  uint32_t n = 0;
  for (uint32_t i = 0; i < player->recorder->n_calls; ++i) {
    const RecordedCall* const call = &player->recorder->calls[i];
    n += call->verb == verb && call->channel == channel - 1;
  }
  return n;
}

/** The last value that was given by a channel; NAN if none was. */
static inline double last(const Player* player, uint32_t verb, uint32_t channel) {
  double value = (double)NAN;
  for (uint32_t i = 0; i < player->recorder->n_calls; ++i) {
    const RecordedCall* const call = &player->recorder->calls[i];
    value = call->verb == verb && call->channel == channel - 1 ? call->value : value;
  }
  return value;
}

/** Whether these are, in doubles' last bits, the same. */
static inline bool is_near(double a, double b) {
  return fabs(a - b) <= 1e-12;
}

static inline void
assert_last(const Player* player, uint32_t verb, uint32_t channel, double expected) {
  const double found = last(player, verb, channel);
  if (!is_near(found, expected)) {
    fail_msg("verb %u of channel %u: %.15g, expected %.15g", verb, channel, found, expected);
  }
}

/** Nothing was done at all. */
static inline void assert_nothing(const Player* player) {
  assert_int_equal(player->recorder->n_calls, 0);
}

/** The last thing done was this, by this channel. */
static inline void
assert_call(const Player* player, uint32_t verb, uint32_t channel, uint32_t key, double value) {
  assert_true(player->recorder->n_calls > 0);
  const RecordedCall* const call = &player->recorder->calls[player->recorder->n_calls - 1];
  assert_int_equal(call->verb, verb);
  assert_int_equal(call->channel, channel - 1);
  assert_int_equal(call->key, key);
  assert_true(is_near(call->value, value));
}

#endif

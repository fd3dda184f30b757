/** Keys that go down and up, and what the guitarist then does with the guitar, in short. */
#ifndef HOOKE_TESTS_SUPPORT_GUITARIST_HANDS_H
#define HOOKE_TESTS_SUPPORT_GUITARIST_HANDS_H

#include "tests/support/guitarist_player.h"

#include <string.h>

static inline void on(Player player, uint32_t channel, uint32_t key, uint32_t velocity) {
  guitarist_note_on(player.guitarist, channel, key, velocity);
}

static inline void off(Player player, uint32_t channel, uint32_t key) {
  guitarist_note_off(player.guitarist, channel, key);
}

/* What was done since the n-th call, a letter each and the string: "f0 p0" is fretted and plucked.
 */
static inline void assert_done(Player player, uint32_t* from, const char* expected) {
  static const char letters[] = "pfhsbvdltmcg";
  char done[1024] = "";
  size_t length = 0;
  for (uint32_t i = *from; i < player.guitar->n_calls; ++i) {
    const RecordedAct* const call = &player.guitar->calls[i];
    assert_true(length + 4 < sizeof done);
    done[length++] = letters[call->verb];
    done[length++] = (char)('0' + call->string);
    done[length++] = ' ';
  }
  done[length > 0 ? length - 1 : 0] = '\0';
  assert_string_equal(done, expected);
  *from = player.guitar->n_calls;
}

static inline void assert_near(double found, double expected) {
  assert_true(fabs(found - expected) < 1e-9);
}

/* What a call says but for its time. */
static inline void assert_last(Player player, uint32_t verb, uint32_t string, double a, double b) {
  const RecordedAct* const call = player_last(player.guitar, verb);
  assert_int_equal(call->string, string);
  assert_near(call->value[0], a);
  assert_near(call->value[1], b);
}

#endif

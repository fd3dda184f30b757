/** Messages to Hooke Guitar in a host beside the orders that its guitarist is to be given for them.
 */
#ifndef HOOKE_TESTS_SUPPORT_ORDERS_H
#define HOOKE_TESTS_SUPPORT_ORDERS_H

#include "tests/support/guitar_host.h"

enum { ORDERS_RATE = 48000, ORDERS_BLOCK = 256, ORDERS_FRAMES = 60 * ORDERS_BLOCK };

enum {
  CC_VIBRATO = 1,
  CC_DATA_UPPER = 6,
  CC_DATA_LOWER = 38,
  CC_DECREMENT = 97,
  CC_PALM = 67,
  CC_OWN_LOWER = 98,
  CC_OWN_UPPER = 99,
  CC_LOWER = 100,
  CC_UPPER = 101,
};

/** What a guitarist can be told. */
typedef enum {
  END,
  ON,
  OFF,
  BEND,
  PEDAL,
  VIBRATO,
  PALM,
  GAIN,
  PRESSURE,
  KEY_PRESSURE,
  BRIGHTNESS,
  SOSTENUTO,
  NOTES_OFF,
  SOUND_OFF
} Verb;

/** With the numbers that its function takes. */
typedef struct {
  Verb verb;
  uint32_t channel;
  double a, b;
} Order;

/** A message, and what is to come of it. */
typedef struct {
  size_t frame;
  uint8_t bytes[3]; /**< All nought: none */
  Order order;
} Step;

/** The plugin with a channel for each string, for host_free(). */
Host* orders_open(void);

/** What a guitarist plays who is given the orders. */
Sound orders_play(const Host* host, const Step* steps, size_t n_steps);

/** What the plugin plays, from rest, that is sent the messages. */
Sound orders_play_messages(Host* host, const Step* steps, size_t n_steps);

/** Whether the two are the same to the last bit. */
bool orders_are_told(Host* host, const Step* steps, size_t n_steps);

#endif

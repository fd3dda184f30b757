#include "tests/support/orders.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static void tell(const Duo* duo, Order order) {
  const uint32_t channel = order.channel;
  switch (order.verb) {
  case ON:
    guitarist_note_on(duo->guitarist, channel, (uint32_t)order.a, (uint32_t)order.b);
    break;
  case OFF:
    guitarist_note_off(duo->guitarist, channel, (uint32_t)order.a);
    break;
  case BEND:
    guitarist_gesture(duo->guitarist, channel, GESTURE_BEND, order.a);
    break;
  case PEDAL:
    guitarist_gesture(duo->guitarist, channel, GESTURE_DAMPER, order.a);
    break;
  case VIBRATO:
    guitarist_gesture(duo->guitarist, channel, GESTURE_VIBRATO, order.a);
    break;
  case PALM:
    guitar_palm(duo->guitar, order.a);
    break;
  case GAIN:
    guitarist_gesture(duo->guitarist, channel, GESTURE_GAIN, order.a);
    break;
  case PRESSURE:
    guitarist_gesture(duo->guitarist, channel, GESTURE_PRESSURE, order.a);
    break;
  case KEY_PRESSURE:
    guitarist_press_key(duo->guitarist, channel, (uint32_t)order.a, order.b);
    break;
  case BRIGHTNESS:
    guitarist_gesture(duo->guitarist, channel, GESTURE_BRIGHTNESS, order.a);
    break;
  case SOSTENUTO:
    guitarist_gesture(duo->guitarist, channel, GESTURE_SOSTENUTO, order.a);
    break;
  case NOTES_OFF:
    guitarist_all_notes_off(duo->guitarist, channel);
    break;
  case SOUND_OFF:
    guitarist_all_sound_off(duo->guitarist, channel);
    break;
  case END:
    break;
  }
}

Host* orders_open(void) {
  Host* const host = guitar_open(ORDERS_RATE, ORDERS_BLOCK);
  strings_set(host, "mode", 1.0);
  return host;
}

Sound orders_play(const Host* host, const Step* steps, size_t n_steps) {
  Duo duo = duo_new(host, ORDERS_RATE);
  Sound sound = sound_new(ORDERS_FRAMES);
  size_t done = 0;
  for (size_t i = 0; i < n_steps; ++i) {
    duo_run(&duo, &sound, done, steps[i].frame);
    done = steps[i].frame;
    tell(&duo, steps[i].order);
  }
  duo_run(&duo, &sound, done, ORDERS_FRAMES);
  duo_free(&duo);
  return sound;
}

Sound orders_play_messages(Host* host, const Step* steps, size_t n_steps) {
  Sound sound = sound_new(ORDERS_FRAMES);
  strings_restart(host);
  for (size_t i = 0; i < n_steps; ++i) {
    const uint8_t* const bytes = steps[i].bytes;
    if (bytes[0]) {
      strings_midi(host, steps[i].frame, bytes[0], bytes[1], bytes[2]);
    }
  }
  strings_run(host, &sound, 0, ORDERS_FRAMES, ORDERS_BLOCK);
  return sound;
}

bool orders_are_told(Host* host, const Step* steps, size_t n_steps) {
  Sound wanted = orders_play(host, steps, n_steps);
  Sound heard = orders_play_messages(host, steps, n_steps);
  const bool is_same = sound_is_same(&wanted, &heard);
  sound_free(&wanted);
  sound_free(&heard);
  return is_same;
}

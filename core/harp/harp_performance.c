#include "core/harp/harp_performance.h"

#include <stddef.h>

static void note_on(void* harp, uint32_t channel, uint32_t key, uint32_t velocity) {
  harp_note_on(harp, channel, key, velocity);
}

static void note_off(void* harp, uint32_t channel, uint32_t key) {
  harp_note_off(harp, channel, key);
}

static void gesture(void* harp, uint32_t channel, Gesture what, double value) {
  switch (what) {
  case GESTURE_BEND:
    harp_bend(harp, channel, value);
    break;
  case GESTURE_PRESSURE:
    harp_press(harp, channel, value);
    break;
  case GESTURE_BRIGHTNESS:
    harp_brighten(harp, channel, value);
    break;
  case GESTURE_VIBRATO:
    harp_vibrato(harp, channel, value);
    break;
  case GESTURE_BREATH:
    harp_breathe(harp, channel, value);
    break;
  case GESTURE_SOFTNESS:
    harp_soften(harp, channel, value);
    break;
  case GESTURE_SOSTENUTO:
    harp_sostenuto(harp, channel, value > 0.0);
    break;
  case GESTURE_DAMPER:
    harp_pedal(harp, channel, value);
    break;
  case GESTURE_GAIN:
    harp_set_gain(harp, channel, value);
    break;
  case N_GESTURES:
    break;
  }
}

static void press_key(void* harp, uint32_t channel, uint32_t key, double pressure) {
  harp_press_key(harp, channel, key, pressure);
}

static void let_go(void* harp, uint32_t channel) {
  harp_let_go(harp, channel);
}

static void all_notes_off(void* harp, uint32_t channel) {
  harp_all_notes_off(harp, channel);
}

static void all_sound_off(void* harp, uint32_t channel) {
  harp_all_sound_off(harp, channel);
}

static void
tune(void* harp, uint32_t channel, const double semitones[PERFORMANCE_KEYS], bool is_live) {
  harp_set_scale(harp, channel, semitones, is_live);
}

Performance harp_performance(Harp* harp) {
  static const PerformanceKind kind = {note_on,       note_off,      gesture, press_key, let_go,
                                       all_notes_off, all_sound_off, NULL,    tune};
  return (Performance){&kind, harp};
}

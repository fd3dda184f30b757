#include "core/harp/harp_hands.h"

void harp_hands_reset(HarpHand hands[HARP_HANDS]) {
  for (uint32_t hand = 0; hand < HARP_HANDS; ++hand) {
    hands[hand] = (HarpHand){.touch = HARP_TOUCH_NONE};
  }
}

static bool is_held_by(const HarpString* string, uint32_t hand) {
  return string->is_down && string->hand == hand;
}

HarpString* harp_hands_held(Harp* harp, uint32_t hand, uint32_t key) {
  if (is_held_by(&harp->strings[key], hand)) {
    return &harp->strings[key];
  }
  for (uint32_t i = HARP_KEYS; i < HARP_STRINGS; ++i) {
    HarpString* const guest = &harp->strings[i];
    if (guest->key == key && is_held_by(guest, hand)) {
      return guest;
    }
  }
  return NULL;
}

/* A guest's string for a key: one that rings at that key, or one at rest. */
static HarpString* find_guest(Harp* harp, uint32_t key) {
  HarpString* found = NULL;
  for (uint32_t i = HARP_KEYS; i < HARP_STRINGS; ++i) {
    HarpString* const guest = &harp->strings[i];
    if (!guest->is_down && guest->voice.is_awake && guest->key == key) {
      return guest;
    }
    if (!guest->is_down && !guest->voice.is_awake && !found) {
      found = guest;
    }
  }
  return found;
}

HarpString* harp_hands_take(Harp* harp, uint32_t hand, uint32_t key) {
  HarpString* const own = &harp->strings[key];
  HarpString* const held = harp_hands_held(harp, hand, key);
  if (held || !own->is_down) {
    return held ? held : own;
  }
  HarpString* const guest = find_guest(harp, key);
  if (guest) {
    guest->key = key;
    guest->semitones = own->semitones;
  }
  return guest ? guest : own;
}

bool harp_hands_follows(const HarpString* string, uint32_t hand) {
  return string->hand == hand && !string->is_let_go;
}

#include "plugin/strings_hands.h"

#include "core/play/rpn.h"

enum { USUAL_CENTS = 200, MEMBER_CENTS = 4800 };

/* One thing that the harp is told of a hand. */
typedef void (*Tell)(const StringsHands* all, uint32_t hand);

static const Hand* leader_of(const StringsHands* all, uint32_t hand) {
  return &all->hands[zones_leader(&all->zones, hand)];
}

static void tell_bend(const StringsHands* all, uint32_t hand) {
  harp_bend(all->harp, hand, hand_bend(leader_of(all, hand), &all->hands[hand]));
}

static void tell_pressure(const StringsHands* all, uint32_t hand) {
  harp_press(all->harp, hand, hand_pressure(leader_of(all, hand), &all->hands[hand]));
}

static void tell_brightness(const StringsHands* all, uint32_t hand) {
  harp_brighten(all->harp, hand, hand_brightness(leader_of(all, hand), &all->hands[hand]));
}

static void tell_vibrato(const StringsHands* all, uint32_t hand) {
  harp_vibrato(all->harp, hand, leader_of(all, hand)->vibrato);
}

static void tell_breath(const StringsHands* all, uint32_t hand) {
  harp_breathe(all->harp, hand, leader_of(all, hand)->breath);
}

static void tell_lift(const StringsHands* all, uint32_t hand) {
  harp_pedal(all->harp, hand, leader_of(all, hand)->lift);
}

static void tell_sostenuto(const StringsHands* all, uint32_t hand) {
  harp_sostenuto(all->harp, hand, leader_of(all, hand)->is_sostenuto);
}

static void tell_softness(const StringsHands* all, uint32_t hand) {
  harp_soften(all->harp, hand, leader_of(all, hand)->softness);
}

static void tell_everything(const StringsHands* all, uint32_t hand) {
  static const Tell tells[] = {tell_bend,   tell_pressure, tell_brightness, tell_vibrato,
                               tell_breath, tell_softness, tell_sostenuto,  tell_lift};
  for (uint32_t i = 0; i < sizeof(tells) / sizeof(tells[0]); ++i) {
    tells[i](all, hand);
  }
}

/* Of `hand`, and of all that follow it. */
static void tell_followers(const StringsHands* all, uint32_t hand, Tell tell) {
  for (uint32_t h = 0; h < ZONES_CHANNELS; ++h) {
    if (strings_hands_follows(all, h, hand)) {
      tell(all, h);
    }
  }
}

static void let_go(StringsHands* all, uint32_t hand) {
  Hand* const h = &all->hands[hand];
  if (strings_hands_is_member(all, hand) && h->has_played && hand_keys_are_none(&h->down)) {
    harp_let_go(all->harp, hand);
    h->has_played = false;
  }
}

void strings_hands_reset(StringsHands* all) {
  all->zones = (Zones){0};
  for (uint32_t h = 0; h < ZONES_CHANNELS; ++h) {
    hand_reset(&all->hands[h], USUAL_CENTS);
  }
}

/* As a bit each. */
static uint32_t hands_changed(const Zones* before, const Zones* after, uint32_t leader) {
  uint32_t changed = 0;
  for (uint32_t channel = 0; channel < ZONES_CHANNELS; ++channel) {
    if (zones_has(after, leader, channel) || !zones_agree(before, after, channel)) {
      changed |= 1u << zones_hand(before, channel) | 1u << zones_hand(after, channel);
    }
  }
  return changed;
}

/* Each hand's leader is reset before the hand is told what comes of both. */
void strings_hands_set_zone(StringsHands* all, uint32_t leader, uint32_t n_members) {
  const Zones before = all->zones;
  zones_set(&all->zones, leader, n_members);
  const uint32_t changed = hands_changed(&before, &all->zones, leader);
  for (uint32_t h = 0; h < ZONES_CHANNELS; ++h) {
    if (changed >> h & 1) {
      harp_all_notes_off(all->harp, h);
      harp_let_go(all->harp, h);
      hand_reset(&all->hands[h], strings_hands_is_member(all, h) ? MEMBER_CENTS : USUAL_CENTS);
    }
  }
  for (uint32_t h = 0; h < ZONES_CHANNELS; ++h) {
    if (changed >> h & 1) {
      tell_everything(all, h);
    }
  }
}

bool strings_hands_is_member(const StringsHands* all, uint32_t hand) {
  return zones_leader(&all->zones, hand) != hand;
}

bool strings_hands_follows(const StringsHands* all, uint32_t hand, uint32_t leader) {
  return hand == leader || zones_leader(&all->zones, hand) == leader;
}

void strings_hands_note_on(StringsHands* all, uint32_t hand, uint32_t key, uint32_t velocity) {
  Hand* const h = &all->hands[hand];
  let_go(all, hand);
  h->has_played = true;
  hand_keys_put(&h->down, key, true);
  harp_note_on(all->harp, hand, key, velocity);
}

void strings_hands_note_off(StringsHands* all, uint32_t hand, uint32_t key) {
  hand_keys_put(&all->hands[hand].down, key, false);
  harp_note_off(all->harp, hand, key);
}

void strings_hands_turn_wheel(StringsHands* all, uint32_t hand, double wheel) {
  let_go(all, hand);
  all->hands[hand].wheel = wheel;
  tell_followers(all, hand, tell_bend);
}

void strings_hands_press(StringsHands* all, uint32_t hand, double pressure) {
  let_go(all, hand);
  all->hands[hand].pressure = pressure;
  tell_followers(all, hand, tell_pressure);
}

void strings_hands_brighten(StringsHands* all, uint32_t hand, double brightness) {
  let_go(all, hand);
  all->hands[hand].brightness = brightness;
  tell_followers(all, hand, tell_brightness);
}

/* Whether data for a parameter of `hand` is for `other` too. */
static bool shares(const StringsHands* all, uint32_t hand, uint32_t other) {
  const bool is_same_zone = zones_leader(&all->zones, other) == zones_leader(&all->zones, hand);
  return other == hand || (is_same_zone && strings_hands_is_member(all, hand) &&
                           strings_hands_is_member(all, other));
}

void strings_hands_enter(
    StringsHands* all, uint32_t hand, uint32_t parameter, uint32_t controller, uint32_t value) {
  if (parameter != RPN_BEND_RANGE && strings_hands_is_member(all, hand)) {
    return;
  }
  for (uint32_t h = 0; h < ZONES_CHANNELS; ++h) {
    if (shares(all, hand, h)) {
      let_go(all, h);
      hand_enter(&all->hands[h], parameter, controller, value);
      tell_followers(all, h, tell_bend);
    }
  }
}

void strings_hands_vibrate(StringsHands* all, uint32_t hand, double semitones) {
  all->hands[hand].vibrato = semitones;
  tell_followers(all, hand, tell_vibrato);
}

void strings_hands_breathe(StringsHands* all, uint32_t hand, double breath) {
  all->hands[hand].breath = breath;
  tell_followers(all, hand, tell_breath);
}

void strings_hands_lift(StringsHands* all, uint32_t hand, double lift) {
  all->hands[hand].lift = lift;
  tell_followers(all, hand, tell_lift);
}

void strings_hands_sostenuto(StringsHands* all, uint32_t hand, bool is_down) {
  all->hands[hand].is_sostenuto = is_down;
  tell_followers(all, hand, tell_sostenuto);
}

void strings_hands_soften(StringsHands* all, uint32_t hand, double softness) {
  all->hands[hand].softness = softness;
  tell_followers(all, hand, tell_softness);
}

void strings_hands_all_notes_off(StringsHands* all, uint32_t hand) {
  for (uint32_t h = 0; h < ZONES_CHANNELS; ++h) {
    if (strings_hands_follows(all, h, hand)) {
      all->hands[h].down = (HandKeys){{0, 0}};
      harp_all_notes_off(all->harp, h);
    }
  }
}

void strings_hands_press_key(StringsHands* all, uint32_t hand, uint32_t key, double pressure) {
  hand_keys_put(&all->hands[hand].pressed, key, pressure > 0.0);
  harp_press_key(all->harp, hand, key, pressure);
}

static void release_keys(StringsHands* all, uint32_t hand) {
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    if (hand_keys_have(&all->hands[hand].pressed, key)) {
      strings_hands_press_key(all, hand, key, 0.0);
    }
  }
}

void strings_hands_reset_controllers(StringsHands* all, uint32_t hand) {
  for (uint32_t h = 0; h < ZONES_CHANNELS; ++h) {
    if (strings_hands_follows(all, h, hand)) {
      release_keys(all, h);
      hand_reset_controllers(&all->hands[h]);
    }
  }
  tell_followers(all, hand, tell_everything);
}

/* The harp lifts keys and pedals itself.  Nothing tells it of a pedal again before that has moved.
 */
void strings_hands_silence(StringsHands* all) {
  for (uint32_t h = 0; h < ZONES_CHANNELS; ++h) {
    all->hands[h].down = (HandKeys){{0, 0}};
  }
  harp_silence(all->harp);
}

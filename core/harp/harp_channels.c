#include "core/harp/harp_channels.h"

#include "core/harp/harp_group.h"

#include <math.h>

/* More could be more than the numbers of a string hold. */
static const double MOST_LOUDER = 4.0;

void harp_channels_reset(HarpChannel channels[HARP_CHANNELS]) {
  for (uint32_t channel = 0; channel < HARP_CHANNELS; ++channel) {
    channels[channel] = (HarpChannel){.touch = HARP_TOUCH_NONE};
    line_set(&channels[channel].gain, 1.0);
  }
}

bool harp_channels_holds(const HarpString* string, uint32_t channel) {
  return string->holders >> channel & 1;
}

HarpString* harp_channels_held(Harp* harp, uint32_t channel, uint32_t key) {
  if (harp_channels_holds(&harp->strings[key], channel)) {
    return &harp->strings[key];
  }
  for (uint32_t i = HARP_KEYS; i < HARP_STRINGS; ++i) {
    HarpString* const spare = &harp->strings[i];
    if (spare->key == key && harp_channels_holds(spare, channel)) {
      return spare;
    }
  }
  return NULL;
}

static double gain_of(const Harp* harp, uint32_t channel) {
  return harp->channels[channel].gain.goal;
}

/* Whether nobody holds it, and its motion is as loud with the channel as it is now. */
static bool is_free_for(const Harp* harp, const HarpString* string, uint32_t channel) {
  return !string->holders && (!harp_group_is_awake(string) ||
                              gain_of(harp, harp_channels_heard(string)) == gain_of(harp, channel));
}

/* A spare string for a key: one that rings at that key, or one at rest. */
static HarpString* find_spare(Harp* harp, uint32_t channel, uint32_t key) {
  HarpString* found = NULL;
  for (uint32_t i = HARP_KEYS; i < HARP_STRINGS; ++i) {
    HarpString* const spare = &harp->strings[i];
    if (harp_group_is_awake(spare) && spare->key == key && is_free_for(harp, spare, channel)) {
      return spare;
    }
    if (!spare->holders && !harp_group_is_awake(spare) && !found) {
      found = spare;
    }
  }
  return found;
}

HarpString* harp_channels_take(Harp* harp, uint32_t channel, uint32_t key) {
  HarpString* const own = &harp->strings[key];
  HarpString* const held = harp_channels_held(harp, channel, key);
  if (held || is_free_for(harp, own, channel)) {
    return held ? held : own;
  }
  HarpString* const spare = find_spare(harp, channel, key);
  if (spare) {
    spare->key = key;
  }
  return spare ? spare : own;
}

uint32_t harp_channels_heard(const HarpString* string) {
  return string->lender ? string->lender - 1 : string->channel;
}

double harp_channels_hand(const Harp* harp, HarpString* string, uint32_t channel, bool is_played) {
  const uint32_t heard = harp_channels_heard(string);
  const double old = gain_of(harp, heard);
  const double gain = gain_of(harp, channel);
  const bool would_step = harp_group_is_awake(string) && old != gain && (old > 0.0 || !is_played);
  string->lender = would_step ? 1 + heard : 0;
  string->channel = channel;
  return would_step && is_played ? fmin(gain / old, MOST_LOUDER) : 1.0;
}

uint32_t harp_channels_pedal(const Harp* harp) {
  uint32_t most = 0;
  for (uint32_t channel = 1; channel < HARP_CHANNELS; ++channel) {
    most = harp->channels[channel].lift > harp->channels[most].lift ? channel : most;
  }
  return most;
}

double harp_channels_lift(const Harp* harp, const HarpString* string) {
  if (string->holders || string->is_caught) {
    return 1.0;
  }
  const bool is_awake = harp_group_is_awake(string);
  return harp->channels[is_awake ? string->channel : harp_channels_pedal(harp)].lift;
}

bool harp_channels_follows(const HarpString* string, uint32_t channel) {
  return string->channel == channel && !string->is_let_go;
}

void harp_channels_retune(Harp* harp, HarpString* string, uint32_t n_glide) {
  string->lift = harp_channels_lift(harp, string);
  harp_group_retune(string, n_glide);
}

void harp_channels_retune_all(Harp* harp, uint32_t n_glide) {
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    harp_channels_retune(harp, &harp->strings[i], n_glide);
  }
}

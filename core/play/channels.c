#include "core/play/channels.h"

#include "core/play/midi.h"
#include "core/play/rpn.h"

#include <math.h>

enum { USUAL_CENTS = 200, MEMBER_CENTS = 4800 };

/* The middle of brightness, and how far it is to its upper end. */
static const double BRIGHTNESS_CENTRE = 64.0;
static const double BRIGHTNESS_REACH = 63.0;

static double share(uint32_t value) {
  return value / 127.0;
}

static double gain(uint32_t value) {
  return share(value) * share(value);
}

static bool is_member(const Channels* all, uint32_t channel) {
  return zones_leader(&all->zones, channel) != channel;
}

/* Whether what is said to `leader` is said to `channel` too. */
static bool follows(const Channels* all, uint32_t channel, uint32_t leader) {
  return channel == leader || zones_leader(&all->zones, channel) == leader;
}

static void tell(const Channels* all, uint32_t channel, Gesture gesture) {
  const Channel* const leader = &all->channels[zones_leader(&all->zones, channel)];
  const double value = channel_gesture(leader, &all->channels[channel], gesture);
  all->to.kind->gesture(all->to.instrument, channel, gesture, value);
}

/* Of `channel`, and of all that follow it. */
static void tell_followers(const Channels* all, uint32_t channel, Gesture gesture) {
  for (uint32_t c = 0; c < ZONES_CHANNELS; ++c) {
    if (follows(all, c, channel)) {
      tell(all, c, gesture);
    }
  }
}

static void tell_everything(const Channels* all, uint32_t channel) {
  for (uint32_t gesture = 0; gesture < N_GESTURES; ++gesture) {
    tell(all, channel, (Gesture)gesture);
  }
}

static void let_go(Channels* all, uint32_t channel) {
  Channel* const c = &all->channels[channel];
  if (c->has_played && channel_keys_are_none(&c->down) && is_member(all, channel)) {
    all->to.kind->let_go(all->to.instrument, channel);
    c->has_played = false;
  }
}

static void note_on(Channels* all, uint32_t channel, uint32_t key, uint32_t velocity) {
  let_go(all, channel);
  all->channels[channel].has_played = true;
  channel_keys_put(&all->channels[channel].down, key, true);
  all->to.kind->note_on(all->to.instrument, channel, key, velocity);
}

static void note_off(Channels* all, uint32_t channel, uint32_t key) {
  channel_keys_put(&all->channels[channel].down, key, false);
  all->to.kind->note_off(all->to.instrument, channel, key);
}

/* A gesture that a member makes for itself; `what` is of the channel. */
static void move(Channels* all, uint32_t channel, double* what, double value, Gesture gesture) {
  let_go(all, channel);
  *what = value;
  tell_followers(all, channel, gesture);
}

static void press_key(Channels* all, uint32_t channel, uint32_t key, double pressure) {
  channel_keys_put(&all->channels[channel].pressed, key, pressure > 0.0);
  all->to.kind->press_key(all->to.instrument, channel, key, pressure);
}

/* Channels whose place has changed, and those of a zone that is set up, if as it was, start afresh;
 * each one's leader before it is told what comes of both. */
static void set_zone(Channels* all, uint32_t leader, uint32_t n_members) {
  const Zones before = all->zones;
  bool is_changed[ZONES_CHANNELS];
  zones_set(&all->zones, leader, n_members);
  for (uint32_t c = 0; c < ZONES_CHANNELS; ++c) {
    Channel* const channel = &all->channels[c];
    const Channel was = *channel;
    is_changed[c] = zones_has(&all->zones, leader, c) || !zones_agree(&before, &all->zones, c);
    if (is_changed[c]) {
      all->to.kind->all_notes_off(all->to.instrument, c);
      all->to.kind->let_go(all->to.instrument, c);
      channel_reset(channel, is_member(all, c) ? MEMBER_CENTS : USUAL_CENTS);
      channel->volume = was.volume;
      channel->parameter = was.parameter;
    }
  }
  for (uint32_t c = 0; c < ZONES_CHANNELS; ++c) {
    if (is_changed[c]) {
      tell_everything(all, c);
      if (all->to.kind->seat) {
        all->to.kind->seat(all->to.instrument, c, zones_seat(&all->zones, c));
      }
    }
  }
}

static void enter_zone(Channels* all, uint32_t channel, uint32_t controller, uint32_t value) {
  const bool can_lead = channel == ZONES_LOWER || channel == ZONES_UPPER;
  if (can_lead && controller == MIDI_DATA_UPPER && value <= ZONES_MOST_MEMBERS) {
    set_zone(all, channel, value);
  }
}

/* Whether data for a parameter of `channel` is for `other` too: the range of a zone's members is
 * one. */
static bool shares(const Channels* all, uint32_t channel, uint32_t other) {
  const bool is_same_zone = zones_leader(&all->zones, other) == zones_leader(&all->zones, channel);
  return other == channel || (is_same_zone && is_member(all, channel) && is_member(all, other));
}

static void enter_data(Channels* all, uint32_t channel, uint32_t controller, uint32_t value) {
  const uint32_t parameter = all->channels[channel].parameter;
  if (parameter == RPN_ZONE) {
    enter_zone(all, channel, controller, value);
  }
  const bool is_tuning = parameter == RPN_FINE || parameter == RPN_COARSE;
  const bool is_known = parameter == RPN_BEND_RANGE || (is_tuning && !is_member(all, channel));
  for (uint32_t c = 0; is_known && c < ZONES_CHANNELS; ++c) {
    if (shares(all, channel, c)) {
      let_go(all, c);
      channel_enter(&all->channels[c], parameter, controller, value);
      tell_followers(all, c, GESTURE_BEND);
    }
  }
}

static void all_notes_off(Channels* all, uint32_t channel) {
  for (uint32_t c = 0; c < ZONES_CHANNELS; ++c) {
    if (follows(all, c, channel)) {
      all->channels[c].down = (ChannelKeys){{0, 0}};
      all->to.kind->all_notes_off(all->to.instrument, c);
    }
  }
}

/* The instrument lifts keys and pedals itself.  Nothing tells it of a pedal again before that has
 * moved. */
static void silence(Channels* all, uint32_t channel) {
  all->channels[channel].down = (ChannelKeys){{0, 0}};
  all->to.kind->all_sound_off(all->to.instrument, channel);
}

static void all_sound_off(Channels* all, uint32_t channel) {
  for (uint32_t c = 0; c < ZONES_CHANNELS; ++c) {
    if (follows(all, c, channel)) {
      silence(all, c);
    }
  }
}

static void release_keys(Channels* all, uint32_t channel) {
  for (uint32_t key = 0; key < PERFORMANCE_KEYS; ++key) {
    if (channel_keys_have(&all->channels[channel].pressed, key)) {
      press_key(all, channel, key, 0.0);
    }
  }
}

static void reset_controllers(Channels* all, uint32_t channel) {
  for (uint32_t c = 0; c < ZONES_CHANNELS; ++c) {
    if (follows(all, c, channel)) {
      release_keys(all, c);
      channel_reset_controllers(&all->channels[c]);
    }
  }
  for (uint32_t c = 0; c < ZONES_CHANNELS; ++c) {
    if (follows(all, c, channel)) {
      tell_everything(all, c);
    }
  }
}

static void tune(const Channels* all, MtsChange change) {
  double semitones[PERFORMANCE_KEYS];
  for (uint32_t c = 0; c < PERFORMANCE_CHANNELS; ++c) {
    if (change.channels >> c & 1) {
      mts_pitches(&all->mts, c, semitones);
      all->to.kind->tune(all->to.instrument, c, semitones, change.is_live);
    }
  }
}

/* What a leader says, or a channel that follows none. */
static void play_leader(Channels* all, uint32_t channel, uint32_t controller, uint32_t value) {
  Channel* const c = &all->channels[channel];
  switch (controller) {
  case MIDI_VIBRATO:
    c->vibrato = CHANNELS_VIBRATO * share(value);
    tell_followers(all, channel, GESTURE_VIBRATO);
    break;
  case MIDI_BREATH:
    c->breath = share(value);
    tell_followers(all, channel, GESTURE_BREATH);
    break;
  case MIDI_VOLUME:
    c->volume = gain(value);
    tell_followers(all, channel, GESTURE_GAIN);
    break;
  case MIDI_EXPRESSION:
    c->expression = gain(value);
    tell_followers(all, channel, GESTURE_GAIN);
    break;
  case MIDI_PEDAL:
    c->lift = fmin((double)value / MIDI_DOWN, 1.0);
    tell_followers(all, channel, GESTURE_DAMPER);
    break;
  case MIDI_SOSTENUTO:
    c->is_sostenuto = value >= MIDI_DOWN;
    tell_followers(all, channel, GESTURE_SOSTENUTO);
    break;
  case MIDI_SOFT_PEDAL:
    c->softness = share(value);
    tell_followers(all, channel, GESTURE_SOFTNESS);
    break;
  case MIDI_ALL_SOUND_OFF:
    all_sound_off(all, channel);
    break;
  case MIDI_RESET_CONTROLLERS:
    reset_controllers(all, channel);
    break;
  default:
    if (controller >= MIDI_ALL_NOTES_OFF) {
      all_notes_off(all, channel);
    }
    break;
  }
}

static void play_controller(Channels* all, const MidiMessage* message) {
  const uint32_t channel = message->channel;
  Channel* const c = &all->channels[channel];
  if (rpn_is_choice(message->number)) {
    c->parameter = rpn_choose(c->parameter, message->number, message->value);
  } else if (rpn_is_entry(message->number)) {
    enter_data(all, channel, message->number, message->value);
  } else if (message->number == MIDI_BRIGHTNESS) {
    const double brightness = (message->value - BRIGHTNESS_CENTRE) / BRIGHTNESS_REACH;
    move(all, channel, &c->brightness, fmax(brightness, -1.0), GESTURE_BRIGHTNESS);
  } else if (!is_member(all, channel)) {
    play_leader(all, channel, message->number, message->value);
  }
}

void channels_reset(Channels* all) {
  all->zones = (Zones){0};
  mts_reset(&all->mts);
  for (uint32_t c = 0; c < ZONES_CHANNELS; ++c) {
    channel_reset(&all->channels[c], USUAL_CENTS);
  }
}

void channels_set_scale(Channels* all, const double semitones[PERFORMANCE_KEYS]) {
  tune(all, mts_set_scale(&all->mts, semitones));
}

void channels_silence(Channels* all) {
  for (uint32_t c = 0; c < ZONES_CHANNELS; ++c) {
    silence(all, c);
  }
}

void channels_play(Channels* all, const uint8_t* bytes, uint32_t n_bytes, bool is_muted) {
  const MidiMessage message = midi_read(bytes, n_bytes);
  const uint32_t channel = message.channel;
  Channel* const c = &all->channels[channel];
  switch (message.kind) {
  case MIDI_NOTE_ON:
    if (!is_muted) {
      note_on(all, channel, message.number, message.value);
    }
    break;
  case MIDI_NOTE_OFF:
    note_off(all, channel, message.number);
    break;
  case MIDI_KEY_PRESSURE:
    if (!is_member(all, channel)) {
      press_key(all, channel, message.number, share(message.value));
    }
    break;
  case MIDI_CONTROLLER:
    play_controller(all, &message);
    break;
  case MIDI_CHANNEL_PRESSURE:
    move(all, channel, &c->pressure, share(message.value), GESTURE_PRESSURE);
    break;
  case MIDI_BEND:
    move(all, channel, &c->wheel, message.bend, GESTURE_BEND);
    break;
  case MIDI_PROGRAM:
    break;
  case MIDI_OTHER:
    tune(all, mts_play(&all->mts, bytes, n_bytes));
    break;
  }
}

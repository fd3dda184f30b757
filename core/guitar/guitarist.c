#include "core/guitar/guitarist.h"

#include "core/guitar/guitarist_chord.h"

#include <math.h>
#include <stdlib.h>

/* A harmonic is touched until the string has settled into it. */
static const double TOUCH_PERIODS = 20.0;
static const double LEAST_TOUCH_S = 0.03;
static const double MOST_TOUCH_S = 0.4;

static const double VIBRATO_HZ = 5.5;
static const uint32_t MOST_VELOCITY = 127;

static const GuitarPatch USUAL = {
    .string = {.tuning_hz = 440.0},
    .open = {64.0, 59.0, 55.0, 50.0, 45.0, 40.0},
    .n_strings = 6,
};

static double touch_s(const Guitarist* guitarist, uint32_t key) {
  const double f0_hz = guitarist->tuning_hz * exp2((key - 69.0) / 12.0);
  return fmin(fmax(TOUCH_PERIODS / f0_hz, LEAST_TOUCH_S), MOST_TOUCH_S);
}

static void play_note(Guitarist* guitarist, const GuitaristEvent* event) {
  const GuitaristHand hand = guitarist_chord_hand(guitarist, event->string);
  const GuitaristNote note = {
      .channel = event->channel,
      .key = event->key,
      .velocity = event->value,
      .fret = guitarist_chord_fret(guitarist, event->string, event->key),
      .harmonic = guitarist->how.harmonic,
      .touch_s = touch_s(guitarist, event->key),
  };
  if (guitarist_chord_is_hammered(guitarist, event)) {
    guitarist_string_hammer(hand, note);
  } else {
    const double wait = round(event->stroke * guitarist_chord_strum_frames(guitarist));
    guitarist_string_play(hand, note, guitarist->strum.start + (uint64_t)wait);
  }
  if (hand.string->is_due && hand.string->due <= guitarist->now) {
    guitarist_string_pluck(hand);
  }
  hand.string->onset = guitarist->now;
  hand.string->played = ++guitarist->n_played;
}

static void lift_key(Guitarist* guitarist, const GuitaristEvent* event) {
  const bool is_legato = guitarist->how.legato > 0 && event->key != GUITARIST_ANY_KEY;
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    const GuitaristHand hand = guitarist_chord_hand(guitarist, s);
    const bool is_pedal = guitarist_chord_is_pedalled(guitarist, hand.string->note.channel);
    guitarist_string_release(hand, event->channel, event->key, is_legato, is_pedal);
  }
}

/* Let go the strings that no pedal holds any more. */
static void look_at_pedals(Guitarist* guitarist) {
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    const GuitaristHand hand = guitarist_chord_hand(guitarist, s);
    if (hand.string->hold == GUITARIST_PEDAL &&
        !guitarist_chord_is_pedalled(guitarist, hand.string->note.channel)) {
      guitarist_string_let_go(hand, false);
    }
  }
}

static void act(Guitarist* guitarist, const GuitaristEvent* event) {
  switch (event->verb) {
  case GUITARIST_NOTE_ON:
    play_note(guitarist, event);
    break;
  case GUITARIST_NOTE_OFF:
    lift_key(guitarist, event);
    break;
  case GUITARIST_PEDAL_MOVE:
    guitarist->is_pedal_down[event->channel] = event->value > 0;
    look_at_pedals(guitarist);
    break;
  }
}

/* Do what was gathered in this frame. */
static void end_frame(Guitarist* guitarist) {
  guitarist_chord_decide(guitarist);
  for (uint32_t i = 0; i < guitarist->n_events; ++i) {
    act(guitarist, &guitarist->events[i]);
  }
  guitarist->n_events = 0;
  guitarist->n_notes = 0;
}

/* Events from the first note of a frame on wait for the whole chord. */
static void take(Guitarist* guitarist, GuitaristEvent event) {
  const bool is_note = event.verb == GUITARIST_NOTE_ON;
  if (guitarist->n_events == GUITARIST_EVENTS ||
      (is_note && guitarist->n_notes == FRETBOARD_NOTES)) {
    end_frame(guitarist);
  }
  if (is_note || guitarist->n_events > 0) {
    guitarist->events[guitarist->n_events++] = event;
    guitarist->n_notes += is_note;
  } else {
    act(guitarist, &event);
  }
}

static bool is_of_midi(uint32_t channel, uint32_t key) {
  return channel < GUITARIST_CHANNELS && key < GUITARIST_KEYS;
}

Guitarist* guitarist_new(Guitar* guitar) {
  Guitarist* const guitarist = calloc(1, sizeof(Guitarist));
  if (guitarist) {
    guitarist->guitar = guitar;
    guitarist->rate_hz = guitar_rate_hz(guitar);
    guitarist_set_patch(guitarist, &USUAL);
    guitarist_reset(guitarist);
  }
  return guitarist;
}

void guitarist_free(Guitarist* guitarist) {
  free(guitarist);
}

void guitarist_reset(Guitarist* guitarist) {
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    guitarist->strings[s] = (GuitaristString){0};
  }
  for (uint32_t c = 0; c < GUITARIST_CHANNELS; ++c) {
    guitarist->is_pedal_down[c] = false;
  }
  guitarist->strum = (GuitaristStrum){0};
  guitarist->position = 1;
  guitarist->n_events = 0;
  guitarist->n_notes = 0;
}

void guitarist_set_how(Guitarist* guitarist, GuitaristHow how) {
  if (how.has_channels == guitarist->how.has_channels) {
    guitarist->how = how;
    return;
  }
  end_frame(guitarist);
  guitarist->how = how;
  look_at_pedals(guitarist);
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    guitar_bend(guitarist->guitar, s, 0.0, 0.0);
    guitar_vibrato(guitarist->guitar, s, 0.0, VIBRATO_HZ);
  }
}

void guitarist_set_patch(Guitarist* guitarist, const GuitarPatch* patch) {
  guitarist->tuning_hz = patch->string.tuning_hz;
  guitarist->n_strings = patch->n_strings;
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    guitarist->open[s] = patch->open[s] + patch->capo;
  }
}

void guitarist_note_on(Guitarist* guitarist, uint32_t channel, uint32_t key, uint32_t velocity) {
  if (velocity == 0) {
    guitarist_note_off(guitarist, channel, key);
  } else if (is_of_midi(channel, key)) {
    const uint32_t value = velocity < MOST_VELOCITY ? velocity : MOST_VELOCITY;
    take(guitarist, (GuitaristEvent){GUITARIST_NOTE_ON, channel, key, value, 0, 0});
  }
}

void guitarist_note_off(Guitarist* guitarist, uint32_t channel, uint32_t key) {
  if (is_of_midi(channel, key)) {
    take(guitarist, (GuitaristEvent){GUITARIST_NOTE_OFF, channel, key, 0, 0, 0});
  }
}

void guitarist_bend(Guitarist* guitarist, uint32_t channel, double semitones) {
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    if (s == channel || !guitarist->how.has_channels) {
      guitar_bend(guitarist->guitar, s, semitones, 0.0);
    }
  }
}

void guitarist_pedal(Guitarist* guitarist, uint32_t channel, bool is_down) {
  if (is_of_midi(channel, 0)) {
    take(guitarist, (GuitaristEvent){GUITARIST_PEDAL_MOVE, channel, 0, is_down, 0, 0});
  }
}

void guitarist_vibrato(Guitarist* guitarist, uint32_t channel, double depth) {
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    if (s == channel || !guitarist->how.has_channels) {
      guitar_vibrato(guitarist->guitar, s, depth, VIBRATO_HZ);
    }
  }
}

void guitarist_all_notes_off(Guitarist* guitarist, uint32_t channel) {
  if (is_of_midi(channel, 0)) {
    const uint32_t all = guitarist->how.has_channels ? channel : GUITARIST_ANY_CHANNEL;
    take(guitarist, (GuitaristEvent){GUITARIST_NOTE_OFF, all, GUITARIST_ANY_KEY, 0, 0, 0});
  }
}

void guitarist_all_sound_off(Guitarist* guitarist) {
  guitarist_reset(guitarist);
  guitar_choke(guitarist->guitar);
}

/* Pluck what is due; how many frames there are until the next, at most `n_frames`. */
static uint32_t pluck_what_is_due(Guitarist* guitarist, uint32_t n_frames) {
  uint32_t n = n_frames;
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    const GuitaristHand hand = guitarist_chord_hand(guitarist, s);
    if (hand.string->is_due && hand.string->due <= guitarist->now) {
      guitarist_string_pluck(hand);
    } else if (hand.string->is_due && hand.string->due - guitarist->now < n) {
      n = (uint32_t)(hand.string->due - guitarist->now);
    }
  }
  return n;
}

void guitarist_run(Guitarist* guitarist, uint32_t n_frames, float* left, float* right) {
  if (n_frames > 0) {
    end_frame(guitarist);
  }
  for (uint32_t done = 0; done < n_frames;) {
    const uint32_t n = pluck_what_is_due(guitarist, n_frames - done);
    guitar_run(guitarist->guitar, n, left + done, right + done);
    guitarist->now += n;
    done += n;
  }
}

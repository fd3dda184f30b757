#include "core/guitar/guitarist.h"

#include "core/base/maths.h"
#include "core/guitar/guitar_string.h"
#include "core/guitar/guitarist_chord.h"
#include "core/guitar/guitarist_state.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A harmonic is touched until the string has settled into it. */
static const double TOUCH_PERIODS = 20.0;
static const double LEAST_TOUCH_S = 0.03;
static const double MOST_TOUCH_S = 0.4;

/* Nobody plucks nearer to the bridge, of the length. */
static const double LEAST_PLACE = 0.01;

static const uint32_t MOST_VELOCITY = 127;

static const GuitarPatch USUAL = {
    .string = {.tuning_hz = 440.0},
    .open = {64.0, 59.0, 55.0, 50.0, 45.0, 40.0},
    .n_strings = 6,
};

static double touch_s(const Guitarist* guitarist, uint32_t channel, uint32_t key) {
  const double f0_hz = guitarist->tuning_hz * exp2(guitarist->scales[channel][key] / 12.0);
  return fmin(fmax(TOUCH_PERIODS / f0_hz, LEAST_TOUCH_S), MOST_TOUCH_S);
}

/* The patch's, unless the channel makes it brighter or darker. */
static double hardness_of(const Guitarist* guitarist, uint32_t channel, uint32_t velocity) {
  const double brightness = guitarist->channels[channel].brightness;
  const double usual = guitar_hardness(guitarist->hardness, guitar_force(velocity));
  const double hardness = usual + PLUCK_BRIGHTER * brightness;
  return brightness == 0.0 ? (double)NAN : fmin(fmax(hardness, 0.0), 1.0);
}

/* Whether anything sounds, or is to, or a key is down. */
static bool is_played(const Guitarist* guitarist) {
  const GuitarSeat* const seat = &guitarist->seat;
  bool is_played = false;
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    const GuitaristString* const string = &guitarist->strings[s];
    is_played = is_played || string->hold == GUITARIST_KEY || string->is_due ||
                seat->is_awake(seat->guitar, s);
  }
  return is_played;
}

/* What a pluck moves the fundamental by, at a place on the open string. */
static double reach(const Guitarist* guitarist, const GuitaristNote* note, double place) {
  const double sounding = place * exp2((guitarist->capo + note->fret) / 12.0);
  return sin(PI * clamp(sounding, LEAST_PLACE, GUITAR_FARTHEST));
}

/* What plays as the patch says is left to say so.  Another place is no other loudness. */
static void vary(Guitarist* guitarist, GuitaristNote* note, bool is_hammered) {
  const double usual = guitar_hardness(guitarist->hardness, note->force);
  const Pluck asked = {guitarist->place, isnan(note->hardness) ? usual : note->hardness,
                       note->force, 0.0};
  guitarist->n_varied = is_played(guitarist) ? guitarist->n_varied + 1 : 0;
  if (guitarist->how.variation.amount > 0.0) {
    const Pluck played =
        variation_of(guitarist->how.variation, note->key, guitarist->n_varied, asked);
    const double even = reach(guitarist, note, asked.place) / reach(guitarist, note, played.place);
    note->place = played.place;
    note->hardness = played.hardness;
    note->force = fmin((is_hammered ? 1.0 : even) * played.amplitude, 1.0);
  }
}

static void play_note(Guitarist* guitarist, const GuitaristEvent* event) {
  const GuitaristHand hand = guitarist_chord_hand(guitarist, event->string);
  GuitaristNote note = {
      .channel = event->channel,
      .holders = UINT32_C(1) << event->channel,
      .key = event->key,
      .force = guitar_force(event->value),
      .place = (double)NAN,
      .hardness = hardness_of(guitarist, event->channel, event->value),
      .fret = guitarist_chord_fret(guitarist, event->string, event->key),
      .harmonic = guitarist->how.harmonic,
      .touch_s = touch_s(guitarist, event->channel, event->key),
  };
  const bool is_hammered = guitarist_chord_is_hammered(guitarist, event);
  vary(guitarist, &note, is_hammered);
  if (is_hammered) {
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
    guitarist_string_release(guitarist_chord_hand(guitarist, s), event->channel, event->key,
                             is_legato);
  }
}

/* Let go the strings that no pedal holds any more. */
static void look_at_pedals(Guitarist* guitarist) {
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    const GuitaristHand hand = guitarist_chord_hand(guitarist, s);
    if (hand.string->hold == GUITARIST_FOOT) {
      guitarist_string_let_go(hand);
    }
  }
}

/* It catches what is held when it goes down. */
static void move_sostenuto(Guitarist* guitarist, uint32_t channel, bool is_down) {
  GuitaristChannel* const c = &guitarist->channels[channel];
  for (uint32_t s = 0; is_down != c->is_sostenuto_down && s < GUITAR_STRINGS; ++s) {
    GuitaristString* const string = &guitarist->strings[s];
    if (string->note.channel == channel) {
      string->is_caught = is_down && string->hold == GUITARIST_KEY;
    }
  }
  c->is_sostenuto_down = is_down;
}

static void lean_on_key(Guitarist* guitarist, const GuitaristEvent* event) {
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    const GuitaristHand hand = guitarist_chord_hand(guitarist, s);
    const GuitaristNote* const note = &hand.string->note;
    if (hand.string->hold == GUITARIST_KEY && note->channel == event->channel &&
        note->key == event->key) {
      hand.string->leaned_on = event->amount;
      guitarist_string_feel(hand, event->channel);
    }
  }
}

static void leave_what_is_up(Guitarist* guitarist, uint32_t channel) {
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    GuitaristString* const string = &guitarist->strings[s];
    const bool is_up = string->note.channel == channel && string->hold != GUITARIST_KEY;
    string->is_let_go = string->is_let_go || (string->has_played && is_up);
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
  case GUITARIST_PEDAL:
    guitarist->channels[event->channel].is_pedal_down = event->value > 0;
    look_at_pedals(guitarist);
    break;
  case GUITARIST_SOSTENUTO:
    move_sostenuto(guitarist, event->channel, event->value > 0);
    look_at_pedals(guitarist);
    break;
  case GUITARIST_PRESS_KEY:
    lean_on_key(guitarist, event);
    break;
  case GUITARIST_LET_GO:
    leave_what_is_up(guitarist, event->channel);
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

/* What a channel did in this frame is not done. */
static void forget_events(Guitarist* guitarist, uint32_t channel) {
  uint32_t n_kept = 0;
  for (uint32_t i = 0; i < guitarist->n_events; ++i) {
    const GuitaristEvent event = guitarist->events[i];
    if (event.channel != channel) {
      guitarist->events[n_kept++] = event;
    } else {
      guitarist->n_notes -= event.verb == GUITARIST_NOTE_ON;
    }
  }
  guitarist->n_events = n_kept;
}

static bool is_of_midi(uint32_t channel, uint32_t key) {
  return channel < PERFORMANCE_CHANNELS && key < PERFORMANCE_KEYS;
}

/* A string that nobody has played yet follows the channel that it belongs to, or whoever moves. */
static bool follows(const Guitarist* guitarist, uint32_t string, uint32_t channel) {
  const GuitaristString* const s = &guitarist->strings[string];
  if (s->has_played) {
    return s->note.channel == channel && !s->is_let_go;
  }
  return !guitarist->how.has_channels || guitarist->channels[channel].seat == string;
}

/* The channel has another touch, and so have all strings that follow it. */
static void feel(Guitarist* guitarist, uint32_t channel) {
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    if (follows(guitarist, s, channel)) {
      guitarist_string_feel(guitarist_chord_hand(guitarist, s), channel);
    }
  }
}

/* The palm lies on all strings, as heavily as the heaviest channel says. */
static void lay_palm(const Guitarist* guitarist) {
  GuitarAct palm = {.verb = GUITAR_PALM};
  for (uint32_t c = 0; c < PERFORMANCE_CHANNELS; ++c) {
    palm.value[0] = fmax(palm.value[0], guitarist->channels[c].softness);
  }
  guitarist->seat.act(guitarist->seat.guitar, &palm);
}

static void tune_equally(Guitarist* guitarist) {
  for (uint32_t c = 0; c < PERFORMANCE_CHANNELS; ++c) {
    for (uint32_t key = 0; key < PERFORMANCE_KEYS; ++key) {
      guitarist->scales[c][key] = (double)key - 69.0;
    }
  }
}

Guitarist* guitarist_new(GuitarSeat seat) {
  Guitarist* const guitarist = calloc(1, sizeof(Guitarist));
  if (guitarist) {
    guitarist->seat = seat;
    tune_equally(guitarist);
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
    guitarist->strings[s] = (GuitaristString){.touch = {.gain = 1.0}};
  }
  for (uint32_t c = 0; c < PERFORMANCE_CHANNELS; ++c) {
    guitarist->channels[c] = (GuitaristChannel){.gain = 1.0, .seat = c};
  }
  guitarist->strum = (GuitaristStrum){0};
  guitarist->position = 1;
  guitarist->n_events = 0;
  guitarist->n_notes = 0;
  guitarist->n_varied = 0;
}

void guitarist_set_how(Guitarist* guitarist, GuitaristHow how) {
  if (how.has_channels != guitarist->how.has_channels) {
    end_frame(guitarist);
  }
  guitarist->how = how;
}

void guitarist_set_patch(Guitarist* guitarist, const GuitarPatch* patch) {
  guitarist->tuning_hz = patch->string.tuning_hz;
  guitarist->place = patch->pluck;
  guitarist->capo = patch->capo;
  guitarist->hardness = patch->hardness;
  guitarist->n_strings = patch->n_strings;
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    guitarist->open[s] = patch->open[s] + patch->capo;
  }
}

void guitarist_set_scale(Guitarist* guitarist,
                         uint32_t channel,
                         const double semitones[PERFORMANCE_KEYS],
                         bool is_live) {
  memcpy(guitarist->scales[channel], semitones, sizeof(guitarist->scales[channel]));
  if (guitarist->seat.tune) {
    guitarist->seat.tune(guitarist->seat.guitar, channel, semitones, is_live);
  }
  for (uint32_t s = 0; is_live && s < GUITAR_STRINGS; ++s) {
    const GuitaristString* const string = &guitarist->strings[s];
    if (string->has_played && string->note.channel == channel &&
        isnan(semitones[string->note.key])) {
      guitarist_string_choke(guitarist_chord_hand(guitarist, s));
    }
  }
}

void guitarist_note_on(Guitarist* guitarist, uint32_t channel, uint32_t key, uint32_t velocity) {
  if (velocity == 0) {
    guitarist_note_off(guitarist, channel, key);
  } else if (is_of_midi(channel, key) && !isnan(guitarist->scales[channel][key])) {
    const uint32_t value = velocity < MOST_VELOCITY ? velocity : MOST_VELOCITY;
    take(guitarist, (GuitaristEvent){
                        .verb = GUITARIST_NOTE_ON, .channel = channel, .key = key, .value = value});
  }
}

void guitarist_note_off(Guitarist* guitarist, uint32_t channel, uint32_t key) {
  if (is_of_midi(channel, key)) {
    take(guitarist,
         (GuitaristEvent){.verb = GUITARIST_NOTE_OFF, .channel = channel, .key = key, .value = 0});
  }
}

void guitarist_gesture(Guitarist* guitarist, uint32_t channel, Gesture gesture, double value) {
  if (!is_of_midi(channel, 0)) {
    return;
  }
  GuitaristChannel* const c = &guitarist->channels[channel];
  switch (gesture) {
  case GESTURE_BEND:
    c->bend = fmin(fmax(value, -GUITARIST_MOST_BEND), GUITARIST_MOST_BEND);
    feel(guitarist, channel);
    break;
  case GESTURE_VIBRATO:
    c->vibrato = value;
    feel(guitarist, channel);
    break;
  case GESTURE_PRESSURE:
    c->pressure = value;
    feel(guitarist, channel);
    break;
  case GESTURE_GAIN:
    c->gain = value;
    feel(guitarist, channel);
    break;
  case GESTURE_BRIGHTNESS:
    c->brightness = value;
    break;
  case GESTURE_SOFTNESS:
    c->softness = value;
    lay_palm(guitarist);
    break;
  case GESTURE_DAMPER:
    take(guitarist,
         (GuitaristEvent){
             .verb = GUITARIST_PEDAL, .channel = channel, .key = 0, .value = value >= 1.0});
    break;
  case GESTURE_SOSTENUTO:
    take(guitarist,
         (GuitaristEvent){
             .verb = GUITARIST_SOSTENUTO, .channel = channel, .key = 0, .value = value > 0.0});
    break;
  case GESTURE_BREATH:
  case N_GESTURES:
    break;
  }
}

void guitarist_press_key(Guitarist* guitarist, uint32_t channel, uint32_t key, double pressure) {
  if (is_of_midi(channel, key)) {
    take(guitarist,
         (GuitaristEvent){
             .verb = GUITARIST_PRESS_KEY, .channel = channel, .key = key, .amount = pressure});
  }
}

void guitarist_let_go(Guitarist* guitarist, uint32_t channel) {
  if (is_of_midi(channel, 0)) {
    take(guitarist, (GuitaristEvent){.verb = GUITARIST_LET_GO, .channel = channel});
  }
}

void guitarist_all_notes_off(Guitarist* guitarist, uint32_t channel) {
  if (is_of_midi(channel, 0)) {
    take(guitarist,
         (GuitaristEvent){
             .verb = GUITARIST_NOTE_OFF, .channel = channel, .key = GUITARIST_ANY_KEY, .value = 0});
  }
}

/* Once nobody plays any more the hand goes back to where it began. */
void guitarist_all_sound_off(Guitarist* guitarist, uint32_t channel) {
  bool is_over = true;
  forget_events(guitarist, channel);
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    GuitaristString* const string = &guitarist->strings[s];
    const GuitaristHand hand = guitarist_chord_hand(guitarist, s);
    if (!string->has_played || string->note.channel == channel) {
      guitarist_string_choke(hand);
    } else {
      guitarist_string_release(hand, channel, GUITARIST_ANY_KEY, false);
    }
    is_over = is_over && !string->has_played;
  }
  guitarist->channels[channel].is_pedal_down = false;
  guitarist->channels[channel].is_sostenuto_down = false;
  look_at_pedals(guitarist);
  if (is_over) {
    guitarist->strum = (GuitaristStrum){0};
    guitarist->position = 1;
  }
}

void guitarist_seat(Guitarist* guitarist, uint32_t channel, uint32_t seat) {
  guitarist->channels[channel].seat = seat;
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
    guitarist->seat.run(guitarist->seat.guitar, n, left + done, right + done);
    guitarist->now += n;
    done += n;
  }
}

static void note_on(void* guitarist, uint32_t channel, uint32_t key, uint32_t velocity) {
  guitarist_note_on(guitarist, channel, key, velocity);
}

static void note_off(void* guitarist, uint32_t channel, uint32_t key) {
  guitarist_note_off(guitarist, channel, key);
}

static void gesture(void* guitarist, uint32_t channel, Gesture what, double value) {
  guitarist_gesture(guitarist, channel, what, value);
}

static void press_key(void* guitarist, uint32_t channel, uint32_t key, double pressure) {
  guitarist_press_key(guitarist, channel, key, pressure);
}

static void let_go(void* guitarist, uint32_t channel) {
  guitarist_let_go(guitarist, channel);
}

static void all_notes_off(void* guitarist, uint32_t channel) {
  guitarist_all_notes_off(guitarist, channel);
}

static void all_sound_off(void* guitarist, uint32_t channel) {
  guitarist_all_sound_off(guitarist, channel);
}

static void seat(void* guitarist, uint32_t channel, uint32_t number) {
  guitarist_seat(guitarist, channel, number);
}

static void
tune(void* guitarist, uint32_t channel, const double semitones[PERFORMANCE_KEYS], bool is_live) {
  guitarist_set_scale(guitarist, channel, semitones, is_live);
}

Performance guitarist_performance(Guitarist* guitarist) {
  static const PerformanceKind kind = {note_on,       note_off,      gesture, press_key, let_go,
                                       all_notes_off, all_sound_off, seat,    tune};
  return (Performance){&kind, guitarist};
}

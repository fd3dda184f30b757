#include "core/harp/harp.h"

#include "core/base/aligned.h"
#include "core/base/chance.h"
#include "core/base/maths.h"
#include "core/harp/harp_bridge.h"
#include "core/harp/harp_channels.h"
#include "core/harp/harp_group.h"
#include "core/harp/harp_mixer.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* What the soft pedal does to hardness, and to loudness. */
static const double SOFT_HARDNESS = -0.2;
static const double SOFT_GAIN = 0.6;

/* All that has a channel's touch takes it anew. */
static void feel(Harp* harp, uint32_t channel) {
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    HarpString* const string = &harp->strings[i];
    if (harp_channels_follows(string, channel)) {
      string->touch = harp->channels[channel].touch;
      harp_channels_retune(harp, string, harp->n_gesture);
    }
  }
}

static void set_touch(Harp* harp, uint32_t channel, double* what, double value) {
  if (value != *what) {
    *what = value;
    feel(harp, channel);
  }
}

static void set_level(Harp* harp, uint32_t n_frames) {
  line_to(&harp->level, harp->patch.level, n_frames);
  harp_stereo_set(&harp->stereo, harp->patch.spread, n_frames);
}

static size_t memory_size(void) {
  return HARP_STRINGS * (chain_size(CHAIN_MAX_MASSES) + harp_group_size());
}

/* A scale may give any key any pitch, so the strings of all have the same memory.  It is touched
 * here, so that a first note does not have to wait for pages. */
static void lay_out(Harp* harp, char* memory) {
  const size_t size = chain_size(CHAIN_MAX_MASSES);
  memset(memory, 0, memory_size());
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    HarpString* const string = &harp->strings[i];
    harp_string_init(string, &harp->patch, harp->rate_hz, i % HARP_KEYS, memory, CHAIN_MAX_MASSES,
                     &harp->bridge.bridge);
    harp_group_init(string, harp->followers[i], memory + size);
    memory += size + harp_group_size();
  }
}

static void tune_equally(Harp* harp) {
  for (uint32_t i = 0; i < HARP_CHANNELS * HARP_KEYS; ++i) {
    harp->scales[i / HARP_KEYS][i % HARP_KEYS] = (double)(i % HARP_KEYS) - 69.0;
  }
}

Harp* harp_new(double rate_hz) {
  Harp* const harp =
      isfinite(rate_hz) && rate_hz > 0.0 ? aligned_new(_Alignof(Harp), sizeof(Harp)) : NULL;
  if (!harp) {
    return NULL;
  }
  memset(harp, 0, sizeof(*harp));
  harp->rate_hz = rate_hz;
  harp->n_gesture = voice_gesture_frames(rate_hz);
  harp->onset = onset_pole(rate_hz);
  harp->memory = aligned_new(CHAIN_ALIGNMENT, memory_size());
  if (!harp->memory || !harp_stereo_new(&harp->stereo, rate_hz)) {
    harp_free(harp);
    return NULL;
  }
  harp_bridge_init(&harp->bridge, rate_hz);
  harp->noise_make = noise_make(rate_hz);
  radiator_init(&harp->radiator);
  lay_out(harp, harp->memory);
  harp_channels_reset(harp->channels);
  tune_equally(harp);
  return harp;
}

void harp_free(Harp* harp) {
  if (harp) {
    harp_stereo_free(&harp->stereo);
    aligned_free(harp->memory);
    aligned_free(harp);
  }
}

/* Give a string the pitch that its key has on the channel that played it last. */
static void tune(Harp* harp, HarpString* string) {
  string->semitones = harp->scales[string->channel][string->key];
}

void harp_reset(Harp* harp) {
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    harp_group_rest(&harp->strings[i]);
    tune(harp, &harp->strings[i]);
  }
  harp->is_followed = false;
  harp_channels_reset(harp->channels);
  harp_bridge_init(&harp->bridge, harp->rate_hz);
  harp_bridge_move(harp);
  harp->reading.n_taps = 0;
  harp->n_notes = 0;
  memset(harp->noises, 0, sizeof(harp->noises));
  harp->is_bowed = false;
  harp->dc = 0.0;
  memset(harp->onsets, 0, sizeof harp->onsets);
  harp_stereo_reset(&harp->stereo);
  radiator_rest(&harp->radiator);
}

/* Whether what rings has the same coefficients under both. */
static bool is_same_string(const HarpPatch* a, const HarpPatch* b) {
  return string_patch_rings_alike(&a->string, &b->string) && a->resonance == b->resonance &&
         harp_members_lie_alike(a, b);
}

void harp_set_patch(Harp* harp, const HarpPatch* patch, uint32_t n_frames) {
  const bool is_same = is_same_string(patch, &harp->patch);
  const uint32_t n_glide = n_frames > 0 && n_frames < harp->n_gesture ? harp->n_gesture : n_frames;
  harp->patch = *patch;
  harp->patch.radiates = radiator_body(&harp->radiator, patch->body.choice);
  harp->n_fade = n_glide;
  radiator_set(&harp->radiator, &patch->body, harp->rate_hz, n_glide);
  harp_bridge_move(harp);
  set_level(harp, n_glide);
  if (n_glide == 0) {
    harp_mixer_place_pickups(harp);
  }
  if (!is_same) {
    harp_channels_retune_all(harp, n_glide);
  }
}

void harp_set_body(Harp* harp, const Body* body) {
  radiator_take_file(&harp->radiator, body);
  harp->patch.radiates = radiator_body(&harp->radiator, harp->patch.body.choice);
}

void harp_set_scale(Harp* harp, uint32_t channel, const double semitones[HARP_KEYS], bool is_live) {
  memcpy(harp->scales[channel], semitones, sizeof(harp->scales[channel]));
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    HarpString* const string = &harp->strings[i];
    if (string->channel == channel && (is_live || !harp_group_is_awake(string)) &&
        semitones[string->key] != string->semitones) {
      tune(harp, string);
      harp_channels_retune(harp, string, harp->n_gesture);
    }
  }
}

/* Nothing sounds, and nothing is left of what a bow pulled aside. */
static bool is_still(const Harp* harp) {
  return harp->dc == 0.0 && harp_report(harp).n_strings == 0;
}

static bool is_played(const Harp* harp) {
  bool is_played = false;
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    is_played = is_played || harp_group_is_awake(&harp->strings[i]) || harp->strings[i].holders;
  }
  return is_played;
}

/* What a channel makes of a velocity. */
static Pluck pluck_of(const Harp* harp, const HarpChannel* channel, uint32_t velocity) {
  const double force = velocity / 127.0;
  const double harder =
      PLUCK_BRIGHTER * channel->touch.brightness + SOFT_HARDNESS * channel->softness;
  const double softened = 1.0 - (1.0 - SOFT_GAIN) * channel->softness;
  return (Pluck){
      .place = harp->patch.pluck,
      .hardness = clamp(harp->patch.hardness + harder, 0.0, 1.0),
      .amplitude = HARP_NOTE_PEAK * softened * force * force,
      .softness = pluck_softness(force),
  };
}

/* The finger that plucks a string stops it first, and all that follow it. */
static void stop(Harp* harp, HarpString* string) {
  harp_mixer_hide_end(harp, string);
  harp_group_sleep(string);
}

/* The wood is pushed by what plays the strings, but for a bow. */
static void knock(Harp* harp, uint32_t channel, Pluck pluck) {
  const double hardness = clamp(pluck_played(pluck.hardness, pluck.softness), 0.0, 1.0);
  const double gain = harp->level.value * harp->channels[channel].gain.value;
  const double share = harp->patch.exciter == EXCITER_BOW ? 0.0 : harp->patch.body.knock;
  radiator_play(&harp->radiator, harp->rate_hz, hardness, share * gain * pluck.amplitude);
}

static void make_noise(Harp* harp, uint32_t channel, Pluck pluck) {
  Noise* const noise = &harp->noises[channel];
  const uint64_t seed = chance_bits(channel, harp->n_notes);
  const double amplitude = harp->patch.noise * pluck.amplitude;
  if (amplitude == 0.0) {
    return;
  }
  const double hardness = clamp(pluck_played(pluck.hardness, pluck.softness), 0.0, 1.0);
  switch (harp->patch.exciter) {
  case EXCITER_PLUCK:
    noise_scrape(noise, seed, hardness, amplitude);
    break;
  case EXCITER_STRIKE:
    noise_knock(noise, &harp->noise_make, seed, hardness, amplitude);
    break;
  case EXCITER_BOW:
    break;
  }
}

void harp_note_on(Harp* harp, uint32_t channel, uint32_t key, uint32_t velocity) {
  assert(channel < HARP_CHANNELS && key < HARP_KEYS);
  harp->n_notes = is_played(harp) ? harp->n_notes + 1 : 0;
  HarpString* const string = harp_channels_take(harp, channel, key);
  string->is_caught = string->is_caught && string->channel == channel;
  const bool is_plucked = harp->patch.exciter == EXCITER_PLUCK;
  if (is_plucked) {
    stop(harp, string);
  }
  const double louder = harp_channels_hand(harp, string, channel, true);
  string->holders |= 1u << channel;
  string->is_let_go = false;
  string->leaned_on = 0.0;
  string->touch = harp->channels[channel].touch;
  tune(harp, string);
  harp->is_bowed = harp->patch.exciter == EXCITER_BOW || (harp->is_bowed && !is_still(harp));
  const Pluck asked = pluck_of(harp, &harp->channels[channel], velocity);
  const Pluck own = variation_of(harp->patch.variation, key, harp->n_notes, asked);
  Pluck pluck = own;
  pluck.amplitude *= louder;
  harp_group_play(string, pluck, harp->n_gesture);
  harp->is_followed = harp->is_followed || string->is_followed;
  if (is_plucked) {
    harp_mixer_hide_start(harp, string);
  }
  if (string->voice.is_awake && !string->voice.is_choked) {
    make_noise(harp, channel, own);
    knock(harp, channel, own);
  }
}

/* Its key is up: the damper falls, as far as it may. */
static void raise_key(Harp* harp, HarpString* string) {
  const bool was_leaned_on = string->leaned_on > 0.0;
  string->leaned_on = 0.0;
  harp_group_lift(string);
  if (was_leaned_on || string->lift != harp_channels_lift(harp, string) ||
      tie_is_on(&string->voice.tie)) {
    harp_channels_retune(harp, string, harp->n_gesture);
  }
}

/* It is played by the first of the channels that hold it still. */
static void hand_on(Harp* harp, HarpString* string) {
  uint32_t channel = 0;
  while (!harp_channels_holds(string, channel)) {
    ++channel;
  }
  (void)harp_channels_hand(harp, string, channel, false);
  string->touch = harp->channels[channel].touch;
  tune(harp, string);
  harp_channels_retune(harp, string, harp->n_gesture);
}

/* A channel lets go of the key; the last one to do so lifts it. */
static void release(Harp* harp, HarpString* string, uint32_t channel) {
  string->holders &= ~(1u << channel);
  if (!string->holders) {
    raise_key(harp, string);
  } else if (string->channel == channel) {
    hand_on(harp, string);
  }
}

void harp_note_off(Harp* harp, uint32_t channel, uint32_t key) {
  assert(channel < HARP_CHANNELS && key < HARP_KEYS);
  HarpString* const string = harp_channels_held(harp, channel, key);
  if (string) {
    release(harp, string, channel);
  }
}

void harp_let_go(Harp* harp, uint32_t channel) {
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    HarpString* const string = &harp->strings[i];
    string->is_let_go = string->is_let_go || (string->channel == channel && !string->holders);
  }
}

/* Bring all dampers of a channel to where its pedals let them be. */
static void move_dampers(Harp* harp, uint32_t channel) {
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    HarpString* const string = &harp->strings[i];
    if (string->channel == channel && string->lift != harp_channels_lift(harp, string)) {
      harp_channels_retune(harp, string, harp->n_gesture);
    }
  }
}

void harp_pedal(Harp* harp, uint32_t channel, double lift) {
  harp->channels[channel].lift = lift;
  move_dampers(harp, channel);
}

void harp_sostenuto(Harp* harp, uint32_t channel, bool is_down) {
  const bool was_down = harp->channels[channel].is_sostenuto;
  harp->channels[channel].is_sostenuto = is_down;
  for (uint32_t i = 0; is_down != was_down && i < HARP_STRINGS; ++i) {
    HarpString* const string = &harp->strings[i];
    if (string->channel == channel) {
      string->is_caught = is_down && string->holders;
    }
  }
  move_dampers(harp, channel);
}

void harp_soften(Harp* harp, uint32_t channel, double softness) {
  harp->channels[channel].softness = softness;
}

void harp_bend(Harp* harp, uint32_t channel, double semitones) {
  set_touch(harp, channel, &harp->channels[channel].touch.bend, semitones);
}

void harp_vibrato(Harp* harp, uint32_t channel, double semitones) {
  set_touch(harp, channel, &harp->channels[channel].touch.vibrato, semitones);
}

void harp_press(Harp* harp, uint32_t channel, double pressure) {
  set_touch(harp, channel, &harp->channels[channel].touch.pressure, pressure);
}

void harp_press_key(Harp* harp, uint32_t channel, uint32_t key, double pressure) {
  HarpString* const string = harp_channels_held(harp, channel, key);
  if (string && string->leaned_on != pressure) {
    string->leaned_on = pressure;
    harp_channels_retune(harp, string, harp->n_gesture);
  }
}

void harp_brighten(Harp* harp, uint32_t channel, double brightness) {
  set_touch(harp, channel, &harp->channels[channel].touch.brightness, brightness);
}

void harp_breathe(Harp* harp, uint32_t channel, double breath) {
  set_touch(harp, channel, &harp->channels[channel].touch.breath, breath);
}

/* Whether anything is heard with the channel's gain. */
static bool is_heard(const Harp* harp, uint32_t channel) {
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    const HarpString* const string = &harp->strings[i];
    if (harp_group_is_awake(string) && harp_channels_heard(string) == channel) {
      return true;
    }
  }
  return harp->noises[channel].is_active;
}

void harp_set_gain(Harp* harp, uint32_t channel, double gain) {
  line_to(&harp->channels[channel].gain, gain, is_heard(harp, channel) ? harp->n_gesture : 0);
}

void harp_all_notes_off(Harp* harp, uint32_t channel) {
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    if (harp_channels_holds(&harp->strings[i], channel)) {
      release(harp, &harp->strings[i], channel);
    }
  }
}

/* The body of strings that are choked, all of them, is so too. */
static void choke_body(Harp* harp) {
  bool is_heard = false;
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    const HarpString* const string = &harp->strings[i];
    is_heard = is_heard || (harp_group_is_awake(string) && !string->voice.is_choked);
  }
  if (!is_heard) {
    radiator_choke(&harp->radiator);
  }
}

/* What others hold goes on as theirs. */
void harp_all_sound_off(Harp* harp, uint32_t channel) {
  harp->channels[channel].lift = 0.0;
  harp->channels[channel].is_sostenuto = false;
  noise_choke(&harp->noises[channel]);
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    HarpString* const string = &harp->strings[i];
    if (harp_channels_holds(string, channel)) {
      release(harp, string, channel);
    }
    if (string->channel == channel && !string->holders) {
      string->is_caught = false;
      string->lift = 0.0;
      harp_group_choke(string, harp->n_gesture);
    }
  }
  choke_body(harp);
}

void harp_silence(Harp* harp) {
  for (uint32_t channel = 0; channel < HARP_CHANNELS; ++channel) {
    harp_all_sound_off(harp, channel);
  }
}

VoiceReport harp_report(const Harp* harp) {
  VoiceReport report = {.headroom = harp_bridge_headroom(harp)};
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    voice_report(&harp->strings[i].voice, &report);
  }
  for (uint32_t i = 0; harp->is_followed && i < HARP_STRINGS; ++i) {
    harp_group_report(&harp->strings[i], &report);
  }
  return report;
}

void harp_run(Harp* harp, uint32_t n_frames, float* left, float* right) {
  harp_mixer_run(harp, n_frames, left, right);
}

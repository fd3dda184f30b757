#include "core/harp/harp_mixer.h"

#include "core/base/finite.h"
#include "core/base/maths.h"
#include "core/harp/harp_bridge.h"
#include "core/harp/harp_channels.h"
#include "core/harp/harp_group.h"
#include "core/string/pickup.h"

#include <math.h>
#include <string.h>

/* Below which what is heard of a bow is taken for standing still [Hz]. */
static const double DC_HZ = 5.0;

/* The same once nothing sounds [Hz]; and what is left of it that nobody hears. */
static const double SILENT_DC_HZ = 100.0;
static const double LEAST_DC = 1e-7;

/* There is one, and what pulls at the body. */
static void pickups_of(const Harp* harp, Pickup places[PICKUPS]) {
  places[0] = (Pickup){harp->patch.pickup_type, harp->patch.pickup};
  places[1] = (Pickup){PICKUP_FORCE, 0.0};
}

void harp_mixer_place_pickups(Harp* harp) {
  Pickup places[PICKUPS];
  pickups_of(harp, places);
  pickups_set(&harp->pickups, places);
}

/* What is to be read until the pickup changes. */
static Reading reading_of(const Harp* harp) {
  const bool is_body = radiator_is_on(&harp->radiator);
  return pickups_reading(&harp->pickups, (const bool[PICKUPS]){true, is_body});
}

/* Velocities are weighed as if a key were in its usual tune: weights must not move while it rings.
 */
static double angle_of(const Harp* harp, const HarpString* string) {
  const double f0_hz = 440.0 * exp2(((double)string->key - 69.0) / 12.0);
  return 2.0 * PI * f0_hz / harp->rate_hz;
}

static void add_part(Harp* harp, uint32_t i, HarpString* string, const Reading* reading) {
  ChainPart* const part = &harp->parts[i];
  const double angle1 = angle_of(harp, string);
  part->chain = &string->voice.chain;
  for (uint32_t t = 0; t < reading->n_taps; ++t) {
    part->taps[t] = voice_tap(&string->voice, &reading->at[t], angle1);
  }
  harp->awake[i] = string;
}

/* Channels whose gain is 1, and stays there, are heard as they are: as if there were no gains. */
static uint8_t bus_of(const Harp* harp, uint32_t channel) {
  const Line* const gain = &harp->channels[channel].gain;
  return gain->value == 1.0 && gain->n_left == 0 ? 0 : (uint8_t)(1 + channel);
}

/* Those of the strings awake that are tied to the bridge, or those that are not, of one bus. */
static uint32_t
gather_bus(Harp* harp, uint32_t n_parts, bool are_tied, uint8_t bus, const Reading* reading) {
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    HarpString* const string = &harp->strings[i];
    if (string->voice.is_awake && tie_is_on(&string->voice.tie) == are_tied &&
        bus_of(harp, harp_channels_heard(string)) == bus) {
      voice_share(&string->voice, are_tied);
      harp->buses[n_parts] = bus;
      add_part(harp, n_parts++, string, reading);
    }
  }
  return n_parts;
}

/* What follows a string is heard where it is, and tied to nothing. */
static uint32_t
gather_followers(Harp* harp, uint32_t n_parts, uint8_t bus, const Reading* reading) {
  for (uint32_t i = 0; i < HARP_STRINGS * HARP_FOLLOWERS; ++i) {
    const HarpString* const leader = &harp->strings[i / HARP_FOLLOWERS];
    HarpString* const follower = harp_group_awake(leader, i % HARP_FOLLOWERS);
    if (follower && bus_of(harp, harp_channels_heard(leader)) == bus) {
      harp->buses[n_parts] = bus;
      add_part(harp, n_parts++, follower, reading);
    }
  }
  return n_parts;
}

static uint32_t
gather_all_of(Harp* harp, uint32_t n_parts, bool are_tied, uint8_t bus, const Reading* reading) {
  n_parts = gather_bus(harp, n_parts, are_tied, bus, reading);
  const bool are_followed = harp->is_followed && !are_tied;
  return are_followed ? gather_followers(harp, n_parts, bus, reading) : n_parts;
}

/* Of all buses, one after the other. */
static uint32_t gather_some(Harp* harp, uint32_t n_parts, bool are_tied, const Reading* reading) {
  n_parts = gather_all_of(harp, n_parts, are_tied, 0, reading);
  for (uint32_t channel = 0; channel < HARP_CHANNELS; ++channel) {
    const uint8_t bus = bus_of(harp, channel);
    n_parts = bus > 0 ? gather_all_of(harp, n_parts, are_tied, bus, reading) : n_parts;
  }
  return n_parts;
}

/* What has died away has no gain lent to it any more. */
static void end_loans(Harp* harp) {
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    HarpString* const string = &harp->strings[i];
    if (string->lender && !harp_group_is_awake(string)) {
      string->lender = 0;
    }
  }
}

/* What follows no string any more is not looked for. */
static void forget_followers(Harp* harp) {
  bool is_followed = false;
  for (uint32_t i = 0; harp->is_followed && i < HARP_STRINGS; ++i) {
    is_followed = !harp_group_forget(&harp->strings[i]) || is_followed;
  }
  harp->is_followed = is_followed;
}

/* The strings awake, and where they are read. */
static uint32_t gather(Harp* harp, const Reading* reading) {
  forget_followers(harp);
  end_loans(harp);
  const uint32_t n_tied = gather_some(harp, 0, true, reading);
  harp_bridge_gather(harp, n_tied);
  return gather_some(harp, n_tied, false, reading);
}

/* What a tap reads of all strings of a bus as they are. */
static float read_now(const Harp* harp, uint32_t n_parts, uint32_t bus, uint32_t t) {
  float sum = 0.0f;
  for (uint32_t i = 0; i < n_parts; ++i) {
    const ChainPart* const part = &harp->parts[i];
    const ChainTap* const tap = &part->taps[t];
    if (harp->buses[i] == bus) {
      sum += tap->weight[0] * chain_position(part->chain, tap->mass[0]) +
             tap->weight[1] * chain_position(part->chain, tap->mass[1]);
    }
  }
  return sum;
}

static uint32_t channels_apart(const Harp* harp) {
  uint32_t apart = 0;
  for (uint32_t channel = 0; channel < HARP_CHANNELS; ++channel) {
    apart |= (uint32_t)(bus_of(harp, channel) > 0) << channel;
  }
  return apart;
}

static bool are_same(const Reading* a, const Reading* b) {
  bool are_same = a->n_taps == b->n_taps;
  for (uint32_t t = 0; are_same && t < a->n_taps; ++t) {
    are_same = pickups_are_same(&a->at[t], &b->at[t]);
  }
  return are_same;
}

/* What is left behind goes on hiding what it hid; so does what comes, if it reads the same thing.
 */
static void take_onsets(Harp* harp, const Reading* reading) {
  const bool is_alike = reading->at[0].type == harp->onset_type;
  const uint32_t n_before = harp->reading.n_heard;
  for (uint32_t bus = 0; bus < HARP_BUSES; ++bus) {
    Onset* const onsets = harp->onsets[bus];
    Onset kept[PICKUPS] = {onsets[0], n_before > 1 ? onsets[1] : (Onset){0}};
    memset(onsets, 0, CHAIN_MAX_TAPS * sizeof(Onset));
    for (uint32_t t = 0; t < reading->n_heard; ++t) {
      onsets[t] = t > 0 || is_alike ? kept[t] : (Onset){0};
      if (reading->is_fading) {
        onsets[t + reading->n_heard] = kept[t];
      }
    }
  }
}

/* Who begins to read velocities must know where the strings were. */
static void take_reading(Harp* harp, const Reading* reading, uint32_t n_parts) {
  const uint32_t apart = channels_apart(harp);
  if (apart == harp->apart && are_same(reading, &harp->reading)) {
    return;
  }
  take_onsets(harp, reading);
  harp->reading = *reading;
  harp->apart = apart;
  for (uint32_t bus = 0; bus < HARP_BUSES; ++bus) {
    for (uint32_t t = 0; t < reading->n_taps; ++t) {
      const bool is_velocity = reading->at[t].type == PICKUP_VELOCITY;
      harp->before[bus][t] = is_velocity ? read_now(harp, n_parts, bus, t) : 0.0f;
    }
  }
}

/* Where the taps of a bus go, from a frame on. */
static void outputs_of(Harp* harp, uint32_t bus, uint32_t from, uint32_t n_taps, float** out) {
  for (uint32_t t = 0; t < n_taps; ++t) {
    out[t] = harp->mix[bus][t] + from;
  }
}

/* Fade from the old pickup, and set the level of what is read and of what pulls at the body. */
static void
mix_down(Harp* harp, const Reading* reading, uint32_t n_frames, float* read, float* pull) {
  float* mix[CHAIN_MAX_TAPS];
  outputs_of(harp, 0, 0, reading->n_taps, mix);
  pickups_cross(&harp->pickups, reading, n_frames, mix);
  for (uint32_t n = 0; n < n_frames; ++n) {
    const float level = (float)line_next(&harp->level);
    read[n] = level * mix[0][n];
    pull[n] = reading->n_heard > 1 ? level * mix[1][n] : 0.0f;
  }
}

/*
  A bow pulls the string aside for as long as it is drawn, and none can hear that.  So from the
  first note that is bowed on, what stands still is taken out of the sum; before that it is not
  touched.  Exact zeros mean that nothing sounds: then what is left of it is let go.
*/
static void block_dc(Harp* harp, uint32_t n_frames, float* read) {
  if (!harp->is_bowed) {
    return;
  }
  const double share = -expm1(-2.0 * PI * DC_HZ / harp->rate_hz);
  const double share_in_silence = -expm1(-2.0 * PI * SILENT_DC_HZ / harp->rate_hz);
  double dc = harp->dc;
  for (uint32_t n = 0; n < n_frames; ++n) {
    const double x = (double)read[n];
    const bool is_silent = x == 0.0;
    dc += (is_silent ? share_in_silence : share) * (x - dc);
    dc = is_silent && fabs(dc) < LEAST_DC ? 0.0 : dc;
    read[n] = (float)(x - dc);
  }
  harp->dc = dc;
}

/* Frames that can be run in one go: pickups and gains may not change within them but by their own
 * ramps. */
static uint32_t stretch(const Harp* harp, uint32_t n_frames) {
  uint32_t n = least(least(n_frames, HARP_MIX_FRAMES), pickups_stretch(&harp->pickups));
  n = least(n, radiator_stretch(&harp->radiator));
  for (uint32_t channel = 0; channel < HARP_CHANNELS; ++channel) {
    const uint32_t n_left = harp->channels[channel].gain.n_left;
    n = n_left > 0 ? least(n, n_left) : n;
  }
  return n;
}

/* Run a string that something happens to on the way. */
static void run_alone(Harp* harp, uint32_t i, uint32_t n_frames) {
  HarpString* const string = harp->awake[i];
  float* out[CHAIN_MAX_TAPS];
  outputs_of(harp, harp->buses[i], 0, harp->reading.n_taps, out);
  voice_run(&string->voice, &harp->reading, angle_of(harp, string), n_frames, out);
  voice_catch_up(&string->voice);
}

/* Run strings of one bus to which nothing happens side by side. */
static void
run_together(Harp* harp, uint32_t first, uint32_t end, uint32_t n_frames, uint32_t n_taps) {
  if (first < end) {
    float* out[CHAIN_MAX_TAPS];
    outputs_of(harp, harp->buses[first], 0, n_taps, out);
    chain_run_all(&harp->parts[first], end - first, n_frames, n_taps, out);
  }
  for (uint32_t i = first; i < end; ++i) {
    voice_pass(&harp->awake[i]->voice, n_frames);
    voice_catch_up(&harp->awake[i]->voice);
  }
}

/* Run the strings that are not tied in their order, those that nothing happens to together. */
static void run_strings(Harp* harp, uint32_t n_parts, uint32_t n_frames, uint32_t n_taps) {
  uint32_t first = harp->bridge.n_tied;
  for (uint32_t i = first; i < n_parts; ++i) {
    const bool is_new_bus = harp->buses[i] != harp->buses[first];
    const bool is_apart = voice_stretch(&harp->awake[i]->voice) <= n_frames;
    if (is_new_bus || is_apart) {
      run_together(harp, first, i, n_frames, n_taps);
      first = i;
    }
    if (is_apart) {
      run_alone(harp, i, n_frames);
      first = i + 1;
    }
  }
  run_together(harp, first, n_parts, n_frames, n_taps);
}

/* The buses that are heard, a bit each: the first, those of strings and noises, and those whose
 * last sample is still to be taken away, or that hide something. */
static uint32_t heard_buses(const Harp* harp, uint32_t n_parts, uint32_t n_taps) {
  uint32_t heard = 1;
  for (uint32_t i = 0; i < n_parts; ++i) {
    heard |= 1u << harp->buses[i];
  }
  for (uint32_t bus = 1; bus < HARP_BUSES; ++bus) {
    for (uint32_t t = 0; t < n_taps; ++t) {
      const bool is_left = harp->before[bus][t] != 0.0f || !onset_is_over(&harp->onsets[bus][t]);
      heard |= (uint32_t)is_left << bus;
    }
  }
  for (uint32_t channel = 0; channel < HARP_CHANNELS; ++channel) {
    heard |= (uint32_t)harp->noises[channel].is_active << bus_of(harp, channel);
  }
  return heard;
}

static void clear_buses(Harp* harp, uint32_t heard, uint32_t n_frames, uint32_t n_taps) {
  for (uint32_t bus = 0; bus < HARP_BUSES; ++bus) {
    for (uint32_t t = 0; t < n_taps && (heard >> bus & 1); ++t) {
      memset(harp->mix[bus][t], 0, n_frames * sizeof(float));
    }
  }
}

/* Differentiate what is a velocity, and hide that strings were pulled aside. */
static void finish_bus(Harp* harp, uint32_t bus, const Reading* reading, uint32_t n_frames) {
  for (uint32_t t = 0; t < reading->n_taps; ++t) {
    if (reading->at[t].type == PICKUP_VELOCITY) {
      pickup_differentiate(harp->mix[bus][t], n_frames, &harp->before[bus][t]);
    }
    onset_run(&harp->onsets[bus][t], harp->onset, n_frames, harp->mix[bus][t]);
  }
}

/* What fingers and hammers make of themselves is read as it is, whatever pickups hear. */
static void add_noises(Harp* harp, uint32_t bus, uint32_t n_taps, uint32_t n_frames) {
  float* out[CHAIN_MAX_TAPS];
  outputs_of(harp, bus, 0, n_taps, out);
  for (uint32_t channel = 0; channel < HARP_CHANNELS; ++channel) {
    if (bus_of(harp, channel) == bus) {
      noise_add(&harp->noises[channel], &harp->noise_make, n_frames, n_taps, out);
    }
  }
}

static void add_bus(Harp* harp, uint32_t channel, const Reading* reading, uint32_t n_frames) {
  Line* const gain = &harp->channels[channel].gain;
  finish_bus(harp, 1 + channel, reading, n_frames);
  add_noises(harp, 1 + channel, reading->n_taps, n_frames);
  for (uint32_t n = 0; n < n_frames; ++n) {
    const float now = (float)line_next(gain);
    for (uint32_t t = 0; t < reading->n_taps; ++t) {
      harp->mix[0][t][n] += now * harp->mix[1 + channel][t][n];
    }
  }
}

/* Add what each channel with a gain of its own plays to what the others do; a gain that nothing is
 * heard with goes on all the same. */
static void add_buses(Harp* harp, uint32_t heard, const Reading* reading, uint32_t n_frames) {
  finish_bus(harp, 0, reading, n_frames);
  add_noises(harp, 0, reading->n_taps, n_frames);
  for (uint32_t channel = 0; channel < HARP_CHANNELS; ++channel) {
    Line* const gain = &harp->channels[channel].gain;
    const bool is_heard = heard >> (1 + channel) & 1;
    if (is_heard) {
      add_bus(harp, channel, reading, n_frames);
    }
    for (uint32_t n = 0; !is_heard && n < n_frames && gain->n_left > 0; ++n) {
      (void)line_next(gain);
    }
  }
}

static bool is_sound(const Harp* harp, uint32_t heard, uint32_t n_frames, uint32_t n_taps) {
  bool is_sound = true;
  for (uint32_t bus = 0; bus < HARP_BUSES; ++bus) {
    for (uint32_t t = 0; t < n_taps && (heard >> bus & 1); ++t) {
      is_sound = is_sound && finite_all(harp->mix[bus][t], n_frames);
    }
  }
  return is_sound;
}

/* What is not a number is heard by nobody, and whose it was is silent. */
static void mend(Harp* harp, uint32_t n_parts, uint32_t heard, uint32_t n_frames, uint32_t n_taps) {
  for (uint32_t i = 0; i < n_parts; ++i) {
    voice_mend(&harp->awake[i]->voice);
  }
  harp_bridge_mend(harp);
  clear_buses(harp, heard, n_frames, n_taps);
  memset(harp->before, 0, sizeof harp->before);
  memset(harp->onsets, 0, sizeof harp->onsets);
}

/* Run as many of `n_frames` as can be run in one go; how many they were. */
static uint32_t run_stretch(Harp* harp, uint32_t n_frames, float* left, float* right) {
  float pull[HARP_MIX_FRAMES];
  const Reading reading = reading_of(harp);
  const uint32_t n_parts = gather(harp, &reading);
  const uint32_t n_most = harp_bridge_stretch(harp, stretch(harp, n_frames));
  take_reading(harp, &reading, n_parts);
  const uint32_t heard = heard_buses(harp, n_parts, reading.n_taps);
  clear_buses(harp, heard, n_most, reading.n_taps);
  const uint32_t n = harp_bridge_run(harp, n_most, &reading);
  run_strings(harp, n_parts, n, reading.n_taps);
  if (!is_sound(harp, heard, n, reading.n_taps)) {
    mend(harp, n_parts, heard, n, reading.n_taps);
  }
  add_buses(harp, heard, &reading, n);
  harp_bridge_pass(harp, n);
  mix_down(harp, &reading, n, left, pull);
  block_dc(harp, n, left);
  harp_stereo_run(&harp->stereo, left, n, left, right);
  radiator_run(&harp->radiator, pull, n, left, right);
  return n;
}

/* A tap of a string, of its position or its velocity. */
static double
read_string(const HarpString* string, const ChainTap* tap, float (*of)(const Chain*, uint32_t)) {
  const Chain* const chain = &string->voice.chain;
  return (double)tap->weight[0] * (double)of(chain, tap->mass[0]) +
         (double)tap->weight[1] * (double)of(chain, tap->mass[1]);
}

/* Hide that what is read of a string steps: by what it reads now, or the other way round. */
static void hide(Harp* harp, uint32_t bus, const HarpString* string, double sign) {
  const Reading reading = reading_of(harp);
  for (uint32_t t = 0; t < reading.n_taps; ++t) {
    const ChainTap tap = voice_tap(&string->voice, &reading.at[t], angle_of(harp, string));
    const double x = sign * read_string(string, &tap, chain_position);
    const double u = sign > 0.0 ? read_string(string, &tap, chain_velocity) : 0.0;
    if (reading.at[t].type == PICKUP_VELOCITY) {
      harp->before[bus][t] -= (float)x;
      onset_hide(&harp->onsets[bus][t], u, 0.0);
    } else {
      onset_hide(&harp->onsets[bus][t], x, u);
    }
  }
  harp->onset_type = reading.at[0].type;
}

/* What was read before must be known, or there would be nothing to take a step from. */
static void listen(Harp* harp) {
  const Reading reading = reading_of(harp);
  if (!are_same(&reading, &harp->reading)) {
    take_reading(harp, &reading, gather(harp, &reading));
  }
}

static void hide_group(Harp* harp, const HarpString* leader, double sign) {
  const uint32_t bus = bus_of(harp, harp_channels_heard(leader));
  if (leader->voice.is_awake) {
    hide(harp, bus, leader, sign);
  }
  for (uint32_t i = 0; i < HARP_FOLLOWERS; ++i) {
    const HarpString* const follower = harp_group_awake(leader, i);
    if (follower) {
      hide(harp, bus, follower, sign);
    }
  }
}

void harp_mixer_hide_end(Harp* harp, const HarpString* leader) {
  listen(harp);
  hide_group(harp, leader, 1.0);
}

void harp_mixer_hide_start(Harp* harp, const HarpString* leader) {
  hide_group(harp, leader, -1.0);
}

void harp_mixer_run(Harp* harp, uint32_t n_frames, float* left, float* right) {
  for (uint32_t done = 0; done < n_frames;) {
    Pickup places[PICKUPS];
    pickups_of(harp, places);
    pickups_move(&harp->pickups, places, harp->n_fade);
    radiator_set(&harp->radiator, &harp->patch.body, harp->rate_hz, harp->n_fade);
    harp_bridge_move(harp);
    done += run_stretch(harp, n_frames - done, left + done, right + done);
  }
}

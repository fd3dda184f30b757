#include "core/harp/harp_bridge.h"

#include "core/base/maths.h"
#include "core/harp/harp_channels.h"
#include "core/harp/harp_group.h"
#include "core/string/chain_numbers.h"

#include <math.h>
#include <string.h>

/* Motion of the bridge from which on strings wake: some 60 dB less than what moves it. */
static const double WAKING = 1e-9;

/* Motion of the bridge, over the loudest string's, up to which they may sleep: what a string moves
 * it by that has died away to -120 dB. */
static const double RESTING = 1e-10;

/* What is left of its level at the next place of the grid. */
static const double LEVEL_KEPT = 0.97;

/* How far a damper must be lifted for its string to wake. */
static const double LIFTED = 0.5;

void harp_bridge_init(HarpBridge* bridge, double rate_hz) {
  memset(bridge, 0, sizeof(*bridge));
  bridge_init(&bridge->bridge, rate_hz);
  bridge->n_until_grid = HARP_BRIDGE_FRAMES;
}

/* Nothing moves it any more. */
static void rest(HarpBridge* bridge) {
  bridge_rest(&bridge->bridge);
  bridge->loudest = 0.0;
  bridge->level = 0.0;
  bridge->n_until_grid = HARP_BRIDGE_FRAMES;
  bridge->next_key = 0;
}

static void read_tie(HarpBridgeEnd* end, const Tie* tie) {
  end->give = tie->weight * tie->pull.value;
  end->pull = tie->pull.value;
  end->spring = tie->spring.value;
}

static HarpBridgeEnd end_of(const Chain* chain, const Tie* tie) {
  const size_t offset = chain_numbers_offset(chain, chain->n_masses - 1);
  const bool is_double = chain->numbers == CHAIN_DOUBLE;
  HarpBridgeEnd end = {
      .f = is_double ? NULL : (float*)chain->cells + offset,
      .d = is_double ? (double*)chain->cells + offset : NULL,
      .to_u = chain->loops->n_lanes,
  };
  read_tie(&end, tie);
  return end;
}

/* Strings that follow each other, need the same loop and are heard on one bus are stepped by one
 * call. */
static void
add_work(HarpBridge* bridge, uint32_t i, const ChainPart* part, uint32_t bus, uint32_t n_taps) {
  const ChainLoop loop = chain_loop(part->chain, n_taps);
  HarpBridgeBatch* const last = i > 0 ? &bridge->batches[bridge->n_batches - 1] : NULL;
  bridge->works[i] = chain_work(part, n_taps);
  if (last && last->loop == loop && last->bus == bus && last->n < CHAIN_MAX_BATCH) {
    ++last->n;
  } else {
    bridge->batches[bridge->n_batches++] =
        (HarpBridgeBatch){.loop = loop, .bus = bus, .first = i, .n = 1};
  }
}

static double weight_of_last(const ChainPart* part, uint32_t t) {
  const ChainTap* const tap = &part->taps[t];
  const uint32_t last = part->chain->n_masses - 1;
  return (tap->mass[0] == last ? (double)tap->weight[0] : 0.0) +
         (tap->mass[1] == last ? (double)tap->weight[1] : 0.0);
}

/* What loops read is what strings do by themselves, before the bridge pulls and moves the last
 * mass. */
static void tell_taps(Harp* harp, const Reading* reading) {
  HarpBridge* const bridge = &harp->bridge;
  for (uint32_t b = 0; b < bridge->n_batches; ++b) {
    HarpBridgeBatch* const batch = &bridge->batches[b];
    for (uint32_t t = 0; t < reading->n_taps; ++t) {
      double pulled = 0.0;
      for (uint32_t i = batch->first; i < batch->first + batch->n; ++i) {
        pulled += weight_of_last(&harp->parts[i], t) * bridge->ends[i].pull;
      }
      batch->pulled[t] = pulled;
    }
  }
}

static void prepare(Harp* harp, const Reading* reading) {
  HarpBridge* const bridge = &harp->bridge;
  bridge->n_batches = 0;
  bridge->is_gliding = false;
  bridge->spring = 0.0;
  for (uint32_t i = 0; i < bridge->n_tied; ++i) {
    const Tie* const tie = &harp->awake[i]->voice.tie;
    add_work(bridge, i, &harp->parts[i], harp->buses[i], reading->n_taps);
    bridge->ends[i] = end_of(harp->parts[i].chain, tie);
    bridge->is_gliding = bridge->is_gliding || tie_stretch(tie) > 0;
    bridge->spring += tie->spring.value;
  }
  tell_taps(harp, reading);
}

static void glide(Harp* harp, const Reading* reading) {
  HarpBridge* const bridge = &harp->bridge;
  bridge->spring = 0.0;
  for (uint32_t i = 0; i < bridge->n_tied; ++i) {
    const Tie* const tie = &harp->awake[i]->voice.tie;
    voice_advance_tie(&harp->awake[i]->voice);
    read_tie(&bridge->ends[i], tie);
    bridge->spring += tie->spring.value;
  }
  tell_taps(harp, reading);
}

/* How the strings pull at the bridge where they are. */
static double force_of(const HarpBridge* bridge) {
  double force = 0.0;
  for (uint32_t i = 0; i < bridge->n_tied; ++i) {
    const HarpBridgeEnd* const end = &bridge->ends[i];
    /* It is in one of them.  NOLINTNEXTLINE(clang-analyzer-core.NullDereference) */
    force += end->give * (end->d ? *end->d : (double)*end->f);
  }
  return force;
}

/* And it at them. */
static void pull(HarpBridge* bridge) {
  const double y = bridge->bridge.y;
  for (uint32_t i = 0; i < bridge->n_tied; ++i) {
    const HarpBridgeEnd* const end = &bridge->ends[i];
    const double change = end->pull * y;
    if (end->d) {
      end->d[0] += change;
      end->d[end->to_u] += change;
    } else {
      end->f[0] = (float)((double)end->f[0] + change);
      end->f[end->to_u] = (float)((double)end->f[end->to_u] + change);
    }
  }
}

/* What taps read of what the bridge does, which was where it `was` before this frame. */
static void hear(Harp* harp, double was, uint32_t n_taps, uint32_t n) {
  const HarpBridge* const bridge = &harp->bridge;
  for (uint32_t b = 0; b < bridge->n_batches; ++b) {
    const HarpBridgeBatch* const batch = &bridge->batches[b];
    for (uint32_t t = 0; t < n_taps; ++t) {
      harp->mix[batch->bus][t][n] += (float)(batch->pulled[t] * was);
    }
  }
}

/* Hammers and bows, and who listens to them, which may set the string gliding; true if something is
 * over, or begins. */
static bool act(Harp* harp) {
  bool is_new = false;
  for (uint32_t i = 0; i < harp->bridge.n_tied; ++i) {
    if (harp->bridge.is_touched[i]) {
      chain_pass(harp->parts[i].chain, 1);
      is_new = voice_pass(&harp->awake[i]->voice, 1) || is_new;
      voice_catch_up(&harp->awake[i]->voice);
    }
  }
  return is_new;
}

static void run_frame(Harp* harp, const Reading* reading, uint32_t n) {
  HarpBridge* const bridge = &harp->bridge;
  if (bridge->is_gliding) {
    glide(harp, reading);
  }
  const double force = force_of(bridge);
  const double was = bridge->bridge.y;
  for (uint32_t b = 0; b < bridge->n_batches; ++b) {
    const HarpBridgeBatch* const batch = &bridge->batches[b];
    float* out[CHAIN_MAX_TAPS];
    for (uint32_t t = 0; t < reading->n_taps; ++t) {
      out[t] = &harp->mix[batch->bus][t][n];
    }
    batch->loop(&bridge->works[batch->first], batch->n, 1, out);
  }
  pull(bridge);
  bridge_step(&bridge->bridge, force, bridge->spring);
  bridge->level = fmax(bridge->level, fabs(bridge->bridge.y));
  hear(harp, was, reading->n_taps, n);
}

static void pass_untouched(Harp* harp, uint32_t n_frames) {
  for (uint32_t i = 0; i < harp->bridge.n_tied; ++i) {
    if (!harp->bridge.is_touched[i]) {
      chain_pass(harp->parts[i].chain, n_frames);
      voice_pass(&harp->awake[i]->voice, n_frames);
      voice_catch_up(&harp->awake[i]->voice);
    }
  }
}

static bool is_tied(const Harp* harp) {
  bool is_tied = false;
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    const Voice* const voice = &harp->strings[i].voice;
    is_tied = is_tied || (voice->is_awake && tie_is_on(&voice->tie));
  }
  return is_tied;
}

static void put_on(Harp* harp, RadiatorBody body) {
  HarpBridge* const bridge = &harp->bridge;
  if (body.body) {
    bridge_init_on(&bridge->bridge, body.body, body.shape, harp->rate_hz);
  } else {
    bridge_init(&bridge->bridge, harp->rate_hz);
  }
  bridge->on = body;
}

void harp_bridge_move(Harp* harp) {
  HarpBridge* const bridge = &harp->bridge;
  const bool was_leaving = bridge->bridge.is_leaving;
  const RadiatorBody body = radiator_wanted(&harp->radiator, &harp->patch.body);
  const bool is_there = harp->patch.resonance == 0.0 || radiator_body_is_same(&body, &bridge->on);
  bridge->bridge.is_leaving = !is_there && is_tied(harp);
  if (!is_there && !bridge->bridge.is_leaving) {
    put_on(harp, body);
  }
  if (bridge->bridge.is_leaving != was_leaving) {
    harp_channels_retune_all(harp, harp->n_gesture);
  }
}

void harp_bridge_gather(Harp* harp, uint32_t n_tied) {
  if (n_tied == 0 && harp->bridge.n_tied > 0) {
    rest(&harp->bridge);
  }
  harp->bridge.n_tied = n_tied;
}

uint32_t harp_bridge_stretch(const Harp* harp, uint32_t n_frames) {
  const HarpBridge* const bridge = &harp->bridge;
  if (bridge->n_tied > 0) {
    n_frames = least(n_frames, bridge->n_until_grid);
  }
  for (uint32_t i = 0; i < bridge->n_tied; ++i) {
    const Voice* const voice = &harp->awake[i]->voice;
    const uint32_t n_gliding = tie_stretch(&voice->tie);
    n_frames = least(n_frames, voice_due(voice));
    n_frames = n_gliding > 0 ? least(n_frames, n_gliding) : n_frames;
  }
  return n_frames;
}

uint32_t harp_bridge_run(Harp* harp, uint32_t n_frames, const Reading* reading) {
  HarpBridge* const bridge = &harp->bridge;
  if (bridge->n_tied == 0) {
    return n_frames;
  }
  bool is_touched = false;
  for (uint32_t i = 0; i < bridge->n_tied; ++i) {
    bridge->is_touched[i] = voice_is_touched(&harp->awake[i]->voice);
    is_touched = is_touched || bridge->is_touched[i];
  }
  prepare(harp, reading);
  uint32_t n = 0;
  for (bool is_over = false; n < n_frames && !is_over; ++n) {
    run_frame(harp, reading, n);
    is_over = is_touched && act(harp);
  }
  pass_untouched(harp, n);
  return n;
}

/* The energy that a square of the amplitude of a string is, in that of the bridge's mass. */
static double energy_of(const Voice* voice) {
  return voice->tie.hold.mass * chain_pace(&voice->chain);
}

/* What others may have given a string: all that was given to any. */
static void lend(Harp* harp) {
  double sum = 0.0;
  for (uint32_t i = 0; i < harp->bridge.n_tied; ++i) {
    const Voice* const voice = &harp->awake[i]->voice;
    sum += energy_of(voice) * voice->ledger.given;
  }
  for (uint32_t i = 0; i < harp->bridge.n_tied; ++i) {
    Voice* const voice = &harp->awake[i]->voice;
    if (voice->tie.hold.mass > 0.0) {
      voice_lend(voice, sum / energy_of(voice));
    }
  }
}

/* No string sleeps that the bridge moves, or that is yet to answer. */
static void keep(Harp* harp) {
  HarpBridge* const bridge = &harp->bridge;
  for (uint32_t i = 0; i < bridge->n_tied; ++i) {
    bridge->loudest = fmax(bridge->loudest, harp->awake[i]->voice.loudest);
  }
  for (uint32_t i = 0; i < bridge->n_tied; ++i) {
    Voice* const voice = &harp->awake[i]->voice;
    const bool is_open = voice->tie.hold.lever > 0.0;
    voice_keep(voice, is_open && bridge->level > RESTING * bridge->loudest, bridge->loudest);
  }
}

static bool is_waiting(const Harp* harp, const HarpString* string) {
  return !string->voice.is_awake && harp_channels_lift(harp, string) >= LIFTED &&
         !isnan(string->semitones);
}

/* It is then the string of the channel that lifts its damper, unless others of its group ring. */
static void wake_string(Harp* harp, HarpString* string) {
  if (!string->holders && !string->is_caught && !harp_group_is_awake(string)) {
    string->channel = harp_channels_pedal(harp);
    string->touch = harp->channels[string->channel].touch;
    string->is_let_go = false;
  }
  string->lift = harp_channels_lift(harp, string);
  harp_group_wake(string, harp->n_gesture);
}

static void wake(Harp* harp) {
  HarpBridge* const bridge = &harp->bridge;
  uint32_t n_woken = 0;
  for (uint32_t key = HARP_BRIDGE_LOWEST; key <= HARP_BRIDGE_HIGHEST; ++key) {
    enum { N_KEYS = HARP_BRIDGE_HIGHEST + 1 - HARP_BRIDGE_LOWEST };
    HarpString* const string = &harp->strings[HARP_BRIDGE_LOWEST + bridge->next_key];
    if (n_woken == HARP_BRIDGE_WAKES) {
      return;
    }
    bridge->next_key = (bridge->next_key + 1) % N_KEYS;
    if (is_waiting(harp, string)) {
      wake_string(harp, string);
      ++n_woken;
    }
  }
}

void harp_bridge_pass(Harp* harp, uint32_t n_frames) {
  HarpBridge* const bridge = &harp->bridge;
  if (bridge->n_tied == 0) {
    return;
  }
  bridge->n_until_grid -= n_frames;
  if (bridge->n_until_grid == 0) {
    bridge->n_until_grid = HARP_BRIDGE_FRAMES;
    lend(harp);
    keep(harp);
    if (bridge->level > WAKING && harp->patch.resonance > 0.0) {
      wake(harp);
    }
    bridge->level *= LEVEL_KEPT;
  }
}

void harp_bridge_mend(Harp* harp) {
  if (!isfinite(harp->bridge.bridge.y)) {
    rest(&harp->bridge);
  }
}

double harp_bridge_headroom(const Harp* harp) {
  double load = 0.0;
  bool is_tied = false;
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    const HarpString* const string = &harp->strings[i];
    const Tie* const tie = &string->voice.tie;
    if (string->voice.is_awake && tie_is_on(tie)) {
      load += fmax(tie->load.value, tie->load.goal);
      is_tied = true;
    }
  }
  return is_tied ? bridge_headroom(&harp->bridge.bridge, load) : 1.0;
}

#include "core/guitar/guitar_string.h"

#include "core/base/maths.h"

#include <string.h>

/* Time in which a choked string has died away far enough for another to take its place [s]. */
static const double LEFT_S = 5.0 * VOICE_CHOKE_S;

/* Where it pulls at the body. */
static const Pickup at_bridge = {PICKUP_FORCE, 0.0};

uint32_t guitar_string_masses(uint32_t n_open, double frets) {
  return (uint32_t)fmax(1.0, round((n_open + 1.0) * exp2(-frets / 12.0)) - 1.0);
}

/* Frets from the nut of one that is counted from the capo; at least 0. */
static double frets_from_nut(const GuitarPatch* patch, double fret) {
  return fmax(patch->capo + fret, 0.0);
}

/* What a note is to sound like without a hand on the string. */
static TuningTarget free_target(const GuitarString* string, double note, double f0_hz) {
  return string_patch_target(&string->patch->string, string->voice.rate_hz, note - 69.0, f0_hz);
}

static double pitch_hz(const GuitarString* string, double note) {
  return string_patch_pitch_hz(&string->patch->string, note - 69.0);
}

static double open_note(const GuitarString* string) {
  return string->open + string->detuning;
}

/* Of the open string, with no hand on it. */
static TuningTarget open_target(const GuitarString* string) {
  const double note = open_note(string);
  return free_target(string, note, pitch_hz(string, note));
}

/* The palm dulls it, too. */
static TuningTarget under_palm(const GuitarPatch* patch, TuningTarget target) {
  const double palm_per_s = GUITAR_PALM_PER_S * patch->palm * patch->palm;
  const double tau_s = 1.0 / (1.0 / target.tone.tau_s + palm_per_s);
  return palm_per_s > 0.0 ? tuning_damped(target, tau_s, GUITAR_PALM_LOSS) : target;
}

/* The pitch where a mass is stopped and nothing else is done: that of the open string's springs. */
static double uncorrected_hz(const GuitarString* string) {
  const TuningTarget open = open_target(string);
  const double frets = frets_from_nut(string->patch, string->voice.motion.slide.value);
  StringCoefs coefs = {0};
  if (tuning_solve(&open, string->n_open, &coefs)) {
    return open.tone.f0_hz;
  }
  const Pole first = tuning_mode(coefs, guitar_string_masses(string->n_open, frets), 1);
  return pole_tone(open.rate_hz, first).f0_hz;
}

/* What it is to sound like, as it is fretted, bent and damped now.  The damping is that of the note
 * that is fretted. */
static VoiceAim aim_of(const GuitarString* string) {
  const GuitarPatch* const patch = string->patch;
  const VoiceMotion* const motion = &string->voice.motion;
  const double note = open_note(string) + patch->capo + motion->slide.value;
  const double f0_hz = patch->is_uncorrected ? uncorrected_hz(string) : pitch_hz(string, note);
  const double bent_hz = f0_hz * exp2(motion_bend(motion) / 12.0);
  const double release_s = string_patch_release_s(&patch->string, note - 69.0);
  return (VoiceAim){
      .open = under_palm(patch, free_target(string, note, bent_hz)),
      .damper_s = string->damper == GUITAR_DAMPED ? release_s : 0.0,
      .tension = patch->string.tension,
  };
}

/* What a magnet hears is to be as loud at every pitch as what moves: 1/(2 sin(ω/2)), ω being the
 * fundamental's digital angle. */
static double weight_of(const Voice* voice) {
  return 0.5 / sin(fmin(PI * voice->f0_hz / voice->rate_hz, 0.5 * PI));
}

/* A pitch that cannot be had chokes it. */
static void retune(GuitarString* string, uint32_t n_glide) {
  Voice* const voice = &string->voice;
  voice_choke(voice, string->damper == GUITAR_CHOKED);
  if (voice->is_awake) {
    const VoiceAim aim = aim_of(string);
    voice_aim(voice, &aim, n_glide);
    string->damper = voice->is_choked ? GUITAR_CHOKED : string->damper;
    line_to(&string->weight, weight_of(voice), voice->chain.n_gliding);
  }
}

static double pull_of(const GuitarString* string) {
  const ChainTap tap = voice_tap(&string->voice, &at_bridge, 0.0);
  return string->voice.is_awake
             ? (double)tap.weight[0] * (double)chain_position(&string->voice.chain, tap.mass[0])
             : 0.0;
}

/* Masses between the bridge and where it will be stopped. */
static uint32_t masses_wanted(const GuitarString* string) {
  const double frets = frets_from_nut(string->patch, guitar_string_fretted(string));
  return guitar_string_masses(string->n_open, frets);
}

/* What becomes shorter has fewer masses from the beginning of its way on. */
static void shorten(GuitarString* string) {
  if (string->voice.is_awake) {
    const VoiceAim aim = aim_of(string);
    voice_shorten(&string->voice, &aim, masses_wanted(string));
  }
}

/* And what becomes longer has more at its end. */
static void lengthen(GuitarString* string) {
  if (string->voice.is_awake) {
    const VoiceAim aim = aim_of(string);
    voice_lengthen(&string->voice, &aim, masses_wanted(string));
  }
}

/* Something in its motion has changed: its pieces begin now. */
static void start(GuitarString* string) {
  shorten(string);
  voice_start_pieces(&string->voice);
  string->n_fade = string->voice.n_gesture;
}

/* The next piece of its motion, or after the last the masses that it has room for. */
static void begin_piece(void* of) {
  GuitarString* const string = of;
  Voice* const voice = &string->voice;
  if (motion_is_still(&voice->motion)) {
    voice_end_pieces(voice);
    lengthen(string);
    retune(string, voice->n_gesture);
  } else {
    const uint32_t n_frames = motion_piece(&voice->motion);
    voice_begin_piece(voice, n_frames);
    retune(string, n_frames);
  }
}

static void places_of(const GuitarString* string, Pickup places[PICKUPS]) {
  for (int p = 0; p < GUITAR_PICKUPS; ++p) {
    places[p] = (Pickup){.type = PICKUP_MAGNET,
                         .place = guitar_string_place(string, string->patch->pickups[p].place)};
  }
}

/* From rest, with the masses of the open string that are not stopped. */
static bool restring(GuitarString* string) {
  const TuningTarget open = open_target(string);
  const uint32_t n_open =
      tuning_max_masses(&open, least(string->patch->string.max_masses, string->voice.capacity));
  Pickup places[PICKUPS];
  string->n_open = n_open > 0 ? n_open : 1;
  const VoiceAim aim = aim_of(string);
  places_of(string, places);
  pickups_set(&string->pickups, places);
  if (!voice_string(&string->voice, &aim, masses_wanted(string), 0)) {
    return false;
  }
  line_set(&string->weight, weight_of(&string->voice));
  return true;
}

void guitar_string_init(
    GuitarString* string, const GuitarPatch* patch, double rate_hz, uint32_t phase, void* memory) {
  *string = (GuitarString){.patch = patch, .onset_pole = onset_pole(rate_hz)};
  voice_init(&string->voice, rate_hz, phase, memory, GUITAR_MAX_MASSES,
             (VoiceOwner){begin_piece, string}, NULL);
}

void guitar_string_reset(GuitarString* string) {
  voice_reset(&string->voice);
  string->onset = (Onset){0};
  string->damper = GUITAR_RINGING;
  string->n_damped = 0;
  string->fret = 0.0;
  string->channel = 0;
}

double guitar_string_place(const GuitarString* string, double place) {
  const double frets = frets_from_nut(string->patch, guitar_string_fretted(string));
  return fmin(place * exp2(frets / 12.0), GUITAR_FARTHEST);
}

double guitar_string_fretted(const GuitarString* string) {
  return string->voice.motion.slide.goal;
}

void guitar_string_follow(GuitarString* string, uint32_t n_glide) {
  Voice* const voice = &string->voice;
  string->n_fade = n_glide > voice->n_gesture ? n_glide : voice->n_gesture;
  if (voice->is_awake && motion_is_still(&voice->motion)) {
    shorten(string);
    retune(string, string->n_fade);
    voice_wait_for_piece(voice, string->n_fade);
  }
}

/* A string that is asleep is where it is going at once, if that takes no more than a gesture. */
static uint32_t frames_for(const Voice* voice, uint32_t n_frames) {
  return !voice->is_awake && n_frames <= voice->n_gesture ? 0 : n_frames;
}

void guitar_string_slide(GuitarString* string, double fret, uint32_t n_frames) {
  Voice* const voice = &string->voice;
  voice_halt(voice);
  voice_slide(voice, fret, frames_for(voice, n_frames));
  start(string);
}

void guitar_string_bend(GuitarString* string, double semitones, uint32_t n_frames) {
  Voice* const voice = &string->voice;
  voice_halt(voice);
  voice_bend(voice, semitones, frames_for(voice, n_frames));
  start(string);
}

void guitar_string_vibrato(GuitarString* string, double depth, double rate) {
  Voice* const voice = &string->voice;
  voice_halt(voice);
  voice_vibrato(voice, depth);
  voice_vibrato_rate(voice, rate);
  start(string);
}

void guitar_string_leave(GuitarString* string, GuitarString* tail) {
  Voice* const voice = &string->voice;
  const bool is_taken = tail->voice.is_awake && tail->voice.n_choked < LEFT_S * voice->rate_hz;
  if (!voice->is_awake || is_taken) {
    return;
  }
  voice_hand_over(voice, &tail->voice);
  voice_slide(&tail->voice, tail->voice.motion.slide.value, 0);
  tail->pickups = string->pickups;
  tail->weight = string->weight;
  tail->onset = string->onset;
  string->onset = (Onset){0};
  tail->open = string->open;
  tail->detuning = string->detuning;
  tail->n_fade = string->n_fade;
  tail->n_open = string->n_open;
  tail->damper = GUITAR_RINGING;
  guitar_string_damp(tail, GUITAR_CHOKED, 0);
  if (voice->motion.slide.n_left <= voice->n_gesture) {
    voice_slide(voice, voice->motion.slide.goal, 0);
  }
}

void guitar_string_pluck(GuitarString* string, Pluck pluck) {
  if (string->damper != GUITAR_RINGING) {
    guitar_string_damp(string, GUITAR_RINGING, 0);
  }
  if (string->voice.is_awake || restring(string)) {
    const double before = pull_of(string);
    pluck.amplitude = -pluck.amplitude; /* It flies back from where it was pulled. */
    voice_pluck(&string->voice, pluck);
    onset_hide(&string->onset, before - pull_of(string), 0.0);
  }
}

void guitar_string_damp(GuitarString* string, GuitarDamper damper, uint32_t n_frames) {
  if (damper == GUITAR_DAMPED && string->damper == GUITAR_CHOKED) {
    return; /* A finger more keeps nothing ringing, nor does it when it lifts. */
  }
  string->damper = damper;
  string->n_damped = n_frames;
  voice_choke(&string->voice, damper == GUITAR_CHOKED);
  guitar_string_follow(string, string->voice.n_gesture);
}

void guitar_string_touch(GuitarString* string, double place, uint32_t n_frames) {
  voice_touch(&string->voice, place, n_frames);
}

void guitar_string_untouch(GuitarString* string) {
  voice_untouch(&string->voice);
}

/* Add what some of the pickups read, by their gains from frame `from` on. */
static void
add(float* const* samples, const GuitarGains* gains, uint32_t from, uint32_t n_frames, float* out) {
  uint32_t t = 0;
  for (int p = 0; p < GUITAR_PICKUPS; ++p) {
    if (gains->is_read[p]) {
      const float* const gain = gains->gain[p] + from;
      for (uint32_t n = 0; n < n_frames; ++n) {
        out[n] += gain[n] * samples[t][n];
      }
      ++t;
    }
  }
}

/* A string that no pickup reads is stepped all the same; the bridge comes last, as often as there
 * is room, and never fades. */
static Reading reading_of(const GuitarString* string, const GuitarGains* gains, bool is_body) {
  const bool is_none = !gains->is_read[0] && !gains->is_read[1] && !is_body;
  Reading reading = pickups_reading(
      &string->pickups, (const bool[PICKUPS]){gains->is_read[0] || is_none, gains->is_read[1]});
  if (is_body) {
    const uint32_t n_taps = chain_taps(reading.n_taps + 1);
    while (reading.n_taps < n_taps) {
      reading.at[reading.n_taps++] = at_bridge;
    }
  }
  return reading;
}

/* What a magnet reads, as loud at every pitch. */
static void weigh(GuitarString* string, uint32_t n_taps, uint32_t n_frames, float* const* samples) {
  float weight[GUITAR_MIX_FRAMES];
  line_fill(&string->weight, n_frames, weight);
  for (uint32_t t = 0; t < n_taps; ++t) {
    for (uint32_t n = 0; n < n_frames; ++n) {
      samples[t][n] *= weight[n];
    }
  }
}

/* Run it as long as the pickups do not change but by their own fade. */
static void run_stretch(GuitarString* string,
                        const GuitarGains* gains,
                        uint32_t from,
                        uint32_t n_frames,
                        float* out,
                        float* pull) {
  const Reading reading = reading_of(string, gains, pull);
  float samples[CHAIN_MAX_TAPS][GUITAR_MIX_FRAMES];
  float* taps[CHAIN_MAX_TAPS];
  for (uint32_t t = 0; t < reading.n_taps; ++t) {
    taps[t] = memset(samples[t], 0, n_frames * sizeof(float));
  }
  voice_run(&string->voice, &reading, 0.0, n_frames, taps);
  pickups_cross(&string->pickups, &reading, n_frames, taps);
  weigh(string, reading.n_heard, n_frames, taps);
  add(taps, gains, from, n_frames, out);
  for (uint32_t n = 0; pull && n < n_frames; ++n) {
    pull[n] += taps[reading.n_taps - 1][n];
  }
}

/* Fingers take their time to pull, and a string that has died in it leaves that behind. */
static void run_onset(GuitarString* string, uint32_t n_frames, float* pull) {
  if (pull) {
    onset_run(&string->onset, string->onset_pole, n_frames, pull);
  } else {
    string->onset = (Onset){0};
  }
}

/* What is not heard moves all the same. */
static void run_asleep(GuitarString* string, uint32_t n_frames) {
  const Reading none = {.n_taps = 0};
  voice_run(&string->voice, &none, 0.0, n_frames, NULL);
}

static void pass(GuitarString* string, uint32_t n_frames) {
  if (string->n_damped > 0) {
    string->n_damped -= n_frames;
    if (string->n_damped == 0) {
      guitar_string_damp(string, GUITAR_RINGING, 0);
    }
  }
}

/* Frames until something happens to it: its pitch is looked after between two runs. */
static uint32_t stretch(const GuitarString* string, uint32_t n_frames) {
  const Voice* const voice = &string->voice;
  uint32_t n = string->n_damped > 0 ? least(n_frames, string->n_damped) : n_frames;
  if (voice->is_awake) {
    n = voice->is_moving ? least(n, voice->n_until_piece) : n;
    n = least(n, pickups_stretch(&string->pickups));
  }
  return n;
}

void guitar_string_mend(GuitarString* string) {
  voice_mend(&string->voice);
  string->onset = (Onset){0};
}

bool guitar_string_is_heard(const GuitarString* string) {
  return string->voice.is_awake || !onset_is_over(&string->onset);
}

void guitar_string_run(
    GuitarString* string, const GuitarGains* gains, uint32_t n_frames, float* out, float* pull) {
  for (uint32_t done = 0; done < n_frames;) {
    voice_catch_up(&string->voice);
    if (string->voice.is_awake) {
      Pickup places[PICKUPS];
      places_of(string, places);
      pickups_move(&string->pickups, places, string->n_fade);
    }
    const uint32_t n = stretch(string, n_frames - done);
    float* const pull_on = pull ? pull + done : NULL;
    if (string->voice.is_awake) {
      run_stretch(string, gains, done, n, out + done, pull_on);
    } else {
      run_asleep(string, n);
    }
    run_onset(string, n, pull_on);
    pass(string, n);
    done += n;
  }
}

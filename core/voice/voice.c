#include "core/voice/voice.h"

#include "core/base/maths.h"
#include "core/excite/finger.h"
#include "core/string/remesh.h"

/* Amplitude, of the loudest, at which a string has died away. */
static const double SILENCE = 1e-6;

/* Amplitude at which it has in any case, should it have been fast to die before it was looked at.
 */
static const double STILLNESS = 1e-20;

/* Bending, in units of k1, below which a string has given way so far that its upper modes fold
 * back; fewer masses are better then. */
static const double MOST_GIVEN_WAY = -0.126;

/* How often a string is looked after: whether it has died away, and what numbers suit it [frames];
 * and by how much the first time differs from phase to phase, after it is strung and after a glide,
 * so that those touched together are not all looked after together. */
enum { CHECK_FRAMES = 1024, N_PHASES = 16, STRING_SPREAD = 64, GLIDE_SPREAD = 8 };

/* When a choked string is let go, should one of its upper modes be slow to give in [s]. */
static const double CHOKED_S = 0.1;

/* Work that was done on it. */
static void credit(Voice* voice, double work) {
  ledger_credit(&voice->ledger, &voice->chain, work);
}

/*
  Take back what moving coefficients fed it, until the glide ends.  What bends its clock feeds it
  nothing (core/string/chain.h); but partials that change, a bridge that is tied while it moves, and
  what is near half the rate might, in time with it, and do so for minutes.
*/
static void hold_back(Voice* voice, uint32_t n_glide) {
  const double kept = ledger_settle(&voice->ledger, &voice->chain);
  if (kept < 1.0) {
    chain_drain(&voice->chain, kept, n_glide);
  }
}

/* What others move may be fed though it stands still itself. */
static void look(Voice* voice) {
  if (tie_is_on(&voice->tie)) {
    hold_back(voice, voice->n_gesture);
  }
}

/* Remember what the coefficients were made for. */
static void note_design(Voice* voice, double f0_hz, StringCoefs coefs) {
  voice->f0_hz = f0_hz;
  voice->a1 = tuning_mode(coefs, voice->chain.n_masses, 1).a;
  voice->headroom = tuning_headroom(coefs, voice->chain.n_masses);
}

/* Move the motion onto `n_masses`, at the pitch and decay that it has now; all else is as `target`
 * says.  False, and nothing done, if they cannot hold it. */
static bool mesh(Voice* voice, const TuningTarget* target, uint32_t n_masses) {
  Chain* const chain = &voice->chain;
  TuningTarget kept = *target;
  StringCoefs coefs = {0};
  kept.tone = pole_tone(voice->rate_hz, tuning_mode(chain->now, chain->n_masses, 1));
  if (tuning_fit(&kept, n_masses, &coefs)) {
    return false;
  }
  remesh(chain, n_masses);
  chain_set(chain, coefs);
  return true;
}

/* Coefficients for the masses that it has, or if they would give way too far, for fewer. */
static bool fit(Voice* voice, const TuningTarget* target, StringCoefs* coefs) {
  const uint32_t n_masses = voice->chain.n_masses;
  if (!tuning_fit(target, n_masses, coefs) && coefs->k2 > MOST_GIVEN_WAY * coefs->k1) {
    return true;
  }
  const uint32_t fewer = tuning_max_masses(target, n_masses);
  if (fewer > 0 && fewer < n_masses && mesh(voice, target, fewer)) {
    return !tuning_fit(target, fewer, coefs);
  }
  return !tuning_fit(target, n_masses, coefs);
}

/* What is tied goes in even steps, as its tie does. */
static bool retune(Voice* voice, const TuningTarget* target, bool is_tied, uint32_t n_glide) {
  StringCoefs coefs = {0};
  if (!fit(voice, target, &coefs)) {
    return false;
  }
  note_design(voice, target->tone.f0_hz, coefs);
  if (is_tied) {
    chain_share(&voice->chain, true);
  }
  chain_glide(&voice->chain, coefs, n_glide);
  hold_back(voice, n_glide);
  voice->n_until_check = least(voice->n_until_check, n_glide + GLIDE_SPREAD * (1 + voice->phase));
  return true;
}

/* The same, such that it is in tune once it is tied and the glide is over.  Its masses are known
 * once it has been retuned; so where that changes them, once more. */
static bool
retune_tied(Voice* voice, const TuningTarget* target, BridgeHold hold, uint32_t n_glide) {
  Tie* const tie = &voice->tie;
  BridgeHold kept = hold;
  uint32_t n_masses = 0;
  tie_take_masses(tie, voice->bridge, &voice->chain);
  if (!tie_is_wanted(hold) && !tie_is_on(tie)) {
    return retune(voice, target, false, n_glide);
  }
  do {
    n_masses = voice->chain.n_masses;
    kept = hold;
    const TuningTarget own = bridge_correct(voice->bridge, *target, n_masses, &kept, &tie->shift);
    if (!retune(voice, &own, true, n_glide)) {
      return false;
    }
  } while (voice->chain.n_masses < n_masses);
  tie_take_masses(tie, voice->bridge, &voice->chain);
  tie_glide(tie, voice->bridge, &voice->chain, kept, n_glide);
  return true;
}

/* What damps it acts from outside. */
static TuningTarget target_of(const Voice* voice, const VoiceAim* aim) {
  const double tau_s = voice->is_choked ? VOICE_CHOKE_S : aim->damper_s;
  return tau_s > 0.0 ? tuning_damped(aim->open, fmin(aim->open.tone.tau_s, tau_s), 0.0) : aim->open;
}

static BridgeHold hold_of(const Voice* voice, const VoiceAim* aim) {
  return voice->bridge && !voice->is_choked ? aim->hold : (BridgeHold){0};
}

/* As retune_tied(), but sharp of its own motion; at its pitch if it cannot be that high. */
static bool
retune_sharp(Voice* voice, const TuningTarget* target, BridgeHold hold, uint32_t n_glide) {
  TuningTarget sharp = *target;
  sharp.tone.f0_hz = tension_raised_hz(&voice->tension, target->tone.f0_hz);
  return retune_tied(voice, &sharp, hold, n_glide) ||
         (voice->tension.is_moving && retune_tied(voice, target, hold, n_glide));
}

/* Bring it to where it is to be after `n_glide` frames. */
static bool glide(Voice* voice, const VoiceAim* aim, uint32_t n_glide) {
  const TuningTarget wanted = target_of(voice, aim);
  const TuningTarget target = intonation_retune(&voice->intonation, &wanted, n_glide);
  if (!retune_sharp(voice, &target, hold_of(voice, aim), n_glide)) {
    return false;
  }
  voice->f0_hz = wanted.tone.f0_hz;
  return true;
}

/* At the pitch that it has. */
static void glide_choked(Voice* voice, VoiceAim aim, uint32_t n_glide) {
  voice_choke(voice, true);
  aim.open.tone.f0_hz = voice->f0_hz;
  const TuningTarget target = target_of(voice, &aim);
  if (!retune_tied(voice, &target, (BridgeHold){0}, n_glide)) {
    voice_sleep(voice);
  }
}

/* Nothing is left at a string that sleeps. */
static void leave(Voice* voice) {
  voice->hammer.is_active = false;
  voice->bow.is_active = false;
  voice->intonation.is_active = false;
}

/* What is at it sees that something else has moved it. */
static void notice(Voice* voice) {
  if (voice->hammer.is_active) {
    hammer_notice(&voice->hammer, &voice->chain);
  }
  if (voice->bow.is_active) {
    bow_notice(&voice->bow, &voice->chain);
  }
}

/* Whether something is at it that gives it motion. */
static bool is_played(const Voice* voice) {
  return voice->hammer.is_active || voice->bow.is_active;
}

/* What is played is not looked after. */
static void put_off(Voice* voice) {
  look(voice);
  voice->n_until_check = CHECK_FRAMES;
}

/* Of the fundamental as it is now: what is played in the middle of a glide is heard at its end. */
static double angle1_of(const Voice* voice) {
  return pole_angle(tuning_mode(voice->chain.now, voice->chain.n_masses, 1));
}

static bool is_let_go(const Voice* voice) {
  return voice->is_choked && voice->n_choked >= CHOKED_S * voice->rate_hz;
}

static void check(Voice* voice) {
  look(voice);
  voice->loudest = fmax(voice->loudest, chain_amplitude(&voice->chain, HUGE_VAL));
  const double silence = fmax(SILENCE * voice->loudest, STILLNESS);
  const bool is_silent = !voice->is_kept && chain_amplitude(&voice->chain, voice->a1) < silence;
  if (is_let_go(voice) || is_silent) {
    voice_sleep(voice);
  } else {
    chain_settle(&voice->chain);
  }
  voice->n_until_check = CHECK_FRAMES;
}

/* The finger comes in a gesture, and goes in one. */
static void act_finger(Voice* voice) {
  VoiceFinger* const finger = &voice->finger;
  const double coming = line_next(&finger->coming);
  const double going = fmin(1.0, (double)finger->n_left / voice->n_gesture);
  if (voice->is_awake) {
    credit(voice, -finger_act(&voice->chain, finger->place, going * coming));
    notice(voice);
  }
  if (--finger->n_left == 0) {
    line_set(&finger->coming, 0.0);
  }
}

/* The hammer, the bow and who listens to it; true if they have left, or set the string gliding. */
static bool act_played(Voice* voice) {
  if (voice->hammer.is_active) {
    (void)hammer_act(&voice->hammer, &voice->chain);
    credit(voice, voice->hammer.work);
  }
  if (voice->bow.is_active) {
    (void)bow_act(&voice->bow, &voice->chain);
    credit(voice, voice->bow.work);
  }
  const bool is_gliding = intonation_hear(&voice->intonation, &voice->chain, voice->bow.before);
  if (is_gliding) {
    tie_follow(&voice->tie, voice->bridge, &voice->chain);
  }
  const bool has_left = !is_played(voice);
  if (has_left || voice->n_until_check == 1) {
    put_off(voice);
  }
  return is_gliding || has_left;
}

/* It goes to `aim`, and on from there by itself; in how many frames.  How sharp it is does not wait
 * for slow changes. */
static uint32_t tighten(Voice* voice, const VoiceAim* aim, uint32_t n_glide) {
  Tension* const tension = &voice->tension;
  voice->aim = *aim;
  tension->cents = aim->tension;
  if (aim->tension > 0.0 || tension->is_moving) {
    tension_see(tension, &voice->chain, voice->hammer.is_active);
    n_glide = tension->is_moving ? least(n_glide, voice->n_gesture) : n_glide;
    tension->n_left = n_glide > 0 ? n_glide : 1;
  }
  return n_glide;
}

/* A piece begins of how sharp it is; what is under way is not hurried. */
static void begin_tension(Voice* voice) {
  const VoiceAim aim = voice->aim;
  const uint32_t n_gliding = voice->chain.n_gliding;
  voice_aim(voice, &aim, n_gliding > MOTION_PIECE_FRAMES ? n_gliding : MOTION_PIECE_FRAMES);
}

/* The next piece, if it is due; where one of the pitch's motion is, that will see to it. */
static bool pass_tension(Voice* voice, uint32_t n_frames) {
  Tension* const tension = &voice->tension;
  if (!tension->is_moving) {
    return false;
  }
  tension->n_left -= n_frames;
  if (tension->n_left > 0) {
    return false;
  }
  if (voice->is_moving && voice->n_until_piece == 0) {
    tension->n_left = 1;
    return false;
  }
  begin_tension(voice);
  return true;
}

/* It moves freely from now on, or is held to its pitch by who plays it. */
static void set_free(Voice* voice, bool is_free) {
  voice->tension.is_free = is_free;
  if (is_free ? voice->tension.cents > 0.0 : voice->tension.is_moving) {
    begin_tension(voice);
  }
}

uint32_t voice_gesture_frames(double rate_hz) {
  return (uint32_t)fmax(VOICE_GESTURE_FRAMES, round(VOICE_GESTURE_S * rate_hz));
}

void voice_init(Voice* voice,
                double rate_hz,
                uint32_t phase,
                void* memory,
                uint32_t capacity,
                VoiceOwner owner,
                const Bridge* bridge) {
  *voice = (Voice){.kernel = chain_kernel(0),
                   .memory = memory,
                   .capacity = capacity,
                   .phase = phase % N_PHASES,
                   .n_gesture = voice_gesture_frames(rate_hz),
                   .rate_hz = rate_hz,
                   .owner = owner,
                   .bridge = bridge};
}

void voice_sleep(Voice* voice) {
  if (voice->is_awake) {
    chain_rest(&voice->chain);
    voice->is_awake = false;
    voice->loudest = 0.0;
    leave(voice);
  }
}

void voice_reset(Voice* voice) {
  voice_sleep(voice);
  voice_choke(voice, false);
  voice_still(voice);
  voice->finger = (VoiceFinger){0};
  voice->tie = (Tie){0};
}

bool voice_string(Voice* voice, const VoiceAim* aim, uint32_t limit, uint32_t n_tie) {
  voice_sleep(voice);
  voice->is_choked = false;
  voice->tie = (Tie){0};
  voice->n_strung = 0;
  const TuningTarget target = target_of(voice, aim);
  const uint32_t n_masses = tuning_max_masses(&target, least(limit, voice->capacity));
  StringCoefs coefs = {0};
  if (n_masses == 0 || tuning_solve(&target, n_masses, &coefs)) {
    return false;
  }
  chain_init(&voice->chain, voice->kernel, voice->memory, n_masses);
  chain_set(&voice->chain, coefs);
  note_design(voice, target.tone.f0_hz, coefs);
  voice->n_strung = n_masses;
  voice->ledger = (Ledger){.lent = tie_is_wanted(hold_of(voice, aim)) ? HUGE_VAL : 0.0};
  voice->tension = (Tension){.cents = aim->tension};
  voice->aim = *aim;
  voice->is_kept = false;
  voice->loudest = 0.0;
  voice->n_choked = 0;
  voice->is_awake = true;
  voice->n_until_check = STRING_SPREAD * (1 + voice->phase);
  if (tie_is_wanted(hold_of(voice, aim))) {
    (void)glide(voice, aim, 0);
    tie_renew(&voice->tie, n_tie);
  }
  return true;
}

void voice_aim(Voice* voice, const VoiceAim* aim, uint32_t n_glide) {
  if (is_played(voice)) {
    put_off(voice);
  }
  n_glide = tighten(voice, aim, n_glide);
  if (!glide(voice, aim, n_glide)) {
    glide_choked(voice, *aim, n_glide);
  }
  if (voice->is_choked) {
    leave(voice);
  }
  notice(voice);
}

void voice_shorten(Voice* voice, const VoiceAim* aim, uint32_t n_masses) {
  if (n_masses < voice->chain.n_masses) {
    const TuningTarget target = target_of(voice, aim);
    (void)mesh(voice, &target, n_masses);
  }
}

void voice_lengthen(Voice* voice, const VoiceAim* aim, uint32_t n_masses) {
  if (n_masses > voice->chain.n_masses) {
    const TuningTarget target = target_of(voice, aim);
    const uint32_t most = tuning_max_masses(&target, n_masses);
    if (most > voice->chain.n_masses) {
      (void)mesh(voice, &target, most);
    }
  }
}

void voice_choke(Voice* voice, bool is_choked) {
  voice->n_choked = is_choked == voice->is_choked ? voice->n_choked : 0;
  voice->is_choked = is_choked;
}

void voice_hand_over(Voice* from, Voice* to) {
  voice_sleep(to);
  voice_halt(from);
  const Voice idle = *to;
  const Voice ringing = *from;
  *to = ringing;
  to->owner = idle.owner;
  to->finger = (VoiceFinger){0};
  *from = idle;
  from->owner = ringing.owner;
  from->motion = ringing.motion;
  from->n_piece = ringing.n_piece;
  from->n_until_piece = ringing.n_until_piece;
  from->is_moving = ringing.is_moving;
  from->finger = ringing.finger;
}

/* It has been plucked by so much. */
static void take_pluck(Voice* voice, double work) {
  credit(voice, work);
  chain_settle(&voice->chain);
  voice->loudest = 0.0;
  notice(voice);
  set_free(voice, true);
}

void voice_pluck(Voice* voice, Pluck pluck) {
  take_pluck(voice, pluck_pull(&voice->chain, pluck));
}

void voice_strike(Voice* voice, Strike strike) {
  hammer_throw(&voice->hammer, &voice->chain, strike, angle1_of(voice), voice->rate_hz);
  put_off(voice);
  set_free(voice, true);
}

void voice_bow(Voice* voice, Stroke stroke, const TuningTarget* target) {
  bow_start(&voice->bow, &voice->chain, stroke, angle1_of(voice), voice->rate_hz);
  if (!voice->intonation.is_active) {
    intonation_start(&voice->intonation, target);
  }
  put_off(voice);
  set_free(voice, false);
}

void voice_swell_bow(Voice* voice, double strength, uint32_t n_frames) {
  if (voice->bow.is_active) {
    bow_swell(&voice->bow, strength, n_frames);
  }
}

void voice_lift_bow(Voice* voice) {
  if (voice->bow.is_active) {
    bow_lift(&voice->bow);
    intonation_leave(&voice->intonation, &voice->chain, voice->n_gesture);
  }
}

void voice_touch(Voice* voice, double place, uint32_t n_frames) {
  voice->finger.place = place;
  voice->finger.n_left = n_frames;
  line_to(&voice->finger.coming, 1.0, voice->n_gesture);
}

void voice_untouch(Voice* voice) {
  voice->finger.n_left = least(voice->finger.n_left, voice->n_gesture);
}

void voice_halt(Voice* voice) {
  if (voice->is_moving && voice->n_piece > 0) {
    voice->motion = voice->begun;
    motion_go(&voice->motion, voice->n_piece - voice->n_until_piece);
  }
  voice->n_piece = 0;
}

void voice_slide(Voice* voice, double semitones, uint32_t n_frames) {
  line_to(&voice->motion.slide, semitones, n_frames);
}

void voice_bend(Voice* voice, double semitones, uint32_t n_frames) {
  line_to(&voice->motion.bend, semitones, n_frames);
}

void voice_vibrato(Voice* voice, double depth) {
  line_to(&voice->motion.depth, depth, voice->n_gesture);
}

void voice_vibrato_rate(Voice* voice, double rate) {
  voice->motion.rate = rate;
}

void voice_start_pieces(Voice* voice) {
  voice->is_moving = true;
  voice->n_until_piece = 0;
}

void voice_begin_piece(Voice* voice, uint32_t n_frames) {
  voice->is_moving = true;
  voice->begun = voice->motion;
  voice->n_piece = n_frames;
  voice->n_until_piece = n_frames;
  motion_go(&voice->motion, n_frames);
}

void voice_wait_for_piece(Voice* voice, uint32_t n_frames) {
  voice->is_moving = true;
  voice->n_piece = 0;
  voice->n_until_piece = n_frames;
}

void voice_end_pieces(Voice* voice) {
  voice->is_moving = false;
  voice->n_piece = 0;
}

void voice_catch_up(Voice* voice) {
  if (voice->is_moving && voice->n_until_piece == 0) {
    voice->owner.begin_piece(voice->owner.string);
  }
}

void voice_still(Voice* voice) {
  voice->motion = (VoiceMotion){.rate = voice->motion.rate};
  voice_end_pieces(voice);
}

bool voice_is_touched(const Voice* voice) {
  return is_played(voice) || voice->finger.n_left > 0;
}

uint32_t voice_due(const Voice* voice) {
  uint32_t n =
      voice->is_awake ? least(chain_stretch(&voice->chain), voice->n_until_check) : UINT32_MAX;
  n = voice->is_awake && voice->tension.is_moving ? least(n, voice->tension.n_left) : n;
  return voice->is_moving ? least(n, voice->n_until_piece) : n;
}

uint32_t voice_stretch(const Voice* voice) {
  return voice_is_touched(voice) ? 1 : voice_due(voice);
}

bool voice_pass(Voice* voice, uint32_t n_frames) {
  bool has_changed = is_played(voice) && act_played(voice);
  if (voice->finger.n_left > 0) {
    act_finger(voice);
  }
  voice->n_until_piece -= voice->is_moving ? n_frames : 0;
  if (voice->is_awake) {
    voice->ledger.n_unseen += n_frames;
    voice->n_until_check -= n_frames;
    voice->n_choked += voice->is_choked ? n_frames : 0;
    has_changed = pass_tension(voice, n_frames) || has_changed;
    if (voice->n_until_check == 0) {
      check(voice);
    }
  }
  return has_changed;
}

ChainTap voice_tap(const Voice* voice, const Pickup* pickup, double angle1) {
  const uint32_t n_masses = voice->chain.n_masses;
  return pickup->type == PICKUP_DISPLACEMENT
             ? pickup_tap(n_masses, pickup->place)
             : pickup_tap_of_type(pickup->type, n_masses, pickup->place, angle1);
}

void voice_run(
    Voice* voice, const Reading* reading, double angle1, uint32_t n_frames, float* const* out) {
  for (uint32_t done = 0; done < n_frames;) {
    voice_catch_up(voice);
    const uint32_t n = least(n_frames - done, voice_stretch(voice));
    if (voice->is_awake) {
      ChainPart part = {.chain = &voice->chain};
      float* rest[CHAIN_MAX_TAPS];
      for (uint32_t t = 0; t < reading->n_taps; ++t) {
        part.taps[t] = voice_tap(voice, &reading->at[t], angle1);
        rest[t] = out[t] + done;
      }
      chain_run_all(&part, 1, n, reading->n_taps, rest);
    }
    voice_pass(voice, n);
    done += n;
  }
}

void voice_mend(Voice* voice) {
  if (voice->is_awake && !isfinite(chain_energy(&voice->chain))) {
    voice_reset(voice);
  }
}

void voice_report(const Voice* voice, VoiceReport* report) {
  if (voice->is_awake) {
    ++report->n_strings;
    report->n_masses += voice->chain.n_masses;
    report->headroom = fmin(report->headroom, voice->headroom);
  }
}

double voice_energy(const Voice* voice) {
  return voice->is_awake ? chain_energy(&voice->chain) : 0.0;
}

double voice_work(const Voice* voice) {
  return voice->ledger.work;
}

void voice_lend(Voice* voice, double square) {
  ledger_lend(&voice->ledger, square);
}

void voice_share(Voice* voice, bool is_shared) {
  chain_share(&voice->chain, is_shared);
  voice->is_kept = voice->is_kept && is_shared;
}

void voice_keep(Voice* voice, bool is_kept, double loudest) {
  voice->is_kept = is_kept;
  voice->loudest = fmax(voice->loudest, loudest);
}

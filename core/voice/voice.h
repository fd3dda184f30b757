/**
   A string in play: strung, played, brought to a pitch and a decay, moved onto other masses, read,
   and put to sleep.  What the strings of all instruments have in common.

   It keeps its amplitude through every change of pitch, has at most a little more energy than what
   plays it has given it, and costs nothing once it has died away.  What happens to it in its own
   time depends on nothing but when it was played and retuned, so not on how its frames are cut into
   calls.

   Time.  A voice says how far it can be run in one go (voice_stretch()): one frame while a hammer,
   a bow or a finger touches it, else until a glide or a piece of its motion ends, or it is due to
   be looked after.  After that many frames voice_pass() lets all of that happen.  voice_run() does
   both for a voice by itself; who steps many side by side, or ties them to a bridge, does it for
   all.

   Pitch.  The instrument says what its strings are to be (VoiceAim): when the player changes
   something, and whenever a piece of the pitch's motion is due, for which it is asked (VoiceOwner).
   What its own motion adds to that (core/voice/tension.h) a voice sees to by itself, in pieces too.

   Its fields may be read; nobody but this room writes them.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_VOICE_VOICE_H
#define HOOKE_CORE_VOICE_VOICE_H

#include "core/base/line.h"
#include "core/excite/bow.h"
#include "core/excite/hammer.h"
#include "core/excite/pluck.h"
#include "core/string/chain.h"
#include "core/string/tuning.h"
#include "core/voice/intonation.h"
#include "core/voice/ledger.h"
#include "core/voice/motion.h"
#include "core/voice/pickups.h"
#include "core/voice/tension.h"
#include "core/voice/tie.h"

#include <stdbool.h>
#include <stdint.h>

/** Largest displacement of one string plucked with full force, at level 1. */
#define VOICE_NOTE_PEAK 0.25

/** Vibrato that full pressure on what is not bowed asks for [semitones]. */
#define VOICE_PRESSED_VIBRATO 0.5

/** τ of a string that is choked [s]. */
#define VOICE_CHOKE_S 0.005

/** What a player's gesture takes [s], and the fewest frames: a string must have the time to follow
 * it, whatever the rate. */
#define VOICE_GESTURE_S 0.004
enum { VOICE_GESTURE_FRAMES = 192 };

/** What a voice is to be. */
typedef struct {
  TuningTarget open; /**< With nothing that damps it, at the pitch that is wanted */
  double damper_s;   /**< τ that its damper leaves it at most [s]; 0: none is at it */
  BridgeHold hold;   /**< How the bridge holds it; zero: not at all */
  double tension;    /**< Cents that it is sharp by at TENSION_AMPLITUDE, ≥ 0; 0: it does not
                        stretch */
} VoiceAim;

/** Whose a voice is: who says where the next piece of its pitch's motion goes. */
typedef struct {
  /** The last piece is over: begin another with voice_begin_piece() and voice_aim(), or say with
   * voice_end_pieces() that there is none. */
  void (*begin_piece)(void* string);
  void* string; /**< Of the owner's own; what `begin_piece` is called with */
} VoiceOwner;

/** A finger that rests lightly on a string for a while; zero is none. */
typedef struct {
  double place;    /**< Fraction of the length, 0 to 1 */
  Line coming;     /**< How far it has come, 0 to 1 */
  uint32_t n_left; /**< Frames until it is gone */
} VoiceFinger;

/** Zero is one that is asleep and has no memory. */
typedef struct {
  /* What it is made of */
  Chain chain;
  const ChainKernel* kernel; /**< What steps it */
  void* memory;              /**< Memory for `capacity` masses, the caller's */
  uint32_t capacity;         /**< Most masses it can have */
  uint32_t phase;            /**< Voices of different phases are not looked after together */
  uint32_t n_gesture;        /**< Frames that a gesture takes */
  double rate_hz;            /**< Steps per second [Hz] */
  VoiceOwner owner;

  /* What it sounds like */
  double f0_hz;      /**< Pitch it has or is gliding to [Hz] */
  double a1;         /**< (ω0 h)² of its fundamental */
  double headroom;   /**< Of its coefficients, see tuning_headroom() */
  uint32_t n_strung; /**< Masses that it was strung with; a bend may have left it fewer */

  /* Where its pitch is going */
  VoiceMotion motion;     /**< As it will be at the end of its piece, while it is in one */
  VoiceMotion begun;      /**< As it was at the beginning of it */
  uint32_t n_piece;       /**< Frames of its piece; 0: it is in none */
  uint32_t n_until_piece; /**< Frames until the next piece, while it is moving */
  bool is_moving;         /**< Whether there is a next piece */
  Tension tension;        /**< What its own motion adds to that */
  VoiceAim aim;           /**< Where it was last brought; of one that stretches */

  /* What is at it */
  Hammer hammer;
  Bow bow;
  Intonation intonation; /**< What listens while it is bowed */
  VoiceFinger finger;
  const Bridge* bridge; /**< What it can be tied to; NULL: nothing */
  Tie tie;

  /* How long it lives, and what it was given */
  Ledger ledger;
  double loudest;         /**< Largest displacement seen since it was last plucked */
  uint32_t n_choked;      /**< Frames in which it has been choked */
  uint32_t n_until_check; /**< Frames until it is next looked after, see voice_pass() */
  bool is_awake;          /**< Whether it moves */
  bool is_kept;           /**< Something else moves it: it is not put to sleep */
  bool is_choked;         /**< Whether it is to be let go soon, however slow its upper modes are */
} Voice;

/** What is sounding of several. */
typedef struct {
  uint32_t n_strings; /**< Voices awake */
  uint32_t n_masses;  /**< Their masses */
  double headroom;    /**< The smallest of their stability margins, see tuning_headroom(); 1 if none
                         is awake */
} VoiceReport;

/** Frames that a gesture takes at a rate. */
uint32_t voice_gesture_frames(double rate_hz);

/** Lay a voice at rest over `memory`, chain_size(capacity) bytes, aligned to CHAIN_ALIGNMENT.
 * @param bridge  What it can be tied to; may be NULL */
void voice_init(Voice* voice,
                double rate_hz,
                uint32_t phase,
                void* memory,
                uint32_t capacity,
                VoiceOwner owner,
                const Bridge* bridge);

/** Silence a voice, set all its masses to exact zeros, and take away what is at it. */
void voice_sleep(Voice* voice);

/** The same, and nothing moves its pitch, touches or chokes it any more. */
void voice_reset(Voice* voice);

/**
   String it anew, at rest, with the largest stable number of masses up to `limit` and its capacity;
   a tie is there in `n_tie` frames.

   @return false, and it sleeps, if it cannot sound at this pitch
*/
bool voice_string(Voice* voice, const VoiceAim* aim, uint32_t limit, uint32_t n_tie);

/**
   Bring a voice that is awake to `aim` in `n_glide` frames, its motion kept.  Where that would pass
   its limit stiffness and true partials give way (tuning_fit()); where they would have to by far,
   the motion is moved onto fewer masses (core/string/remesh.h).  A pitch that cannot be had chokes
   it at the one that it has.  While it is sharp of its own motion it takes a gesture at most.
*/
void voice_aim(Voice* voice, const VoiceAim* aim, uint32_t n_glide);

/** Move the motion of a voice that is awake onto `n_masses` if those are fewer, at the pitch and
 * decay that it has now; all else is as `aim` says. */
void voice_shorten(Voice* voice, const VoiceAim* aim, uint32_t n_masses);

/** The same if those are more: as many of them as it can have. */
void voice_lengthen(Voice* voice, const VoiceAim* aim, uint32_t n_masses);

/** Say whether it is choked, see VOICE_CHOKE_S; it is so from the next voice_aim() on. */
void voice_choke(Voice* voice, bool is_choked);

/**
   Let `to`, which falls silent for that, have all that rings on `from` and what moves it; `from` is
   at rest then, in the other's memory, its pitch's motion where it was.
*/
void voice_hand_over(Voice* from, Voice* to);

/* Playing a voice that is awake */

/** Pull it aside and let it go, beside all that it does. */
void voice_pluck(Voice* voice, Pluck pluck);

/** Throw a hammer at it. */
void voice_strike(Voice* voice, Strike strike);

/** Draw a bow across it, which is listened to.  @param target  What is to be heard */
void voice_bow(Voice* voice, Stroke stroke, const TuningTarget* target);

/** Let the bow, if there is one, swell to a strength in `n_frames`, see bow_swell(). */
void voice_swell_bow(Voice* voice, double strength, uint32_t n_frames);

/** Lift the bow, if there is one. */
void voice_lift_bow(Voice* voice);

/** Lay a finger on it for `n_frames`, awake or not; it comes in a gesture, and goes in one. */
void voice_touch(Voice* voice, double place, uint32_t n_frames);

/** Lift the finger, in a gesture. */
void voice_untouch(Voice* voice);

/* Where its pitch goes */

/** What sets out in the middle of a piece finds the motion where it is, not at the end of it. */
void voice_halt(Voice* voice);

/** Slide to `semitones` above the note that it is played as, in `n_frames`; 0: at once. */
void voice_slide(Voice* voice, double semitones, uint32_t n_frames);

/** Bend to `semitones` above that. */
void voice_bend(Voice* voice, double semitones, uint32_t n_frames);

/** Bring the vibrato to a depth [semitones], ≥ 0, in a gesture. */
void voice_vibrato(Voice* voice, double depth);

/** Let it swing at a rate [cycles per frame]. */
void voice_vibrato_rate(Voice* voice, double rate);

/** There is something to move: a piece is due before the next frames that are run. */
void voice_start_pieces(Voice* voice);

/** A piece of `n_frames` begins: go to its end. */
void voice_begin_piece(Voice* voice, uint32_t n_frames);

/** Let the pitch rest for `n_frames`, and then ask for a piece. */
void voice_wait_for_piece(Voice* voice, uint32_t n_frames);

/** There is no other piece. */
void voice_end_pieces(Voice* voice);

/** Begin the piece that is due, if one is: before anything else happens at this frame. */
void voice_catch_up(Voice* voice);

/** Nothing moves its pitch, which goes back to its note. */
void voice_still(Voice* voice);

/* Running */

/** Whether a hammer, a bow or a finger is at it, which act after every frame. */
bool voice_is_touched(const Voice* voice);

/** Frames until a glide or a piece of either kind ends, or it is due to be looked after. */
uint32_t voice_due(const Voice* voice);

/** Frames that it can be run in one go, before voice_pass() must be told: one while it is touched,
 * else voice_due(). */
uint32_t voice_stretch(const Voice* voice);

/**
   After `n_frames`, at most its stretch: let what is at it act, which may be once it has run one
   frame; and when it is due, put it to sleep if it has died away to −120 dB of its loudest, or has
   been choked for a while, else see that its numbers suit it.

   @return Whether what was at it has left, or has set it gliding
*/
bool voice_pass(Voice* voice, uint32_t n_frames);

/** The tap of a pickup.  @param angle1  What velocities are weighed by, see pickup_tap_of_type() */
ChainTap voice_tap(const Voice* voice, const Pickup* pickup, double angle1);

/**
   Run a voice by itself, awake or not, and add what pickups read of it to `out`.

   @param reading  As many taps as chain_taps() says
   @param out      As many buffers of n_frames
*/
void voice_run(
    Voice* voice, const Reading* reading, double angle1, uint32_t n_frames, float* const* out);

/** Silence a voice that holds what is not a number; the next time it is strung it is as new.  For
 * who heard such a thing: nothing that is played or set makes it. */
void voice_mend(Voice* voice);

/** Add a voice, if it is awake, to what is sounding. */
void voice_report(const Voice* voice, VoiceReport* report);

/* Its energy, in the measure of chain_energy() */

/** What it has now. */
double voice_energy(const Voice* voice);

/**
   What plucks, hammers and bows have given it since it was strung, by their own forces, less what
   fingers took: exact but for rounding while a hammer and a bow do not share a mass.  The rest of
   its energy is what the movement of its coefficients and of its motion onto other masses did, less
   what was held back of that, and what other strings gave it by the
   bridge, less what its dampers took.
*/
double voice_work(const Voice* voice);

/* For what ties voices together */

/** Others may have given it so much, see Ledger.lent. */
void voice_lend(Voice* voice, double square);

/** Let its tie go on by one frame. */
static inline void voice_advance_tie(Voice* voice) {
  tie_advance(&voice->tie);
}

/** Say whether something else moves it in every frame. */
void voice_share(Voice* voice, bool is_shared);

/** It is not put to sleep, or may be again, and what is `loudest` near it counts as its own. */
void voice_keep(Voice* voice, bool is_kept, double loudest);

#endif

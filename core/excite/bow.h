/**
   A bow that is drawn across a string: friction at one place.

   It acts between the steps of one frame (core/excite/contact.h).  With the hair's speed b against
   the string's own,

       v = eᵀ(u' + u)/2 − b,   u' = u* + e f,   f = −F μ(v),

   is solved for in every step.  Friction is Coulomb's and falls as the hair slips faster,

       μ(v) = sgn(v) (μd + (μs − μd)/(1 + |v|/v0)),   any from −μs to μs where it sticks, v = 0,

   so both the branch that sticks and those that slip have closed forms.  It falls sharply, v0 =
   b/5, which lets the string go at once and catches it at once: what slips goes on slipping until v
   passes 0, and what sticks holds up to μs F.

   A string rolls under the hair, too, which swallows some of what a hard grip would throw back. The
   roll is a damper r and a spring s side by side, and v has its speed w beside the string's own:

       f = r w + s (q + w/2),   q ← q + w.

   The hair is not a line: where its edge is, a little nearer to the wall, it drags at the string by
   d = −R (v_d − b), v_d being the edge's (u' + u)/2.  So partials that have a node at the bow,
   which friction could not hold, do not grow.  Both are solved for as one.

   In a step the string's energy grows by f (v + b − w) + d v_d, in which f v and d (v_d − b) are
   heat, ≤ 0, and f w is r w² and what ½ s q² grows by: string and roll together get at most what
   the bow gives, (f + d) b.

   The string moves as Helmholtz's then, one slip a period that lasts β of it, if F is in
   Schelleng's window: at most F = 2 √k1 b/(β (μs − μd)), which is what the corner brings, and not
   too far below that.  The pressure goes from the one end of where it does to the other.  It sounds
   a little flat, which core/voice/intonation.h makes good.  In the middle of the string nothing
   holds it to its period, and where a slip would take less than four frames it could not be told
   from none; so there the bow keeps away, as a fiddler does.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_EXCITE_BOW_H
#define HOOKE_CORE_EXCITE_BOW_H

#include "core/base/line.h"
#include "core/string/chain.h"

#include <stdbool.h>
#include <stdint.h>

/** A stroke as it is wanted. */
typedef struct {
  double place;     /**< β, fraction of the length, 0 to 1; kept to where it can be bowed */
  double pressure;  /**< 0: all but too light, to 1: all but too heavy for Helmholtz's motion */
  double amplitude; /**< Largest displacement of the ideal string that it gives, > 0 */
  double attack_s;  /**< Time in which it comes to its speed [s] */
  double release_s; /**< Time in which it is lifted [s] */
} Stroke;

/** What the hair does to the string just now. */
typedef enum { BOW_STICKS, BOW_SLIPS_BACK, BOW_SLIPS_AHEAD } BowState;

/** A bow at work; zero is none. */
typedef struct {
  Line place;
  Line strength;   /**< Of what is drawn and pressed, see bow_swell() */
  Line drawn;      /**< b, per step, for a strength of 1 */
  Line pressed;    /**< F, of √k1 */
  double spring;   /**< s, of √k1 */
  double pace;     /**< Of the string when the stroke began, see chain_pace() */
  double haste;    /**< How fast the string's clock goes against that: the bow is drawn in it */
  double before;   /**< eᵀu before the step */
  double beside;   /**< The same at the edge of the hair */
  double full;     /**< F of this stroke, once it is pressed */
  double drag;     /**< d of the last step */
  double rolled;   /**< q */
  double hair;     /**< b of the last step */
  double slip;     /**< v of the last step */
  double friction; /**< f of the last step, in h²/m */
  double
      work; /**< What it gave to the string in the last step, f and d times their places' speeds */
  uint32_t n_lift; /**< Steps that it takes to lift it */
  BowState state;
  bool is_lifted;
  bool is_active;
} Bow;

/** The place where a string can be bowed that is nearest to a wanted one: off the walls and the
 * middle.  @param angle1  As of bow_start() */
double bow_place(double wanted, double angle1);

/**
   Put a bow to a string and begin to draw it; its strength is 1.

   One that is at work already turns to the new stroke in its attack, from the place, the speed and
   the force that it has.

   @param angle1  The fundamental's digital angular frequency 2πF/rate [rad per sample]
*/
void bow_start(Bow* bow, const Chain* chain, Stroke stroke, double angle1, double rate_hz);

/**
   Let its strength, with which its speed and its force grow alike, go to `strength` in a straight
   line over `n_frames`; 0: at once.

   @param strength  0 to 2, and kept to it; 1: as started
*/
void bow_swell(Bow* bow, double strength, uint32_t n_frames);

/** Lift it. */
void bow_lift(Bow* bow);

/** See the string anew: call it before the next step when anything but its steps, hammers or other
 * bows has moved it. */
void bow_notice(Bow* bow, const Chain* chain);

/**
   Let the bow act for one step; call it after every step of one frame.

   @return false once it has been lifted; from then on it does nothing
*/
bool bow_act(Bow* bow, Chain* chain);

#endif

/**
   One string as a chain of masses: the loop that makes the sound.

   The step is that of core/string/tuning.h, link by link.  With Δ the difference between a mass and
   the one before it,

       link = k1 Δx + z1 Δu + k2 Δ(L x) + k3 Δ(L² x) ;
       u_i += link_{i+1} − link_i − z0 u_i ;   x_i += u_i.

   It keeps position x and scaled velocity u = h v, never two positions: in floats that is worth 40
   dB.

   Numbers.  What is touched or moves is kept in floats.  Rounding changes what a string loses in a
   step by up to 3 in 10⁹, which is nothing to one that loses 1 in 10⁴; but one that loses 1 in 10⁶
   would die a part in a hundred too soon or too late.  So a string that is left alone and weakly
   damped is put into fixed point (core/string/chain_fixed.h), which does not drift, or if it is so
   short or rings so long that their noise would be too near, into doubles: see chain_settle().

   Moving.  A spring that is tightened while it is stretched gives the string energy, and one that
   is let go takes it; in time with the string's own motion that would feed it without end.  So what
   glides is not the springs but the string's clock: x(t) becomes x(τ(t)), the same motion read
   faster or slower.  Position stays, and the velocity at the same instant, v = u − ½ K x, is scaled
   by the ratio of the fundamental's frequencies.  So no glide of pitch feeds or starves it,
   whatever its time, and its amplitude is the same at all pitches.  What is no change of time, one
   of stiffness say, still is one of springs.

   Layout.  The string is cut into as many segments as the kernel has lanes, S cells each, one a
   lane: mass i is lane i div S of cell i mod S, and a cell is a vector of x and a vector of u.  So
   neighbours are in the cells beside, and lanes are shifted only at the two seams of a step.  Where
   the masses do not fill the last lane, the one after the last is held at rest by a mask, and is
   the wall.

   Thread: one at a time; everything here is real-time safe.
*/
#ifndef HOOKE_CORE_STRING_CHAIN_H
#define HOOKE_CORE_STRING_CHAIN_H

#include "core/string/chain_kernel.h"
#include "core/string/tuning.h"

#include <stdbool.h>
#include <stdint.h>

/** A place where the chain is read: weight[0] x[mass[0]] + weight[1] x[mass[1]], or the same of u;
 * masses count from 0. */
typedef struct {
  uint32_t mass[2];
  float weight[2];
  bool is_velocity; /**< Whether u is read, how far x has come in the last step */
} ChainTap;

/** A string; zero is one without masses. */
typedef struct {
  const ChainKernel* kernel;
  ChainNumbers numbers;    /**< What its masses are kept in now */
  const ChainLoops* loops; /**< Those for them */
  void* memory;            /**< The caller's */
  void* cells;             /**< Where in it the masses are now */
  uint32_t n_masses;       /**< N */
  uint32_t n_cells;        /**< S = ⌈N / lanes⌉, but CHAIN_LEAST_CELLS at least */
  uint32_t n_gliding; /**< Steps until `goal` is reached; 0 when the coefficients stand still */
  StringCoefs now;    /**< What the next step uses, while still */
  StringCoefs change; /**< What a step adds to it, while gliding */
  double haste;       /**< What a gliding step makes of that */
  StringCoefs goal;   /**< Where a glide ends */
  double lambda1;     /**< Of the fundamental */
  double kept;        /**< What a gliding step leaves of the motion, see chain_drain() */
  StringCoefs fixed;  /**< CHAIN_FIXED: what the next step uses instead, see ChainFixed */
  double gain;        /**< CHAIN_FIXED: of a number */
  double fade;        /**< CHAIN_FIXED: what a step makes of the gain */
  uint32_t chance;    /**< CHAIN_FIXED: where the dither is */
  bool is_shared; /**< Something else acts on it in every frame, so that it is never left alone */
} Chain;

/** Bytes that hold `n_masses` with any kernel; a multiple of CHAIN_ALIGNMENT. */
size_t chain_size(uint32_t n_masses);

/**
   Make a chain of `n_masses` at rest, in floats.

   @param kernel    From chain_kernel()
   @param memory    chain_size(n_masses) bytes, aligned to CHAIN_ALIGNMENT; kept by the chain, not
   owned
   @param n_masses  1 to CHAIN_MAX_MASSES
*/
void chain_init(Chain* chain, const ChainKernel* kernel, void* memory, uint32_t n_masses);

/** Bring every mass to rest. */
void chain_rest(Chain* chain);

/** Set the coefficients at once. */
void chain_set(Chain* chain, StringCoefs coefs);

/**
   Move the coefficients to `coefs` in a straight line over `n_frames` steps (0: in one), from
   wherever they are, bending the clock on the way, such that the pitch moves by about the same
   interval in each step; a shared one goes in even steps. The stable region is convex in them, so a
   way from one stable string to another is stable all along.
*/
void chain_glide(Chain* chain, StringCoefs coefs, uint32_t n_frames);

/** Take energy from it until its glide ends, or where it stands still within `n_frames` steps, such
 * that `share` of it is left, 0 < share ≤ 1: the motion grows smaller, and is otherwise as it
 * was. */
void chain_drain(Chain* chain, double share, uint32_t n_frames);

/** How fast its clock goes, squared, see chain_pace_of(). */
double chain_pace(const Chain* chain);

/** Position of mass `i`, 0 ≤ i < n_masses, in the units of the caller's excitation. */
float chain_position(const Chain* chain, uint32_t i);

/** Scaled velocity u = h v of mass `i`. */
float chain_velocity(const Chain* chain, uint32_t i);

/** Put mass `i` at position `x` with scaled velocity `u`. */
void chain_place(Chain* chain, uint32_t i, float x, float u);

/** Add to the positions and scaled velocities of all masses. */
void chain_add(Chain* chain, const double* x, const double* u);

/** Add `u` to the scaled velocity of mass `i`. */
void chain_push(Chain* chain, uint32_t i, float u);

/** The scheme's own energy, ½ Σ u² + ½ xᵀK (x − u), with the coefficients of now: of a standing
 * chain without dampers it is constant to rounding. */
double chain_energy(const Chain* chain);

/**
   The amplitude of the fundamental if all the energy were in it:

       √(2/(N + 1) Σ (x² − x u + u²/a1) / (1 − a1/4)),

   the scheme's own energy, for x and u are half a step apart.  Without damping it is constant to
   rounding where there is nothing but the fundamental, and never less than the fundamental's own.

   @param a1  The fundamental's a, 0 < a1 < 4; HUGE_VAL: displacement alone, √(2/(N + 1) Σ x²)
*/
double chain_amplitude(const Chain* chain, double a1);

/** The fewest taps, at least `n_taps` of 1 to CHAIN_MAX_TAPS, that there are loops for. */
uint32_t chain_taps(uint32_t n_taps);

/**
   Step the chain `n_frames` times, and after each step add what each tap reads to its output.

   The way in which n_frames are cut into calls does not change a bit of it.

   @param n_taps  1, 2, 4 or CHAIN_MAX_TAPS, see chain_taps()
   @param out     n_taps buffers of n_frames
*/
void chain_run(
    Chain* chain, uint32_t n_frames, const ChainTap* taps, uint32_t n_taps, float* const* out);

/** Frames until the chain's glide ends; UINT32_MAX if it stands still. */
uint32_t chain_stretch(const Chain* chain);

/**
   Keep the chain in the numbers that suit it best; it stays there until it is touched: set, pushed,
   placed or made to glide.  Call it now and then, a few dozen times a second, for it also watches
   that the numbers are neither too large nor too small.  Nothing is done while the chain glides.
*/
void chain_settle(Chain* chain);

/**
   Keep the chain in certain numbers, with all its motion.

   @return false, and nothing done, for CHAIN_FIXED where they cannot be had: while it glides, or
   see chain_fixed_design()
*/
bool chain_hold(Chain* chain, ChainNumbers numbers);

/** A chain and where it is read, for chain_run_all(). */
typedef struct {
  Chain* chain;
  ChainTap taps[CHAIN_MAX_TAPS];
} ChainPart;

/**
   As chain_run() of each part in turn, all added to the same outputs, but faster: short chains that
   need the same loop and follow each other are stepped together.

   @param n_frames  At most the chain_stretch() of every part
*/
void chain_run_all(const ChainPart* parts,
                   uint32_t n_parts,
                   uint32_t n_frames,
                   uint32_t n_taps,
                   float* const* out);

/* For who steps chains by the loops themselves, a frame at a time, since something acts on them
   between frames: of each a loop and its work, which stand until the chain is touched otherwise,
   and after at most chain_stretch() frames chain_pass(). */

/** Say whether something acts on it so; then it is not kept in fixed point. */
void chain_share(Chain* chain, bool is_shared);

/** The loop for what the chain is now: nothing that it does not need is in it. */
ChainLoop chain_loop(const Chain* chain, uint32_t n_taps);

/** What is to be given to it. */
ChainWork chain_work(const ChainPart* part, uint32_t n_taps);

/** `n_frames` have been run; a glide that ends with them leaves the chain where it was going. */
void chain_pass(Chain* chain, uint32_t n_frames);

#endif

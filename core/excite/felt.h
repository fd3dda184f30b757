/**
   A felt that is pressed: the force between a hammer and a string, over one step.

   Pressed by c it stores φ(c) = K c^(p+1)/(p+1), and nothing where c ≤ 0.  What it gives over a
   step, from the compression `before` the last step to that `after` this one, is the slope of φ
   between the two, more while it is pressed and less while it is let go, and it never pulls:

       f = (φ(after) − φ(before))/(after − before) · max(0, 1 + κ (after − before)).

   The work of f is half of f (after − before), so with κ = 0 it is just what (φ + φ)/2 of two steps
   running loses, and with κ > 0 more is lost.  The force moves what it acts on:

       after = free − A f,   A = eᵀe + 1/M.

   The right side falls as `after` grows, so there is one solution, whatever K, p, κ and A.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_EXCITE_FELT_H
#define HOOKE_CORE_EXCITE_FELT_H

/** The exponent of the felts that are used, with which a power is a product and a root. */
#define FELT_EXPONENT 2.5

/** A felt; zero is none. */
typedef struct {
  double stiffness; /**< K ≥ 0, in the string's units of force */
  double exponent;  /**< p ≥ 1 */
  double loss;      /**< κ ≥ 0, a length */
} Felt;

/** φ(c). */
double felt_energy(const Felt* felt, double compression);

/**
   Solve a step.

   @param before      Compression a step ago
   @param free        Compression after the step if there were no felt
   @param admittance  A > 0
   @param[out] after  Compression after the step
   @return f ≥ 0
*/
double felt_press(const Felt* felt, double before, double free, double admittance, double* after);

#endif

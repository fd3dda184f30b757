/**
   Any network of masses, springs and dampers, and its reference simulation in double.

   Points are numbered from 0 in the order in which they are added.  A point is a mass, with one
   coordinate x [m] and its velocity v [m/s], or grounded: held where it is.  Springs and dampers
   join any two points, any number of them; a part that hangs together need not hang on the rest.
   One step of h [s] is that of [MQ09] section 2.2, edge by edge and without a matrix: the force on
   each mass from the old positions and velocities,

       F_i = external_i + Σ k (x_j − x_i) + Σ Z (v_j − v_i),

   and, of a lever, by which a spring is pulled at many points, w_i each:  − w_i k Σ_j w_j x_j.
   Then  v_i ← v_i + h F_i/m_i,  and with the new velocity  x_i ← x_i + h v_i.   [MQ09] (5)

   Life: network_new(), network_add_…(), network_check(), then step; adding more asks for another
   check.  Thread: a network belongs to one thread at a time.  Stepping does not allocate.
*/
#ifndef HOOKE_CORE_ANALYSIS_NETWORK_H
#define HOOKE_CORE_ANALYSIS_NETWORK_H

#include "core/base/status.h"

#include <stdbool.h>
#include <stdint.h>

/** A spring or a damper between two points. */
typedef struct {
  uint32_t from;
  uint32_t to;
  double value; /**< Stiffness k [N/m] of a spring, Z [kg/s] of a damper; ≥ 0 */
} NetworkLink;

/**
   A spring that levers pull at from any number of points: its energy is  k/2 (Σ w_i x_i)².

   With the weights 1, −2, 1 it is the moment of a bar that is bent, with 1, −1, −1, 1 that of a
   plate that is twisted, and with the areas of a box's walls the air in it.
*/
typedef struct {
  uint32_t first; /**< Of its terms */
  uint32_t n_terms;
  double stiffness; /**< k [N/m]; ≥ 0 */
} NetworkLever;

typedef struct {
  uint32_t point;
  double weight; /**< w */
} NetworkTerm;

/** In the order in which they were added. */
typedef struct {
  NetworkLever* lever;
  uint32_t n;
  uint32_t capacity;
  NetworkTerm* term; /**< Of all levers, one after the other */
  uint32_t n_terms;
  uint32_t term_capacity;
} NetworkLevers;

/** Links in the order in which they were added. */
typedef struct {
  NetworkLink* link;
  uint32_t n;
  uint32_t capacity;
} NetworkLinks;

/**
   To be read; written only by the functions below, but for `x`, `v` and `force`, which anyone may
   set between two steps to displace, push and pull.  All arrays have `n_points` elements.  A
   grounded point stays at its x, and its v must stay 0.
*/
typedef struct {
  uint32_t n_points;
  uint32_t n_masses; /**< Those of the points that are not grounded */
  uint32_t capacity;
  bool is_checked; /**< Whether network_check() has passed since the last addition */
  bool* is_ground;
  double* mass_kg; /**< Mass [kg]; HUGE_VAL where grounded */
  double* x;       /**< Position [m] */
  double* v;       /**< Velocity [m/s] */
  double* force;   /**< External force [N], until it is set otherwise */
  double* sum;     /**< Working space of a step */
  NetworkLinks springs;
  NetworkLinks dampers;
  NetworkLevers levers;
  double* space; /**< Working space of network_prepare() */
} Network;

/** What kind of element a fault is in. */
typedef enum { NETWORK_POINT, NETWORK_SPRING, NETWORK_DAMPER, NETWORK_LEVER } NetworkElement;

/** Where a fault is. */
typedef struct {
  NetworkElement element;
  uint32_t index; /**< Of the point, spring, damper or lever, counted from 0 as added */
} NetworkFault;

/** @return An empty network, to be given to network_free(), or NULL: out of memory */
Network* network_new(void);

/** Free `network` and all that is in it; NULL is fine. */
void network_free(Network* network);

/** @return Another network with the same points, links and state, or NULL: out of memory */
Network* network_copy(const Network* network);

/**
   Add an element.  Nothing is judged before network_check().

   @param mass_kg     [kg]; is to be finite and > 0
   @param stiffness   [N/m]; is to be finite and ≥ 0
   @param damping     [kg/s]; is to be finite and ≥ 0
   @param[out] point  The number of the new point; NULL if not wanted
   @return STATUS_OK, or STATUS_NO_MEMORY with the network as it was
*/
Status network_add_mass(Network* network, double mass_kg, uint32_t* point);
Status network_add_ground(Network* network, uint32_t* point);
Status network_add_spring(Network* network, uint32_t from, uint32_t to, double stiffness);
Status network_add_damper(Network* network, uint32_t from, uint32_t to, double damping);

/**
   Add a lever's spring.

   @param term  n_terms points, each once, and their weights, finite; copied
*/
Status
network_add_lever(Network* network, double stiffness, uint32_t n_terms, const NetworkTerm* term);

/** Make a mass heavier by `mass_kg`, ≥ 0 [kg]; a grounded point stays as it is. */
void network_load(Network* network, uint32_t point, double mass_kg);

/**
   Add a uniform string: `n_masses` masses in a row, then two grounded points, and n_masses + 1
   springs and as many dampers between neighbours and to the two ends; no damper where damping is 0.

   @param[out] first  The number of the first mass; the others follow; NULL if not wanted
   @return STATUS_OK; STATUS_BAD_ARGUMENT for 0 masses; STATUS_NO_MEMORY, with part of it added
*/
Status network_add_string(Network* network,
                          uint32_t n_masses,
                          double mass_kg,
                          double stiffness,
                          double damping,
                          uint32_t* first);

/**
   Judge every element.

   @param[out] fault  Where the first fault is; untouched if there is none; NULL if not wanted
   @return STATUS_OK; STATUS_EMPTY; STATUS_BAD_MASS; STATUS_BAD_LINK (a stiffness or damping that is
   negative or not finite, or a weight that is not finite); STATUS_NO_SUCH_POINT; STATUS_SELF_LINK
   (also a lever with a point twice)
*/
Status network_check(Network* network, NetworkFault* fault);

/**
   Number the parts which hang together, and on no grounded point, by springs of more than zero
   stiffness.  Each has a mode of frequency 0: it drifts.  A damper to a grounded point slows it
   down and does not bring it back.  A lever holds its masses together, and to the ground where
   their weights do not sum to 0; that what levers alone hold may turn as well is not seen here.

   @param is_by_dampers_too  Take dampers of more than zero for springs: what is free then is not
                             slowed down either
   @param[out] part          n_points elements: the part, from 0, in order of its lowest point;
                             UINT32_MAX for a grounded point and for what hangs on one
   @param[out] n_free        How many parts there are
   @return STATUS_OK or STATUS_NO_MEMORY
*/
Status
network_find_free(const Network* network, bool is_by_dampers_too, uint32_t* part, uint32_t* n_free);

/**
   Fill the matrices of a checked network, over its n = n_masses masses in the order of their
   points; n × n, column-major, ld = n.

   @param[out] mass_kg    The diagonal of M [kg], n
   @param[out] stiffness  K [N/m]; NULL if not wanted
   @param[out] damping    Z [kg/s]; NULL if not wanted
   @return STATUS_OK or STATUS_NO_MEMORY
*/
Status
network_matrices(const Network* network, double* mass_kg, double* stiffness, double* damping);

/** Multiply every stiffness and every damping; both factors ≥ 0 and finite. */
void network_scale(Network* network, double stiffness_factor, double damping_factor);

/** Bring every mass to rest at 0 and take away all external forces. */
void network_rest(Network* network);

/** Step a checked network once by `step_s` [s], symplectic Euler.  Linear in points, links and
 * terms. */
void network_step(Network* network, double step_s);

/** How far the spring of a lever is stretched where its points are at `x`, Σ w_i x_i. */
double network_stretch(const Network* network, uint32_t lever, const double* x);

/** The energy ½ vᵀMv + ½ xᵀKx [J], summed link by link and lever by lever. */
double network_energy(const Network* network);

/**
   The scheme's own energy [J]:  ½ vᵀMv + ½ xᵀK(x − h v).

   Without damping and external forces it is constant to rounding, and it is positive in every state
   exactly where the step is stable.  (With u = h v and x' = x + u', M u' = M u − h²K x:
   u'ᵀM u' + h² u'ᵀK x = u'ᵀM u = uᵀM u − h² uᵀK x.)
*/
double network_scheme_energy(const Network* network, double step_s);

#endif

/**
   A network as the solvers want it: links between the same two masses summed, and coordinates
   y = M^½ x in which the masses are all 1, so that with K̂ = M^−½ K M^−½ and Ẑ alike

       s² y + s Ẑ y + K̂ y = 0.

   Part of core/analysis/modes.
*/
#ifndef HOOKE_CORE_ANALYSIS_MODES_FRAME_H
#define HOOKE_CORE_ANALYSIS_MODES_FRAME_H

#include "core/analysis/network.h"
#include "core/base/status.h"

#include <complex.h>
#include <stdbool.h>
#include <stdint.h>

/** In the place of a mass: a grounded point. */
#define FRAME_GROUND UINT32_MAX

/** All springs and dampers between two masses, or between a mass and the ground. */
typedef struct {
  uint32_t a;
  uint32_t b; /**< > a, or FRAME_GROUND */
  double k;   /**< Stiffness [N/m] */
  double z;   /**< Damping [kg/s] */
} FrameLink;

/** A lever's spring, as far as it is at masses. */
typedef struct {
  uint32_t first; /**< Of its terms */
  uint32_t n_terms;
  double k; /**< Stiffness [N/m] */
} FrameLever;

typedef struct {
  uint32_t mass;
  double weight; /**< w/√m */
} FrameTerm;

typedef struct {
  uint32_t n; /**< Masses, numbered as their points come */
  uint32_t n_links;
  uint32_t n_free;   /**< Parts that hang on no ground by springs: so many modes are of 0 Hz */
  uint32_t n_adrift; /**< How many of these modes nothing slows down */
  uint32_t* part;    /**< Of each mass its free part, or FRAME_GROUND, n */
  double* part_root; /**< √m of each free part as a whole, n_free */
  double* root;      /**< √m, n */
  FrameLink* link;   /**< In order of a, then b; of neither stiffness nor damping between masses
                          that a lever alone couples */
  uint32_t n_levers;
  FrameLever* lever; /**< With stiffness */
  FrameTerm* term;
} Frame;

/** @return STATUS_OK; or, with nothing to be cleared, STATUS_NO_MEMORY, or STATUS_ILL_SCALED where
 * an entry of K̂ or Ẑ is too large or too small for a number */
Status frame_init(Frame* frame, const Network* network);
void frame_clear(Frame* frame);

/** The quadratic forms of a shape. */
typedef struct {
  double complex inertia;   /**< yᵀ y */
  double complex stiffness; /**< yᵀ K̂ y */
  double complex damping;   /**< yᵀ Ẑ y */
} FrameForms;

/** The forms of y, without conjugation, link by link: of a real y, sums of what is not negative, so
 * exact to a few roundings. */
FrameForms frame_forms(const Frame* frame, const double complex* y);

/** yᵀ K̂ y and yᵀ Ẑ y of a real y, in the same way. */
double frame_stiffness(const Frame* frame, const double* y);
double frame_damping(const Frame* frame, const double* y);

/** Add Ẑ y of a real y to `sum`, n. */
void frame_add_drag(const Frame* frame, const double* y, double* sum);

/** Fill K̂ or Ẑ; n × n, column-major, ld = n. */
void frame_fill_stiffness(const Frame* frame, double* matrix);
void frame_fill_damping(const Frame* frame, double* matrix);

/** The rows of frame_fill_edges(): links and levers with stiffness, and as many more as it takes to
 * have one for each mass and none for each free part. */
uint32_t frame_count_edges(const Frame* frame);

/** Fill B with BᵀB = K̂, a row √k (e_a/√m_a − e_b/√m_b) a spring, √k Σ w_i e_i/√m_i a lever, and of
 * zeros after these; n_edges × n, column-major. */
void frame_fill_edges(const Frame* frame, uint32_t n_edges, double* edges);

/** The stretches B y, n_edges, without cancellation of what was multiplied before. */
void frame_stretch_edges(const Frame* frame, const double* y, double* stretches);

/** Whether Z = α M + β K for some α and β, to a few roundings of each entry. */
bool frame_is_proportional(const Frame* frame);

#endif

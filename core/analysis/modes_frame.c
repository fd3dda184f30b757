#include "core/analysis/modes_frame.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Roundings that tell a β K_ij written in decimals from another number. */
static const double ROUNDINGS = 32.0 * DBL_EPSILON;

/* Beyond this the pairs that levers couple are too many for any solver. */
static const uint64_t MOST_LINKS = UINT64_C(1) << 26;

static int compare_links(const void* left, const void* right) {
  const FrameLink* const p = left;
  const FrameLink* const q = right;
  if (p->a != q->a) {
    return p->a < q->a ? -1 : 1;
  }
  return p->b < q->b ? -1 : p->b > q->b;
}

/* The row of each point's mass, and √m of each row. */
static void number_masses(Frame* frame, const Network* network, uint32_t* row) {
  for (uint32_t p = 0; p < network->n_points; ++p) {
    row[p] = FRAME_GROUND;
    if (!network->is_ground[p]) {
      frame->root[frame->n] = sqrt(network->mass_kg[p]);
      row[p] = frame->n++;
    }
  }
}

/* The free parts of masses, from those of points. */
static void take_parts(Frame* frame, const uint32_t* row, const uint32_t* part, uint32_t n_points) {
  memset(frame->part_root, 0, frame->n_free * sizeof(double));
  for (uint32_t p = 0; p < n_points; ++p) {
    if (row[p] != FRAME_GROUND) {
      frame->part[row[p]] = part[p];
      if (part[p] != FRAME_GROUND) {
        double* const root = &frame->part_root[part[p]];
        *root = hypot(*root, frame->root[row[p]]);
      }
    }
  }
}

/* `part` has room for a number each point. */
static Status
find_parts(Frame* frame, const Network* network, const uint32_t* row, uint32_t* part) {
  Status status = network_find_free(network, true, part, &frame->n_adrift);
  status = status ? status : network_find_free(network, false, part, &frame->n_free);
  if (!status) {
    take_parts(frame, row, part, network->n_points);
  }
  return status;
}

static void
take_links(Frame* frame, const NetworkLinks* links, const uint32_t* row, bool is_spring) {
  for (uint32_t l = 0; l < links->n; ++l) {
    const uint32_t from = row[links->link[l].from];
    const uint32_t to = row[links->link[l].to];
    const double value = links->link[l].value;
    if (from != to && value > 0.0) {
      frame->link[frame->n_links++] = (FrameLink){
          .a = from < to ? from : to,
          .b = from < to ? to : from,
          .k = is_spring ? value : 0.0,
          .z = is_spring ? 0.0 : value,
      };
    }
  }
}

/* A place in the matrices for each two masses of a lever. */
static void couple(Frame* frame, FrameLever lever) {
  for (uint32_t i = 0; i < lever.n_terms; ++i) {
    for (uint32_t j = i + 1; j < lever.n_terms; ++j) {
      const uint32_t a = frame->term[lever.first + i].mass;
      const uint32_t b = frame->term[lever.first + j].mass;
      frame->link[frame->n_links++] = (FrameLink){.a = a < b ? a : b, .b = a < b ? b : a};
    }
  }
}

static void take_levers(Frame* frame, const NetworkLevers* levers, const uint32_t* row) {
  uint32_t n_terms = 0;
  for (uint32_t l = 0; l < levers->n; ++l) {
    const NetworkLever from = levers->lever[l];
    FrameLever lever = {.first = n_terms, .k = from.stiffness};
    for (uint32_t i = 0; i < from.n_terms; ++i) {
      const NetworkTerm term = levers->term[from.first + i];
      const uint32_t mass = row[term.point];
      if (mass != FRAME_GROUND && term.weight != 0.0) {
        frame->term[n_terms++] = (FrameTerm){mass, term.weight / frame->root[mass]};
      }
    }
    lever.n_terms = n_terms - lever.first;
    if (lever.k > 0.0 && lever.n_terms > 0) {
      frame->lever[frame->n_levers++] = lever;
      couple(frame, lever);
    }
  }
}

/* How many links there may be, those that levers couple included. */
static uint64_t count_links(const Network* network) {
  uint64_t n = (uint64_t)network->springs.n + network->dampers.n;
  for (uint32_t l = 0; l < network->levers.n; ++l) {
    const uint64_t n_terms = network->levers.lever[l].n_terms;
    n += n_terms * (n_terms > 0 ? n_terms - 1 : 0) / 2;
  }
  return n;
}

static void sum_parallel_links(Frame* frame) {
  qsort(frame->link, frame->n_links, sizeof(FrameLink), compare_links);
  uint32_t n = 0;
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    if (n > 0 && compare_links(&frame->link[n - 1], &frame->link[l]) == 0) {
      frame->link[n - 1].k += frame->link[l].k;
      frame->link[n - 1].z += frame->link[l].z;
    } else {
      frame->link[n++] = frame->link[l];
    }
  }
  frame->n_links = n;
}

/* How far a link is stretched in the state y. */
static double stretch(const Frame* frame, FrameLink link, const double* y) {
  const double at_a = y[link.a] / frame->root[link.a];
  return link.b == FRAME_GROUND ? at_a : at_a - y[link.b] / frame->root[link.b];
}

/* How far a lever's spring is stretched in the state y. */
static double stretch_lever(const Frame* frame, FrameLever lever, const double* y) {
  double sum = 0.0;
  for (uint32_t i = 0; i < lever.n_terms; ++i) {
    const FrameTerm term = frame->term[lever.first + i];
    sum += term.weight * y[term.mass];
  }
  return sum;
}

static void fill_lever(const Frame* frame, FrameLever lever, double* matrix) {
  const FrameTerm* const term = frame->term + lever.first;
  for (uint32_t i = 0; i < lever.n_terms; ++i) {
    for (uint32_t j = 0; j < lever.n_terms; ++j) {
      matrix[term[i].mass + (size_t)term[j].mass * frame->n] +=
          lever.k * term[i].weight * term[j].weight;
    }
  }
}

/* Add a link of `value` to a matrix. */
static void fill_link(const Frame* frame, FrameLink link, double value, double* matrix) {
  const size_t n = frame->n;
  const double root_a = frame->root[link.a];
  matrix[link.a + link.a * n] += value / root_a / root_a;
  if (link.b != FRAME_GROUND) {
    const double root_b = frame->root[link.b];
    matrix[link.b + link.b * n] += value / root_b / root_b;
    matrix[link.a + link.b * n] -= value / root_a / root_b;
    matrix[link.b + link.a * n] = matrix[link.a + link.b * n];
  }
}

static bool is_number(double value, double entry) {
  return entry <= DBL_MAX && (value == 0.0 || entry >= DBL_MIN);
}

/* Whether no entry of K̂ or Ẑ overflows, nor is lost. */
static bool has_numbers(const Frame* frame) {
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    const FrameLink link = frame->link[l];
    const double root_a = frame->root[link.a];
    const double root_b = link.b == FRAME_GROUND ? root_a : frame->root[link.b];
    const double least = fmax(root_a, root_b);
    const double most = fmin(root_a, root_b);
    if (!is_number(link.k, link.k / most / most) || !is_number(link.z, link.z / most / most) ||
        !is_number(link.k, link.k / least / least) || !is_number(link.z, link.z / least / least)) {
      return false;
    }
  }
  for (uint32_t l = 0; l < frame->n_levers; ++l) {
    const FrameLever lever = frame->lever[l];
    for (uint32_t i = 0; i < lever.n_terms; ++i) {
      const double weight = frame->term[lever.first + i].weight;
      if (!is_number(lever.k, lever.k * weight * weight)) {
        return false;
      }
    }
  }
  return true;
}

/* The β of masses which hang on the ground only: z/m = α + β k/m on a line through two of them. */
static double guess_beta_to_ground(const Frame* frame) {
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  double z_low = 0.0;
  double z_high = 0.0;
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    const FrameLink link = frame->link[l];
    const double mass = frame->root[link.a] * frame->root[link.a];
    if (link.k / mass < low) {
      low = link.k / mass;
      z_low = link.z / mass;
    }
    if (link.k / mass > high) {
      high = link.k / mass;
      z_high = link.z / mass;
    }
  }
  return high > low ? (z_high - z_low) / (high - low) : 0.0;
}

/* The β that the stiffest link between two masses admits, if any. */
static double guess_beta(const Frame* frame) {
  FrameLink stiffest = {0};
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    if (frame->link[l].b != FRAME_GROUND && frame->link[l].k > stiffest.k) {
      stiffest = frame->link[l];
    }
  }
  return stiffest.k > 0.0 ? stiffest.z / stiffest.k : guess_beta_to_ground(frame);
}

/* Whether z_ij = β k_ij between masses, and what is left over to ground is α m. */
static bool is_split(const Frame* frame, double beta, double* left, double* size) {
  memset(left, 0, frame->n * sizeof(double));
  memset(size, 0, frame->n * sizeof(double));
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    const FrameLink link = frame->link[l];
    const double sum = link.z + beta * link.k;
    size[link.a] += sum;
    if (link.b == FRAME_GROUND) {
      left[link.a] += link.z - beta * link.k;
    } else {
      size[link.b] += sum;
      if (!(fabs(link.z - beta * link.k) <= ROUNDINGS * sum)) {
        return false;
      }
    }
  }
  double all = 0.0;
  double mass = 0.0;
  for (uint32_t i = 0; i < frame->n; ++i) {
    all += left[i];
    mass += frame->root[i] * frame->root[i];
  }
  for (uint32_t i = 0; i < frame->n; ++i) {
    const double share = all / mass * frame->root[i] * frame->root[i];
    if (!(fabs(left[i] - share) <= ROUNDINGS * (size[i] + fabs(share)))) {
      return false;
    }
  }
  return true;
}

Status frame_init(Frame* frame, const Network* network) {
  const uint64_t n_links = count_links(network);
  uint32_t* const row = malloc(2 * ((size_t)network->n_points + 1) * sizeof(uint32_t));
  *frame = (Frame){
      .part = malloc((network->n_masses + (size_t)1) * sizeof(uint32_t)),
      .part_root = malloc((network->n_masses + (size_t)1) * sizeof(double)),
      .root = malloc((network->n_masses + (size_t)1) * sizeof(double)),
      .link = n_links < MOST_LINKS ? malloc((n_links + 1) * sizeof(FrameLink)) : NULL,
      .lever = malloc((network->levers.n + (size_t)1) * sizeof(FrameLever)),
      .term = malloc((network->levers.n_terms + (size_t)1) * sizeof(FrameTerm)),
  };
  Status status = STATUS_NO_MEMORY;
  if (row && frame->part && frame->part_root && frame->root && frame->link && frame->lever &&
      frame->term) {
    number_masses(frame, network, row);
    take_links(frame, &network->springs, row, true);
    take_links(frame, &network->dampers, row, false);
    take_levers(frame, &network->levers, row);
    sum_parallel_links(frame);
    status = has_numbers(frame) ? find_parts(frame, network, row, row + network->n_points)
                                : STATUS_ILL_SCALED;
  }
  free(row);
  if (status) {
    frame_clear(frame);
  }
  return status;
}

void frame_clear(Frame* frame) {
  free(frame->part);
  free(frame->part_root);
  free(frame->root);
  free(frame->link);
  free(frame->lever);
  free(frame->term);
  *frame = (Frame){0};
}

FrameForms frame_forms(const Frame* frame, const double complex* y) {
  FrameForms forms = {0};
  for (uint32_t i = 0; i < frame->n; ++i) {
    forms.inertia += y[i] * y[i];
  }
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    const FrameLink link = frame->link[l];
    double complex length = y[link.a] / frame->root[link.a];
    if (link.b != FRAME_GROUND) {
      length -= y[link.b] / frame->root[link.b];
    }
    forms.stiffness += link.k * length * length;
    forms.damping += link.z * length * length;
  }
  for (uint32_t l = 0; l < frame->n_levers; ++l) {
    const FrameLever lever = frame->lever[l];
    double complex length = 0.0;
    for (uint32_t i = 0; i < lever.n_terms; ++i) {
      const FrameTerm term = frame->term[lever.first + i];
      length += term.weight * y[term.mass];
    }
    forms.stiffness += lever.k * length * length;
  }
  return forms;
}

double frame_stiffness(const Frame* frame, const double* y) {
  double sum = 0.0;
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    const double length = stretch(frame, frame->link[l], y);
    sum += frame->link[l].k * length * length;
  }
  for (uint32_t l = 0; l < frame->n_levers; ++l) {
    const double length = stretch_lever(frame, frame->lever[l], y);
    sum += frame->lever[l].k * length * length;
  }
  return sum;
}

double frame_damping(const Frame* frame, const double* y) {
  double sum = 0.0;
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    const double length = stretch(frame, frame->link[l], y);
    sum += frame->link[l].z * length * length;
  }
  return sum;
}

void frame_add_drag(const Frame* frame, const double* y, double* sum) {
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    const FrameLink link = frame->link[l];
    const double pull = link.z * stretch(frame, link, y);
    sum[link.a] += pull / frame->root[link.a];
    if (link.b != FRAME_GROUND) {
      sum[link.b] -= pull / frame->root[link.b];
    }
  }
}

void frame_fill_stiffness(const Frame* frame, double* matrix) {
  memset(matrix, 0, (size_t)frame->n * frame->n * sizeof(double));
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    fill_link(frame, frame->link[l], frame->link[l].k, matrix);
  }
  for (uint32_t l = 0; l < frame->n_levers; ++l) {
    fill_lever(frame, frame->lever[l], matrix);
  }
}

void frame_fill_damping(const Frame* frame, double* matrix) {
  memset(matrix, 0, (size_t)frame->n * frame->n * sizeof(double));
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    fill_link(frame, frame->link[l], frame->link[l].z, matrix);
  }
}

uint32_t frame_count_edges(const Frame* frame) {
  uint32_t n_edges = frame->n_levers;
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    n_edges += frame->link[l].k > 0.0 ? 1 : 0;
  }
  return n_edges > frame->n - frame->n_free ? n_edges : frame->n - frame->n_free;
}

void frame_fill_edges(const Frame* frame, uint32_t n_edges, double* edges) {
  memset(edges, 0, (size_t)n_edges * frame->n * sizeof(double));
  uint32_t e = 0;
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    const FrameLink link = frame->link[l];
    if (link.k > 0.0) {
      edges[e + (size_t)link.a * n_edges] = sqrt(link.k) / frame->root[link.a];
      if (link.b != FRAME_GROUND) {
        edges[e + (size_t)link.b * n_edges] = -sqrt(link.k) / frame->root[link.b];
      }
      ++e;
    }
  }
  for (uint32_t l = 0; l < frame->n_levers; ++l, ++e) {
    const FrameLever lever = frame->lever[l];
    for (uint32_t i = 0; i < lever.n_terms; ++i) {
      const FrameTerm term = frame->term[lever.first + i];
      edges[e + (size_t)term.mass * n_edges] = sqrt(lever.k) * term.weight;
    }
  }
}

void frame_stretch_edges(const Frame* frame, const double* y, double* stretches) {
  double* const end = stretches + frame_count_edges(frame);
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    if (frame->link[l].k > 0.0) {
      *stretches++ = sqrt(frame->link[l].k) * stretch(frame, frame->link[l], y);
    }
  }
  for (uint32_t l = 0; l < frame->n_levers; ++l) {
    *stretches++ = sqrt(frame->lever[l].k) * stretch_lever(frame, frame->lever[l], y);
  }
  while (stretches < end) {
    *stretches++ = 0.0;
  }
}

bool frame_is_proportional(const Frame* frame) {
  double* const space = malloc(2 * ((size_t)frame->n + 1) * sizeof(double));
  /* No damper acts as levers do.  Without room to tell, the general solver is right as well. */
  const bool is_proportional =
      space &&
      ((frame->n_levers == 0 && is_split(frame, guess_beta(frame), space, space + frame->n)) ||
       is_split(frame, 0.0, space, space + frame->n));
  free(space);
  return is_proportional;
}

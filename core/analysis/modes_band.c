#include "core/analysis/modes_band.h"

#include "core/analysis/modes_lapack.h"
#include "core/string/pole.h"

#include <limits.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Halvings of the logarithm of a step that leave nothing but rounding. */
enum { MOST_HALVINGS = 100 };

/* Who is linked to whom: the neighbours of i are at[start[i]] … at[start[i + 1] − 1]. */
typedef struct {
  uint32_t n;
  uint32_t* start;
  uint32_t* at;
} Graph;

static bool is_between_masses(FrameLink link) {
  return link.b != FRAME_GROUND;
}

static void count_neighbours(Graph* graph, const Frame* frame) {
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    if (is_between_masses(frame->link[l])) {
      ++graph->start[frame->link[l].a + 1];
      ++graph->start[frame->link[l].b + 1];
    }
  }
  for (uint32_t i = 0; i < graph->n; ++i) {
    graph->start[i + 1] += graph->start[i];
  }
}

static void list_neighbours(Graph* graph, const Frame* frame, uint32_t* filled) {
  memcpy(filled, graph->start, graph->n * sizeof(uint32_t));
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    const FrameLink link = frame->link[l];
    if (is_between_masses(link)) {
      graph->at[filled[link.a]++] = link.b;
      graph->at[filled[link.b]++] = link.a;
    }
  }
}

static uint32_t degree(const Graph* graph, uint32_t i) {
  return graph->start[i + 1] - graph->start[i];
}

/* Append to `order` what can be reached from `first`, nearest first, few neighbours before many;
 * marks by `mark`; returns how many there are. */
static uint32_t
spread(const Graph* graph, uint32_t first, uint32_t mark, uint32_t* marks, uint32_t* order) {
  uint32_t n = 0;
  order[n++] = first;
  marks[first] = mark;
  for (uint32_t done = 0; done < n; ++done) {
    const uint32_t begin = n;
    for (uint32_t e = graph->start[order[done]]; e < graph->start[order[done] + 1]; ++e) {
      const uint32_t i = graph->at[e];
      if (marks[i] != mark) {
        marks[i] = mark;
        uint32_t slot = n++;
        for (; slot > begin && degree(graph, order[slot - 1]) > degree(graph, i); --slot) {
          order[slot] = order[slot - 1];
        }
        order[slot] = i;
      }
    }
  }
  return n;
}

/* The farthest point from anywhere is a good end to begin with. */
static void order_masses(const Graph* graph, uint32_t* marks, uint32_t* order) {
  enum { NEW, SOUGHT, SOUGHT_AGAIN, PLACED };
  memset(marks, 0, graph->n * sizeof(uint32_t));
  uint32_t n = 0;
  for (uint32_t i = 0; i < graph->n; ++i) {
    if (marks[i] == NEW) {
      const uint32_t size = spread(graph, i, SOUGHT, marks, order + n);
      spread(graph, order[n + size - 1], SOUGHT_AGAIN, marks, order + n);
      n += spread(graph, order[n + size - 1], PLACED, marks, order + n);
    }
  }
}

static Status place_masses(Band* band, const Frame* frame) {
  const size_t n = frame->n;
  Graph graph = {
      .n = frame->n,
      .start = calloc(n + 1, sizeof(uint32_t)),
      .at = malloc(2 * ((size_t)frame->n_links + 1) * sizeof(uint32_t)),
  };
  uint32_t* const space = malloc(2 * n * sizeof(uint32_t));
  const bool has_room = graph.start && graph.at && space && frame->n_links < UINT32_MAX / 2;
  if (has_room) {
    count_neighbours(&graph, frame);
    list_neighbours(&graph, frame, space);
    order_masses(&graph, space, space + n);
    for (uint32_t i = 0; i < frame->n; ++i) {
      band->place[space[n + i]] = frame->n - 1 - i;
    }
  }
  free(graph.start);
  free(graph.at);
  free(space);
  return has_room ? STATUS_OK : STATUS_NO_MEMORY;
}

static void measure_width(Band* band, const Frame* frame) {
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    if (is_between_masses(frame->link[l])) {
      const uint32_t p = band->place[frame->link[l].a];
      const uint32_t q = band->place[frame->link[l].b];
      const uint32_t apart = p > q ? p - q : q - p;
      band->width = apart > band->width ? apart : band->width;
    }
  }
}

/* Where row i of column j stands, i ≥ j. */
static double* at(const Band* band, uint32_t i, uint32_t j) {
  return &band->value[(i - j) + (size_t)j * (band->width + 1)];
}

/* Steps of single masses which have the largest diagonal entry, or the largest row: the network's
 * own lies between. */
static void bracket_step(const Frame* frame, double* space, double* low, double* high) {
  double* const k = space;
  double* const z = space + frame->n;
  double* const far_k = space + 2 * (size_t)frame->n;
  double* const far_z = space + 3 * (size_t)frame->n;
  memset(space, 0, 4 * (size_t)frame->n * sizeof(double));
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    const FrameLink link = frame->link[l];
    const double root_a = frame->root[link.a];
    k[link.a] += link.k / root_a / root_a;
    z[link.a] += link.z / root_a / root_a;
    if (is_between_masses(link)) {
      const double root_b = frame->root[link.b];
      k[link.b] += link.k / root_b / root_b;
      z[link.b] += link.z / root_b / root_b;
      far_k[link.a] += link.k / root_a / root_b;
      far_k[link.b] += link.k / root_a / root_b;
      far_z[link.a] += link.z / root_a / root_b;
      far_z[link.b] += link.z / root_a / root_b;
    }
  }
  *low = *high = HUGE_VAL;
  for (uint32_t i = 0; i < frame->n; ++i) {
    *high = fmin(*high, pole_largest_step_s(sqrt(k[i]), z[i]));
    *low = fmin(*low, pole_largest_step_s(sqrt(k[i] + far_k[i]), z[i] + far_z[i]));
  }
}

Status band_init(Band* band, const Frame* frame) {
  *band = (Band){.n = frame->n, .place = malloc(frame->n * sizeof(uint32_t))};
  Status status = band->place ? place_masses(band, frame) : STATUS_NO_MEMORY;
  if (!status) {
    measure_width(band, frame);
    const size_t height = (size_t)band->width + 1;
    if (frame->n <= INT_MAX && height <= SIZE_MAX / sizeof(double) / frame->n) {
      band->value = malloc(height * frame->n * sizeof(double));
    }
    status = band->value ? STATUS_OK : STATUS_NO_MEMORY;
  }
  if (status) {
    band_clear(band);
  }
  return status;
}

void band_clear(Band* band) {
  free(band->place);
  free(band->value);
  *band = (Band){0};
}

void band_fill(Band* band, const Frame* frame, double one, double damping, double stiffness) {
  memset(band->value, 0, ((size_t)band->width + 1) * band->n * sizeof(double));
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    const FrameLink link = frame->link[l];
    const double value = damping * link.z + stiffness * link.k;
    const uint32_t p = band->place[link.a];
    const double root_a = frame->root[link.a];
    *at(band, p, p) += value / root_a / root_a;
    if (is_between_masses(link)) {
      const uint32_t q = band->place[link.b];
      const double root_b = frame->root[link.b];
      *at(band, q, q) += value / root_b / root_b;
      *at(band, p > q ? p : q, p > q ? q : p) = -value / root_a / root_b;
    }
  }
  for (uint32_t i = 0; i < band->n; ++i) {
    *at(band, i, i) += one;
  }
}

Status band_factor(Band* band) {
  const int n = (int)band->n;
  const int width = (int)band->width;
  const int height = width + 1;
  int info = 0;
  dpbtrf_("L", &n, &width, band->value, &height, &info);
  return info ? STATUS_ILL_SCALED : STATUS_OK;
}

void band_solve(const Band* band, uint32_t n_vectors, double* vectors, double* space) {
  const int n = (int)band->n;
  const int width = (int)band->width;
  const int height = width + 1;
  const int one = 1;
  int info = 0;
  for (uint32_t v = 0; v < n_vectors; ++v) {
    double* const vector = vectors + (size_t)v * band->n;
    for (uint32_t i = 0; i < band->n; ++i) {
      space[band->place[i]] = vector[i];
    }
    dpbtrs_("L", &n, &width, &one, band->value, &height, space, &n, &info);
    for (uint32_t i = 0; i < band->n; ++i) {
      vector[i] = space[band->place[i]];
    }
  }
}

double band_largest_step(Band* band, const Frame* frame, double* space) {
  double low = 0.0;
  double high = 0.0;
  bracket_step(frame, space, &low, &high);
  for (int i = 0; i < MOST_HALVINGS; ++i) {
    const double middle = sqrt(low) * sqrt(high);
    if (!(middle > low && middle < high)) {
      break;
    }
    band_fill(band, frame, 4.0, -2.0 * middle, -middle * middle);
    if (band_factor(band)) {
      high = middle;
    } else {
      low = middle;
    }
  }
  return low;
}

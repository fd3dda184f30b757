#include "core/analysis/modes_order.h"

#include <assert.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* In the place of a mass: none. */
static const uint32_t NONE = UINT32_MAX;

/* The masses which a mass is linked to, some of them eliminated since. */
typedef struct {
  uint32_t* at;
  uint32_t n;
  uint32_t capacity;
} Neighbours;

/* The masses that are left, those of one degree in one list. */
typedef struct {
  uint32_t n;
  uint32_t n_left;
  uint32_t* place; /* NONE: left */
  Neighbours* of;
  uint32_t* degree; /* Neighbours that are left */
  uint32_t* first;  /* Of each degree */
  uint32_t* next;
  uint32_t* before;
  uint32_t* mark; /* A mass of which this one was last seen to be a neighbour, plus 1 */
} Graph;

static bool reserve(Neighbours* list, size_t n) {
  if (n <= list->capacity) {
    return true;
  }
  const size_t wanted = n + n / 2 + 4;
  const size_t capacity = wanted < UINT32_MAX ? wanted : UINT32_MAX;
  uint32_t* const at = realloc(list->at, capacity * sizeof(uint32_t));
  if (at) {
    list->at = at;
    list->capacity = (uint32_t)capacity;
  }
  return at;
}

static void enlist(const Graph* graph, uint32_t i) {
  uint32_t* const first = &graph->first[graph->degree[i]];
  graph->next[i] = *first;
  graph->before[i] = NONE;
  if (*first != NONE) {
    graph->before[*first] = i;
  }
  *first = i;
}

static void withdraw(const Graph* graph, uint32_t i) {
  const uint32_t before = graph->before[i];
  const uint32_t next = graph->next[i];
  *(before != NONE ? &graph->next[before] : &graph->first[graph->degree[i]]) = next;
  if (next != NONE) {
    graph->before[next] = before;
  }
}

/* Forget the neighbours that were eliminated. */
static void tidy(const Graph* graph, Neighbours* list) {
  uint32_t n = 0;
  for (uint32_t e = 0; e < list->n; ++e) {
    if (graph->place[list->at[e]] == NONE) {
      list->at[n++] = list->at[e];
    }
  }
  list->n = n;
}

/* Link i to all of `others` that it is not linked to yet. */
static bool join(const Graph* graph, uint32_t i, const Neighbours* others) {
  Neighbours* const own = &graph->of[i];
  tidy(graph, own);
  graph->mark[i] = i + 1;
  for (uint32_t e = 0; e < own->n; ++e) {
    graph->mark[own->at[e]] = i + 1;
  }
  if (!reserve(own, (size_t)own->n + others->n)) {
    return false;
  }
  for (uint32_t e = 0; e < others->n; ++e) {
    if (graph->mark[others->at[e]] != i + 1) {
      own->at[own->n++] = others->at[e];
    }
  }
  graph->degree[i] = own->n;
  return true;
}

/* What is left of the neighbours stays in the list: it is the column of the factor. */
static bool eliminate(Graph* graph, uint32_t i) {
  Neighbours* const column = &graph->of[i];
  graph->place[i] = graph->n - graph->n_left--;
  tidy(graph, column);
  for (uint32_t e = 0; e < column->n; ++e) {
    const uint32_t neighbour = column->at[e];
    withdraw(graph, neighbour);
    if (column->n == 1) {
      --graph->degree[neighbour];
    } else if (!join(graph, neighbour, column)) {
      return false;
    }
    enlist(graph, neighbour);
  }
  return true;
}

/* Where all are linked to all, any order will do. */
static void eliminate_rest(Graph* graph) {
  for (uint32_t i = 0; i < graph->n; ++i) {
    if (graph->place[i] == NONE) {
      graph->place[i] = graph->n - graph->n_left--;
      tidy(graph, &graph->of[i]);
    }
  }
}

static bool eliminate_all(Graph* graph) {
  for (uint32_t degree = 0; graph->n_left > 0;) {
    const uint32_t i = graph->first[degree];
    if (i == NONE) {
      ++degree;
    } else if (degree == graph->n_left - 1) {
      eliminate_rest(graph);
    } else {
      withdraw(graph, i);
      if (!eliminate(graph, i)) {
        return false;
      }
      degree = degree > 0 ? degree - 1 : 0;
    }
  }
  return true;
}

static bool add_link(const Graph* graph, uint32_t i, uint32_t other) {
  Neighbours* const list = &graph->of[i];
  if (!reserve(list, (size_t)list->n + 1)) {
    return false;
  }
  list->at[list->n++] = other;
  graph->degree[i] = list->n;
  return true;
}

static bool take_links(const Graph* graph, const Frame* frame) {
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    const FrameLink link = frame->link[l];
    if (link.b != FRAME_GROUND &&
        !(add_link(graph, link.a, link.b) && add_link(graph, link.b, link.a))) {
      return false;
    }
  }
  return true;
}

static void graph_clear(Graph* graph) {
  for (uint32_t i = 0; graph->of && i < graph->n; ++i) {
    free(graph->of[i].at);
  }
  free(graph->of);
  free(graph->degree);
}

static bool graph_init(Graph* graph, const Frame* frame, uint32_t* place) {
  const size_t n = frame->n;
  *graph = (Graph){
      .n = frame->n,
      .n_left = frame->n,
      .place = place,
      .of = calloc(n, sizeof(Neighbours)),
      .degree = calloc(5 * n, sizeof(uint32_t)),
  };
  if (!graph->of || !graph->degree) {
    return false;
  }
  graph->first = graph->degree + n;
  graph->next = graph->first + n;
  graph->before = graph->next + n;
  graph->mark = graph->before + n;
  memset(place, 0xFF, n * sizeof(uint32_t));
  memset(graph->first, 0xFF, n * sizeof(uint32_t));
  if (!take_links(graph, frame)) {
    return false;
  }
  for (uint32_t i = frame->n; i > 0; --i) {
    enlist(graph, i - 1);
  }
  return true;
}

static int compare_places(const void* left, const void* right) {
  const uint32_t p = *(const uint32_t*)left;
  const uint32_t q = *(const uint32_t*)right;
  return p < q ? -1 : p > q;
}

static void take_columns(Order* order, const Graph* graph) {
  for (uint32_t i = 0; i < order->n; ++i) {
    order->start[order->place[i] + 1] = (size_t)graph->of[i].n + 1;
  }
  for (uint32_t j = 0; j < order->n; ++j) {
    order->start[j + 1] += order->start[j];
  }
  for (uint32_t i = 0; i < order->n; ++i) {
    const Neighbours column = graph->of[i];
    uint32_t* const row = order->row + order->start[order->place[i]];
    row[0] = order->place[i];
    for (uint32_t e = 0; e < column.n; ++e) {
      row[e + 1] = order->place[column.at[e]];
    }
    qsort(row, (size_t)column.n + 1, sizeof(uint32_t), compare_places);
  }
}

static size_t count_entries(const Graph* graph) {
  size_t n = graph->n;
  for (uint32_t i = 0; i < graph->n; ++i) {
    n += graph->of[i].n;
  }
  return n;
}

Status order_init(Order* order, const Frame* frame) {
  const size_t n = frame->n;
  Graph graph = {0};
  *order = (Order){
      .n = frame->n,
      .place = malloc(n * sizeof(uint32_t)),
      .start = calloc(n + 1, sizeof(size_t)),
  };
  bool is_done = order->place && order->start && graph_init(&graph, frame, order->place) &&
                 eliminate_all(&graph);
  if (is_done) {
    const size_t n_entries = count_entries(&graph);
    assert(n_entries >= n);
    order->row = malloc(n_entries * sizeof(uint32_t));
    is_done = order->row;
  }
  if (is_done) {
    take_columns(order, &graph);
  }
  graph_clear(&graph);
  if (!is_done) {
    order_clear(order);
  }
  return is_done ? STATUS_OK : STATUS_NO_MEMORY;
}

void order_clear(Order* order) {
  free(order->place);
  free(order->start);
  free(order->row);
  *order = (Order){0};
}

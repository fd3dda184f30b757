#include "tools/formats/scene_mesh.h"

#include <math.h>
#include <stdlib.h>

/* A sheet while it is made.  Places outside of the grid are as those outside of the outline. */
typedef struct {
  Network* network;
  const SceneSheet* sheet;
  SceneMesh mesh;
  uint32_t rim; /* A ground for what springs hold to it */
} Maker;

/* A place of the grid, from 1 where it is inside. */
typedef struct {
  int64_t column;
  int64_t row;
} Place;

static double share_along(const SceneSheet* sheet, int axis, uint32_t i) {
  return sheet->edge == SCENE_FREE ? (i - 0.5) / sheet->n[axis] : i / (sheet->n[axis] + 1.0);
}

/* The outline's share of the width, at a share of the height. */
static double width_at(const SceneSheet* sheet, double share) {
  if (sheet->n_widths < 2) {
    return sheet->n_widths ? sheet->widths[0] : 1.0;
  }
  const double at = share * (sheet->n_widths - 1);
  const uint32_t i = (uint32_t)fmin(floor(at), sheet->n_widths - 2.0);
  return sheet->widths[i] + (at - i) * (sheet->widths[i + 1] - sheet->widths[i]);
}

static bool is_inside(const SceneSheet* sheet, uint32_t column, uint32_t row) {
  const double x = 2.0 * share_along(sheet, 0, column) - 1.0;
  const double share = share_along(sheet, 1, row);
  const double y = 2.0 * share - 1.0;
  return sheet->is_round ? x * x + y * y < 1.0 : fabs(x) < width_at(sheet, share);
}

static Status add_points(Maker* maker) {
  const SceneSheet* const sheet = maker->sheet;
  const double mass_kg = sheet->density * maker->mesh.spacing_m[0] * maker->mesh.spacing_m[1];
  const uint32_t n_before = maker->network->n_masses;
  Status status = STATUS_OK;
  maker->mesh.first = maker->network->n_points;
  for (uint32_t row = 1; row <= sheet->n[1]; ++row) {
    for (uint32_t column = 1; column <= sheet->n[0] && !status; ++column) {
      status = is_inside(sheet, column, row) ? network_add_mass(maker->network, mass_kg, NULL)
                                             : network_add_ground(maker->network, NULL);
    }
  }
  status = status ? status : network_add_ground(maker->network, &maker->rim);
  return !status && maker->network->n_masses == n_before ? STATUS_EMPTY : status;
}

/* The point at a place, or UINT32_MAX where the sheet is not. */
static uint32_t mass_at(const Maker* maker, Place place) {
  const uint32_t* const n = maker->sheet->n;
  if (place.column < 1 || place.column > n[0] || place.row < 1 || place.row > n[1]) {
    return UINT32_MAX;
  }
  const uint32_t point =
      scene_mesh_point(&maker->mesh, (uint32_t)place.column, (uint32_t)place.row);
  return maker->network->is_ground[point] ? UINT32_MAX : point;
}

/* A lever at what there is of some places; on a free sheet all have to be there. */
static Status
add_lever(Maker* maker, uint32_t n, const Place* place, const double* weight, double stiffness) {
  NetworkTerm term[4];
  uint32_t n_terms = 0;
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t point = mass_at(maker, place[i]);
    if (point != UINT32_MAX) {
      term[n_terms++] = (NetworkTerm){point, weight[i]};
    }
  }
  const bool is_there = maker->sheet->edge == SCENE_FREE ? n_terms == n : n_terms > 0;
  return is_there ? network_add_lever(maker->network, stiffness, n_terms, term) : STATUS_OK;
}

static Place next_to(Place place, int axis, int64_t by) {
  place.column += axis == 0 ? by : 0;
  place.row += axis == 1 ? by : 0;
  return place;
}

/* The moment at a place that is there, and what clamps it. */
static Status add_moment(Maker* maker, Place place, int axis) {
  static const double weights[] = {1.0, -2.0, 1.0};
  const double* const spacing_m = maker->mesh.spacing_m;
  const double stiffness =
      maker->sheet->bending[axis] * spacing_m[1 - axis] / pow(spacing_m[axis], 3.0);
  const Place places[] = {next_to(place, axis, -1), place, next_to(place, axis, 1)};
  Status status = add_lever(maker, 3, places, weights, stiffness);
  for (int side = 0; side < 3 && maker->sheet->edge == SCENE_CLAMPED && !status; side += 2) {
    if (mass_at(maker, places[side]) == UINT32_MAX) {
      status =
          network_add_spring(maker->network, mass_at(maker, place), maker->rim, 2.0 * stiffness);
    }
  }
  return status;
}

/* The twist of the four places from this one on. */
static Status add_twist(Maker* maker, Place place) {
  static const double weights[] = {1.0, -1.0, -1.0, 1.0};
  const SceneSheet* const sheet = maker->sheet;
  const double area = maker->mesh.spacing_m[0] * maker->mesh.spacing_m[1];
  const Place beside = next_to(place, 0, 1);
  const Place places[] = {place, beside, next_to(place, 1, 1), next_to(beside, 1, 1)};
  return add_lever(maker, 4, places, weights,
                   2.0 * sqrt(sheet->bending[0] * sheet->bending[1]) / area);
}

/* The spring of a membrane to the next place, and to the rim before. */
static Status add_pull(Maker* maker, Place place, int axis) {
  const double* const spacing_m = maker->mesh.spacing_m;
  const double stiffness = maker->sheet->tension * spacing_m[1 - axis] / spacing_m[axis];
  const uint32_t point = mass_at(maker, place);
  const uint32_t before = mass_at(maker, next_to(place, axis, -1));
  const uint32_t after = mass_at(maker, next_to(place, axis, 1));
  Status status = network_add_spring(maker->network, point,
                                     after == UINT32_MAX ? maker->rim : after, stiffness);
  if (before == UINT32_MAX && !status) {
    status = network_add_spring(maker->network, point, maker->rim, stiffness);
  }
  return status;
}

static Status add_springs(Maker* maker) {
  const SceneSheet* const sheet = maker->sheet;
  const bool is_plate = sheet->bending[0] > 0.0 || sheet->bending[1] > 0.0;
  Status status = STATUS_OK;
  for (int64_t row = 0; row <= sheet->n[1]; ++row) {
    for (int64_t column = 0; column <= sheet->n[0]; ++column) {
      const Place place = {column, row};
      const bool is_mass = mass_at(maker, place) != UINT32_MAX;
      for (int axis = 0; axis < 2 && is_mass && !status; ++axis) {
        status = is_plate ? add_moment(maker, place, axis) : add_pull(maker, place, axis);
      }
      if (is_plate && !status) {
        status = add_twist(maker, place);
      }
    }
  }
  return status;
}

Status scene_mesh_add(Network* network, const SceneSheet* sheet, SceneMesh* mesh) {
  Maker maker = {.network = network, .sheet = sheet};
  for (int axis = 0; axis < 2; ++axis) {
    maker.mesh.n[axis] = sheet->n[axis];
    maker.mesh.spacing_m[axis] =
        sheet->size_m[axis] / (sheet->n[axis] + (sheet->edge == SCENE_FREE ? 0.0 : 1.0));
  }
  Status status = add_points(&maker);
  status = status ? status : add_springs(&maker);
  *mesh = maker.mesh;
  return status;
}

uint32_t scene_mesh_point(const SceneMesh* mesh, uint32_t column, uint32_t row) {
  return mesh->first + (row - 1) * mesh->n[0] + column - 1;
}

/* From 0. */
static Place place_of(const SceneMesh* mesh, uint32_t point) {
  const uint32_t i = point - mesh->first;
  return (Place){i % mesh->n[0], i / mesh->n[0]};
}

void scene_mesh_place(const SceneMesh* mesh, uint32_t point, double place_m[2]) {
  const Place place = place_of(mesh, point);
  place_m[0] = ((double)place.column - 0.5 * (mesh->n[0] - 1.0)) * mesh->spacing_m[0];
  place_m[1] = ((double)place.row - 0.5 * (mesh->n[1] - 1.0)) * mesh->spacing_m[1];
}

Status scene_mesh_brace(Network* network,
                        const SceneMesh* mesh,
                        uint32_t from,
                        uint32_t to,
                        double mass_kg,
                        double bending) {
  const Place a = place_of(mesh, from);
  const Place b = place_of(mesh, to);
  const int64_t columns = b.column - a.column;
  const int64_t rows = b.row - a.row;
  const int64_t n = llabs(columns) > llabs(rows) ? llabs(columns) : llabs(rows);
  if (n == 0 || (columns != 0 && rows != 0 && llabs(columns) != llabs(rows))) {
    return STATUS_BAD_ARGUMENT;
  }
  const int64_t step = rows / n * (int64_t)mesh->n[0] + columns / n;
  const double length_m =
      hypot((double)(columns / n) * mesh->spacing_m[0], (double)(rows / n) * mesh->spacing_m[1]);
  const double stiffness = bending / pow(length_m, 3.0);
  Status status = STATUS_OK;
  for (int64_t i = 0; i <= n && !status; ++i) {
    const uint32_t point = (uint32_t)(from + i * step);
    if (network->is_ground[point]) {
      return STATUS_BAD_ARGUMENT;
    }
    network_load(network, point, mass_kg / (double)(n + 1));
    if (i > 0 && i < n) {
      const NetworkTerm term[] = {
          {(uint32_t)(point - step), 1.0}, {point, -2.0}, {(uint32_t)(point + step), 1.0}};
      status = network_add_lever(network, stiffness, 3, term);
    }
  }
  return status;
}

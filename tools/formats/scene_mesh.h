/**
   Plates and membranes of a scene, as masses on a grid.

   With the spacings a and b, the mass density · a b at each place, and w the displacement there,

       membrane:  T/2 ∫∫ w_x² + w_y²:   springs of T b/a along x and of T a/b along y;
       plate:     ½ ∫∫ D_x w_xx² + D_y w_yy² + 2 √(D_x D_y) w_xy²:
                  levers of 1, −2, 1 and D_x b/a³ along x, of D_y a/b³ along y, and at each four
                  neighbours one of 1, −1, −1, 1 and 2 √(D_x D_y)/(a b), which twists

   (√(D_x D_y) is Huber's for plates that bend more easily one way, as wood does, and right where
   they do not.)  A rim that is held runs one spacing outside of the outermost masses; where it is
   clamped too, a spring of twice the lever's holds each mass to it.  A free one runs half a spacing
   outside of them, and nothing acts across it.

   Part of tools/formats/scene.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCENE_MESH_H
#define HOOKE_TOOLS_FORMATS_SCENE_MESH_H

#include "core/analysis/network.h"
#include "core/base/status.h"

#include <stdbool.h>
#include <stdint.h>

enum {
  SCENE_MOST_COLUMNS = 256, /**< And rows */
  SCENE_MOST_WIDTHS = 32
};

typedef enum { SCENE_FREE, SCENE_HINGED, SCENE_CLAMPED } SceneEdge;

/** What a plate or a membrane is made of. */
typedef struct {
  uint32_t n[2];     /**< Columns and rows, 1 to SCENE_MOST_COLUMNS */
  double size_m[2];  /**< Width and height [m] */
  double density;    /**< [kg/m²] */
  double bending[2]; /**< D_x and D_y [N m]; 0 of a membrane */
  double tension;    /**< T [N/m]; 0 of a plate */
  SceneEdge edge;
  bool is_round;                    /**< An ellipse within that rectangle */
  uint32_t n_widths;                /**< 0: the rectangle itself, or the ellipse */
  double widths[SCENE_MOST_WIDTHS]; /**< Shares of its width, evenly from the first row's end to the
                                       last's: an outline of straight lines */
} SceneSheet;

/** A grid of points, masses where the sheet is and grounds elsewhere. */
typedef struct {
  uint32_t first; /**< The point in column 1 and row 1; columns follow each other */
  uint32_t n[2];
  double spacing_m[2];
} SceneMesh;

/** Add the points and springs of a sheet.  @return STATUS_OK; STATUS_EMPTY where no place of the
 * grid is inside of the outline; STATUS_NO_MEMORY, with part of it added */
Status scene_mesh_add(Network* network, const SceneSheet* sheet, SceneMesh* mesh);

/** The point at a column and a row, from 1. */
uint32_t scene_mesh_point(const SceneMesh* mesh, uint32_t column, uint32_t row);

/** Where a place of the grid is, from its middle [m]. */
void scene_mesh_place(const SceneMesh* mesh, uint32_t point, double place_m[2]);

/**
   Glue a bar of `mass_kg` and the bending stiffness `bending` [N m²] to a mesh, from one of its
   points to another along a column, a row or a diagonal.

   @return STATUS_OK; STATUS_BAD_ARGUMENT where they are not on such a line, or a place between is
   none of the sheet's; STATUS_NO_MEMORY
*/
Status scene_mesh_brace(Network* network,
                        const SceneMesh* mesh,
                        uint32_t from,
                        uint32_t to,
                        double mass_kg,
                        double bending);

#endif

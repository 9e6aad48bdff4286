/* Closed surfaces on a lattice of whole numbers, where questions of inside and outside have exact answers. */
#ifndef PBMPM_SRC_SHAPE_SURFACE_H
#define PBMPM_SRC_SHAPE_SURFACE_H

#include "base/memory.h"
#include "pbmpm/solid.h"

/* Lattice units along the longest side. A determinant of three hull edges then fits 64 bits: 6 * 2^57. */
enum { MESH_LATTICE = 1 << 22, HULL_LATTICE = 1 << 19 };

typedef struct LatticePoint {
    int32_t at[3]; /* 0 to the lattice's size */
} LatticePoint;

/* Indices of vertices; the third is not used in 2D. */
typedef struct Element {
    uint32_t corner[3];
} Element;

/* Triangles (2D: edges). A vertex lies at low + unit * at. */
typedef struct Surface {
    int dimension;
    double low[3], unit;
    uint32_t vertices, elements;
    int orientation; /* 1: wound outward, -1: inward */
    LatticePoint *vertex;
    Element *element;
    size_t vertex_room, element_room;
} Surface;

/* Null if the arrays are sound, else what is wrong. */
const char *surface_problem(const pbmpm_mesh_def *def, bool hull);

/* Corners of the box around the vertices, and its longest side. */
double surface_bounds(const pbmpm_mesh_def *def, double low[3], double high[3]);

/* The definition is sound. Refuses surfaces that are open, wound in two ways, or hold nothing. */
pbmpm_result surface_from_mesh(Surface *surface, Memory *memory, const pbmpm_mesh_def *def);

/* The convex hull of the vertices. Refuses points that all lie in a plane (2D: on a line). */
pbmpm_result surface_from_hull(Surface *surface, Memory *memory, const pbmpm_mesh_def *def);

void surface_free(Surface *surface, Memory *memory);

/* ---- For the makers of surfaces ---- */

/* Moves the vertices to a lattice and merges equal ones; they are sorted then. merged[i]: what vertex i became; may be null. */
pbmpm_result surface_place(Surface *surface, Memory *memory, const pbmpm_mesh_def *def, int32_t lattice, uint32_t *merged);
pbmpm_result surface_reserve(Surface *surface, Memory *memory, size_t elements);

#endif

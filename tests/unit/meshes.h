/* Meshes whose distances have formulas, and how to spoil them. */
#ifndef PBMPM_TESTS_MESHES_H
#define PBMPM_TESTS_MESHES_H

#include <stdbool.h>

#include "pbmpm/pbmpm.h"

enum { MESH_VERTICES_MAX = 40000, MESH_ELEMENTS_MAX = 80000 };

typedef struct Mesh {
    int dimension;
    uint32_t vertices, elements;
    float vertex[3 * MESH_VERTICES_MAX];
    uint32_t element[3 * MESH_ELEMENTS_MAX];
} Mesh;

/* Each adds a part, wound outward, to what is there. */
void mesh_add_ball(Mesh *mesh, double x, double y, double z, double radius, uint32_t rings); /* 2D: a polygon of 2 * rings corners */
void mesh_add_box(Mesh *mesh, const double centre[3], const double half[3]);
void mesh_add_torus(Mesh *mesh, double ring_radius, double tube_radius, uint32_t rings);     /* 3D, around the second axis */

void mesh_clear(Mesh *mesh, int dimension);
/* Winds the elements from `first` on the other way. */
void mesh_turn_over(Mesh *mesh, uint32_t first);
/* Gives each element vertices of its own. */
void mesh_unshare(Mesh *mesh);

pbmpm_mesh_def mesh_def_of(const Mesh *mesh, int32_t resolution);

#endif

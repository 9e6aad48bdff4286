/* Surfaces and points of a world's particles, and what is kept for the next one. */
#ifndef PBMPM_SRC_SKIN_SKIN_H
#define PBMPM_SRC_SKIN_SKIN_H

#include "world/world.h"

pbmpm_surface_def skin_def_defaults(void);
pbmpm_points_def skin_points_defaults(void);

/* Null if valid, else what is wrong. Whether the materials are live is not asked. */
const char *skin_problem(const pbmpm_surface_def *def, const pbmpm_surface_mesh *mesh);
const char *skin_points_problem(const pbmpm_points_def *def);

/* Writes the counts, and the mesh if there is room for it. */
pbmpm_result skin_extract(World *world, const pbmpm_surface_def *def, pbmpm_surface_mesh *mesh);
pbmpm_result skin_points(World *world, const pbmpm_points_def *def, pbmpm_point *points, uint32_t capacity, uint32_t *count);

void skin_free(World *world);

#endif

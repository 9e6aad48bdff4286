/* Distances to a closed surface at the nodes of a grid. */
#ifndef PBMPM_SRC_SHAPE_BAKE_H
#define PBMPM_SRC_SHAPE_BAKE_H

#include "shape/distance_grid.h"
#include "shape/surface.h"

pbmpm_mesh_def mesh_defaults(void);
pbmpm_heights_def heights_defaults(void);

/* As pbmpm_bake_mesh() and pbmpm_bake_hull(), with a definition of known size. */
pbmpm_result bake_mesh(const pbmpm_mesh_def *def, bool hull, void *buffer, uint64_t capacity, uint64_t *bytes);
pbmpm_result bake_heights(const pbmpm_heights_def *def, void *buffer, uint64_t capacity, uint64_t *bytes);

#endif

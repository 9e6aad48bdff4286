/* A pyramid of ever coarser grids over the blocks of a sparse grid, and the preconditioner of J. Bramble, J. Pasciak, J. Xu, "Parallel
 * multilevel preconditioners", Math. Comp. 55, 1990, for one scalar per node:
 *     z = sum_l P_l D_l^-1 P_l^T r,
 * with P_l the hat functions of spacing 2^l (products of 1 - |x| / 2^l) and D_l their energies. The hats are nested, so values pass from
 * level to level with the weights 1/2, 1, 1/2 per axis. */
#ifndef PBMPM_SRC_PYRAMID_H
#define PBMPM_SRC_PYRAMID_H

#include <stdint.h>

#include "memory.h"

enum { PYRAMID_LEVELS = 8 };

typedef struct PyramidLevel {
    int32_t blocks;
    Array coordinate; /* int32_t[3] per block */
    Array parent;     /* int32_t per block and corner {0,1}^d: the coarser block of (coordinate + corner) >> 1 */
    Array value;      /* float per node; not at level 0 */
    Array scale;      /* float per node: 1 / D_l, or 0 where a hat has no energy; not at level 0 */
} PyramidLevel;

typedef struct Pyramid {
    int dimension;
    int levels; /* with level 0 */
    PyramidLevel level[PYRAMID_LEVELS];
    Array table; /* scratch of the build: hash of coarse blocks */
} Pyramid;

/* Builds the levels over blocks of 4^d nodes at `coordinate` (int32_t[3] each, in blocks). False: no memory. */
bool pyramid_build(Pyramid *pyramid, Memory *memory, int dimension, const int32_t *coordinate, int32_t blocks);
void pyramid_free(Pyramid *pyramid, Memory *memory);

/* Sets D_l from the energy sum_i stiffness_i |grad s|^2 + load_i s^2 of a field s, for hats that `stiffness` and `load` (floats per node
 * of level 0) hardly change over. */
void pyramid_set_energy(Pyramid *pyramid, const float *stiffness, const float *load);

/* Adds to z what all levels but 0 make of r (floats per node of level 0). */
void pyramid_precondition(Pyramid *pyramid, const float *r, float *z);

#endif

/* A multilevel preconditioner of vectors on the sparse grid (J. Bramble, J. Pasciak, J. Xu, "Parallel multilevel preconditioners", Math.
 * Comp. 55, 1990):
 *
 *     z = r / N + sum_l P_l (1 / D_l) P_l^T r.
 *
 * Level l has nodes at every 2^l-th of the grid and hat functions of that width; P_l is their values on the grid. Hats of one level are
 * sums of those of the next finer one with weights 1 and 1/2 per axis, so that levels are visited one by one. N = m + k is the nodes' mass and
 * stiffness. D_l is the energy of a hat: with smooth m and k,
 *     sum W^2 m = (2/3)^d sum W m,    1/4 sum |grad W|^2 k = d/2 4^-l (2/3)^(d-1) sum W k,
 * and where nodes are held the stiffness of the jump is added, (2/3)^d sum W k over held nodes. Particles are not touched.
 *
 * A block of level l + 1 covers two blocks of level l per axis. */
#ifndef PBMPM_SRC_MULTILEVEL_H
#define PBMPM_SRC_MULTILEVEL_H

#include "grid.h"

enum { MULTILEVEL_MAX = 20 };

typedef struct Level {
    int32_t blocks;
    Array coordinate; /* int32_t[3] per block; on the finest level counted from the lowest */
    Array child;      /* per block 3^d blocks of the finer level, from 2c - 1 to 2c + 1 per axis, or -1 */
    Array parent;     /* per block of the finer level 2^d blocks of this one: c/2 and the next per axis */
    Array vector;     /* K_NODE_WIDTH floats per node */
    Array inverse;    /* 1/D per axis; the fourth: sum W k */
} Level;

typedef struct Multilevel {
    int dimension, block_cells;
    int levels;                   /* with the finest, whose vectors and inverse are the caller's */
    Level level[MULTILEVEL_MAX];
    Array table;                  /* hash table of blocks while a level is built */
} Multilevel;

/* Lists the blocks of all levels; false without memory. */
bool multilevel_build(Multilevel *m, Memory *memory, const Grid *grid);
void multilevel_free(Multilevel *m, Memory *memory);

/* The diagonals. `weight`: per node of the grid, for each axis the mass that is free plus the stiffness that is held, and the stiffness. */
void multilevel_weigh(Multilevel *m, Pool *pool, const float *weight);

/* z += sum_l P_l (1 / D_l) P_l^T r; both have K_NODE_WIDTH floats per node of the grid. */
void multilevel_add(Multilevel *m, Pool *pool, const float *r, float *z);

#endif

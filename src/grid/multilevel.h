/* A multilevel preconditioner of vectors or scalars on the sparse grid (J. Bramble, J. Pasciak, J. Xu, "Parallel multilevel preconditioners",
 * Math. Comp. 55, 1990):
 *
 *     z = r / N + sum_l P_l (1 / D_l) P_l^T r,
 *
 * r / N the caller's.
 *
 * Level l has nodes at every 2^l-th of the grid and hat functions of that width; P_l is their values on the grid. Hats of one level are
 * sums of those of the next finer one with weights 1 and 1/2 per axis, so that levels are visited one by one. D_l is the energy of a hat: of
 * sum_i m_i |s_i|^2 + k_i/4 |grad s_i|^2, with m and k that hardly change over the hat,
 *     sum W^2 m = (2/3)^d sum W m,    1/4 sum |grad W|^2 k = d/2 4^-l (2/3)^(d-1) sum W k.
 * Particles are not touched.
 *
 * A block of level l + 1 covers two blocks of level l per axis. */
#ifndef PBMPM_SRC_GRID_MULTILEVEL_H
#define PBMPM_SRC_GRID_MULTILEVEL_H

#include "grid/grid.h"

enum { MULTILEVEL_MAX = 20 };

/* Where the levels end. What is best was found by trying both for both. */
typedef enum LevelsEnd {
    LEVELS_OVER_MATTER, /* with hats as wide as each body: for elastic bodies */
    LEVELS_BEYOND       /* with hats many times wider, which nearly all correct the mean alone, first of all; on every level nodes lie at the lowest
                           particles: for pressures, whose mean is what a free surface holds weakest */
} LevelsEnd;

typedef struct Level {
    int32_t blocks;
    Array coordinate; /* int32_t[4] per block: its place, and its body: hats are of one body each */
    Array child;      /* per block 3^d blocks of the finer level, from 2c - 1 to 2c + 1 per axis, or -1 */
    Array parent;     /* per block of the finer level 2^d blocks of this one: c/2 and the next per axis */
    Array vector;     /* `width` floats per node */
    Array inverse;    /* 1/D, as many */
} Level;

typedef struct Multilevel {
    int dimension, block_cells;
    int width;                    /* floats per node of all vectors: 1, or K_NODE_WIDTH */
    int levels;                   /* with the finest, whose vectors and inverse are the caller's */
    Level level[MULTILEVEL_MAX];
    Array table, range;           /* while levels are built: a hash table of blocks; where the blocks of each body lie */
    Array origin;                 /* where the particles of each body begin */
    int32_t shift;                /* of the finest level's blocks against that */
    bool built;                   /* the levels are complete; as long as the grid has the same blocks they stay */
} Multilevel;

/* Lists the blocks of all levels, unless they are as listed before; false without memory. */
bool multilevel_build(Multilevel *m, Memory *memory, const Grid *grid, int width, LevelsEnd end);
void multilevel_free(Multilevel *m, Memory *memory);

/* What follows adds its loops to others.
 *
 * The diagonals, from m (`width` floats per node of the grid) and k (one float per node). `overlap`: the number of levels that correct the same smooth
 * motion; it acts on the stiffness alone. */
void multilevel_weigh(const Multilevel *m, Loops *loops, const float *mass, const float *stiffness, double overlap);

/* z += sum_l P_l (1 / D_l) P_l^T r; both have `width` floats per node of the grid. */
void multilevel_add(const Multilevel *m, Loops *loops, const float *r, float *z);

#endif

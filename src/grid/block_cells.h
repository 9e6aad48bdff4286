/* The cells of a block as bits: x fastest. In 2D the third coordinate is 0. */
#ifndef PBMPM_SRC_GRID_BLOCK_CELLS_H
#define PBMPM_SRC_GRID_BLOCK_CELLS_H

#include <stdint.h>
#include <stdlib.h>

#include "kernel_types.h"

/* Cells whose particles have a node in common are so far apart at most, along every axis. */
enum { BLOCK_CELLS_SHARE = 2 };

/* All cells with this local coordinate on an axis. */
static inline uint64_t block_cells_slice(int axis, int local)
{
    static const uint64_t lowest[3] = {0x1111111111111111u, 0x000f000f000f000fu, 0x000000000000ffffu};
    return lowest[axis] << (local << (2 * axis));
}

/* The cells of the block `offset` blocks further, which share a node with `cell`. */
static inline uint64_t block_cells_near(const int32_t cell[3], const int32_t offset[3], int dimension)
{
    uint64_t near = dimension == 3 ? ~(uint64_t)0 : block_cells_slice(2, 0);
    for (int axis = 0; axis < dimension && near; axis++) {
        uint64_t along = 0;
        for (int to = 0; to < K_BLOCK_AXIS; to++)
            if (abs(to + K_BLOCK_AXIS * offset[axis] - (cell[axis] & (K_BLOCK_AXIS - 1))) <= BLOCK_CELLS_SHARE) along |= block_cells_slice(axis, to);
        near &= along;
    }
    return near;
}

#endif

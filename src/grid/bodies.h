/* Bodies: matter that shares no node with the rest.
 *
 * Two bodies have nothing to do with each other, but their particles may touch nodes of one block. Then each body has that node block for itself: a copy with the same
 * place, its own nodes and its own neighbours. So a block of the grid belongs to one body, and sums over its blocks are sums over the body: what rests, falls, bounces
 * or turns does so alone, however near another body is. The particles of a block are of one body. */
#ifndef PBMPM_SRC_GRID_BODIES_H
#define PBMPM_SRC_GRID_BODIES_H

#include "grid/grid.h"

/* For a grid whose blocks have their places and neighbours: numbers the bodies, and adds the copies behind all other blocks. False: no memory. */
bool bodies_part(Grid *grid, Memory *memory);

static inline int32_t body_of_block(const Grid *grid, int32_t block) { return ((const int32_t *)grid->body.data)[block]; }

#endif

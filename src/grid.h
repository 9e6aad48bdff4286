/* The sparse grid of one substep: which blocks exist, which particles and nodes they hold. */
#ifndef PBMPM_SRC_GRID_H
#define PBMPM_SRC_GRID_H

#include "kernel_types.h"
#include "memory.h"
#include "particles.h"
#include "pool.h"

typedef struct Grid {
    int dimension;
    int neighbours;     /* 3^d */
    int block_cells;    /* 4^d cells, and as many nodes */
    int tile_nodes;     /* 6^d */
    uint32_t capacity;  /* particles */

    /* The lowest cell with a particle, per axis: blocks are counted from it. So the division into blocks, and with it the order
     * of all sums, goes with the matter: a scene shifted by whole cells moves bit for bit the same. */
    int32_t anchor[3];

    /* Blocks [0, particle_blocks) hold particles, the rest up to node_blocks are only touched. Each kind is in Morton order. */
    int32_t particle_blocks;
    int32_t node_blocks;
    Array coordinate;    /* int32_t[3] per node block: its position in blocks from the anchor */
    Array neighbour;     /* int32_t per node block and neighbour: block index or -1 */
    Array block_begin;   /* uint32_t per particle block, and the end: first particle */
    Array block_run;     /* uint32_t per particle block, and the end: first run */

    /* Runs: sorted particles of one cell and material. */
    uint32_t *run_begin; /* capacity + 1 */
    uint32_t *run_key;   /* capacity */
    uint32_t runs;

    /* What the kernels work on; see KernelArgs. */
    Array tile, tile_volume, node, node_base, node_volume, node_reach, clamped, moved, lost, travel;

    /* Scratch of the build. */
    Array found;       /* blocks in order of discovery */
    Array sorted;      /* their order, twice: source and target of the merge sort */
    Array table;       /* hash table: index of a block + 1, or 0 */
    uint32_t found_count;
    int32_t *block_of; /* per particle: block in order of discovery */
    uint32_t *order;   /* per particle: the new order */
    uint32_t *order_scratch;
} Grid;

pbmpm_result grid_init(Grid *grid, Memory *memory, int dimension, uint32_t capacity);
void grid_free(Grid *grid, Memory *memory);

/* No blocks, no runs: there are no particles. */
static inline void grid_clear(Grid *grid)
{
    grid->particle_blocks = grid->node_blocks = 0;
    grid->runs = 0;
}

/* Sorts the particles by block, cell and material and lists the blocks they touch. `with_volume`: also room for rest
 * volumes. On failure (no memory) the particles are as before and the grid is empty. */
pbmpm_result grid_build(Grid *grid, Memory *memory, Particles *particles, Pool *pool, bool with_volume);

#endif

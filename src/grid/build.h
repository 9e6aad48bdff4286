/* Building a grid: finds its blocks, puts them and the particles in order, and links them. */
#ifndef PBMPM_SRC_GRID_BUILD_H
#define PBMPM_SRC_GRID_BUILD_H

#include "grid/grid.h"

/* Sorts the particles by block, cell and material and lists the blocks they touch. `with_volume`: also room for rest
 * volumes. On failure (no memory) the particles are as before and the grid is empty. */
pbmpm_result grid_build(Grid *grid, Memory *memory, Particles *particles, Pool *pool, bool with_volume);

/* The lowest cell of the particles, per axis. */
void grid_drop_anchor(const Particles *particles, int32_t anchor[3]);

/* ---- The same in parts, for who decides between them which particles belong in the grid, and how blocks rank ---- */

/* Forgets all blocks; those to come are counted from `anchor`. False: no memory. */
bool grid_begin(Grid *grid, Memory *memory, const int32_t anchor[3]);

/* Finds the blocks of the particles in the rows [begin, end). False: no memory. */
bool grid_add_rows(Grid *grid, Memory *memory, const Particles *particles, uint32_t begin, uint32_t end);

/* The block in order of discovery at a place that is counted from the anchor; null if it was not found. */
FoundBlock *grid_found(const Grid *grid, const int32_t place[3]);

/* The rest: sorts the rows from `first` on, all of which were added. */
pbmpm_result grid_finish(Grid *grid, Memory *memory, Particles *particles, Pool *pool, bool with_volume, uint32_t first);

/* ---- A grid of some of the particles, which shares the scratch of the whole one: see grid_share() ---- */

/* Builds it of the particles that order_scratch lists from `first` to `end`: their new order stands in `order` then. On failure it is empty. */
pbmpm_result grid_arrange_part(Grid *part, Memory *memory, Particles *particles, Pool *pool, bool with_volume);

/* After the particles were brought into the order of all parts. Adds its loops to others. */
void grid_link_part(Grid *part, Particles *particles, Loops *loops);

#endif

/* The blocks of the lattice that a surface is looked for in: those with particles, and those that these reach.
 *
 * The lattice has `subdivision` points per cell and axis. With 1 they are the nodes of the grid. With 2 they lie a quarter of a cell beside them, see field.h.
 * A block has 8 points per axis, so 8 or 4 cells. Its box is what is near: the block and 2 points more on either side. */
#ifndef PBMPM_SRC_SKIN_BLOCKS_H
#define PBMPM_SRC_SKIN_BLOCKS_H

#include "base/memory.h"
#include "base/pool.h"
#include "grid/grid.h"
#include "matter/particles.h"
#include "skin/matter.h"
#include "skin/skin_kernels.h"

enum {
    BLOCK_AXIS = 8,
    BLOCK_POINTS = BLOCK_AXIS * BLOCK_AXIS * BLOCK_AXIS,
    BOX_MARGIN = 2,
    BOX_AXIS = BLOCK_AXIS + 2 * BOX_MARGIN,
    BOX_POINTS = BOX_AXIS * BOX_AXIS * BOX_AXIS,
    BLOCK_NEIGHBOURS = 27,
    THICKENINGS = K_THICKENINGS
};

/* Rows of particles that follow one another in a block. */
typedef struct BlockRun {
    int32_t block;
    uint32_t begin, end;
} BlockRun;

typedef struct SurfaceRange CellBox;

typedef struct SkinBlock {
    int32_t place[3]; /* in blocks, from the anchor */
    int32_t neighbour[BLOCK_NEIGHBOURS]; /* as grid_neighbour_offset() has them; GRID_NOWHERE: not there */
    uint8_t found[3];                    /* per axis, bit k: a particle is in cell k */
    CellBox cells;                       /* those with particles */
    CellBox splatted;                    /* those whose particles its box is of */
    uint32_t first_run, runs;
    float volume;                        /* of its particles [cells] */
    CellBox reached;                     /* its points that boxes which are splatted change */
    bool bounded;                        /* obstacles are near, see boundary.h */
    bool wanted;                         /* the field is to be worked out here */
    int32_t kept_as;                     /* its number once spray is left out */
    float least, most;       /* of the field */
    float spray, thin, enclosed[THICKENINGS + 1], thickening; /* see thin.h */
    uint64_t inside[BLOCK_AXIS], cut[BLOCK_AXIS]; /* per plane across z, bit 8 y + x: the point is inside; the cube above it is cut */
    uint32_t first_vertex, vertices, first_triangle, triangles;
} SkinBlock;

typedef struct SkinBlocks {
    int32_t anchor[3]; /* the first cell of block (0, 0, 0) */
    int subdivision;
    int32_t count, with_rows; /* those with particles come first */
    int32_t runs, slots;
    Array block, run, found_run, table;
} SkinBlocks;

static inline SkinBlock *blocks_at(const SkinBlocks *blocks, int32_t b) { return (SkinBlock *)blocks->block.data + b; }
static inline const BlockRun *blocks_run(const SkinBlocks *blocks, uint32_t r) { return (const BlockRun *)blocks->run.data + r; }
static inline int32_t blocks_cells(const SkinBlocks *blocks) { return BLOCK_AXIS / blocks->subdivision; }

static inline CellBox cells_none(void) { return (CellBox){{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}}; }
static inline bool cells_any(const CellBox *box) { return box->low[0] <= box->high[0]; }

static inline void cells_add(CellBox *box, const int32_t cell[3])
{
    for (int a = 0; a < 3; a++) {
        if (cell[a] < box->low[a]) box->low[a] = cell[a];
        if (cell[a] > box->high[a]) box->high[a] = cell[a];
    }
}

/* The cell of a particle, from the first of a block. */
static inline void blocks_cell(const SkinBlocks *blocks, const SkinBlock *block, const Particles *p, uint32_t row, int32_t cell[3])
{
    for (int a = 0; a < 3; a++) cell[a] = p->cell[a][row] - blocks->anchor[a] - block->place[a] * blocks_cells(blocks);
}

/* The place of a particle in points, from the first point of a block. */
static inline void blocks_locate(const SkinBlocks *blocks, const SkinBlock *block, const Particles *p, uint32_t row, float local[3])
{
    int32_t cell[3];
    blocks_cell(blocks, block, p, row, cell);
    for (int a = 0; a < 3; a++) local[a] = (float)blocks->subdivision * ((float)cell[a] + p->fraction[a][row]);
}

/* Finds the blocks of the rows that count, in their order, but for those of spray: where a block and those beside it have less than a cell of matter. Thus what is scattered
 * far and wide takes no memory. False: no memory. */
bool blocks_find(SkinBlocks *blocks, Memory *memory, const SkinMatter *matter);
/* Then, who is beside whom. */
void blocks_link(SkinBlocks *blocks, Pool *pool);
void blocks_free(SkinBlocks *blocks, Memory *memory);

/* Of an array with BLOCK_POINTS numbers per block: writes those of a box; 0 where no block is. */
void blocks_gather(const SkinBlock *block, const float *values, float box[BOX_POINTS]);
/* Of an array with a box for each block that has particles: what the boxes that are splatted say of the points of a block, added up. */
void blocks_sum(const SkinBlocks *blocks, const SkinKernels *kernels, int32_t b, const float *boxes, float sum[BLOCK_POINTS]);

/* Whether a block or one beside it has vertices. */
bool blocks_near_surface(const SkinBlocks *blocks, const SkinBlock *block);
/* Works `reached` out. */
void blocks_find_reached(const SkinBlocks *blocks, SkinBlock *block);

#endif

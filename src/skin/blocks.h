/* The blocks of the lattice that a surface is looked for in: those with particles, and those that these reach. A block stays from one surface to the next with all that is
 * known of it; so what did not change is not worked out again. Its box is what is near: the block and 2 points more on either side. */
#ifndef PBMPM_SRC_SKIN_BLOCKS_H
#define PBMPM_SRC_SKIN_BLOCKS_H

#include "base/memory.h"
#include "base/pool.h"
#include "grid/grid.h"
#include "matter/particles.h"
#include "skin/lattice.h"
#include "skin/matter.h"
#include "skin/sites.h"
#include "skin/skin_kernels.h"

enum {
    BLOCK_POINTS = BLOCK_AXIS * BLOCK_AXIS * BLOCK_AXIS,
    BOX_MARGIN = 2,
    BOX_AXIS = BLOCK_AXIS + 2 * BOX_MARGIN,
    BOX_POINTS = BOX_AXIS * BOX_AXIS * BOX_AXIS,
    THICKENINGS = K_THICKENINGS
};

typedef struct SurfaceRange CellBox;

typedef struct SkinBlock {
    int32_t place[3];
    int32_t neighbour[BLOCK_NEIGHBOURS]; /* as grid_neighbour_offset() has them; GRID_NOWHERE: not there */
    uint64_t listed;                     /* the last surface that it is part of; 0: none */
    int32_t at;                          /* where it stands in the list of that */
    CellBox cells;                       /* those with particles */
    uint32_t first_run, runs;
    uint64_t print;                      /* of its particles: as long as they stay the same, it does */
    uint64_t obstacles;                  /* the same of the obstacles near it, see boundary.h */
    bool bounded;                        /* obstacles are near: it has G of its own */
    bool ended;                          /* it has a field of its own, see make.h */

    /* Of the present stage, see make.h. */
    bool fresh;   /* it was not there in the last surface */
    bool anew;    /* it is fresh, or others are beside it */
    bool changed; /* it is not what it was */
    bool due;     /* it is to be worked out */
    bool helps;   /* so it is, or one beside it, which needs sums of this one */
    bool wanted;  /* boxes that are splatted change it */
    CellBox splatted; /* the cells whose particles its box is of */
    CellBox reached;  /* its points that boxes which are splatted change */

    float filling_least, filling_most; /* of F */
    bool thickens, raised;             /* its particles give to T; T may not be 0 here; see thin.h */
    bool told;                         /* what others learn of it is not what it was */
    float spray, thin, enclosed[THICKENINGS + 1], thickening;
    float least, most; /* of the field */
    uint64_t inside[BLOCK_AXIS], cut[BLOCK_AXIS]; /* per plane across z, bit 8 y + x: the point is inside; the cube above it is cut */
    uint32_t first_vertex, vertices, first_triangle, triangles;
} SkinBlock;

typedef struct SkinBlocks {
    int subdivision;
    uint64_t surface;         /* counts them */
    int32_t count, with_rows; /* of the list: those with particles come first */
    bool others;              /* they are not those of the last surface */
    Places block;             /* SkinBlock */
    Array list;               /* int32_t: numbers of those that the surface has, in the order of rows */
    Sites sites;
} SkinBlocks;

static inline SkinBlock *blocks_at(const SkinBlocks *blocks, int32_t b) { return (SkinBlock *)blocks->block.thing.data + b; }
/* The number of the block that stands at `i` in the list. */
static inline int32_t blocks_number(const SkinBlocks *blocks, int32_t i) { return ((const int32_t *)blocks->list.data)[i]; }
static inline const SiteRun *blocks_run(const SkinBlocks *blocks, uint32_t r) { return (const SiteRun *)blocks->sites.run.data + r; }
static inline int32_t blocks_cells(const SkinBlocks *blocks) { return lattice_cells(blocks->subdivision); }

/* For prints: two numbers that differ still do, whatever word goes to both. */
static inline uint64_t blocks_mix(uint64_t print, uint64_t word)
{
    print = (print ^ word) * 0x9e3779b97f4a7c15u;
    return print ^ print >> 32;
}

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
    for (int a = 0; a < 3; a++) cell[a] = p->cell[a][row] - lattice_first(blocks->subdivision, block->place[a]);
}

/* The place of a particle in points, from the first point of a block. */
static inline void blocks_locate(const SkinBlocks *blocks, const SkinBlock *block, const Particles *p, uint32_t row, float local[3])
{
    int32_t cell[3];
    blocks_cell(blocks, block, p, row, cell);
    for (int a = 0; a < 3; a++) local[a] = (float)blocks->subdivision * ((float)cell[a] + p->fraction[a][row]);
}

/* Lists the blocks of the rows that count, in their order, and those that they reach. False: no memory. */
bool blocks_find(SkinBlocks *blocks, Memory *memory, const SkinMatter *matter);
/* Then: which of them are `anew`, and which have changed. */
void blocks_compare(SkinBlocks *blocks, Pool *pool, const SkinMatter *matter);
/* The next surface has nothing in common with the last one. */
void blocks_forget(SkinBlocks *blocks);
void blocks_free(SkinBlocks *blocks, Memory *memory);

/* BLOCK_POINTS numbers per block. Where a flag is not set, which stands there in SkinBlock, a block has those of the layer below. */
typedef struct Layer {
    const float *values;
    size_t flag;
    const struct Layer *below; /* null: all have their own */
} Layer;

const float *blocks_layer(const SkinBlocks *blocks, const Layer *layer, int32_t b);
/* Writes the numbers of a box; 0 where no block is. */
void blocks_gather(const SkinBlocks *blocks, const SkinBlock *block, const Layer *layer, float box[BOX_POINTS]);
/* Of an array with a box for each block that has particles, as they are listed: what the boxes that are splatted say of the points of a block, added up. */
void blocks_sum(const SkinBlocks *blocks, const SkinKernels *kernels, const SkinBlock *block, const float *boxes, float sum[BLOCK_POINTS]);

/* Whether a flag, which stands there in SkinBlock, is set in a block or in one beside it. */
bool blocks_beside(const SkinBlocks *blocks, const SkinBlock *block, size_t flag);
/* Sets the flag `to` where that is so of `from`, and takes it from all others. */
void blocks_spread(const SkinBlocks *blocks, Pool *pool, size_t from, size_t to);

/* Whether a block or one beside it has vertices. */
bool blocks_near_surface(const SkinBlocks *blocks, const SkinBlock *block);
/* Works `reached` out. */
void blocks_find_reached(const SkinBlocks *blocks, SkinBlock *block);

#endif

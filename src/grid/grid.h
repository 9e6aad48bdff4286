/* The sparse grid of one substep: which blocks exist, which particles and nodes they hold. */
#ifndef PBMPM_SRC_GRID_GRID_H
#define PBMPM_SRC_GRID_GRID_H

#include "base/memory.h"
#include "base/pool.h"
#include "kernel_types.h"
#include "matter/particles.h"

/* [cells] per axis: where the quadratic spline of a node ends, and what a particle touches. */
#define NODE_REACH 1.5

/* Into how many parts the particles may be divided that have a grid each; see islands.h. */
enum { GRID_PARTS = 7 };

enum { GRID_NOWHERE = -1 };

/* Rows per flight, see Grid. */
enum { FLIGHT_ROWS = 64 };

/* Whether a particle that shares no node with another one is to fly. Asked for many rows at once, in any order. */
typedef bool GridFlies(const void *context, uint32_t row);

/* How the blocks with particles are ordered: first those that sleep, see sleep_list.h. Without sleeping all move. */
typedef enum GridRank { GRID_LEAVING = -2, GRID_STILL = -1, GRID_MOVING = 0 } GridRank;

/* A block in order of discovery. */
typedef struct FoundBlock {
    int32_t coordinate[3];
    uint32_t particles;
    uint64_t cells;   /* bit n: a particle in cell n, x fastest */
    int32_t index;    /* its final place; GRID_NOWHERE: it is not wanted any more */
    uint32_t touched; /* by a particle of another block */
    uint64_t morton;
    GridRank rank;
} FoundBlock;

/* Particles whose strain was clamped, that left their cells, and that have to go. */
typedef enum GridCount { GRID_CLAMPED, GRID_MOVED, GRID_LOST, GRID_COUNTS } GridCount;

typedef struct Grid {
    int dimension;
    int neighbours;     /* 3^d */
    int block_cells;    /* 4^d cells, and as many nodes */
    int tile_nodes;     /* 6^d */
    uint32_t capacity;  /* particles */

    /* The lowest cell with a particle, per axis: blocks are counted from it. So the division into blocks, and with it the order
     * of all sums, goes with the matter: a scene shifted by whole cells moves bit for bit the same. */
    int32_t anchor[3];

    /* Blocks [0, particle_blocks) hold particles, the rest up to node_blocks are only touched. Each kind is in Morton order, but for copies, which come last. */
    int32_t particle_blocks;
    int32_t node_blocks;
    int32_t still_blocks; /* of the particle blocks the first ones, which take part, but whose particles sleep */
    uint32_t first_row, end_row; /* particles before and from there on are not in the grid: they sleep, or are in another part */
    Array coordinate;    /* int32_t[3] per node block: its position in blocks from the anchor */
    Array neighbour;     /* int32_t per node block and neighbour: block index or -1 */
    int32_t bodies;      /* what shares no node with the rest, see bodies.h */
    Array body;          /* int32_t per node block: its body, numbered by their first blocks */
    Array block_begin;   /* uint32_t per particle block and flight, and the end: first particle */
    Array block_run;     /* uint32_t per particle block and flight, and the end: first run */

    /* A particle that shares no node with another one gets back from its nodes what it gave to them, so it needs none. Those that `flies` takes have no blocks;
     * their rows follow those of the blocks, FLIGHT_ROWS in a flight. block_begin, block_run and the results of kernels count flights as
     * blocks behind those with particles. */
    GridFlies *flies; /* null: none does */
    const void *flies_context;
    uint32_t flight_row; /* the first of them */
    int32_t flights;
    int32_t left_blocks; /* blocks that hold none but such particles */

    /* Runs: sorted particles of one cell and material; of one material alone in a flight. */
    uint32_t *run_begin; /* one more than runs */
    uint32_t *run_key;
    uint32_t runs;

    /* What the kernels work on; see KernelArgs. */
    Array tile, tile_volume, node, node_base, node_volume, node_density, node_reach, edged, travel;
    Array counts; /* uint32_t, all of a GridCount together: see grid_counts() */

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

/* What loops over blocks go over: the nodes, or the particles of the grid. `grain`: blocks that are taken at once. */
static inline Span grid_nodes(const Grid *grid, int32_t grain)
{
    return (Span){grid->node_blocks, grain, (int64_t)grid->node_blocks * grid->block_cells * NODE_NS};
}

static inline Span grid_rows(const Grid *grid, int32_t grain)
{
    return (Span){grid->particle_blocks, grain, (int64_t)(grid->end_row - grid->first_row) * PARTICLE_NS};
}

/* What a kernel counts per block with particles and per flight; null without any. */
static inline uint32_t *grid_counts(const Grid *grid, GridCount kind)
{
    const int32_t blocks = grid->particle_blocks + grid->flights;
    return blocks > 0 ? (uint32_t *)grid->counts.data + (size_t)kind * (size_t)blocks : NULL;
}

/* No blocks, no runs: there are no particles. */
static inline void grid_clear(Grid *grid)
{
    grid->particle_blocks = grid->node_blocks = grid->still_blocks = grid->flights = grid->left_blocks = grid->bodies = 0;
    grid->runs = 0;
}

/* Blocks with particles, and flights. */
static inline int32_t grid_row_blocks(const Grid *grid) { return grid->particle_blocks + grid->flights; }

static inline Span grid_rows_and_flights(const Grid *grid, int32_t grain)
{
    Span span = grid_rows(grid, grain);
    span.count = grid_row_blocks(grid);
    return span;
}

/* Makes room for what there is per node. False: no memory. */
bool grid_reserve_nodes(Grid *grid, Memory *memory, bool with_volume);

/* ---- Grids of some of the particles each, which share the scratch per particle of `whole` ---- */

/* Makes `part` the one at `place` among them, for particles that will stand in the rows [first, end). At place 0 it is `whole` itself. */
void grid_share(Grid *part, const Grid *whole, int place, uint32_t first, uint32_t end);

/* Whether its tables fit each other: blocks, rows, runs, neighbours. For assertions. */
bool grid_is_sound(const Grid *grid);

/* Frees what a part does not share. */
void grid_free_part(Grid *part, Memory *memory);

/* The offset of neighbour n of a block: -1, 0 or 1 per axis, x fastest. */
static inline void grid_neighbour_offset(int n, int dimension, int32_t offset[3])
{
    offset[0] = n % 3 - 1;
    offset[1] = n / 3 % 3 - 1;
    offset[2] = dimension == 3 ? n / 9 - 1 : 0;
}

/* Bits per axis when the place of a block is packed into 64. */
enum { GRID_COORDINATE_BITS = 21 };

/* A number that is different for nearly all places of blocks. */
static inline uint64_t grid_hash(const int32_t place[3])
{
    const uint64_t key = ((uint64_t)(uint32_t)(place[0] + 1) << (2 * GRID_COORDINATE_BITS)) |
                         ((uint64_t)(uint32_t)(place[1] + 1) << GRID_COORDINATE_BITS) | (uint64_t)(uint32_t)(place[2] + 1);
    uint64_t mixed = key * 0x9e3779b97f4a7c15u; /* carries go up only, so fold the high half down and mix again */
    mixed = (mixed ^ mixed >> 32) * 0x9e3779b97f4a7c15u;
    return mixed >> 32;
}

/* The node `way` from that at `local` in a node block, or GRID_NOWHERE: at most a block away. */
static inline int64_t grid_node_beside(const Grid *grid, int32_t block, const int local[3], const int way[3])
{
    int at[3], side[3] = {1, 1, grid->dimension == 3 ? 1 : 0};
    for (int a = 0; a < grid->dimension; a++) {
        at[a] = local[a] + way[a];
        if (at[a] < -K_BLOCK_AXIS || at[a] >= 2 * K_BLOCK_AXIS) return GRID_NOWHERE;
        if (at[a] < 0) side[a] = 0;
        if (at[a] >= K_BLOCK_AXIS) side[a] = 2;
        at[a] &= K_BLOCK_AXIS - 1;
    }
    if (grid->dimension == 2) at[2] = 0;
    const int32_t *neighbour = (const int32_t *)grid->neighbour.data + (size_t)block * (size_t)grid->neighbours;
    const int32_t other = neighbour[(side[2] * 3 + side[1]) * 3 + side[0]];
    return other < 0 ? GRID_NOWHERE : (int64_t)other * grid->block_cells + (at[2] * K_BLOCK_AXIS + at[1]) * K_BLOCK_AXIS + at[0];
}

#endif

#include "grid/bodies.h"

#include <string.h>

#include "base/sets.h"
#include "grid/block_cells.h"

enum { MOST_AROUND = 27 };

/* Scratch per block. */
typedef struct Bodies {
    Grid *grid;
    uint64_t *cells; /* of particle blocks: those that hold particles */
    int32_t *up;     /* of particle blocks: see sets.h */
    int32_t *copies; /* of node blocks, and the end: their first copy */
} Bodies;

static bool open_bodies(Bodies *bodies, Grid *grid, Memory *memory)
{
    const size_t full = (size_t)grid->particle_blocks, all = (size_t)grid->node_blocks;
    const size_t bytes = full * (sizeof(uint64_t) + sizeof(int32_t)) + (all + 1) * sizeof(int32_t);
    if (!array_reserve(memory, &grid->sorted, bytes, 1) || !array_reserve(memory, &grid->body, all, sizeof(int32_t))) return false;
    *bodies = (Bodies){.grid = grid, .cells = grid->sorted.data};
    bodies->up = (int32_t *)(bodies->cells + full);
    bodies->copies = bodies->up + full;
    const FoundBlock *found = grid->found.data;
    for (uint32_t i = 0; i < grid->found_count; i++)
        if (found[i].particles > 0) bodies->cells[found[i].index] = found[i].cells;
    for (int32_t b = 0; b < grid->particle_blocks; b++) bodies->up[b] = b;
    return true;
}

static int32_t *neighbours_of(const Grid *grid, int32_t block) { return (int32_t *)grid->neighbour.data + (ptrdiff_t)block * grid->neighbours; }

/* ---- Which particle blocks share nodes ---- */

/* The nodes of the block `offset` blocks further that particles in these cells touch: those of their own cells and beside these. */
static uint64_t reached(uint64_t cells, const int32_t offset[3], int dimension)
{
    for (int axis = 0; axis < dimension; axis++) {
        const int step = 1 << (2 * axis), across = (K_BLOCK_AXIS - 1) * step;
        const uint64_t low = block_cells_slice(axis, 0), high = block_cells_slice(axis, K_BLOCK_AXIS - 1);
        if (offset[axis] < 0)
            cells = (cells & low) << across;
        else if (offset[axis] > 0)
            cells = (cells & high) >> across;
        else
            cells |= (cells & ~high) << step | (cells & ~low) >> step;
    }
    return cells;
}

/* The particle block that is neighbour `n` of a block, and what nodes of this one it touches; negative: there is none. */
static int32_t toucher(const Bodies *bodies, int32_t block, int n, uint64_t *nodes)
{
    const Grid *grid = bodies->grid;
    const int32_t other = neighbours_of(grid, block)[n];
    int32_t back[3];
    if (other < 0 || other >= grid->particle_blocks) return GRID_NOWHERE;
    grid_neighbour_offset(n, grid->dimension, back);
    for (int a = 0; a < 3; a++) back[a] = -back[a];
    *nodes = reached(bodies->cells[other], back, grid->dimension);
    return *nodes ? other : GRID_NOWHERE;
}

/* The set that all particle blocks around one are in; negative: they are in several. */
static int32_t one_around(const Bodies *bodies, int32_t block)
{
    const Grid *grid = bodies->grid;
    const int32_t *neighbour = neighbours_of(grid, block);
    int32_t one = GRID_NOWHERE, last = GRID_NOWHERE;
    for (int n = 0; n < grid->neighbours; n++) {
        if (neighbour[n] < 0 || neighbour[n] >= grid->particle_blocks || bodies->up[neighbour[n]] == last) continue;
        last = bodies->up[neighbour[n]];
        const int32_t root = sets_root(bodies->up, last);
        if (one >= 0 && root != one) return GRID_NOWHERE;
        one = root;
    }
    return one;
}

/* Joins the blocks that touch the same nodes of one block. */
static void join_at(const Bodies *bodies, int32_t block)
{
    struct {
        int32_t root;
        uint64_t nodes;
    } found[MOST_AROUND];
    int count = 0;
    for (int n = 0; n < bodies->grid->neighbours; n++) {
        uint64_t nodes;
        const int32_t other = toucher(bodies, block, n, &nodes);
        bool joined = false;
        for (int k = 0; k < count && other >= 0; k++) {
            if (sets_root(bodies->up, other) != sets_root(bodies->up, found[k].root) && !(nodes & found[k].nodes)) continue;
            sets_join(bodies->up, other, found[k].root);
            found[k].nodes |= nodes;
            joined = true;
        }
        if (other < 0 || joined) continue;
        found[count].root = other;
        found[count++].nodes = nodes;
    }
}

/* Gives the particle blocks the numbers of their bodies, in the order of the first blocks of these. */
static int32_t number_bodies(const Bodies *bodies)
{
    int32_t *body = bodies->grid->body.data, count = 0;
    for (int32_t b = 0; b < bodies->grid->particle_blocks; b++) {
        const int32_t root = sets_root(bodies->up, b); /* the lowest block of the body */
        body[b] = root == b ? count++ : body[root];
    }
    return count;
}

/* ---- Node blocks of one body each ---- */

/* The bodies that touch a block; its own comes first. */
static int bodies_at(const Bodies *bodies, int32_t block, int32_t list[MOST_AROUND])
{
    const Grid *grid = bodies->grid;
    const int32_t *body = grid->body.data, one = one_around(bodies, block);
    int count = 0;
    if (one >= 0 || block < grid->particle_blocks) list[count++] = body[one >= 0 ? one : block];
    for (int n = 0; n < grid->neighbours && one < 0; n++) {
        uint64_t nodes;
        const int32_t other = toucher(bodies, block, n, &nodes);
        bool is_new = other >= 0;
        for (int k = 0; k < count && is_new; k++) is_new = list[k] != body[other];
        if (is_new) list[count++] = body[other];
    }
    return count;
}

/* Gives each node block its first body, and finds where the copies for the others go. Returns how many blocks there are then. */
static int32_t count_copies(const Bodies *bodies)
{
    const Grid *grid = bodies->grid;
    int32_t *body = grid->body.data, end = grid->node_blocks, list[MOST_AROUND];
    for (int32_t block = 0; block < grid->node_blocks; block++) {
        const int count = bodies_at(bodies, block, list);
        bodies->copies[block] = end;
        body[block] = list[0];
        end += count - 1;
    }
    bodies->copies[grid->node_blocks] = end;
    return end;
}

static bool reserve_copies(Grid *grid, Memory *memory, int32_t end)
{
    const size_t blocks = (size_t)end, before = (size_t)grid->node_blocks, around = (size_t)grid->neighbours;
    if (end == grid->node_blocks) return true;
    return array_grow(memory, &grid->body, blocks, sizeof(int32_t), before * sizeof(int32_t)) &&
           array_grow(memory, &grid->coordinate, 3 * blocks, sizeof(int32_t), 3 * before * sizeof(int32_t)) &&
           array_grow(memory, &grid->neighbour, around * blocks, sizeof(int32_t), around * before * sizeof(int32_t));
}

/* The block of this body in the place of one; negative: there is none. */
static int32_t block_of(const Bodies *bodies, int32_t block, int32_t own)
{
    const int32_t *body = bodies->grid->body.data;
    if (block < 0 || body[block] == own) return block;
    for (int32_t copy = bodies->copies[block]; copy < bodies->copies[block + 1]; copy++)
        if (body[copy] == own) return copy;
    return GRID_NOWHERE;
}

static void link_to_own(const Bodies *bodies, int32_t block, int32_t from)
{
    const Grid *grid = bodies->grid;
    const int32_t own = ((const int32_t *)grid->body.data)[block];
    for (int n = 0; n < grid->neighbours; n++) neighbours_of(grid, block)[n] = block_of(bodies, neighbours_of(grid, from)[n], own);
}

static void place_copies(const Bodies *bodies)
{
    const Grid *grid = bodies->grid;
    int32_t *body = grid->body.data, *coordinate = grid->coordinate.data, list[MOST_AROUND];
    for (int32_t block = 0; block < grid->node_blocks; block++) {
        if (bodies->copies[block] == bodies->copies[block + 1]) continue;
        bodies_at(bodies, block, list);
        for (int32_t copy = bodies->copies[block]; copy < bodies->copies[block + 1]; copy++) {
            body[copy] = list[1 + copy - bodies->copies[block]];
            memcpy(coordinate + 3 * copy, coordinate + 3 * block, 3 * sizeof *coordinate);
        }
    }
    for (int32_t block = 0; block < grid->node_blocks; block++)
        for (int32_t copy = bodies->copies[block]; copy < bodies->copies[block + 1]; copy++) link_to_own(bodies, copy, block);
    for (int32_t block = 0; block < grid->node_blocks; block++) link_to_own(bodies, block, block);
}

bool bodies_part(Grid *grid, Memory *memory)
{
    Bodies bodies;
    grid->bodies = 0;
    if (grid->node_blocks == 0) return true;
    if (!open_bodies(&bodies, grid, memory)) return false;
    for (int32_t block = 0; block < grid->node_blocks; block++)
        if (one_around(&bodies, block) < 0) join_at(&bodies, block);
    grid->bodies = number_bodies(&bodies);
    if (grid->bodies == 1) {
        memset(grid->body.data, 0, (size_t)grid->node_blocks * sizeof(int32_t));
        return true;
    }
    const int32_t end = count_copies(&bodies);
    if (!reserve_copies(grid, memory, end)) return false;
    place_copies(&bodies);
    grid->node_blocks = end;
    return true;
}

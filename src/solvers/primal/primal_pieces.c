/* Pieces of bodies: matter that shares no node with the rest.
 *
 * What the solver knows of bodies it knows per block, so matter up to eight cells apart is one body. One piece of it may lie on something while another falls. A start
 * without gravity is right for the first; five iterations do not make up for it in the second: beside a block of rubber that rested another fell with a fifth of g. */
#include "base/sets.h"
#include "contact/contact_constraints.h"
#include "grid/block_cells.h"
#include "solvers/primal/primal_solve.h"

/* Per block. They lie where the second step will, as long as there is none. */
typedef struct Pieces {
    const Grid *grid;
    uint64_t *cells, *falls; /* of particle blocks, those that hold particles; of all, the nodes of pieces that lean on nothing */
    int32_t *up;             /* of particle blocks: see sets.h */
    uint8_t *leans;          /* of roots */
} Pieces;

static Pieces pieces_of(const Primal *p)
{
    const Grid *grid = &p->world->grid;
    uint64_t *cells = (uint64_t *)p->step[1], *falls = cells + grid->node_blocks;
    int32_t *up = (int32_t *)(falls + grid->node_blocks);
    return (Pieces){grid, cells, falls, up, (uint8_t *)(up + grid->node_blocks)};
}

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
static int32_t toucher(const Pieces *pieces, int32_t block, int n, uint64_t *nodes)
{
    const Grid *grid = pieces->grid;
    const int32_t other = ((const int32_t *)grid->neighbour.data)[block * grid->neighbours + n];
    int32_t back[3];
    if (other < 0 || other >= grid->particle_blocks) return -1;
    grid_neighbour_offset(n, grid->dimension, back);
    for (int a = 0; a < 3; a++) back[a] = -back[a];
    *nodes = reached(pieces->cells[other], back, grid->dimension);
    return *nodes ? other : -1;
}

static void mark_cells(const Pieces *pieces)
{
    const Grid *grid = pieces->grid;
    const uint32_t *run = grid->block_run.data;
    for (int32_t b = 0; b < grid->particle_blocks; b++) {
        pieces->cells[b] = 0;
        pieces->up[b] = b;
        pieces->leans[b] = 0;
        for (uint32_t r = run[b]; r < run[b + 1]; r++) pieces->cells[b] |= (uint64_t)1 << (grid->run_key[r] & K_RUN_CELL_MASK);
    }
}

/* Whether the blocks around one are of one piece already. */
static bool is_joined(const Pieces *pieces, int32_t block)
{
    const Grid *grid = pieces->grid;
    const int32_t *neighbour = (const int32_t *)grid->neighbour.data + (size_t)block * (size_t)grid->neighbours;
    int32_t one = -1;
    for (int n = 0; n < grid->neighbours; n++) {
        if (neighbour[n] < 0 || neighbour[n] >= grid->particle_blocks) continue;
        const int32_t root = sets_root(pieces->up, neighbour[n]);
        if (one >= 0 && root != one) return false;
        one = root;
    }
    return true;
}

/* Joins the blocks that touch the same nodes of one block. */
static void join_at(const Pieces *pieces, int32_t block)
{
    struct {
        int32_t root;
        uint64_t nodes;
    } found[27];
    int count = 0;
    if (is_joined(pieces, block)) return;
    for (int n = 0; n < pieces->grid->neighbours; n++) {
        uint64_t nodes;
        const int32_t other = toucher(pieces, block, n, &nodes);
        bool joined = false;
        for (int k = 0; k < count && other >= 0; k++) {
            if (sets_root(pieces->up, other) != sets_root(pieces->up, found[k].root) && !(nodes & found[k].nodes)) continue;
            sets_join(pieces->up, other, found[k].root);
            found[k].nodes |= nodes;
            joined = true;
        }
        if (other < 0 || joined) continue;
        found[count].root = other;
        found[count++].nodes = nodes;
    }
}

static void find_leaning(const Primal *p, const Pieces *pieces, float fall)
{
    for (int32_t block = 0; block < pieces->grid->node_blocks; block++) {
        const uint64_t contacts = constraints_within(p->contacts, fall, block);
        for (int n = 0; n < pieces->grid->neighbours && contacts; n++) {
            uint64_t nodes;
            const int32_t other = toucher(pieces, block, n, &nodes);
            if (other >= 0 && nodes & contacts) pieces->leans[sets_root(pieces->up, other)] = 1;
        }
    }
}

static bool any_falls(const Pieces *pieces)
{
    for (int32_t b = 0; b < pieces->grid->particle_blocks; b++)
        if (!pieces->leans[sets_root(pieces->up, b)]) return true;
    return false;
}

/* Whether a body without liquid leans on something. */
static bool any_leans(const Primal *p)
{
    const PrimalState *state = &p->world->primal;
    const BodySum *body = state->body_sums.data;
    for (int32_t i = 0; i < state->bodies.count; i++)
        if (body[i].leans && !body[i].with_liquid) return true;
    return false;
}

void primal_find_pieces(Primal *p, float fall)
{
    const Pieces pieces = pieces_of(p);
    p->falls = NULL;
    if (!any_leans(p)) return;
    mark_cells(&pieces);
    for (int32_t block = 0; block < pieces.grid->node_blocks; block++) join_at(&pieces, block);
    find_leaning(p, &pieces, fall);
    if (!any_falls(&pieces)) return;
    for (int32_t block = 0; block < pieces.grid->node_blocks; block++) {
        pieces.falls[block] = 0;
        for (int n = 0; n < pieces.grid->neighbours; n++) {
            uint64_t nodes;
            const int32_t other = toucher(&pieces, block, n, &nodes);
            if (other >= 0 && !pieces.leans[sets_root(pieces.up, other)]) pieces.falls[block] |= nodes;
        }
    }
    p->falls = pieces.falls;
}

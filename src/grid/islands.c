#include "grid/islands.h"

#include <string.h>

#include "base/sets.h"
#include "grid/build.h"

/* ---- Kinds ---- */

/* The bit of a material's kind, as its number. */
static int kind_of(const Materials *materials, uint32_t slot)
{
    if (!material_is_solid(materials, slot)) return 1;
    return materials->kernel[slot].yields == K_SAND ? 2 : 0;
}

uint32_t islands_kind(const Materials *materials, uint32_t slot) { return 1u << kind_of(materials, slot); }

/* ---- Cells of a block as bits: x fastest ---- */

/* Those at local coordinate 0 of each axis, and how far apart the next ones are. */
static const uint64_t SLICE[3] = {0x1111111111111111u, 0x000f000f000f000fu, 0x000000000000ffffu};
static const int STRIDE[3] = {1, 4, 16};

/* Cells of the block `side` blocks further along an axis (-1, 0, 1) that are two cells at most from one of `cells`. */
static uint64_t reached_along(uint64_t cells, int axis, int32_t side)
{
    enum { SHARE = 2 }; /* cells apart, that still have a node in common */
    uint64_t reached = 0;
    for (int from = 0; from < K_BLOCK_AXIS; from++) {
        const uint64_t slice = cells >> (from * STRIDE[axis]) & SLICE[axis];
        for (int to = 0; to < K_BLOCK_AXIS; to++) {
            const int way = to + K_BLOCK_AXIS * side - from;
            if (way <= SHARE && way >= -SHARE) reached |= slice << (to * STRIDE[axis]);
        }
    }
    return reached;
}

static bool share_nodes(uint64_t cells, uint64_t others, const int32_t offset[3], int dimension)
{
    for (int axis = 0; axis < dimension && cells; axis++) cells = reached_along(cells, axis, offset[axis]);
    return (cells & others) != 0;
}

/* ---- Finding islands: of the parts of one kind that blocks hold, those that share nodes are joined ---- */

static void mark_cells(const Grid *grid, const Particles *p, const Materials *materials, uint64_t *cells)
{
    int8_t kind[PBMPM_MAX_MATERIALS];
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) kind[slot] = (int8_t)kind_of(materials, slot);
    memset(cells, 0, (size_t)grid->found_count * ISLAND_KINDS * sizeof *cells);
    for (uint32_t row = 0; row < p->count; row++) {
        uint32_t cell = 0;
        for (int a = 0; a < p->dimension; a++) cell |= (uint32_t)((p->cell[a][row] - grid->anchor[a]) & (K_BLOCK_AXIS - 1)) << (2 * a);
        cells[grid->block_of[row] * ISLAND_KINDS + kind[p->material[row]]] |= (uint64_t)1 << cell;
    }
}

static void join_parts(const Islands *islands, const int32_t offset[3], int dimension, int32_t block, int32_t other)
{
    const uint64_t *cells = islands->cells.data;
    int32_t *up = islands->up.data;
    for (int32_t a = block * ISLAND_KINDS; a < (block + 1) * ISLAND_KINDS; a++)
        for (int32_t b = other * ISLAND_KINDS; b < (other + 1) * ISLAND_KINDS && cells[a]; b++)
            if (cells[b] && sets_root(up, a) != sets_root(up, b) && share_nodes(cells[a], cells[b], offset, dimension)) sets_join(up, a, b);
}

static void join_all(const Islands *islands, const Grid *grid)
{
    const FoundBlock *found = grid->found.data;
    for (int32_t block = 0; block < (int32_t)grid->found_count; block++) {
        for (int n = 0; n <= grid->neighbours / 2; n++) { /* the other half finds this block; the last is itself */
            int32_t offset[3], there[3];
            grid_neighbour_offset(n, grid->dimension, offset);
            for (int a = 0; a < 3; a++) there[a] = found[block].coordinate[a] + offset[a];
            const FoundBlock *other = grid_found(grid, there);
            if (other) join_parts(islands, offset, grid->dimension, block, (int32_t)(other - found));
        }
    }
}

/* up[] becomes the group of each part. */
static void number_groups(Islands *islands, const Grid *grid)
{
    const uint64_t *cells = islands->cells.data;
    int32_t *up = islands->up.data, place[ISLAND_GROUPS + 1];
    uint64_t *kinds = islands->cells.data; /* of the island, at its root, once its cells are not wanted any more */
    const int32_t parts = (int32_t)grid->found_count * ISLAND_KINDS;
    bool found[ISLAND_GROUPS + 1] = {false};
    for (int32_t i = 0; i < parts; i++) up[i] = sets_root(up, i); /* a root is the lowest of its set */
    for (int32_t i = 0; i < parts; i++) {
        const uint64_t own = cells[i] ? 1u << i % ISLAND_KINDS : 0u;
        kinds[i] = 0;
        kinds[up[i]] |= own;
    }
    for (int32_t i = 0; i < parts; i++) found[kinds[up[i]]] = true;
    islands->groups = 0;
    for (int k = 1; k <= ISLAND_GROUPS; k++) {
        if (!found[k]) continue;
        islands->kinds[islands->groups] = (uint32_t)k;
        place[k] = islands->groups++;
    }
    for (int32_t i = 0; i < parts; i++) up[i] = kinds[up[i]] ? place[kinds[up[i]]] : 0;
}

static int group_of(const Islands *islands, const Grid *grid, const Particles *p, const Materials *materials, uint32_t row)
{
    return ((const int32_t *)islands->up.data)[grid->block_of[row] * ISLAND_KINDS + kind_of(materials, p->material[row])];
}

void islands_count(Islands *islands, const Grid *grid, const Particles *p, const Materials *materials)
{
    memset(islands->particles, 0, sizeof islands->particles);
    for (uint32_t row = 0; row < p->count; row++) islands->particles[group_of(islands, grid, p, materials, row)][p->material[row]]++;
}

void islands_list(const Islands *islands, const Grid *grid, const Particles *p, const Materials *materials, uint32_t next[ISLAND_GROUPS], uint32_t *rows)
{
    for (uint32_t row = 0; row < p->count; row++) rows[next[group_of(islands, grid, p, materials, row)]++] = row;
}

bool islands_find(Islands *islands, Grid *grid, Memory *memory, const Particles *p, const Materials *materials)
{
    int32_t anchor[3];
    grid_drop_anchor(p, anchor);
    islands->groups = 0;
    if (!grid_begin(grid, memory, anchor) || !grid_add_rows(grid, memory, p, 0, p->count) ||
        !array_reserve(memory, &islands->cells, (size_t)grid->found_count * ISLAND_KINDS, sizeof(uint64_t)) ||
        !array_reserve(memory, &islands->up, (size_t)grid->found_count * ISLAND_KINDS, sizeof(int32_t)))
        return false;
    mark_cells(grid, p, materials, islands->cells.data);
    int32_t *up = islands->up.data;
    for (int32_t i = 0; i < (int32_t)grid->found_count * ISLAND_KINDS; i++) up[i] = i;
    join_all(islands, grid);
    number_groups(islands, grid);
    return true;
}

void islands_free(Islands *islands, Memory *memory)
{
    for (int g = 1; g < ISLAND_GROUPS; g++) grid_free_part(&islands->part[g], memory);
    array_free(memory, &islands->cells);
    array_free(memory, &islands->up);
}

#include "grid/islands.h"

#include <string.h>

#include "base/assertion.h"
#include "base/result.h"
#include "base/sets.h"
#include "solvers/solver.h"
#include "world/world.h"

/* ---- Kinds ---- */

/* The bit of a material's kind, as its number. */
static int kind_of(const Materials *materials, uint32_t slot)
{
    if (!material_is_solid(materials, slot)) return 1;
    return materials->kernel[slot].yields == K_SAND ? 2 : 0;
}

uint32_t islands_kinds(const World *world)
{
    uint32_t kinds = 0;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (world->particles.of_material[slot] > 0) kinds |= 1u << kind_of(&world->materials, slot);
    return kinds;
}

uint32_t islands_kind(const Materials *materials, uint32_t slot) { return 1u << kind_of(materials, slot); }

bool islands_wanted(const World *world)
{
    if (world->settings.solver != PBMPM_SOLVER_CONVERGENT || world->sleep.on) return false;
    const uint32_t kinds = islands_kinds(world);
    return (kinds & (kinds - 1)) != 0;
}

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

static void mark_cells(const World *world, uint64_t *cells)
{
    const Particles *p = &world->particles;
    const Grid *grid = &world->grid;
    int8_t kind[PBMPM_MAX_MATERIALS];
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) kind[slot] = (int8_t)kind_of(&world->materials, slot);
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

static void join_all(const World *world)
{
    const Grid *grid = &world->grid;
    const FoundBlock *found = grid->found.data;
    for (int32_t block = 0; block < (int32_t)grid->found_count; block++) {
        for (int n = 0; n <= grid->neighbours / 2; n++) { /* the other half finds this block; the last is itself */
            int32_t offset[3], there[3];
            grid_neighbour_offset(n, grid->dimension, offset);
            for (int a = 0; a < 3; a++) there[a] = found[block].coordinate[a] + offset[a];
            const FoundBlock *other = grid_found(grid, there);
            if (other) join_parts(&world->islands, offset, grid->dimension, block, (int32_t)(other - found));
        }
    }
}

/* up[] becomes the group of each part. */
static void number_groups(World *world)
{
    Islands *islands = &world->islands;
    const uint64_t *cells = islands->cells.data;
    int32_t *up = islands->up.data, place[ISLAND_GROUPS + 1];
    uint64_t *kinds = islands->cells.data; /* of the island, at its root, once its cells are not wanted any more */
    const int32_t parts = (int32_t)world->grid.found_count * ISLAND_KINDS;
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

static int group_of(const World *world, uint32_t row)
{
    return ((const int32_t *)world->islands.up.data)[world->grid.block_of[row] * ISLAND_KINDS + kind_of(&world->materials, world->particles.material[row])];
}

static void count_particles(World *world)
{
    Islands *islands = &world->islands;
    memset(islands->particles, 0, sizeof islands->particles);
    for (uint32_t row = 0; row < world->particles.count; row++) islands->particles[group_of(world, row)][world->particles.material[row]]++;
}

/* Of world->grid only what it finds blocks with is changed. */
static bool find(World *world)
{
    Islands *islands = &world->islands;
    Grid *grid = &world->grid;
    Memory *memory = &world->memory;
    int32_t anchor[3];
    grid_drop_anchor(&world->particles, anchor);
    islands->groups = 0;
    if (!grid_begin(grid, memory, anchor) || !grid_add_rows(grid, memory, &world->particles, 0, world->particles.count) ||
        !array_reserve(memory, &islands->cells, (size_t)grid->found_count * ISLAND_KINDS, sizeof(uint64_t)) ||
        !array_reserve(memory, &islands->up, (size_t)grid->found_count * ISLAND_KINDS, sizeof(int32_t)))
        return false;
    mark_cells(world, islands->cells.data);
    int32_t *up = islands->up.data;
    for (int32_t i = 0; i < (int32_t)grid->found_count * ISLAND_KINDS; i++) up[i] = i;
    join_all(world);
    number_groups(world);
    return true;
}

bool islands_foresee(World *world)
{
    int32_t anchor[3];
    memcpy(anchor, world->grid.anchor, sizeof anchor);
    const bool found = find(world);
    if (found) count_particles(world);
    world->islands.groups = found ? world->islands.groups : 0;
    memcpy(world->grid.anchor, anchor, sizeof anchor);
    return found;
}

/* ---- The grids of the groups ---- */

/* Lists the rows of each group in order_scratch, as they stand, and shares the scratch. */
static void share_out(World *world)
{
    Islands *islands = &world->islands;
    Grid *grid = &world->grid;
    uint32_t next[ISLAND_GROUPS], first = 0;
    count_particles(world);
    for (int g = 0; g < islands->groups; g++) {
        next[g] = first;
        for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) first += islands->particles[g][slot];
        grid_share(g == 0 ? grid : &islands->part[g], grid, g, next[g], first);
    }
    ASSERT(first == world->particles.count);
    for (uint32_t row = 0; row < world->particles.count; row++) grid->order_scratch[next[group_of(world, row)]++] = row;
}

static pbmpm_result build_groups(World *world)
{
    Islands *islands = &world->islands;
    Particles *p = &world->particles;
    pbmpm_result result = PBMPM_OK;
    share_out(world);
    for (int g = 0; g < islands->groups && result == PBMPM_OK; g++) {
        islands_enter(world, g);
        result = grid_arrange_part(&world->grid, &world->memory, p, world->pool, solver_wants_volume(world));
        islands_leave(world, g);
    }
    if (result != PBMPM_OK) {
        islands->groups = 0;
        grid_clear(&world->grid);
        return result;
    }
    Loops loops;
    loops_open(&loops, world->pool);
    particles_reorder(p, world->grid.order, 0, &loops);
    for (int g = 0; g < islands->groups; g++) grid_link_part(g == 0 ? &world->grid : &islands->part[g], p, &loops);
    loops_run(&loops);
    for (int g = 0; g < islands->groups; g++) ASSERT(grid_is_sound(islands_grid(world, g)));
    return PBMPM_OK;
}

pbmpm_result islands_build(World *world)
{
    Grid *grid = &world->grid;
    if (!find(world)) {
        grid_clear(grid);
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory to find islands in %u blocks", grid->found_count);
    }
    if (world->islands.groups > 1) return build_groups(world);
    return grid_finish(grid, &world->memory, &world->particles, world->pool, solver_wants_volume(world), 0);
}

void islands_free(Islands *islands, Memory *memory)
{
    for (int g = 1; g < ISLAND_GROUPS; g++) grid_free_part(&islands->part[g], memory);
    array_free(memory, &islands->cells);
    array_free(memory, &islands->up);
}

/* ---- One group at a time ---- */

static void swap_counts(World *world, int group)
{
    uint32_t *of_group = world->islands.particles[group], *of_all = world->particles.of_material;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const uint32_t all = of_all[slot];
        of_all[slot] = of_group[slot];
        of_group[slot] = all;
    }
}

static void swap_grids(World *world, int group)
{
    if (group == 0) return;
    const Grid whole = world->grid;
    world->grid = world->islands.part[group];
    world->islands.part[group] = whole;
}

void islands_enter(World *world, int group)
{
    if (world->islands.groups < 2) return;
    swap_counts(world, group);
    swap_grids(world, group);
}

void islands_leave(World *world, int group)
{
    if (world->islands.groups < 2) return;
    swap_grids(world, group);
    swap_counts(world, group);
}

const Grid *islands_grid(const World *world, int group) { return group == 0 ? &world->grid : &world->islands.part[group]; }

#include "step/build_groups.h"

#include "base/assertion.h"
#include "base/result.h"
#include "grid/build.h"
#include "solvers/solver.h"
#include "world/island_groups.h"

/* Lists the rows of each group in order_scratch, as they stand, and shares the scratch. */
static void share_out(World *world)
{
    Islands *islands = &world->islands;
    Grid *grid = &world->grid;
    uint32_t next[ISLAND_GROUPS], first = 0;
    islands_count(islands, grid, &world->particles, &world->materials);
    for (int g = 0; g < islands->groups; g++) {
        next[g] = first;
        for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) first += islands->particles[g][slot];
        grid_share(g == 0 ? grid : &islands->part[g], grid, g, next[g], first);
    }
    ASSERT(first == world->particles.count);
    islands_list(islands, grid, &world->particles, &world->materials, next, grid->order_scratch);
}

static pbmpm_result build_groups(World *world)
{
    Islands *islands = &world->islands;
    Particles *p = &world->particles;
    pbmpm_result result = PBMPM_OK;
    share_out(world);
    for (int g = 0; g < islands->groups && result == PBMPM_OK; g++) {
        islands_enter(world, g);
        result = grid_arrange_part(&world->grid, &world->memory, p, world->pool, solver_may_want_volume(world));
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
    if (!islands_find(&world->islands, grid, &world->memory, &world->particles, &world->materials)) {
        grid_clear(grid);
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory to find islands in %u blocks", grid->found_count);
    }
    if (world->islands.groups > 1) return build_groups(world);
    return grid_finish(grid, &world->memory, &world->particles, world->pool, solver_may_want_volume(world), 0);
}

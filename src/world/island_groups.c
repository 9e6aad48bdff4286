#include "world/island_groups.h"

#include <string.h>

uint32_t islands_kinds(const World *world)
{
    uint32_t kinds = 0;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (world->particles.of_material[slot] > 0) kinds |= islands_kind(&world->materials, slot);
    return kinds;
}

bool islands_wanted(const World *world)
{
    if (world->settings.solver != PBMPM_SOLVER_CONVERGENT || world->sleep.on) return false;
    const uint32_t kinds = islands_kinds(world);
    return (kinds & (kinds - 1)) != 0;
}

bool islands_foresee(World *world)
{
    int32_t anchor[3];
    memcpy(anchor, world->grid.anchor, sizeof anchor);
    const bool found = islands_find(&world->islands, &world->grid, &world->memory, &world->particles, &world->materials);
    if (found) islands_count(&world->islands, &world->grid, &world->particles, &world->materials);
    world->islands.groups = found ? world->islands.groups : 0;
    memcpy(world->grid.anchor, anchor, sizeof anchor);
    return found;
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

#include "solvers/viscosity.h"

#include <math.h>
#include <string.h>

#include "base/result.h"
#include "contact/wall_shear.h"
#include "contact/walls.h"
#include "solvers/passes.h"

/* What the stress is more than the share of D, at most: d/(d - 1), see ispc/viscosity.isph. */
static double steepness(const World *world) { return world->def.dimension / (world->def.dimension - 1.0); }

/* The share that a round is stable with. */
static double share_of_round(const World *world) { return 0.5 * (VISCOUS_STAGES_MAX * VISCOUS_STAGES_MAX + VISCOUS_STAGES_MAX) / steepness(world); }

double viscosity_share(const World *world, const pbmpm_material_def *def)
{
    const double dx = (double)world->def.cell_size;
    const double most = VISCOUS_ROUNDS_MAX * share_of_round(world);
    return fmin(8.0 * (double)def->kinematic_viscosity * world->substep.dt / (dx * dx), most);
}

bool viscosity_acts(const World *world)
{
    if (world->record.solver == PBMPM_SOLVER_PAPER) return false;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (world->particles.of_material[slot] > 0 && world->materials.def[slot].kind == PBMPM_LIQUID &&
            world->materials.def[slot].kinematic_viscosity > 0.0f)
            return true;
    return false;
}

pbmpm_result viscosity_prepare(World *world)
{
    const size_t floats = (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells * K_NODE_WIDTH;
    if (!viscosity_acts(world) || array_reserve(&world->memory, &world->dual.node_push, floats, sizeof(float))) return PBMPM_OK;
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the viscosity of %d blocks", world->grid.node_blocks);
}

/* One stage, with walls that hold what is viscous. */
static void act(World *world, const ContactFrame *contacts, const WallStage *at_walls)
{
    const Walls *walls = contacts->walls;
    if (!walls || walls->shears == 0) {
        solver_over_both(world, world->kernels->viscous, world->kernels->viscous_nodes, contacts);
        return;
    }
    Loops loops;
    loops_open(&loops, world->pool);
    wall_shear_hold(walls, contacts, &loops, at_walls);
    solver_add_rows(&loops, world, world->kernels->viscous, &world->args);
    solver_add_nodes(&loops, world, world->kernels->viscous_nodes, &world->args, NULL);
    wall_shear_give(walls, contacts, &loops, at_walls);
    walls_add(walls, contacts, &loops, false, NULL);
    loops_run(&loops);
}

void viscosity_apply(World *world, const ContactFrame *contacts)
{
    KernelArgs *a = &world->args;
    double share = 0.0;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (world->particles.of_material[slot] > 0) share = fmax(share, (double)world->materials.kernel[slot].viscous_share);
    if (share == 0.0) return;
    const int rounds = (int)ceil(share / share_of_round(world));
    const int stages = (int)ceil(0.5 * (sqrt(1.0 + 8.0 * steepness(world) * share / rounds) - 1.0));
    WallStage at_walls = {.base = a->grid.node_base, .push = world->dual.node_push.data};
    const Walls *walls = contacts->walls;
    a->dual.node_push = world->dual.node_push.data;
    a->dual.pressure = solver_uses_dual(world) ? world->particles.pressure : NULL;
    memset(a->dual.node_push, 0, (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells * K_NODE_WIDTH * sizeof(float));
    if (walls) wall_shear_begin(walls);
    for (int stage = 0; stage < rounds * stages; stage++) {
        const int j = 1 + stage % stages;
        a->dual.stage_last = (float)((2.0 * j - 1.0) / j);
        a->dual.stage_before = (float)((1.0 - j) / j);
        a->dual.stage_change = (float)(2.0 * (2.0 * j - 1.0) / j / (rounds * (stages * stages + stages)));
        at_walls.last = a->dual.stage_last;
        at_walls.before = a->dual.stage_before;
        act(world, contacts, &at_walls);
    }
    if (walls) wall_shear_book(walls, contacts);
}

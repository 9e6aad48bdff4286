#include "solvers/viscosity.h"

#include <math.h>
#include <string.h>

#include "base/result.h"
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

static bool wanted(const World *world)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (world->particles.of_material[slot] > 0 && world->materials.def[slot].kind == PBMPM_LIQUID &&
            world->materials.def[slot].kinematic_viscosity > 0.0f)
            return true;
    return false;
}

pbmpm_result viscosity_prepare(World *world)
{
    const size_t floats = (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells * K_NODE_WIDTH;
    if (!wanted(world) || array_reserve(&world->memory, &world->dual.node_push, floats, sizeof(float))) return PBMPM_OK;
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the viscosity of %d blocks", world->grid.node_blocks);
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
    a->dual.node_push = world->dual.node_push.data;
    a->dual.pressure = solver_uses_dual(world) ? world->particles.pressure : NULL;
    memset(a->dual.node_push, 0, (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells * K_NODE_WIDTH * sizeof(float));
    for (int stage = 0; stage < rounds * stages; stage++) {
        const int j = 1 + stage % stages;
        a->dual.stage_last = (float)((2.0 * j - 1.0) / j);
        a->dual.stage_before = (float)((1.0 - j) / j);
        a->dual.stage_change = (float)(2.0 * (2.0 * j - 1.0) / j / (rounds * (stages * stages + stages)));
        solver_over_both(world, world->kernels->viscous, world->kernels->viscous_nodes, contacts);
    }
}

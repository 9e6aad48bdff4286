#include "solvers/explicit.h"

#include <float.h>
#include <math.h>

#include "base/result.h"
#include "solvers/moduli.h"
#include "solvers/passes.h"

enum { BLOCK_GRAIN = 8, W = K_NODE_WIDTH };

void explicit_set_materials(World *world) { moduli_set(world, FLT_MAX); }

pbmpm_result explicit_prepare(World *world)
{
    PrimalState *state = &world->primal;
    const size_t blocks = (size_t)world->grid.node_blocks, nodes = blocks * (size_t)world->grid.block_cells;
    if (array_reserve(&world->memory, &state->force, nodes * W, sizeof(float)) &&
        array_reserve(&world->memory, &state->block_energy, K_ENERGIES * blocks, sizeof(float)))
        return PBMPM_OK;
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the forces on %d blocks", world->grid.node_blocks);
}

static void stand_still(void *context, int32_t begin, int32_t end)
{
    const World *world = *(World **)context;
    const size_t floats = (size_t)world->grid.block_cells * W;
    float *node = world->grid.node.data;
    for (size_t i = (size_t)begin * floats; i < (size_t)end * floats; i++)
        if (i % W != 3) node[i] = 0.0f;
}

/* An unstable motion may overflow; it has to stay a number. */
static float bounded(float u) { return u > -K_INCREMENT_MAX ? fminf(u, K_INCREMENT_MAX) : -K_INCREMENT_MAX; }

static void push(void *context, int32_t begin, int32_t end)
{
    const World *world = *(World **)context;
    const size_t floats = (size_t)world->grid.block_cells * W;
    const float *base = world->grid.node_base.data, *force = world->primal.force.data;
    float *node = world->grid.node.data;
    for (size_t i = (size_t)begin * floats; i < (size_t)end * floats; i += W)
        for (size_t c = i; c < i + 3; c++) node[c] = base[i + 3] > 0.0f ? bounded(base[c] - force[c] / base[i + 3]) : 0.0f;
}

void explicit_solve(World *world, const ContactFrame *contacts)
{
    world->args.primal.node_force = world->primal.force.data;
    world->args.primal.block_energy = world->primal.block_energy.data;
    const Span nodes = grid_nodes(&world->grid, BLOCK_GRAIN);
    Loops loops;
    loops_open(&loops, world->pool);
    LOOPS_ADD(&loops, nodes, stand_still, &world);
    solver_add_rows(&loops, world, world->kernels->force, &world->args);
    solver_add_nodes(&loops, world, world->kernels->force_nodes, &world->args, NULL);
    LOOPS_ADD(&loops, nodes, push, &world);
    walls_add(&world->walls, contacts, &loops, false, NULL);
    loops_run(&loops);
    world->record.iterations_used = 1;
}

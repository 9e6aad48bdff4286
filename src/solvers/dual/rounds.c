#include "solvers/dual/rounds.h"

#include <math.h>
#include <string.h>

#include "solvers/dual/acceleration.h"
#include "solvers/passes.h"

enum { BLOCK_GRAIN = 2 };

int rounds_wanted(double stiffness, int iterations)
{
    const double wanted = ceil(DUAL_ITERATIONS_PER_ROOT * sqrt(stiffness)) - iterations;
    return (int)fmax(0.0, fmin(wanted, ROUNDS_MOST));
}

bool rounds_reserve(World *world)
{
    RoundsState *rounds = &world->dual.rounds;
    const size_t blocks = (size_t)world->grid.node_blocks;
    return array_reserve(&world->memory, &rounds->solid, blocks, sizeof(int32_t)) &&
           array_reserve(&world->memory, &rounds->touched, blocks, sizeof(int32_t)) &&
           array_reserve(&world->memory, &rounds->mark, blocks, sizeof(uint8_t));
}

static bool holds_solid(const World *world, int32_t block)
{
    const uint32_t *block_run = world->grid.block_run.data;
    for (uint32_t run = block_run[block]; run < block_run[block + 1]; run++)
        if (world->materials.kernel[world->grid.run_key[run] >> K_RUN_CELL_BITS].kind != K_LIQUID) return true;
    return false;
}

void rounds_begin(World *world)
{
    const Grid *grid = &world->grid;
    RoundsState *rounds = &world->dual.rounds;
    uint8_t *mark = rounds->mark.data;
    int32_t *solid = rounds->solid.data, *touched = rounds->touched.data;
    const uint32_t *block_begin = grid->block_begin.data;
    rounds->solids = rounds->touches = 0;
    rounds->rows = 0;
    memset(mark, 0, (size_t)grid->node_blocks);
    for (int32_t block = 0; block < grid->particle_blocks; block++) {
        if (!holds_solid(world, block)) continue;
        const int32_t *neighbour = (const int32_t *)grid->neighbour.data + (size_t)block * (size_t)grid->neighbours;
        solid[rounds->solids++] = block;
        rounds->rows += block_begin[block + 1] - block_begin[block];
        for (int n = 0; n < grid->neighbours; n++)
            if (neighbour[n] >= 0) mark[neighbour[n]] = 1;
    }
    for (int32_t block = 0; block < grid->node_blocks; block++)
        if (mark[block]) touched[rounds->touches++] = block;
}

typedef struct ListJob {
    World *world;
    Kernel *kernel;
    const int32_t *list;
} ListJob;

static void run_list(void *context, int32_t begin, int32_t end)
{
    const ListJob *job = context;
    for (int32_t i = begin; i < end; i++) job->kernel(&job->world->args, job->list[i], job->list[i] + 1);
}

static void add_iterate(World *world, Loops *loops)
{
    const RoundsState *rounds = &world->dual.rounds;
    const ListJob job = {world, world->kernels->dual_iterate, rounds->solid.data};
    const Span solids = {rounds->solids, BLOCK_GRAIN, rounds->rows * PARTICLE_NS};
    LOOPS_ADD(loops, solids, run_list, &job);
}

static void add_push(World *world, Loops *loops, const ContactFrame *contacts)
{
    const RoundsState *rounds = &world->dual.rounds;
    const ListJob job = {world, world->kernels->push_nodes, rounds->touched.data};
    const Span touched = {rounds->touches, BLOCK_GRAIN, (int64_t)rounds->touches * world->grid.block_cells * NODE_NS};
    LOOPS_ADD(loops, touched, run_list, &job);
    walls_add(&world->walls, contacts, loops, false, rounds->mark.data);
}

static double uphill_of(const World *world)
{
    const RoundsState *rounds = &world->dual.rounds;
    const float *uphill = world->dual.uphill.data;
    const int32_t *solid = rounds->solid.data;
    double sum = 0.0;
    for (int32_t i = 0; i < rounds->solids; i++) sum += (double)uphill[solid[i]];
    return sum;
}

void rounds_run(World *world, const ContactFrame *contacts, int rounds)
{
    Acceleration acceleration = acceleration_begin(world);
    Loops loops;
    bool more = rounds > 0 && world->dual.rounds.solids > 0;
    loops_open(&loops, world->pool);
    if (more) add_iterate(world, &loops);
    loops_run(&loops);
    for (int round = 1; more; round++) {
        more = round < rounds && !solver_time_is_up(world);
        acceleration_next(&acceleration, uphill_of(world) > 0.0, more);
        add_push(world, &loops, contacts);
        if (more) add_iterate(world, &loops);
        loops_run(&loops);
    }
}

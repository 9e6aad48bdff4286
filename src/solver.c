#include "solver.h"

#include <string.h>

enum { BLOCK_GRAIN = 2 };

void solver_bind(World *world, float dt, bool with_volume)
{
    Particles *p = &world->particles;
    Grid *grid = &world->grid;
    KernelArgs *a = &world->args;
    const double cells_per_metre = 1.0 / (double)world->def.cell_size;
    *a = (KernelArgs){.volume_ratio = p->volume_ratio,
                      .mass = p->mass,
                      .status = p->status,
                      .run_begin = grid->run_begin,
                      .run_key = grid->run_key,
                      .block_run = grid->block_run.data,
                      .neighbour = grid->neighbour.data,
                      .particle_blocks = grid->particle_blocks,
                      .tile = grid->tile.data,
                      .tile_volume = with_volume ? grid->tile_volume.data : NULL,
                      .node = grid->node.data,
                      .node_volume = with_volume ? grid->node_volume.data : NULL,
                      .node_reach = grid->node_reach.data,
                      .clamped = grid->clamped.data,
                      .moved = grid->moved.data,
                      .lost = grid->lost.data,
                      .material = world->materials.kernel,
                      .dt = dt,
                      .cells_per_metre = (float)cells_per_metre,
                      .max_displacement = world->settings.max_displacement,
                      .max_cell = CELL_LIMIT,
                      .check_strain = world->strain_unchecked};
    memcpy(a->fraction, p->fraction, sizeof a->fraction);
    memcpy(a->cell, p->cell, sizeof a->cell);
    memcpy(a->velocity, p->velocity, sizeof a->velocity);
    memcpy(a->affine, p->affine, sizeof a->affine);
    memcpy(a->deformation, p->deformation, sizeof a->deformation);
    for (int k = 0; k < world->def.dimension; k++)
        a->gravity[k] = (float)((double)world->settings.gravity[k] * dt * dt * cells_per_metre);
}

typedef struct KernelJob {
    Kernel *kernel;
    KernelArgs *args;
    const ContactFrame *contacts; /* for kernels that update nodes; else null */
} KernelJob;

static void run_kernel(void *context, int32_t begin, int32_t end)
{
    const KernelJob *job = context;
    job->kernel(job->args, begin, end);
    if (job->contacts) contacts_apply(job->contacts, begin, end);
}

static void over_particle_blocks(World *world, Kernel *kernel)
{
    KernelJob job = {kernel, &world->args, NULL};
    pool_for(world->pool, world->grid.particle_blocks, BLOCK_GRAIN, run_kernel, &job);
}

static void over_node_blocks(World *world, Kernel *kernel, const ContactFrame *contacts)
{
    KernelJob job = {kernel, &world->args, contacts};
    pool_for(world->pool, world->grid.node_blocks, 2 * BLOCK_GRAIN, run_kernel, &job);
}

void solver_predict(World *world)
{
    over_particle_blocks(world, world->kernels->scatter);
    over_node_blocks(world, world->kernels->predict_nodes, NULL);
    world->strain_unchecked = false;
}

void solver_iterate(World *world, const ContactFrame *contacts)
{
    contacts_apply(contacts, 0, world->grid.node_blocks); /* the predictor obeys them too */
    for (int i = 0; i < world->settings.iterations; i++) {
        over_particle_blocks(world, world->kernels->iterate);
        over_node_blocks(world, world->kernels->update_nodes, contacts);
    }
}

void solver_integrate(World *world) { over_particle_blocks(world, world->kernels->integrate); }

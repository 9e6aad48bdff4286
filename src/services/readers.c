#include "services/readers.h"

/* The lock is held for no longer than making takes, and nothing of the host's is called but its allocator: its job system might run a job first that
 * waits for this very lock. So with task hooks the caller makes it alone. */
static Pool *pool_of(const World *world) { return world->def.tasks ? NULL : world->pool; }

const float *readers_positions(World *world)
{
    pthread_mutex_lock(&world->making);
    const float *positions = particles_positions(&world->particles, (double)world->def.cell_size, pool_of(world));
    pthread_mutex_unlock(&world->making);
    return positions;
}

const float *readers_kilograms(World *world)
{
    pthread_mutex_lock(&world->making);
    const float *kilograms = particles_kilograms(&world->particles, world_cell_volume(world));
    pthread_mutex_unlock(&world->making);
    return kilograms;
}

void readers_find_rows(World *world)
{
    pthread_mutex_lock(&world->making);
    particles_find_rows(&world->particles);
    pthread_mutex_unlock(&world->making);
}

pbmpm_result readers_build_particle_tree(World *world)
{
    pthread_mutex_lock(&world->making);
    const pbmpm_result result = particle_tree_build(&world->particle_tree, &world->memory, &world->particles, world->generation, pool_of(world));
    pthread_mutex_unlock(&world->making);
    return result;
}

uint64_t readers_memory_used(World *world)
{
    pthread_mutex_lock(&world->making);
    const uint64_t bytes = world->memory.used;
    pthread_mutex_unlock(&world->making);
    return bytes;
}

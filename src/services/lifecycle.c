#include "services/lifecycle.h"

#include <unistd.h>

#include "base/assertion.h"
#include "base/cpu.h"
#include "base/result.h"
#include "services/background.h"
#include "solvers/dual/dual.h"
#include "solvers/dual/pressure_guess.h"
#include "solvers/granular.h"
#include "solvers/joint.h"
#include "solvers/primal/primal.h"
#include "skin/skin.h"

pbmpm_result world_create(const pbmpm_world_def *def, World **out)
{
    const pbmpm_isa isa = cpu_isa();
    *out = NULL;
    if (isa == PBMPM_ISA_NONE) return fail(PBMPM_ERROR_UNSUPPORTED_CPU, "this CPU has no SSE4.2");
    Memory memory;
    memory_init(&memory, def->allocator, def->memory_budget);
    World *world = memory_take(&memory, sizeof *world);
    if (!world) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for a world");
    world->def = *def;
    world->memory = memory;
    if (def->allocator) world->def.allocator = &world->memory.allocator;
    if (def->tasks) {
        world->tasks = *def->tasks;
        world->def.tasks = &world->tasks;
    }
    world->settings = settings_defaults();
    world->sinks.bounds = kill_bounds_defaults();
    world->flow.size = sizeof world->flow;
    world->owner = getpid();
    pthread_mutex_init(&world->making, NULL);
    world->kernels = kernels_for(isa, def->dimension);
    world->generation = 1;
    world->matter_depth = 1.0;
    world->domain = domain_of(def);
    const int threads = def->thread_count ? def->thread_count : cpu_core_count();
    pbmpm_result result = particles_init(&world->particles, &world->memory, def->dimension, def->particle_capacity);
    if (result == PBMPM_OK) result = grid_init(&world->grid, &world->memory, def->dimension, def->particle_capacity);
    if (result == PBMPM_OK) result = colliders_init(&world->colliders, &world->memory);
    if (result == PBMPM_OK && def->domain_measures_impulse) result = impulses_enable(&world->colliders.impulses, &world->memory);
    if (result == PBMPM_OK) result = pool_create(&world->memory, threads, def->tasks, &world->pool);
    if (result != PBMPM_OK) {
        world_destroy(world);
        return result;
    }
    *out = world;
    return PBMPM_OK;
}

void world_destroy(World *world)
{
    const bool here = world->owner == getpid();
    if (!here && (world->frozen || background_is_stepping(world))) return; /* nobody knows what the frozen call has given back */
    background_stop(world, here);
    if (here) pthread_mutex_destroy(&world->making);
    pool_destroy(&world->memory, world->pool, here);
    background_free(world);
    particle_tree_free(&world->particle_tree, &world->memory);
    skin_free(world);
    array_free(&world->memory, &world->submersion);
    colliders_free(&world->colliders, &world->memory);
    baked_free(&world->baked, &world->memory);
    emitters_free(&world->emitters, &world->memory);
    sinks_free(&world->sinks, &world->memory);
    forces_free(&world->forces, &world->memory);
    dual_free(world);
    guess_free(world);
    walls_free(&world->walls, &world->memory);
    for (int kinds = 0; kinds <= ISLAND_GROUPS; kinds++) obstacle_cache_free(&world->obstacle_cache[kinds], &world->memory);
    joint_free(world);
    granular_free(world);
    primal_free(world);
    sleep_free(&world->sleep, &world->memory);
    islands_free(&world->islands, &world->memory);
    grid_free(&world->grid, &world->memory);
    particles_free(&world->particles, &world->memory);
    Memory memory = world->memory;
    memory_give(&memory, world, sizeof *world);
    ASSERT(memory.used == 0 || !here);
}

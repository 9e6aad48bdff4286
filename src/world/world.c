#include "world/world.h"

#include <string.h>

#include "base/numbers.h"

pbmpm_world_def world_def_defaults(void)
{
    return (pbmpm_world_def){.size = sizeof(pbmpm_world_def),
                             .dimension = 3,
                             .cell_size = 0.1f,
                             .particle_capacity = 65536,
                             .domain_max = {1.0f, 1.0f, 1.0f}};
}

pbmpm_settings settings_defaults(void)
{
    return (pbmpm_settings){.size = sizeof(pbmpm_settings), .substeps = 1, .iterations = 5, .max_displacement = 32.0f,
                            .solver = PBMPM_SOLVER_CONVERGENT, .sleep_speed = 0.05f, .sleep_time = 0.5f};
}

static const char *domain_problem(const pbmpm_world_def *def)
{
    const double half_range = 0.5 * PBMPM_MAX_CELL * (double)def->cell_size;
    for (int a = 0; a < def->dimension; a++) {
        if (!in_range(def->domain_min[a], -half_range, half_range) || !in_range(def->domain_max[a], -half_range, half_range))
            return "world.domain_min and domain_max must be within 2^21 cells of the origin";
        if (!((double)def->domain_max[a] - def->domain_min[a] >= 4.0 * def->cell_size))
            return "world.domain_max must be at least 4 cells above domain_min on every axis";
    }
    return in_range(def->domain_friction, 0.0, 100.0) ? NULL : "world.domain_friction must be in [0, 100]";
}

const char *world_def_problem(const pbmpm_world_def *def)
{
    if (def->dimension != 2 && def->dimension != 3) return "world.dimension must be 2 or 3";
    if (!in_range(def->cell_size, 1e-6, 1e6)) return "world.cell_size must be in [1e-6, 1e6]";
    if (def->particle_capacity < 1 || def->particle_capacity > PBMPM_MAX_PARTICLES)
        return "world.particle_capacity must be in [1, 2^28]";
    for (int a = 0; a < 3; a++)
        if (!isfinite(def->origin[a])) return "world.origin must be finite";
    if (def->thread_count < 0 || def->thread_count > 256) return "world.thread_count must be in [0, 256]";
    if (def->domain_enabled != 0 && def->domain_enabled != 1) return "world.domain_enabled must be 0 or 1";
    if (def->domain_measures_impulse != 0 && def->domain_measures_impulse != 1) return "world.domain_measures_impulse must be 0 or 1";
    if (def->allocator && (!def->allocator->allocate || !def->allocator->release)) return "world.allocator needs both functions";
    if (def->tasks && (!def->tasks->enqueue || !def->tasks->finish)) return "world.tasks needs both functions";
    if (def->tasks && def->tasks->nests != 0 && def->tasks->nests != 1) return "world.tasks.nests must be 0 or 1";
    return def->domain_enabled ? domain_problem(def) : NULL;
}

const char *settings_problem(const pbmpm_settings *settings, int dimension)
{
    if (settings->substeps < 1 || settings->substeps > PBMPM_MAX_SUBSTEPS) return "settings.substeps must be in [1, 256]";
    if (settings->iterations < 1 || settings->iterations > PBMPM_MAX_ITERATIONS)
        return "settings.iterations must be in [1, 1000]";
    if (!all_in_range(settings->gravity, (size_t)dimension, -1e9, 1e9)) return "settings.gravity must be in [-1e9, 1e9]";
    if (!in_range(settings->max_displacement, 0.1, PBMPM_MAX_CELLS_PER_SUBSTEP))
        return "settings.max_displacement must be in [0.1, 64]";
    if (!in_enum(settings->solver, PBMPM_SOLVER_PAPER, PBMPM_SOLVER_CONVERGENT)) return "settings.solver is unknown";
    if (!in_enum(settings->pressure, PBMPM_PRESSURE_PARTICLES, PBMPM_PRESSURE_CELLS)) return "settings.pressure is unknown";
    if (!in_enum(settings->integrator, PBMPM_INTEGRATOR_EULER, PBMPM_INTEGRATOR_BDF2)) return "settings.integrator is unknown";
    if (!in_range(settings->flip, 0.0, 1.0)) return "settings.flip must be in [0, 1]";
    if (!in_range(settings->target_error, 0.0, 1.0)) return "settings.target_error must be in [0, 1]";
    if (!in_range(settings->time_budget_ms, 0.0, 1e6)) return "settings.time_budget_ms must be in [0, 1e6]";
    if (settings->sleeping != 0 && settings->sleeping != 1) return "settings.sleeping must be 0 or 1";
    if (!in_range(settings->sleep_speed, 0.0, 1e9)) return "settings.sleep_speed must be in [0, 1e9]";
    if (!in_range(settings->sleep_time, 0.0, 1e6)) return "settings.sleep_time must be in [0, 1e6]";
    return NULL;
}

bool settings_change_motion(const pbmpm_settings *before, const pbmpm_settings *after)
{
    pbmpm_settings same = *after;
    same.target_error = before->target_error;
    same.time_budget_ms = before->time_budget_ms;
    same.sleeping = before->sleeping;
    same.sleep_speed = before->sleep_speed;
    same.sleep_time = before->sleep_time;
    return memcmp(before, &same, sizeof same) != 0;
}

pbmpm_result world_make_room_for(World *world, uint32_t material)
{
    return material_is_solid(&world->materials, material) ? particles_enable_deformation(&world->particles, &world->memory) : PBMPM_OK;
}

bool world_feels(const World *world, const Collider *collider)
{
    uint32_t groups = 0;
    if (!collider_acts(collider) || collider->def.meets == 0) return collider_acts(collider);
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (world->particles.of_material[slot] > 0) groups |= world->materials.def[slot].groups;
    return groups_meet(collider->def.meets, groups);
}

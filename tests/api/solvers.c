#include "solvers.h"

#include <math.h>

const way ways[] = {
    {"paper", PBMPM_SOLVER_PAPER, PBMPM_PRESSURE_PARTICLES, PBMPM_INTEGRATOR_EULER, 0},
    {"dual", PBMPM_SOLVER_DUAL, PBMPM_PRESSURE_PARTICLES, PBMPM_INTEGRATOR_EULER, 0},
    {"dual, lively", PBMPM_SOLVER_DUAL, PBMPM_PRESSURE_PARTICLES, PBMPM_INTEGRATOR_EULER, 0.9f},
    {"dual, cells", PBMPM_SOLVER_DUAL, PBMPM_PRESSURE_CELLS, PBMPM_INTEGRATOR_EULER, 0},
    {"dual, cells, lively", PBMPM_SOLVER_DUAL, PBMPM_PRESSURE_CELLS, PBMPM_INTEGRATOR_EULER, 0.9f},
    {"primal", PBMPM_SOLVER_PRIMAL, PBMPM_PRESSURE_PARTICLES, PBMPM_INTEGRATOR_EULER, 0},
    {"primal, BDF2", PBMPM_SOLVER_PRIMAL, PBMPM_PRESSURE_PARTICLES, PBMPM_INTEGRATOR_BDF2, 0},
    {"explicit", PBMPM_SOLVER_EXPLICIT, PBMPM_PRESSURE_PARTICLES, PBMPM_INTEGRATOR_EULER, 0},
    {"convergent", PBMPM_SOLVER_CONVERGENT, PBMPM_PRESSURE_PARTICLES, PBMPM_INTEGRATOR_BDF2, 0.5f},
};
const int way_count = (int)(sizeof ways / sizeof *ways);

void use_way(pbmpm_world_id world, const way *chosen)
{
    pbmpm_settings settings = {.size = sizeof settings};
    OK(pbmpm_world_get_settings(world, &settings));
    settings.solver = chosen->solver;
    settings.pressure = chosen->pressure;
    settings.integrator = chosen->integrator;
    settings.flip = chosen->flip;
    OK(pbmpm_world_set_settings(world, &settings));
}

pbmpm_material_def soft_material(pbmpm_material_kind kind)
{
    pbmpm_material_def def = default_material(kind);
    def.bulk_modulus = 1e5f;
    def.young_modulus = 1e5f;
    return def;
}

stage stirred_pool(int32_t dimension, const way *chosen, scene_tweak *tweak, void *user)
{
    const float cell = dimension == 3 ? 0.1f : 0.03f, size = 1.2f, middle = size / 2;
    const float rest[3] = {0, 0, 0};
    pbmpm_world_def def = default_world(dimension, cell, 8192);
    pbmpm_material_def liquid = soft_material(PBMPM_LIQUID), elastic = soft_material(PBMPM_ELASTIC);
    pbmpm_material_id water, oil, jelly;
    stage made;
    def.domain_enabled = 1;
    for (int a = 0; a < 3; a++)
        def.domain_max[a] = size;
    if (tweak)
        tweak(&def, user);
    made.world = create_world(&def);
    OK(pbmpm_material_create(made.world, &liquid, &water));
    OK(pbmpm_material_create(made.world, &elastic, &jelly));
    liquid.density = 800;
    liquid.kinematic_viscosity = 1e-3f;
    OK(pbmpm_material_create(made.world, &liquid, &oil));
    fill_shape(made.world, water, box_shape(size / 3, size / 6, middle, size / 3, size / 6, middle), rest);
    fill_shape(made.world, oil, box_shape(size * 5 / 6, size / 6, middle, size / 6, size / 6, middle), rest);
    fill_shape(made.world, jelly, box_shape(0.8f, 0.65f, 0.6f, 0.18f, 0.18f, 0.18f), (const float[3]){0, -1, 0});
    made.paddle = create_collider(made.world, box_shape(0.2f, 0.3f, middle, 0.04f, 0.2f, 0.3f), true);
    set_gravity(made.world, 0, -9.81f, 0);
    set_rate(made.world, 4, 3);
    use_way(made.world, chosen);
    return made;
}

void stirred_pool_run(const stage *made, int from, int to)
{
    const float dt = 1.0f / 120;
    for (int step = from; step < to; step++) {
        const float angle = 0.3f * sinf(5.0f * dt * (float)step);
        const float position[3] = {0.2f + 2.0f * dt * (float)(step % 40), 0.3f, 0.6f}, rotation[4] = {0, 0, sinf(angle), cosf(angle)};
        OK(pbmpm_collider_move(made->world, made->paddle, position, rotation));
        OK(pbmpm_world_step(made->world, dt));
    }
}

#include <stdlib.h>
#include <string.h>

#include "fuzz.h"

#define DONE(call) HOLDS((call) == PBMPM_OK)

void *fuzz_solid(int dimension, int form, uint64_t *bytes)
{
    static const float flat[] = {-0.3f, -0.2f, 0.3f, -0.2f, 0.0f, 0.4f}, deep[] = {0, 0, 0, 0.6f, 0, 0, 0, 0.6f, 0, 0, 0, 0.6f};
    static const uint32_t edges[] = {0, 1, 1, 2, 2, 0}, faces[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    static const float ground[] = {0.1f, 0.3f, 0.2f, 0.0f, 0.25f, 0.1f, 0.2f, 0.1f, 0.0f};
    pbmpm_mesh_def mesh;
    pbmpm_heights_def heights;
    DONE(pbmpm_mesh_def_init(&mesh, sizeof mesh));
    DONE(pbmpm_heights_def_init(&heights, sizeof heights));
    mesh.dimension = heights.dimension = dimension;
    mesh.vertices = dimension == 2 ? flat : deep;
    mesh.elements = form ? NULL : dimension == 2 ? edges : faces;
    mesh.vertex_count = dimension == 2 ? 3 : 4;
    mesh.element_count = form ? 0 : mesh.vertex_count;
    mesh.resolution = heights.resolution = 4;
    heights.count[0] = heights.count[1] = 3;
    heights.spacing[0] = heights.spacing[1] = 0.3f;
    heights.heights = ground;
    heights.thickness = 0.2f;
    DONE(form == 2 ? pbmpm_bake_heights(&heights, NULL, 0, bytes) : form ? pbmpm_bake_hull(&mesh, NULL, 0, bytes) : pbmpm_bake_mesh(&mesh, NULL, 0, bytes));
    void *solid = malloc(*bytes);
    HOLDS(solid);
    DONE(form == 2 ? pbmpm_bake_heights(&heights, solid, *bytes, bytes)
                   : form ? pbmpm_bake_hull(&mesh, solid, *bytes, bytes) : pbmpm_bake_mesh(&mesh, solid, *bytes, bytes));
    return solid;
}

static pbmpm_shape shape_at(pbmpm_shape_kind kind, float x, float y, float size)
{
    pbmpm_shape shape;
    DONE(pbmpm_shape_init(&shape, sizeof shape));
    shape.kind = kind;
    shape.position[0] = x;
    shape.position[1] = y;
    shape.position[2] = 0.5f;
    shape.radius = shape.half_extents[0] = shape.half_extents[1] = shape.half_extents[2] = size;
    return shape;
}

static pbmpm_material_id add_matter(pbmpm_world_id world, pbmpm_material_kind kind)
{
    pbmpm_material_def def;
    pbmpm_fill_def fill;
    DONE(pbmpm_material_def_init(&def, sizeof def));
    DONE(pbmpm_fill_def_init(&fill, sizeof fill));
    def.kind = kind;
    def.volume_feedback = kind == PBMPM_LIQUID;
    DONE(pbmpm_material_create(world, &def, &fill.material));
    const pbmpm_shape box = shape_at(PBMPM_BOX, 0.35f + 0.2f * (float)(kind % 2), 0.35f + 0.2f * (float)(kind / 2), 0.06f);
    DONE(pbmpm_particles_fill(world, &fill, &box, NULL));
    return fill.material;
}

static void add_obstacles(pbmpm_world_id world, int dimension, FuzzIds *ids)
{
    pbmpm_collider_def def;
    static void *solids[2]; /* baking takes long */
    static uint64_t bytes[2];
    const int i = dimension - 2;
    if (!solids[i]) solids[i] = fuzz_solid(dimension, 0, &bytes[i]);
    DONE(pbmpm_baked_create(world, solids[i], bytes[i], &ids->baked));
    DONE(pbmpm_collider_def_init(&def, sizeof def));
    pbmpm_shape shape = shape_at(PBMPM_SPHERE, 0.8f, 0.3f, 0.15f);
    def.kinematic = def.measures_impulse = 1;
    DONE(pbmpm_collider_create(world, &def, &shape, &ids->collider[0]));
    shape = shape_at(PBMPM_BAKED, 0.2f, 0.1f, 0.5f);
    shape.baked = ids->baked;
    def.kinematic = def.measures_impulse = 0;
    DONE(pbmpm_collider_create(world, &def, &shape, &ids->collider[1]));
}

static void add_flow(pbmpm_world_id world, FuzzIds *ids)
{
    pbmpm_emitter_def emitter;
    pbmpm_drain_def drain;
    pbmpm_force_def force;
    DONE(pbmpm_emitter_def_init(&emitter, sizeof emitter));
    DONE(pbmpm_drain_def_init(&drain, sizeof drain));
    DONE(pbmpm_force_def_init(&force, sizeof force));
    emitter.material = ids->material;
    emitter.rate = 0.01f;
    const pbmpm_shape tap = shape_at(PBMPM_BOX, 0.5f, 0.8f, 0.1f), sink = shape_at(PBMPM_BOX, 0.9f, 0.9f, 0.05f);
    const pbmpm_shape centre = shape_at(PBMPM_SPHERE, 0.5f, 0.5f, 0.2f);
    force.strength = 1.0f;
    DONE(pbmpm_emitter_create(world, &emitter, &tap, &ids->emitter));
    DONE(pbmpm_drain_create(world, &drain, &sink, &ids->drain));
    DONE(pbmpm_force_create(world, &force, &centre, &ids->force));
}

pbmpm_world_id fuzz_world(int dimension, FuzzIds *ids)
{
    pbmpm_world_def def;
    pbmpm_world_id world;
    DONE(pbmpm_world_def_init(&def, sizeof def));
    def.dimension = dimension;
    def.particle_capacity = FUZZ_CAPACITY;
    def.thread_count = 1;
    def.domain_enabled = def.domain_measures_impulse = 1;
    DONE(pbmpm_world_create(&def, &world));
    ids->material = add_matter(world, PBMPM_LIQUID);
    add_matter(world, PBMPM_ELASTIC);
    add_matter(world, PBMPM_SAND);
    add_matter(world, PBMPM_VISCO);
    add_obstacles(world, dimension, ids);
    add_flow(world, ids);
    return world;
}

pbmpm_world_id fuzz_used_world(int dimension)
{
    static const pbmpm_solver solvers[] = {PBMPM_SOLVER_PAPER, PBMPM_SOLVER_PRIMAL, PBMPM_SOLVER_DUAL, PBMPM_SOLVER_CONVERGENT};
    FuzzIds ids;
    pbmpm_settings settings;
    const pbmpm_world_id world = fuzz_world(dimension, &ids);
    DONE(pbmpm_settings_init(&settings, sizeof settings));
    settings.iterations = 2;
    settings.gravity[1] = -9.81f;
    settings.integrator = PBMPM_INTEGRATOR_BDF2;
    settings.sleep_time = 0.0f;
    settings.sleep_speed = 1e6f;
    for (size_t i = 0; i < sizeof solvers / sizeof *solvers; i++) {
        settings.solver = solvers[i];
        settings.sleeping = i >= 2;
        DONE(pbmpm_world_set_settings(world, &settings));
        for (int step = 0; step < 2; step++) DONE(pbmpm_world_step(world, 1e-3f));
    }
    return world;
}

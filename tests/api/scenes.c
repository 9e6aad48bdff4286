#include "scenes.h"

#include <math.h>

static const float at_rest[3] = {0, 0, 0};

/* ---- building blocks ---- */

pbmpm_world_def default_world(int32_t dimension, float cell_size, uint32_t capacity)
{
    pbmpm_world_def def;
    OK(pbmpm_world_def_init(&def, sizeof def));
    def.dimension = dimension;
    def.cell_size = cell_size;
    def.particle_capacity = capacity;
    def.thread_count = 1;
    return def;
}

void three_threads(pbmpm_world_def *def, void *user)
{
    (void)user;
    def->thread_count = 3;
}

pbmpm_settings default_settings(void)
{
    pbmpm_settings settings;
    OK(pbmpm_settings_init(&settings, sizeof settings));
    return settings;
}

pbmpm_material_def default_material(pbmpm_material_kind kind)
{
    pbmpm_material_def def;
    OK(pbmpm_material_def_init(&def, sizeof def));
    def.kind = kind;
    return def;
}

pbmpm_collider_def default_collider(void)
{
    pbmpm_collider_def def;
    OK(pbmpm_collider_def_init(&def, sizeof def));
    return def;
}

pbmpm_fill_def default_fill(pbmpm_material_id material)
{
    pbmpm_fill_def fill;
    OK(pbmpm_fill_def_init(&fill, sizeof fill));
    fill.material = material;
    return fill;
}

pbmpm_shape default_shape(void)
{
    pbmpm_shape shape;
    OK(pbmpm_shape_init(&shape, sizeof shape));
    return shape;
}

static pbmpm_shape shape_at(pbmpm_shape_kind kind, float x, float y, float z)
{
    pbmpm_shape shape = default_shape();
    shape.kind = kind;
    shape.position[0] = x;
    shape.position[1] = y;
    shape.position[2] = z;
    return shape;
}

pbmpm_shape box_shape(float x, float y, float z, float half_x, float half_y, float half_z)
{
    pbmpm_shape shape = shape_at(PBMPM_BOX, x, y, z);
    shape.half_extents[0] = half_x;
    shape.half_extents[1] = half_y;
    shape.half_extents[2] = half_z;
    return shape;
}

pbmpm_shape sphere_shape(float x, float y, float z, float radius)
{
    pbmpm_shape shape = shape_at(PBMPM_SPHERE, x, y, z);
    shape.radius = radius;
    return shape;
}

pbmpm_shape plane_shape(float x, float y, float z, float nx, float ny, float nz)
{
    pbmpm_shape shape = shape_at(PBMPM_PLANE, x, y, z);
    shape.normal[0] = nx;
    shape.normal[1] = ny;
    shape.normal[2] = nz;
    return shape;
}

pbmpm_world_id create_world(const pbmpm_world_def *def)
{
    pbmpm_world_id world;
    OK(pbmpm_world_create(def, &world));
    return world;
}

pbmpm_material_id create_material(pbmpm_world_id world, pbmpm_material_kind kind)
{
    const pbmpm_material_def def = default_material(kind);
    pbmpm_material_id material;
    OK(pbmpm_material_create(world, &def, &material));
    return material;
}

pbmpm_collider_id create_collider(pbmpm_world_id world, pbmpm_shape shape, bool kinematic)
{
    pbmpm_collider_def def = default_collider();
    pbmpm_collider_id collider;
    def.kinematic = kinematic;
    OK(pbmpm_collider_create(world, &def, &shape, &collider));
    return collider;
}

pbmpm_emitter_id create_emitter(pbmpm_world_id world, pbmpm_material_id material)
{
    const pbmpm_shape shape = default_shape();
    pbmpm_emitter_def def;
    pbmpm_emitter_id emitter;
    OK(pbmpm_emitter_def_init(&def, sizeof def));
    def.material = material;
    OK(pbmpm_emitter_create(world, &def, &shape, &emitter));
    return emitter;
}

pbmpm_drain_id create_drain(pbmpm_world_id world, pbmpm_shape shape)
{
    pbmpm_drain_def def;
    pbmpm_drain_id drain;
    OK(pbmpm_drain_def_init(&def, sizeof def));
    OK(pbmpm_drain_create(world, &def, &shape, &drain));
    return drain;
}

pbmpm_force_id create_force(pbmpm_world_id world)
{
    const pbmpm_shape shape = default_shape();
    pbmpm_force_def def;
    pbmpm_force_id force;
    OK(pbmpm_force_def_init(&def, sizeof def));
    def.enabled = 0;
    OK(pbmpm_force_create(world, &def, &shape, &force));
    return force;
}

uint32_t fill_shape(pbmpm_world_id world, pbmpm_material_id material, pbmpm_shape shape, const float velocity[3])
{
    pbmpm_fill_def fill = default_fill(material);
    uint32_t added = 0;
    for (int a = 0; a < 3; a++)
        fill.velocity[a] = velocity[a];
    OK(pbmpm_particles_fill(world, &fill, &shape, &added));
    return added;
}

void set_gravity(pbmpm_world_id world, float x, float y, float z)
{
    pbmpm_settings settings = {.size = sizeof settings};
    OK(pbmpm_world_get_settings(world, &settings));
    settings.gravity[0] = x;
    settings.gravity[1] = y;
    settings.gravity[2] = z;
    OK(pbmpm_world_set_settings(world, &settings));
}

void set_rate(pbmpm_world_id world, int32_t substeps, int32_t iterations)
{
    pbmpm_settings settings = {.size = sizeof settings};
    OK(pbmpm_world_get_settings(world, &settings));
    settings.substeps = substeps;
    settings.iterations = iterations;
    OK(pbmpm_world_set_settings(world, &settings));
}

void set_solver(pbmpm_world_id world, pbmpm_solver solver)
{
    pbmpm_settings settings = {.size = sizeof settings};
    OK(pbmpm_world_get_settings(world, &settings));
    settings.solver = solver;
    OK(pbmpm_world_set_settings(world, &settings));
}

pbmpm_world_id papers_world(const pbmpm_world_def *def)
{
    const pbmpm_world_id world = create_world(def);
    set_solver(world, PBMPM_SOLVER_PAPER);
    return world;
}

/* A world in a closed box from the origin to (size, size, size), with gravity down the second axis. */
static pbmpm_world_id boxed_world(int32_t dimension, float cell_size, float size, scene_tweak *tweak, void *user)
{
    pbmpm_world_def def = default_world(dimension, cell_size, 8192);
    def.domain_enabled = 1;
    for (int a = 0; a < 3; a++)
        def.domain_max[a] = size;
    if (tweak)
        tweak(&def, user);
    const pbmpm_world_id world = create_world(&def);
    set_gravity(world, 0, -9.81f, 0);
    set_rate(world, 1, 2);
    return world;
}

static pbmpm_world_id open_world(int32_t dimension, float cell_size, scene_tweak *tweak, void *user)
{
    pbmpm_world_def def = default_world(dimension, cell_size, 8192);
    if (tweak)
        tweak(&def, user);
    const pbmpm_world_id world = create_world(&def);
    set_rate(world, 1, 2);
    return world;
}

pbmpm_world_id tank_2d(scene_tweak *tweak, void *user)
{
    const pbmpm_world_id world = boxed_world(2, 0.05f, 1.0f, tweak, user);
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    fill_shape(world, water, box_shape(0.5f, 0.25f, 0, 0.5f, 0.25f, 0.5f), at_rest);
    return world;
}

pbmpm_world_id block_2d(scene_tweak *tweak, void *user)
{
    const pbmpm_world_id world = open_world(2, 0.1f, tweak, user);
    const pbmpm_material_id jelly = create_material(world, PBMPM_ELASTIC);
    fill_shape(world, jelly, box_shape(0, 0, 0, 0.4f, 0.4f, 0.5f), at_rest);
    return world;
}

/* ---- the catalogue ---- */

/* A column of liquid that collapses in a closed box. */
static stage dam_2d(scene_tweak *tweak, void *user)
{
    const pbmpm_world_id world = boxed_world(2, 0.02f, 2.0f, tweak, user);
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    fill_shape(world, water, box_shape(0.25f, 0.5f, 0, 0.25f, 0.5f, 0.5f), at_rest);
    return (stage){.world = world};
}

static stage dam_3d(scene_tweak *tweak, void *user)
{
    const pbmpm_world_id world = boxed_world(3, 0.1f, 1.5f, tweak, user);
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    fill_shape(world, water, box_shape(0.3f, 0.4f, 0.4f, 0.3f, 0.4f, 0.4f), at_rest);
    return (stage){.world = world};
}

/* Two elastic discs that collide in free space. */
static stage discs_2d(scene_tweak *tweak, void *user)
{
    const pbmpm_world_id world = open_world(2, 0.025f, tweak, user);
    const pbmpm_material_id jelly = create_material(world, PBMPM_ELASTIC);
    fill_shape(world, jelly, sphere_shape(-0.35f, -0.05f, 0, 0.3f), (const float[3]){1.0f, 0.2f, 0});
    fill_shape(world, jelly, sphere_shape(0.35f, 0.05f, 0, 0.3f), (const float[3]){-1.0f, 0, 0});
    return (stage){.world = world};
}

/* A liquid pool, an elastic block that falls into it, and a kinematic paddle that stirs. */
static stage paddle_2d(scene_tweak *tweak, void *user)
{
    stage made = {.world = boxed_world(2, 0.03f, 2.0f, tweak, user)};
    const pbmpm_material_id water = create_material(made.world, PBMPM_LIQUID);
    const pbmpm_material_id jelly = create_material(made.world, PBMPM_ELASTIC);
    fill_shape(made.world, water, box_shape(1.0f, 0.2f, 0, 1.0f, 0.2f, 0.5f), at_rest);
    fill_shape(made.world, jelly, box_shape(1.2f, 0.9f, 0, 0.15f, 0.15f, 0.5f), at_rest);
    made.paddle = create_collider(made.world, box_shape(0.3f, 0.4f, 0, 0.05f, 0.3f, 0.5f), true);
    return made;
}

static void swing_paddle(const stage *made, int step, float dt)
{
    const float time = (float)(step + 1) * dt;
    const float angle = 0.5f * sinf(4.0f * time);
    const float position[3] = {0.6f - 0.3f * cosf(3.0f * time), 0.4f, 0};
    const float rotation[4] = {0, 0, sinf(angle / 2), cosf(angle / 2)};
    OK(pbmpm_collider_move(made->world, made->paddle, position, rotation));
}

/* Liquid, an elastic ball and a static capsule in 3D. */
static stage mixed_3d(scene_tweak *tweak, void *user)
{
    const pbmpm_world_id world = boxed_world(3, 0.1f, 1.2f, tweak, user);
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    const pbmpm_material_id jelly = create_material(world, PBMPM_ELASTIC);
    pbmpm_shape post = box_shape(0.6f, 0.25f, 0.6f, 0.3f, 0, 0);
    post.kind = PBMPM_CAPSULE;
    post.radius = 0.12f;
    create_collider(world, post, false);
    fill_shape(world, water, box_shape(0.25f, 0.45f, 0.6f, 0.25f, 0.45f, 0.4f), at_rest);
    fill_shape(world, jelly, sphere_shape(0.85f, 0.85f, 0.6f, 0.3f), at_rest);
    return (stage){.world = world};
}

/* Two elastic balls that hit each other at many cells per step, in unbounded space; the clamp slows them down. */
static stage crash_3d(scene_tweak *tweak, void *user)
{
    const pbmpm_world_id world = open_world(3, 0.1f, tweak, user);
    const pbmpm_material_id jelly = create_material(world, PBMPM_ELASTIC);
    pbmpm_settings settings = default_settings();
    settings.iterations = 2;
    settings.max_displacement = 1.5f;
    settings.gravity[1] = -9.81f;
    OK(pbmpm_world_set_settings(world, &settings));
    fill_shape(world, jelly, sphere_shape(-2.0f, 0, 0, 0.37f), (const float[3]){20.0f, 3.0f, 0});
    fill_shape(world, jelly, sphere_shape(2.0f, 0.2f, 0.1f, 0.37f), (const float[3]){-20.0f, 2.0f, 0});
    return (stage){.world = world};
}

const scene scenes[] = {
    {"dam_2d", 2, 1.0f / 120, dam_2d, NULL},
    {"dam_3d", 3, 1.0f / 60, dam_3d, NULL},
    {"discs_2d", 2, 1.0f / 240, discs_2d, NULL},
    {"paddle_2d", 2, 1.0f / 120, paddle_2d, swing_paddle},
    {"mixed_3d", 3, 1.0f / 60, mixed_3d, NULL},
    {"crash_3d", 3, 1.0f / 120, crash_3d, NULL},
};
const int scene_count = (int)(sizeof scenes / sizeof *scenes);

void scene_run(const scene *plan, const stage *made, int from, int to)
{
    for (int step = from; step < to; step++) {
        if (plan->before_step)
            plan->before_step(made, step, plan->dt);
        OK(pbmpm_world_step(made->world, plan->dt));
    }
}

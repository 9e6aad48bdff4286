#include "sized_calls.h"

#include <string.h>

target world;

/* ---- Structures with defaults ---- */

#define DEFAULTS(X)                                                                                                     \
    X(pbmpm_world_def) X(pbmpm_settings) X(pbmpm_material_def) X(pbmpm_shape) X(pbmpm_collider_def) X(pbmpm_particles_def) \
    X(pbmpm_fill_def) X(pbmpm_emitter_def) X(pbmpm_drain_def) X(pbmpm_force_def) X(pbmpm_kill_bounds) X(pbmpm_mesh_def) \
    X(pbmpm_heights_def) X(pbmpm_ray) X(pbmpm_copy_def) X(pbmpm_surface_def) X(pbmpm_points_def)

#define INIT_FUNCTION(type) static pbmpm_result init_##type(void *given, size_t size) { return type##_init(given, size); }
DEFAULTS(INIT_FUNCTION)

#define INIT_ROW(type) {#type, #type "_init", sizeof(type), init_##type},
const sized_init sized_inits[] = {DEFAULTS(INIT_ROW)};
const int sized_init_count = (int)(sizeof sized_inits / sizeof *sized_inits);

/* ---- Structures that calls read ---- */

static void sound_world_def(void *structure)
{
    pbmpm_world_def *def = structure;
    *def = default_world(2, 0.25f, 77);
    def->origin[1] = -3.5;
    def->domain_friction = 0.5f;
    def->user_data = 12;
}

static pbmpm_result make_world(const pbmpm_world_def *def, pbmpm_world_def *back, pbmpm_world_id *made)
{
    const pbmpm_result result = pbmpm_world_create(def, made);
    if (result != PBMPM_OK) return result;
    back->size = sizeof *back;
    OK(pbmpm_world_get_def(*made, back));
    fill_shape(*made, create_material(*made, PBMPM_LIQUID), box_shape(0, 0, 0, 0.5f, 0.5f, 0.5f), (const float[3]){0, 0, 0});
    OK(pbmpm_world_step(*made, 0.01f));
    return PBMPM_OK;
}

static pbmpm_result give_world_def(const void *structure, void *outcome)
{
    pbmpm_world_id made;
    const pbmpm_result result = make_world(structure, outcome, &made);
    if (result == PBMPM_OK) OK(pbmpm_world_destroy(made));
    return result;
}

static ledger book;

static void sound_allocator(void *structure)
{
    book = (ledger){0};
    memcpy(structure, ledger_allocator(&book), sizeof(pbmpm_allocator));
}

static pbmpm_result give_allocator(const void *structure, void *outcome)
{
    pbmpm_world_def def = default_world(2, 0.1f, 1000), back;
    pbmpm_world_id made;
    def.allocator = structure;
    const pbmpm_result result = make_world(&def, &back, &made);
    if (result != PBMPM_OK) return result;
    memcpy(outcome, back.allocator, sizeof *back.allocator);
    TEST_ASSERT_TRUE(book.live_blocks > 0);
    OK(pbmpm_world_destroy(made));
    ledger_expect_clean(&book, "a world with a larger allocator");
    return PBMPM_OK;
}

static int tasks_done;

static void *enqueue_at_once(pbmpm_task *task, int32_t count, void *context, void *user)
{
    for (int32_t i = 0; i < count; i++) task(i, context);
    *(int *)user += count;
    return NULL;
}

static void finish_nothing(void *handle, void *user) { (void)handle, (void)user; }

static void sound_task_hooks(void *structure)
{
    pbmpm_task_hooks *hooks = structure;
    *hooks = (pbmpm_task_hooks){sizeof *hooks, 0, enqueue_at_once, finish_nothing, &tasks_done};
}

static pbmpm_result give_task_hooks(const void *structure, void *outcome)
{
    pbmpm_world_def def = default_world(2, 0.02f, 20000), back; /* enough matter to share */
    pbmpm_world_id made;
    def.tasks = structure;
    def.thread_count = 4;
    tasks_done = 0;
    const pbmpm_result result = make_world(&def, &back, &made);
    if (result != PBMPM_OK) return result;
    memcpy(outcome, back.tasks, sizeof *back.tasks);
    TEST_ASSERT_TRUE(tasks_done > 0);
    OK(pbmpm_world_destroy(made));
    return PBMPM_OK;
}

static void sound_settings(void *structure)
{
    pbmpm_settings *settings = structure;
    *settings = default_settings();
    settings->gravity[1] = -9.81f;
    settings->iterations = 3;
}

static pbmpm_result give_settings(const void *structure, void *outcome)
{
    const pbmpm_result result = pbmpm_world_set_settings(world.world, structure);
    if (result == PBMPM_OK) OK(pbmpm_world_get_settings(world.world, outcome));
    return result;
}

static void sound_material(void *structure)
{
    pbmpm_material_def *def = structure;
    *def = default_material(PBMPM_ELASTIC);
    def->young_modulus = 3e4f;
    def->user_data = 12;
}

static pbmpm_result give_new_material(const void *structure, void *outcome)
{
    pbmpm_material_id material;
    const pbmpm_result result = pbmpm_material_create(world.world, structure, &material);
    if (result == PBMPM_OK) OK(pbmpm_material_get(world.world, material, outcome));
    return result;
}

static pbmpm_result give_material(const void *structure, void *outcome)
{
    const pbmpm_result result = pbmpm_material_set(world.world, world.material, structure);
    if (result == PBMPM_OK) OK(pbmpm_material_get(world.world, world.material, outcome));
    return result;
}

static void sound_collider(void *structure)
{
    pbmpm_collider_def *def = structure;
    *def = default_collider();
    def->friction = PBMPM_FRICTION_STICK;
    def->user_data = 12;
}

static pbmpm_result give_collider(const void *structure, void *outcome)
{
    const pbmpm_shape shape = box_shape(1, 0.5f, 0, 0.2f, 0.2f, 0.2f);
    pbmpm_collider_id collider;
    const pbmpm_result result = pbmpm_collider_create(world.world, structure, &shape, &collider);
    if (result == PBMPM_OK) OK(pbmpm_collider_get(world.world, collider, outcome, NULL));
    return result;
}

/* Over the lower part of the block that is there. */
static void sound_shape(void *structure)
{
    const pbmpm_shape shape = sphere_shape(1, 0.6f, 0, 0.2f);
    memcpy(structure, &shape, sizeof shape);
}

static pbmpm_result give_changed_collider(const void *structure, void *outcome)
{
    const pbmpm_result result = pbmpm_collider_set(world.world, world.collider, structure, NULL);
    if (result == PBMPM_OK) OK(pbmpm_collider_get(world.world, world.collider, outcome, NULL));
    return result;
}

static pbmpm_result give_changed_collider_shape(const void *structure, void *outcome)
{
    const pbmpm_result result = pbmpm_collider_set(world.world, world.collider, NULL, structure);
    if (result == PBMPM_OK) OK(pbmpm_collider_get(world.world, world.collider, NULL, outcome));
    return result;
}

static void sound_wall(void *structure)
{
    pbmpm_domain_wall *wall = structure;
    *wall = (pbmpm_domain_wall){.size = sizeof *wall, .friction = PBMPM_FRICTION_STICK, .friction_coefficient = 0.25f};
}

static pbmpm_result give_wall(const void *structure, void *outcome)
{
    const pbmpm_result result = pbmpm_domain_wall_set(world.world, 0, 1, structure);
    if (result == PBMPM_OK) OK(pbmpm_domain_wall_get(world.world, 0, 1, outcome));
    return result;
}

static pbmpm_result give_collider_shape(const void *structure, void *outcome)
{
    const pbmpm_collider_def def = default_collider();
    pbmpm_collider_id collider;
    const pbmpm_result result = pbmpm_collider_create(world.world, &def, structure, &collider);
    if (result == PBMPM_OK) OK(pbmpm_collider_get(world.world, collider, NULL, outcome));
    return result;
}

static pbmpm_result give_fill_shape(const void *structure, void *outcome)
{
    const pbmpm_fill_def fill = default_fill(world.spare);
    return pbmpm_particles_fill(world.world, &fill, structure, outcome);
}

static pbmpm_result give_removed_shape(const void *structure, void *outcome)
{
    return pbmpm_particles_remove_in(world.world, structure, outcome);
}

static pbmpm_result give_asked_shape(const void *structure, void *outcome)
{
    return pbmpm_query_shape(world.world, structure, NULL, 0, outcome);
}

static pbmpm_result give_asked_region(const void *structure, void *outcome)
{
    return pbmpm_query_region(world.world, structure, NULL, 0, outcome);
}

static pbmpm_result give_woken_shape(const void *structure, void *outcome)
{
    (void)outcome;
    return pbmpm_world_wake(world.world, structure);
}

static void sound_emitter(void *structure)
{
    pbmpm_emitter_def *def = structure;
    OK(pbmpm_emitter_def_init(def, sizeof *def));
    def->material = world.material;
    def->rate = 2;
    def->fill_limit = 100;
    def->user_data = 12;
}

static void sound_drain(void *structure)
{
    pbmpm_drain_def *def = structure;
    OK(pbmpm_drain_def_init(def, sizeof *def));
    def->material = world.material;
    def->user_data = 12;
}

static void sound_force(void *structure)
{
    pbmpm_force_def *def = structure;
    OK(pbmpm_force_def_init(def, sizeof *def));
    def->kind = PBMPM_FORCE_RADIAL;
    def->strength = 5;
    def->user_data = 12;
}

/* What is given along with a structure also differs from what is there: it must not be taken when the structure is refused. */
#define GIVE_KIND(kind)                                                                                                 \
    static pbmpm_result give_new_##kind(const void *structure, void *outcome)                                           \
    {                                                                                                                   \
        pbmpm_shape shape;                                                                                              \
        pbmpm_##kind##_id id;                                                                                           \
        sound_shape(&shape);                                                                                            \
        const pbmpm_result result = pbmpm_##kind##_create(world.world, structure, &shape, &id);                         \
        if (result == PBMPM_OK) OK(pbmpm_##kind##_get(world.world, id, outcome, NULL));                                 \
        return result;                                                                                                  \
    }                                                                                                                   \
    static pbmpm_result give_new_##kind##_shape(const void *structure, void *outcome)                                   \
    {                                                                                                                   \
        pbmpm_##kind##_def def;                                                                                         \
        pbmpm_##kind##_id id;                                                                                           \
        sound_##kind(&def);                                                                                             \
        const pbmpm_result result = pbmpm_##kind##_create(world.world, &def, structure, &id);                           \
        if (result == PBMPM_OK) OK(pbmpm_##kind##_get(world.world, id, NULL, outcome));                                 \
        return result;                                                                                                  \
    }                                                                                                                   \
    static pbmpm_result give_##kind(const void *structure, void *outcome)                                               \
    {                                                                                                                   \
        pbmpm_shape shape;                                                                                              \
        sound_shape(&shape);                                                                                            \
        const pbmpm_result result = pbmpm_##kind##_set(world.world, world.kind, structure, &shape);                     \
        if (result == PBMPM_OK) OK(pbmpm_##kind##_get(world.world, world.kind, outcome, NULL));                         \
        return result;                                                                                                  \
    }                                                                                                                   \
    static pbmpm_result give_##kind##_shape(const void *structure, void *outcome)                                       \
    {                                                                                                                   \
        pbmpm_##kind##_def def;                                                                                         \
        sound_##kind(&def);                                                                                             \
        const pbmpm_result result = pbmpm_##kind##_set(world.world, world.kind, &def, structure);                       \
        if (result == PBMPM_OK) OK(pbmpm_##kind##_get(world.world, world.kind, NULL, outcome));                         \
        return result;                                                                                                  \
    }
GIVE_KIND(emitter)
GIVE_KIND(drain)
GIVE_KIND(force)

static void sound_fill(void *structure)
{
    pbmpm_fill_def *fill = structure;
    *fill = default_fill(world.spare);
    fill->seed = 5;
    fill->velocity[1] = 1;
}

static pbmpm_result give_fill(const void *structure, void *outcome)
{
    const pbmpm_shape shape = box_shape(1.7f, 1.7f, 0, 0.2f, 0.2f, 0.2f);
    return pbmpm_particles_fill(world.world, structure, &shape, outcome);
}

static void sound_particles(void *structure)
{
    static const float positions[4] = {1.5f, 1.5f, 1.75f, 1.5f}, velocities[4] = {1, 0, 0, 1};
    pbmpm_particles_def *def = structure;
    OK(pbmpm_particles_def_init(def, sizeof *def));
    def->count = 2;
    def->material = world.spare;
    def->volume = 0.002f;
    def->positions = positions;
    def->velocities = velocities;
}

static pbmpm_result give_particles(const void *structure, void *outcome)
{
    const pbmpm_result result = pbmpm_particles_add(world.world, structure, NULL);
    if (result == PBMPM_OK) *(uint64_t *)outcome = world_count(world.world);
    return result;
}

static void sound_bounds(void *structure)
{
    pbmpm_kill_bounds *bounds = structure;
    OK(pbmpm_kill_bounds_init(bounds, sizeof *bounds));
    bounds->enabled = 1;
    bounds->high[0] = bounds->high[1] = 1.2f;
}

static pbmpm_result give_bounds(const void *structure, void *outcome)
{
    const pbmpm_result result = pbmpm_world_set_kill_bounds(world.world, structure);
    if (result == PBMPM_OK) OK(pbmpm_world_get_kill_bounds(world.world, outcome));
    return result;
}

static char baked[1 << 16];
static uint64_t baked_bytes;

static uint64_t hash_of_baked(void)
{
    uint64_t hash = 1469598103934665603u; /* FNV-1a */
    for (uint64_t i = 0; i < baked_bytes; i++) hash = (hash ^ (unsigned char)baked[i]) * 1099511628211u;
    return hash;
}

static void sound_mesh(void *structure)
{
    static const float vertices[6] = {0, 0, 1, 0, 0, 1};
    static const uint32_t edges[6] = {0, 1, 1, 2, 2, 0};
    pbmpm_mesh_def *def = structure;
    OK(pbmpm_mesh_def_init(def, sizeof *def));
    def->dimension = 2;
    def->resolution = 8;
    def->vertex_count = def->element_count = 3;
    def->vertices = vertices;
    def->elements = edges;
}

static pbmpm_result give_mesh(const void *structure, void *outcome)
{
    const pbmpm_result result = pbmpm_bake_mesh(structure, baked, sizeof baked, &baked_bytes);
    if (result == PBMPM_OK) *(uint64_t *)outcome = hash_of_baked();
    return result;
}

static void sound_hull(void *structure)
{
    pbmpm_mesh_def *def = structure;
    sound_mesh(def);
    def->element_count = 0;
    def->elements = NULL;
}

static pbmpm_result give_hull(const void *structure, void *outcome)
{
    const pbmpm_result result = pbmpm_bake_hull(structure, baked, sizeof baked, &baked_bytes);
    if (result == PBMPM_OK) *(uint64_t *)outcome = hash_of_baked();
    return result;
}

static void sound_heights(void *structure)
{
    static const float heights[8] = {0.1f, 0.2f, 0.1f, 0.3f, 0, 0.1f, 0.2f, 0.3f};
    pbmpm_heights_def *def = structure;
    OK(pbmpm_heights_def_init(def, sizeof *def));
    def->dimension = 2;
    def->count[0] = 8;
    def->spacing[0] = 0.5f;
    def->heights = heights;
}

static pbmpm_result give_heights(const void *structure, void *outcome)
{
    const pbmpm_result result = pbmpm_bake_heights(structure, baked, sizeof baked, &baked_bytes);
    if (result == PBMPM_OK) *(uint64_t *)outcome = hash_of_baked();
    return result;
}

static void sound_ray(void *structure)
{
    pbmpm_ray *ray = structure;
    OK(pbmpm_ray_init(ray, sizeof *ray));
    ray->origin[0] = 1;
    ray->origin[1] = 1.9f;
    ray->level = 0.25f;
}

static pbmpm_result give_ray(const void *structure, void *outcome)
{
    pbmpm_ray_hit hit = {.size = sizeof hit};
    const pbmpm_result result = pbmpm_query_ray(world.world, structure, &hit);
    if (result != PBMPM_OK) return result;
    TEST_ASSERT_EQUAL_INT32(1, hit.hit);
    memcpy(outcome, &hit.distance, sizeof hit.distance);
    return PBMPM_OK;
}

static void sound_rigid(void *structure)
{
    pbmpm_rigid_def *def = structure;
    OK(pbmpm_rigid_def_init(def, sizeof *def));
    def->moves = PBMPM_FREEDOM_AXIS;
    def->force[1] = 3;
}

static pbmpm_rigid_state moving_state(void)
{
    return (pbmpm_rigid_state){.size = sizeof(pbmpm_rigid_state), .position = {1, 1}, .rotation = {0, 0, 0, 1}, .velocity = {0, 2}};
}

static pbmpm_result give_rigid(const void *structure, void *outcome)
{
    pbmpm_rigid_state state = moving_state();
    const pbmpm_result result = pbmpm_rigid_advance(world.world, world.collider, structure, &state, 0.01f);
    memcpy(outcome, &state.position[1], sizeof(float));
    return result;
}

static void sound_copy(void *structure)
{
    static const pbmpm_field fields[] = {PBMPM_POSITION};
    pbmpm_copy_def *def = structure;
    OK(pbmpm_copy_def_init(def, sizeof *def));
    def->fields = fields;
    def->field_count = 1;
    def->stride = 12;
}

static pbmpm_result give_copy(const void *structure, void *outcome)
{
    static float buffer[1 << 16];
    return pbmpm_particles_copy(world.world, structure, buffer, sizeof buffer, outcome);
}

/* Surfaces are of worlds in 3D. */
static pbmpm_world_id world_in_3d(void)
{
    const pbmpm_world_def def = default_world(3, 0.1f, 1000);
    const pbmpm_world_id made = create_world(&def);
    fill_shape(made, create_material(made, PBMPM_LIQUID), box_shape(0, 0, 0, 0.2f, 0.2f, 0.2f), (const float[3]){0, 0, 0});
    return made;
}

static void sound_surface(void *structure)
{
    pbmpm_surface_def *def = structure;
    OK(pbmpm_surface_def_init(def, sizeof *def));
    def->subdivision = 1;
    def->level = 0.4f;
}

static pbmpm_result give_surface(const void *structure, void *outcome)
{
    const pbmpm_world_id solid = world_in_3d();
    pbmpm_surface_mesh mesh = {.size = sizeof mesh};
    const pbmpm_result result = pbmpm_surface_extract(solid, structure, &mesh);
    memcpy(outcome, &mesh.vertex_count, sizeof mesh.vertex_count);
    OK(pbmpm_world_destroy(solid));
    return result;
}

/* Its pointers are read: none. */
static pbmpm_result take_mesh(void *structure)
{
    const pbmpm_world_id solid = world_in_3d();
    uint32_t size;
    memcpy(&size, structure, sizeof size);
    if (size >= sizeof(pbmpm_surface_mesh) && size <= 4096) memset((char *)structure + sizeof size, 0, size - sizeof size);
    const pbmpm_result result = pbmpm_surface_extract(solid, NULL, structure);
    OK(pbmpm_world_destroy(solid));
    return result;
}

static void sound_points(void *structure)
{
    pbmpm_points_def *def = structure;
    OK(pbmpm_points_def_init(def, sizeof *def));
    def->radius_scale = 2.0f;
}

static pbmpm_result give_points(const void *structure, void *outcome)
{
    static pbmpm_point points[1 << 13];
    uint32_t count;
    const pbmpm_result result = pbmpm_surface_points(world.world, structure, points, 1 << 13, &count);
    memcpy(outcome, &points[0].radius, sizeof points[0].radius);
    return result;
}

#define READ_BACK(type, call, fill, give) {#type, #call, sizeof(type), fill, give, true}
#define COUNTED(type, call, fill, give) {#type, #call, sizeof(type), fill, give, false}

const sized_input sized_inputs[] = {
    READ_BACK(pbmpm_world_def, pbmpm_world_create, sound_world_def, give_world_def),
    READ_BACK(pbmpm_allocator, pbmpm_world_create, sound_allocator, give_allocator),
    READ_BACK(pbmpm_task_hooks, pbmpm_world_create, sound_task_hooks, give_task_hooks),
    READ_BACK(pbmpm_settings, pbmpm_world_set_settings, sound_settings, give_settings),
    READ_BACK(pbmpm_material_def, pbmpm_material_create, sound_material, give_new_material),
    READ_BACK(pbmpm_material_def, pbmpm_material_set, sound_material, give_material),
    READ_BACK(pbmpm_collider_def, pbmpm_collider_create, sound_collider, give_collider),
    READ_BACK(pbmpm_shape, pbmpm_collider_create, sound_shape, give_collider_shape),
    READ_BACK(pbmpm_collider_def, pbmpm_collider_set, sound_collider, give_changed_collider),
    READ_BACK(pbmpm_shape, pbmpm_collider_set, sound_shape, give_changed_collider_shape),
    READ_BACK(pbmpm_domain_wall, pbmpm_domain_wall_set, sound_wall, give_wall),
    COUNTED(pbmpm_shape, pbmpm_particles_fill, sound_shape, give_fill_shape),
    COUNTED(pbmpm_shape, pbmpm_particles_remove_in, sound_shape, give_removed_shape),
    COUNTED(pbmpm_shape, pbmpm_query_shape, sound_shape, give_asked_shape),
    COUNTED(pbmpm_shape, pbmpm_query_region, sound_shape, give_asked_region),
    COUNTED(pbmpm_shape, pbmpm_world_wake, sound_shape, give_woken_shape),
    READ_BACK(pbmpm_emitter_def, pbmpm_emitter_create, sound_emitter, give_new_emitter),
    READ_BACK(pbmpm_shape, pbmpm_emitter_create, sound_shape, give_new_emitter_shape),
    READ_BACK(pbmpm_emitter_def, pbmpm_emitter_set, sound_emitter, give_emitter),
    READ_BACK(pbmpm_shape, pbmpm_emitter_set, sound_shape, give_emitter_shape),
    READ_BACK(pbmpm_drain_def, pbmpm_drain_create, sound_drain, give_new_drain),
    READ_BACK(pbmpm_shape, pbmpm_drain_create, sound_shape, give_new_drain_shape),
    READ_BACK(pbmpm_drain_def, pbmpm_drain_set, sound_drain, give_drain),
    READ_BACK(pbmpm_shape, pbmpm_drain_set, sound_shape, give_drain_shape),
    READ_BACK(pbmpm_force_def, pbmpm_force_create, sound_force, give_new_force),
    READ_BACK(pbmpm_shape, pbmpm_force_create, sound_shape, give_new_force_shape),
    READ_BACK(pbmpm_force_def, pbmpm_force_set, sound_force, give_force),
    READ_BACK(pbmpm_shape, pbmpm_force_set, sound_shape, give_force_shape),
    COUNTED(pbmpm_fill_def, pbmpm_particles_fill, sound_fill, give_fill),
    COUNTED(pbmpm_particles_def, pbmpm_particles_add, sound_particles, give_particles),
    READ_BACK(pbmpm_kill_bounds, pbmpm_world_set_kill_bounds, sound_bounds, give_bounds),
    COUNTED(pbmpm_mesh_def, pbmpm_bake_mesh, sound_mesh, give_mesh),
    COUNTED(pbmpm_mesh_def, pbmpm_bake_hull, sound_hull, give_hull),
    COUNTED(pbmpm_heights_def, pbmpm_bake_heights, sound_heights, give_heights),
    COUNTED(pbmpm_ray, pbmpm_query_ray, sound_ray, give_ray),
    COUNTED(pbmpm_rigid_def, pbmpm_rigid_advance, sound_rigid, give_rigid),
    COUNTED(pbmpm_copy_def, pbmpm_particles_copy, sound_copy, give_copy),
    COUNTED(pbmpm_surface_def, pbmpm_surface_extract, sound_surface, give_surface),
    COUNTED(pbmpm_points_def, pbmpm_surface_points, sound_points, give_points),
};
const int sized_input_count = (int)(sizeof sized_inputs / sizeof *sized_inputs);

/* ---- Structures that calls write ---- */

static pbmpm_result take_ray_hit(void *structure)
{
    pbmpm_ray ray;
    sound_ray(&ray);
    return pbmpm_query_ray(world.world, &ray, structure);
}

static pbmpm_result take_inspected(void *structure)
{
    pbmpm_mesh_def def;
    sound_mesh(&def);
    OK(pbmpm_bake_mesh(&def, baked, sizeof baked, &baked_bytes));
    return pbmpm_baked_inspect(baked, baked_bytes, structure);
}

#define TAKE(name, call) static pbmpm_result take_##name(void *structure) { return call; }
TAKE(world_def, pbmpm_world_get_def(world.world, structure))
TAKE(settings, pbmpm_world_get_settings(world.world, structure))
TAKE(material, pbmpm_material_get(world.world, world.material, structure))
TAKE(effective, pbmpm_material_effective(world.world, world.material, 0.01f, structure))
TAKE(collider, pbmpm_collider_get(world.world, world.collider, structure, NULL))
TAKE(collider_shape, pbmpm_collider_get(world.world, world.collider, NULL, structure))
TAKE(collider_impulse, pbmpm_collider_impulse(world.world, world.collider, structure))
TAKE(domain_impulse, pbmpm_domain_impulse(world.world, 1, 0, structure))
TAKE(domain_wall, pbmpm_domain_wall_get(world.world, 1, 0, structure))
TAKE(submersion, pbmpm_collider_submerged(world.world, world.collider, NULL, structure))
TAKE(baked_info, pbmpm_baked_get(world.world, world.baked, structure))
TAKE(view, pbmpm_particles_view(world.world, PBMPM_VELOCITY, structure))
TAKE(emitter, pbmpm_emitter_get(world.world, world.emitter, structure, NULL))
TAKE(emitter_shape, pbmpm_emitter_get(world.world, world.emitter, NULL, structure))
TAKE(emitter_status, pbmpm_emitter_status_get(world.world, world.emitter, structure))
TAKE(drain, pbmpm_drain_get(world.world, world.drain, structure, NULL))
TAKE(drain_shape, pbmpm_drain_get(world.world, world.drain, NULL, structure))
TAKE(drain_status, pbmpm_drain_status_get(world.world, world.drain, structure))
TAKE(force, pbmpm_force_get(world.world, world.force, structure, NULL))
TAKE(force_shape, pbmpm_force_get(world.world, world.force, NULL, structure))
TAKE(force_status, pbmpm_force_status_get(world.world, world.force, structure))
TAKE(bounds, pbmpm_world_get_kill_bounds(world.world, structure))
TAKE(flow, pbmpm_world_get_flow(world.world, structure))
TAKE(stats, pbmpm_world_get_stats(world.world, structure))

static pbmpm_result take_mass(void *structure)
{
    const pbmpm_shape shape = default_shape();
    return pbmpm_shape_mass(world.world, &shape, 1.0f, structure);
}

static pbmpm_result take_rigid_state(void *structure)
{
    pbmpm_rigid_def def;
    OK(pbmpm_rigid_def_init(&def, sizeof def));
    return pbmpm_rigid_begin(world.world, world.collider, &def, structure);
}

#define TAKEN(type, call, take) {#type, #call, sizeof(type), take}

const sized_output sized_outputs[] = {
    TAKEN(pbmpm_world_def, pbmpm_world_get_def, take_world_def),
    TAKEN(pbmpm_settings, pbmpm_world_get_settings, take_settings),
    TAKEN(pbmpm_material_def, pbmpm_material_get, take_material),
    TAKEN(pbmpm_effective, pbmpm_material_effective, take_effective),
    TAKEN(pbmpm_collider_def, pbmpm_collider_get, take_collider),
    TAKEN(pbmpm_shape, pbmpm_collider_get, take_collider_shape),
    TAKEN(pbmpm_impulse, pbmpm_collider_impulse, take_collider_impulse),
    TAKEN(pbmpm_domain_wall, pbmpm_domain_wall_get, take_domain_wall),
    TAKEN(pbmpm_impulse, pbmpm_domain_impulse, take_domain_impulse),
    TAKEN(pbmpm_submersion, pbmpm_collider_submerged, take_submersion),
    TAKEN(pbmpm_mass_properties, pbmpm_shape_mass, take_mass),
    TAKEN(pbmpm_rigid_state, pbmpm_rigid_begin, take_rigid_state),
    TAKEN(pbmpm_baked_info, pbmpm_baked_get, take_baked_info),
    TAKEN(pbmpm_baked_info, pbmpm_baked_inspect, take_inspected),
    TAKEN(pbmpm_view, pbmpm_particles_view, take_view),
    TAKEN(pbmpm_emitter_def, pbmpm_emitter_get, take_emitter),
    TAKEN(pbmpm_shape, pbmpm_emitter_get, take_emitter_shape),
    TAKEN(pbmpm_emitter_status, pbmpm_emitter_status_get, take_emitter_status),
    TAKEN(pbmpm_drain_def, pbmpm_drain_get, take_drain),
    TAKEN(pbmpm_shape, pbmpm_drain_get, take_drain_shape),
    TAKEN(pbmpm_drain_status, pbmpm_drain_status_get, take_drain_status),
    TAKEN(pbmpm_force_def, pbmpm_force_get, take_force),
    TAKEN(pbmpm_shape, pbmpm_force_get, take_force_shape),
    TAKEN(pbmpm_force_status, pbmpm_force_status_get, take_force_status),
    TAKEN(pbmpm_kill_bounds, pbmpm_world_get_kill_bounds, take_bounds),
    TAKEN(pbmpm_flow, pbmpm_world_get_flow, take_flow),
    TAKEN(pbmpm_stats, pbmpm_world_get_stats, take_stats),
    TAKEN(pbmpm_ray_hit, pbmpm_query_ray, take_ray_hit),
    TAKEN(pbmpm_surface_mesh, pbmpm_surface_extract, take_mesh),
};
const int sized_output_count = (int)(sizeof sized_outputs / sizeof *sized_outputs);

/* ---- Arrays that calls write ---- */

static pbmpm_result list_events(void *array, uint32_t capacity, uint32_t *count)
{
    return pbmpm_world_events(world.world, array, capacity, count, NULL);
}

static pbmpm_result list_touches(void *array, uint32_t capacity, uint32_t *count)
{
    return pbmpm_world_touches(world.world, array, capacity, count);
}

static pbmpm_result list_advice(void *array, uint32_t capacity, uint32_t *count)
{
    return pbmpm_world_advice(world.world, 0.01f, array, capacity, count);
}

static pbmpm_result list_region(void *array, uint32_t capacity, uint32_t *count)
{
    const pbmpm_shape all = box_shape(1, 1, 0, 1, 1, 1);
    return pbmpm_query_region(world.world, &all, array, capacity, count);
}

#define LISTS(type, call, list) {#type, #call, sizeof(type), list}

const sized_array sized_arrays[] = {
    LISTS(pbmpm_event, pbmpm_world_events, list_events),
    LISTS(pbmpm_touch, pbmpm_world_touches, list_touches),
    LISTS(pbmpm_advice, pbmpm_world_advice, list_advice),
    LISTS(pbmpm_region_share, pbmpm_query_region, list_region),
};
const int sized_array_count = (int)(sizeof sized_arrays / sizeof *sized_arrays);

/* Three materials with particles, three events, and what no scene holds. */
void make_arrays_busy(void)
{
    const float position[2] = {1, 1};
    pbmpm_particles_def def;
    fill_shape(world.world, world.spare, box_shape(1.7f, 1.7f, 0, 0.1f, 0.1f, 0.1f), (const float[3]){0, 0, 0});
    pbmpm_material_def grains = default_material(PBMPM_SAND);
    pbmpm_material_id sand;
    grains.rebound_max = 0.5f; /* for the paper's solver alone */
    OK(pbmpm_material_create(world.world, &grains, &sand));
    fill_shape(world.world, sand, box_shape(0.2f, 1.7f, 0, 0.1f, 0.1f, 0.1f), (const float[3]){500, 0, 0});
    OK(pbmpm_particles_def_init(&def, sizeof def));
    def.material = world.material;
    def.positions = position;
    for (uint32_t i = 0; i < 3; i++) {
        def.count = 4000 + i; /* more than there is room for */
        EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_particles_add(world.world, &def, NULL));
    }
    pbmpm_collider_def everywhere = default_collider();
    pbmpm_collider_id sensor;
    pbmpm_touch touches[8] = {{.size = sizeof touches[0]}};
    const pbmpm_shape ball = sphere_shape(1, 1, 0, 10);
    uint32_t count;
    everywhere.sensor = everywhere.reports_touches = 1;
    OK(pbmpm_collider_create(world.world, &everywhere, &ball, &sensor));
    OK(pbmpm_world_touches(world.world, touches, 8, &count)); /* from here on they stay */
}

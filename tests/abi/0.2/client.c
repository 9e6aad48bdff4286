/* A program of version 0.2: uses every structure that it knows, with a guard behind each that the library writes, and prints what it gets.
 * Later libraries must give it the same. Compiled with the header beside it; never edited once that version is released. */
#include <pbmpm/pbmpm.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { GUARD = 64, PATTERN = 0x5a, EVENTS = 8 };

#define REQUIRE(condition) ((condition) ? (void)0 : stop(#condition, __LINE__))
#define OK(call) REQUIRE((call) == PBMPM_OK)

static void stop(const char *what, int line)
{
    fprintf(stderr, "client.c:%d: %s: %s\n", line, what, pbmpm_last_error());
    exit(1);
}

/* `count` structures of `size` bytes with a guard behind them. */
static void *guarded(size_t size, size_t count)
{
    char *memory = malloc(size * count + GUARD);
    const uint32_t first = (uint32_t)size;
    REQUIRE(memory);
    memset(memory, PATTERN, size * count + GUARD);
    memcpy(memory, &first, sizeof first);
    return memory;
}

static void release(void *memory, size_t size, size_t count)
{
    const char *guard = (const char *)memory + size * count;
    for (int i = 0; i < GUARD; i++) REQUIRE(guard[i] == PATTERN);
    free(memory);
}

#define NEW(type) ((type *)guarded(sizeof(type), 1))
#define DELETE(pointer) release(pointer, sizeof *(pointer), 1)

static void *take(size_t size, size_t alignment, void *user)
{
    ++*(int *)user;
    return aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

static void give(void *memory, size_t size, void *user)
{
    (void)size;
    --*(int *)user;
    free(memory);
}

static void *run_all(pbmpm_task *task, int32_t count, void *context, void *user)
{
    ++*(int *)user;
    for (int32_t i = 0; i < count; i++) task(i, context);
    return NULL;
}

static void nothing(void *handle, void *user)
{
    (void)handle;
    (void)user;
}

static int blocks, jobs;

static pbmpm_world_id make_world(void)
{
    pbmpm_allocator *allocator = NEW(pbmpm_allocator);
    pbmpm_task_hooks *tasks = NEW(pbmpm_task_hooks);
    pbmpm_world_def *def = NEW(pbmpm_world_def);
    pbmpm_settings *settings = NEW(pbmpm_settings);
    pbmpm_world_id world;
    *allocator = (pbmpm_allocator){sizeof *allocator, take, give, &blocks};
    *tasks = (pbmpm_task_hooks){sizeof *tasks, 0, run_all, nothing, &jobs};
    OK(pbmpm_world_def_init(def, sizeof *def));
    def->dimension = 2;
    def->particle_capacity = 4000;
    def->thread_count = 2;
    def->domain_enabled = def->domain_measures_impulse = 1;
    def->domain_max[0] = def->domain_max[1] = 3.0f;
    def->allocator = allocator;
    def->tasks = tasks;
    def->user_data = 77;
    OK(pbmpm_world_create(def, &world));
    OK(pbmpm_settings_init(settings, sizeof *settings));
    settings->gravity[1] = -9.81f;
    OK(pbmpm_world_set_settings(world, settings));
    OK(pbmpm_world_get_settings(world, settings));
    REQUIRE(settings->gravity[1] == -9.81f && settings->iterations == 5);
    OK(pbmpm_world_get_def(world, def));
    REQUIRE(def->user_data == 77 && def->allocator->user == &blocks && def->tasks->user == &jobs);
    DELETE(allocator);
    DELETE(tasks);
    DELETE(def);
    DELETE(settings);
    return world;
}

static pbmpm_material_id add_material(pbmpm_world_id world, pbmpm_material_kind kind)
{
    pbmpm_material_def *def = NEW(pbmpm_material_def);
    pbmpm_effective *effective = NEW(pbmpm_effective);
    pbmpm_material_id id;
    OK(pbmpm_material_def_init(def, sizeof *def));
    def->kind = kind;
    OK(pbmpm_material_create(world, def, &id));
    def->relaxation = 1.25f;
    OK(pbmpm_material_set(world, id, def));
    OK(pbmpm_material_get(world, id, def));
    OK(pbmpm_material_effective(world, id, 0.01f, effective));
    printf("material %d: %g %g\n", (int)def->kind, (double)def->relaxation, (double)effective->young_modulus);
    DELETE(def);
    DELETE(effective);
    return id;
}

static pbmpm_shape *new_box(float x, float y, float half_x, float half_y)
{
    pbmpm_shape *shape = NEW(pbmpm_shape);
    OK(pbmpm_shape_init(shape, sizeof *shape));
    shape->position[0] = x;
    shape->position[1] = y;
    shape->half_extents[0] = half_x;
    shape->half_extents[1] = half_y;
    return shape;
}

static void fill(pbmpm_world_id world, pbmpm_material_id material, float x, float y, float half)
{
    pbmpm_fill_def *def = NEW(pbmpm_fill_def);
    pbmpm_shape *shape = new_box(x, y, half, half);
    pbmpm_particles_def *more = NEW(pbmpm_particles_def);
    const float place[2] = {x, y + half + 0.1f};
    uint32_t added;
    OK(pbmpm_fill_def_init(def, sizeof *def));
    def->material = material;
    OK(pbmpm_particles_fill(world, def, shape, &added));
    OK(pbmpm_particles_def_init(more, sizeof *more));
    more->material = material;
    more->count = 1;
    more->positions = place;
    OK(pbmpm_particles_add(world, more, NULL));
    printf("%u particles\n", added + 1);
    DELETE(def);
    DELETE(shape);
    DELETE(more);
}

static pbmpm_baked_id bake(pbmpm_world_id world)
{
    static const float vertices[] = {-0.2f, -0.2f, 0.2f, -0.2f, 0, 0.2f};
    static const uint32_t edges[] = {0, 1, 1, 2, 2, 0};
    static const float heights[] = {0, 0.1f, 0};
    pbmpm_mesh_def *mesh = NEW(pbmpm_mesh_def);
    pbmpm_heights_def *ground = NEW(pbmpm_heights_def);
    pbmpm_baked_info *info = NEW(pbmpm_baked_info);
    pbmpm_baked_id id;
    uint64_t bytes, needed;
    OK(pbmpm_mesh_def_init(mesh, sizeof *mesh));
    mesh->dimension = 2;
    mesh->vertices = vertices;
    mesh->elements = edges;
    mesh->vertex_count = mesh->element_count = 3;
    OK(pbmpm_bake_mesh(mesh, NULL, 0, &bytes));
    void *data = malloc(bytes);
    OK(pbmpm_bake_mesh(mesh, data, bytes, &bytes));
    OK(pbmpm_baked_inspect(data, bytes, info));
    OK(pbmpm_baked_create(world, data, bytes, &id));
    OK(pbmpm_baked_get(world, id, info));
    OK(pbmpm_heights_def_init(ground, sizeof *ground));
    ground->dimension = 2;
    ground->count[0] = 3;
    ground->heights = heights;
    OK(pbmpm_bake_heights(ground, NULL, 0, &needed));
    printf("baked: %u x %u, %llu and %llu bytes\n", info->count[0], info->count[1], (unsigned long long)info->bytes, (unsigned long long)needed);
    free(data);
    DELETE(mesh);
    DELETE(ground);
    DELETE(info);
    return id;
}

static pbmpm_collider_id add_colliders(pbmpm_world_id world)
{
    pbmpm_collider_def *def = NEW(pbmpm_collider_def);
    pbmpm_shape *shape = new_box(1.5f, 0.3f, 0.3f, 0.1f);
    pbmpm_collider_id box, solid;
    OK(pbmpm_collider_def_init(def, sizeof *def));
    def->measures_impulse = 1;
    OK(pbmpm_collider_create(world, def, shape, &box));
    shape->kind = PBMPM_BAKED;
    shape->baked = bake(world);
    shape->position[0] = 2.5f;
    OK(pbmpm_collider_create(world, def, shape, &solid));
    OK(pbmpm_collider_get(world, solid, def, shape));
    REQUIRE(def->measures_impulse == 1 && shape->position[0] == 2.5f);
    DELETE(def);
    DELETE(shape);
    return box;
}

static void add_flow(pbmpm_world_id world, pbmpm_material_id material)
{
    pbmpm_emitter_def *emitter = NEW(pbmpm_emitter_def);
    pbmpm_emitter_status *emitted = NEW(pbmpm_emitter_status);
    pbmpm_drain_def *drain = NEW(pbmpm_drain_def);
    pbmpm_drain_status *drained = NEW(pbmpm_drain_status);
    pbmpm_force_def *force = NEW(pbmpm_force_def);
    pbmpm_force_status *felt = NEW(pbmpm_force_status);
    pbmpm_kill_bounds *bounds = NEW(pbmpm_kill_bounds);
    pbmpm_flow *flow = NEW(pbmpm_flow);
    pbmpm_shape *shape = new_box(0.5f, 2.5f, 0.2f, 0.2f);
    pbmpm_emitter_id emitter_id;
    pbmpm_drain_id drain_id;
    pbmpm_force_id force_id;
    OK(pbmpm_emitter_def_init(emitter, sizeof *emitter));
    emitter->material = material;
    emitter->rate = 1.0f;
    OK(pbmpm_emitter_create(world, emitter, shape, &emitter_id));
    OK(pbmpm_emitter_get(world, emitter_id, emitter, shape));
    OK(pbmpm_emitter_set(world, emitter_id, emitter, NULL));
    OK(pbmpm_drain_def_init(drain, sizeof *drain));
    OK(pbmpm_drain_create(world, drain, shape, &drain_id));
    shape->position[0] = 2.7f;
    OK(pbmpm_drain_set(world, drain_id, NULL, shape));
    OK(pbmpm_drain_get(world, drain_id, drain, shape));
    OK(pbmpm_force_def_init(force, sizeof *force));
    OK(pbmpm_force_create(world, force, shape, &force_id));
    OK(pbmpm_force_get(world, force_id, force, NULL));
    force->strength = 0.5f;
    OK(pbmpm_force_set(world, force_id, force, NULL));
    OK(pbmpm_kill_bounds_init(bounds, sizeof *bounds));
    OK(pbmpm_world_set_kill_bounds(world, bounds));
    OK(pbmpm_world_get_kill_bounds(world, bounds));
    for (int i = 0; i < 20; i++) OK(pbmpm_world_step(world, 0.01f));
    OK(pbmpm_emitter_status_get(world, emitter_id, emitted));
    OK(pbmpm_drain_status_get(world, drain_id, drained));
    OK(pbmpm_force_status_get(world, force_id, felt));
    OK(pbmpm_world_get_flow(world, flow));
    printf("flow: %llu %llu %u %.9g %llu\n", (unsigned long long)emitted->emitted, (unsigned long long)drained->drained, felt->nodes,
           felt->impulse[1], (unsigned long long)flow->emitted);
    DELETE(emitter);
    DELETE(emitted);
    DELETE(drain);
    DELETE(drained);
    DELETE(force);
    DELETE(felt);
    DELETE(bounds);
    DELETE(flow);
    DELETE(shape);
}

static void ride(pbmpm_world_id world)
{
    pbmpm_collider_id collider;
    pbmpm_shape *shape = new_box(1.5f, 2.5f, 0.25f, 0.125f);
    pbmpm_collider_def *def = NEW(pbmpm_collider_def);
    OK(pbmpm_collider_def_init(def, sizeof *def));
    def->kinematic = def->measures_impulse = 1;
    OK(pbmpm_collider_create(world, def, shape, &collider));
    pbmpm_mass_properties *mass = NEW(pbmpm_mass_properties);
    pbmpm_submersion *submersion = NEW(pbmpm_submersion);
    pbmpm_rigid_def *rigid = NEW(pbmpm_rigid_def);
    pbmpm_rigid_state *state = NEW(pbmpm_rigid_state);
    OK(pbmpm_shape_mass(world, shape, 500.0f, mass));
    OK(pbmpm_collider_submerged(world, collider, NULL, submersion));
    OK(pbmpm_rigid_def_init(rigid, sizeof *rigid));
    rigid->mass = mass->mass;
    OK(pbmpm_rigid_begin(world, collider, rigid, state));
    OK(pbmpm_rigid_advance(world, collider, rigid, state, 0.01f));
    printf("rigid: %.9g kg, %.9g under, at %.9g\n", mass->mass, submersion->share, state->position[1]);
    OK(pbmpm_collider_destroy(world, collider));
    DELETE(shape);
    DELETE(def);
    DELETE(mass);
    DELETE(submersion);
    DELETE(rigid);
    DELETE(state);
}

static void ask(pbmpm_world_id world, pbmpm_collider_id collider)
{
    pbmpm_stats *stats = NEW(pbmpm_stats);
    pbmpm_impulse *impulse = NEW(pbmpm_impulse);
    pbmpm_view *view = NEW(pbmpm_view);
    pbmpm_ray *ray = NEW(pbmpm_ray);
    pbmpm_ray_hit *hit = NEW(pbmpm_ray_hit);
    pbmpm_shape *shape = new_box(1.5f, 1.5f, 1.5f, 1.5f);
    pbmpm_region_share *shares = guarded(sizeof *shares, 2);
    pbmpm_advice *advice = guarded(sizeof *advice, 4);
    pbmpm_event *events = guarded(sizeof *events, EVENTS);
    pbmpm_copy_def *copy = NEW(pbmpm_copy_def);
    static float drawn[1 << 16];
    uint32_t found, told, happened, missed, copied;
    OK(pbmpm_world_get_stats(world, stats));
    OK(pbmpm_collider_impulse(world, collider, impulse));
    OK(pbmpm_domain_impulse(world, 1, 0, impulse));
    OK(pbmpm_particles_view(world, PBMPM_POSITION, view));
    OK(pbmpm_ray_init(ray, sizeof *ray));
    ray->origin[0] = 1.0f;
    ray->origin[1] = 2.9f;
    OK(pbmpm_query_ray(world, ray, hit));
    OK(pbmpm_query_region(world, shape, shares, 2, &found));
    OK(pbmpm_world_advice(world, 0.01f, advice, 4, &told));
    OK(pbmpm_world_events(world, events, EVENTS, &happened, &missed));
    OK(pbmpm_copy_def_init(copy, sizeof *copy));
    copy->alpha = 0.5f;
    OK(pbmpm_particles_copy(world, copy, drawn, sizeof drawn, &copied));
    printf("copied %u, first at %.9g\n", copied, (double)drawn[1]);
    printf("stats: %u %.9g; impulse %.9g; view of %u; hit %d %.9g\n", stats->particle_count, stats->kinetic_energy, impulse->linear[1], view->count,
           hit->hit, (double)hit->distance);
    for (uint32_t i = 0; i < found && i < 2; i++) printf("share: %llu %.9g\n", (unsigned long long)shares[i].count, shares[i].volume);
    for (uint32_t i = 0; i < told && i < 4; i++) printf("advice: %d %.9g\n", (int)advice[i].code, (double)advice[i].figure);
    for (uint32_t i = 0; i < happened && i < EVENTS; i++) printf("event: %d %u %u\n", (int)events[i].kind, events[i].count, events[i].substep);
    DELETE(stats);
    DELETE(impulse);
    DELETE(view);
    DELETE(ray);
    DELETE(hit);
    DELETE(shape);
    DELETE(copy);
    release(shares, sizeof *shares, 2);
    release(advice, sizeof *advice, 4);
    release(events, sizeof *events, EVENTS);
}

static void save_and_restore(pbmpm_world_id world)
{
    uint64_t bytes, before, after;
    OK(pbmpm_snapshot_size(world, &bytes, NULL));
    void *data = malloc(bytes);
    OK(pbmpm_snapshot_save(world, data, bytes, NULL));
    OK(pbmpm_world_hash(world, &before));
    OK(pbmpm_world_step(world, 0.01f));
    OK(pbmpm_snapshot_restore(world, data, bytes, 0));
    OK(pbmpm_world_hash(world, &after));
    REQUIRE(before == after);
    printf("hash %016llx\n", (unsigned long long)after);
    free(data);
}

int main(void)
{
    const pbmpm_world_id world = make_world();
    const pbmpm_material_id water = add_material(world, PBMPM_LIQUID), jelly = add_material(world, PBMPM_ELASTIC);
    fill(world, water, 1.0f, 0.8f, 0.4f);
    fill(world, jelly, 2.0f, 1.5f, 0.2f);
    const pbmpm_collider_id box = add_colliders(world);
    add_flow(world, water);
    ride(world);
    ask(world, box);
    save_and_restore(world);
    OK(pbmpm_world_destroy(world));
    REQUIRE(blocks == 0);
    return 0;
}

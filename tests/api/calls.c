#include "calls.h"

/* Unchecked: a check that fails on another thread would jump out of it. */
static pbmpm_shape unit_box(void)
{
    pbmpm_shape shape;
    pbmpm_shape_init(&shape, sizeof shape);
    return shape;
}

static pbmpm_result call_get_def(const target *ids)
{
    pbmpm_world_def def = {.size = sizeof def};
    return pbmpm_world_get_def(ids->world, &def);
}

static pbmpm_result call_get_settings(const target *ids)
{
    pbmpm_settings settings = {.size = sizeof settings};
    return pbmpm_world_get_settings(ids->world, &settings);
}

static pbmpm_result call_set_settings(const target *ids)
{
    pbmpm_settings settings;
    pbmpm_settings_init(&settings, sizeof settings);
    return pbmpm_world_set_settings(ids->world, &settings);
}

static pbmpm_result call_step(const target *ids)
{
    return pbmpm_world_step(ids->world, 0.001f);
}

static pbmpm_result call_generation(const target *ids)
{
    uint64_t generation;
    return pbmpm_world_generation(ids->world, &generation);
}

static pbmpm_result call_hash(const target *ids)
{
    uint64_t hash;
    return pbmpm_world_hash(ids->world, &hash);
}

static pbmpm_result call_get_stats(const target *ids)
{
    pbmpm_stats stats = {.size = sizeof stats};
    return pbmpm_world_get_stats(ids->world, &stats);
}

static pbmpm_result call_get_step_stats(const target *ids)
{
    pbmpm_stats stats = {.size = sizeof stats};
    return pbmpm_world_get_step_stats(ids->world, &stats);
}

static pbmpm_result call_events(const target *ids)
{
    pbmpm_event event = {.size = sizeof event};
    uint32_t count, missed;
    return pbmpm_world_events(ids->world, &event, 1, &count, &missed);
}

static pbmpm_result call_material_create(const target *ids)
{
    pbmpm_material_def def;
    pbmpm_material_id material;
    pbmpm_material_def_init(&def, sizeof def);
    return pbmpm_material_create(ids->world, &def, &material);
}

static pbmpm_result call_material_get(const target *ids)
{
    pbmpm_material_def def = {.size = sizeof def};
    return pbmpm_material_get(ids->world, ids->material, &def);
}

static pbmpm_result call_material_effective(const target *ids)
{
    pbmpm_effective effective = {.size = sizeof effective};
    return pbmpm_material_effective(ids->world, ids->material, 0.001f, &effective);
}

static pbmpm_result call_material_set(const target *ids)
{
    pbmpm_material_def def;
    pbmpm_material_def_init(&def, sizeof def);
    def.kind = PBMPM_ELASTIC;
    return pbmpm_material_set(ids->world, ids->material, &def);
}

static pbmpm_result call_material_destroy(const target *ids)
{
    return pbmpm_material_destroy(ids->world, ids->spare);
}

static pbmpm_result call_collider_create(const target *ids)
{
    const pbmpm_shape shape = unit_box();
    pbmpm_collider_def def;
    pbmpm_collider_id collider;
    pbmpm_collider_def_init(&def, sizeof def);
    return pbmpm_collider_create(ids->world, &def, &shape, &collider);
}

static pbmpm_result call_collider_get(const target *ids)
{
    pbmpm_collider_def def = {.size = sizeof def};
    pbmpm_shape shape = {.size = sizeof shape};
    return pbmpm_collider_get(ids->world, ids->collider, &def, &shape);
}

static pbmpm_result call_collider_move(const target *ids)
{
    const float position[3] = {0.5f, 0.5f, 0};
    return pbmpm_collider_move(ids->world, ids->collider, position, NULL);
}

static pbmpm_result call_collider_teleport(const target *ids)
{
    const float position[3] = {0.5f, 0.25f, 0};
    return pbmpm_collider_teleport(ids->world, ids->collider, position, NULL);
}

static pbmpm_result call_query_collider(const target *ids)
{
    uint32_t count;
    return pbmpm_query_collider(ids->world, ids->collider, NULL, 0, &count);
}

static pbmpm_result call_collider_impulse(const target *ids)
{
    pbmpm_impulse impulse = {.size = sizeof impulse};
    return pbmpm_collider_impulse(ids->world, ids->collider, &impulse);
}

static pbmpm_result call_domain_impulse(const target *ids)
{
    pbmpm_impulse impulse = {.size = sizeof impulse};
    return pbmpm_domain_impulse(ids->world, 1, 0, &impulse);
}

static pbmpm_result call_collider_set(const target *ids)
{
    pbmpm_collider_def def;
    const pbmpm_shape shape = unit_box();
    pbmpm_collider_def_init(&def, sizeof def);
    def.kinematic = def.measures_impulse = 1;
    return pbmpm_collider_set(ids->world, ids->collider, &def, &shape);
}

static pbmpm_result call_domain_wall_get(const target *ids)
{
    pbmpm_domain_wall wall = {.size = sizeof wall};
    return pbmpm_domain_wall_get(ids->world, 1, 0, &wall);
}

static pbmpm_result call_domain_wall_set(const target *ids)
{
    pbmpm_domain_wall wall = {.size = sizeof wall};
    const pbmpm_result result = pbmpm_domain_wall_get(ids->world, 1, 0, &wall);
    return result == PBMPM_OK ? pbmpm_domain_wall_set(ids->world, 1, 0, &wall) : result;
}

static pbmpm_result call_touches(const target *ids)
{
    pbmpm_touch touches[8] = {{.size = sizeof touches[0]}};
    uint32_t count;
    return pbmpm_world_touches(ids->world, touches, 8, &count);
}

static pbmpm_result call_debug_lines(const target *ids)
{
    uint32_t count;
    return pbmpm_world_debug_lines(ids->world, PBMPM_DEBUG_ALL, NULL, 0, &count);
}

static pbmpm_result call_shift_origin(const target *ids)
{
    double moved[3];
    return pbmpm_world_shift_origin(ids->world, (const double[3]){0}, moved);
}

static pbmpm_result call_get_materials(const target *ids)
{
    pbmpm_material_id found[4];
    uint32_t count;
    return pbmpm_world_get_materials(ids->world, found, 4, &count);
}

static pbmpm_result call_get_colliders(const target *ids)
{
    pbmpm_collider_id found[4];
    uint32_t count;
    return pbmpm_world_get_colliders(ids->world, found, 4, &count);
}

static pbmpm_result call_get_emitters(const target *ids)
{
    pbmpm_emitter_id found[4];
    uint32_t count;
    return pbmpm_world_get_emitters(ids->world, found, 4, &count);
}

static pbmpm_result call_get_drains(const target *ids)
{
    pbmpm_drain_id found[4];
    uint32_t count;
    return pbmpm_world_get_drains(ids->world, found, 4, &count);
}

static pbmpm_result call_get_forces(const target *ids)
{
    pbmpm_force_id found[4];
    uint32_t count;
    return pbmpm_world_get_forces(ids->world, found, 4, &count);
}

static pbmpm_result call_collider_submerged(const target *ids)
{
    pbmpm_submersion submersion = {.size = sizeof submersion};
    return pbmpm_collider_submerged(ids->world, ids->collider, NULL, &submersion);
}

static pbmpm_result call_shape_mass(const target *ids)
{
    const pbmpm_shape shape = default_shape();
    pbmpm_mass_properties mass = {.size = sizeof mass};
    return pbmpm_shape_mass(ids->world, &shape, 1.0f, &mass);
}

static pbmpm_result call_rigid_begin(const target *ids)
{
    pbmpm_rigid_def def;
    pbmpm_rigid_state state = {.size = sizeof state};
    OK(pbmpm_rigid_def_init(&def, sizeof def));
    return pbmpm_rigid_begin(ids->world, ids->collider, &def, &state);
}

static pbmpm_result call_rigid_advance(const target *ids)
{
    pbmpm_rigid_def def;
    pbmpm_rigid_state state = {.size = sizeof state, .position = {0.5, 0.25}, .rotation = {0, 0, 0, 1}};
    OK(pbmpm_rigid_def_init(&def, sizeof def));
    return pbmpm_rigid_advance(ids->world, ids->collider, &def, &state, 0.01f);
}

pbmpm_result load_triangle(pbmpm_world_id world, pbmpm_baked_id *baked)
{
    static const float vertices[6] = {0, 0, 1, 0, 0, 1};
    char data[4096];
    uint64_t bytes;
    pbmpm_mesh_def def;
    pbmpm_mesh_def_init(&def, sizeof def);
    def.dimension = 2;
    def.vertices = vertices;
    def.vertex_count = 3;
    def.resolution = 4;
    const pbmpm_result result = pbmpm_bake_hull(&def, data, sizeof data, &bytes);
    return result == PBMPM_OK ? pbmpm_baked_create(world, data, bytes, baked) : result;
}

static pbmpm_result call_baked_create(const target *ids)
{
    pbmpm_baked_id baked;
    return load_triangle(ids->world, &baked);
}

static pbmpm_result call_baked_get(const target *ids)
{
    pbmpm_baked_info info = {.size = sizeof info};
    return pbmpm_baked_get(ids->world, ids->baked, &info);
}

static pbmpm_result call_baked_destroy(const target *ids) { return pbmpm_baked_destroy(ids->world, ids->baked); }

static pbmpm_result call_collider_destroy(const target *ids)
{
    return pbmpm_collider_destroy(ids->world, ids->collider);
}

static pbmpm_result call_particles_add(const target *ids)
{
    const float position[2] = {1.5f, 1.5f};
    pbmpm_particles_def def;
    pbmpm_particles_def_init(&def, sizeof def);
    def.material = ids->material;
    def.count = 1;
    def.positions = position;
    return pbmpm_particles_add(ids->world, &def, NULL);
}

static pbmpm_result call_particles_fill(const target *ids)
{
    pbmpm_shape shape = unit_box();
    pbmpm_fill_def fill;
    pbmpm_fill_def_init(&fill, sizeof fill);
    fill.material = ids->material;
    shape.position[0] = shape.position[1] = 1.5f;
    shape.half_extents[0] = shape.half_extents[1] = 0.1f;
    return pbmpm_particles_fill(ids->world, &fill, &shape, NULL);
}

static pbmpm_result call_surface_extract(const target *ids)
{
    pbmpm_surface_mesh mesh = {.size = sizeof mesh};
    const pbmpm_result result = pbmpm_surface_extract(ids->world, NULL, &mesh);
    return result == PBMPM_ERROR_UNSUPPORTED ? PBMPM_OK : result; /* the world is in 2D */
}

static pbmpm_result call_surface_points(const target *ids)
{
    static pbmpm_point room[1 << 13];
    uint32_t count;
    return pbmpm_surface_points(ids->world, NULL, room, 1 << 13, &count);
}

static pbmpm_result call_particles_copy(const target *ids)
{
    static float room[1 << 16];
    uint32_t count;
    return pbmpm_particles_copy(ids->world, NULL, room, sizeof room, &count);
}

static pbmpm_result call_particles_count(const target *ids)
{
    uint32_t count;
    return pbmpm_particles_count(ids->world, &count);
}

static pbmpm_result call_particles_view(const target *ids)
{
    pbmpm_view view = {.size = sizeof view};
    return pbmpm_particles_view(ids->world, PBMPM_POSITION, &view);
}

static pbmpm_result call_particles_set(const target *ids)
{
    const float velocity[2] = {0.5f, 0.25f};
    return pbmpm_particles_set(ids->world, PBMPM_VELOCITY, &ids->particle, 1, velocity);
}

static pbmpm_result call_particles_find(const target *ids)
{
    uint32_t row;
    return pbmpm_particles_find(ids->world, &ids->particle, 1, &row);
}

static pbmpm_result call_wake(const target *ids)
{
    return pbmpm_world_wake(ids->world, NULL);
}

static pbmpm_result call_query_shape(const target *ids)
{
    const pbmpm_shape shape = unit_box();
    uint32_t count;
    return pbmpm_query_shape(ids->world, &shape, NULL, 0, &count);
}

static pbmpm_result call_query_region(const target *ids)
{
    const pbmpm_shape shape = unit_box();
    uint32_t count;
    return pbmpm_query_region(ids->world, &shape, NULL, 0, &count);
}

static pbmpm_result call_query_points(const target *ids)
{
    const float point[2] = {1, 1};
    float filling;
    return pbmpm_query_points(ids->world, point, 1, &filling, NULL, NULL);
}

static pbmpm_result call_query_heights(const target *ids)
{
    const float point[2] = {1, 1}, up[2] = {0, 1};
    float height;
    return pbmpm_query_heights(ids->world, point, 1, up, 0.5f, &height);
}

static pbmpm_result call_query_ray(const target *ids)
{
    pbmpm_ray ray;
    pbmpm_ray_hit hit = {.size = sizeof hit};
    pbmpm_ray_init(&ray, sizeof ray);
    return pbmpm_query_ray(ids->world, &ray, &hit);
}

static unsigned char snapshot_room[1 << 18];

static pbmpm_result call_snapshot_size(const target *ids)
{
    uint64_t bytes;
    return pbmpm_snapshot_size(ids->world, &bytes, NULL);
}

static pbmpm_result call_snapshot_save(const target *ids)
{
    return pbmpm_snapshot_save(ids->world, snapshot_room, sizeof snapshot_room, NULL);
}

static pbmpm_result call_snapshot_restore(const target *ids)
{
    call_snapshot_save(ids);
    return pbmpm_snapshot_restore(ids->world, snapshot_room, sizeof snapshot_room, 0);
}

static pbmpm_result call_publish(const target *ids)
{
    const pbmpm_field field = PBMPM_POSITION;
    return pbmpm_world_publish(ids->world, &field, 1);
}

static pbmpm_result call_step_begin(const target *ids)
{
    const pbmpm_result begun = pbmpm_world_step_begin(ids->world, 0.001f);
    return begun == PBMPM_OK ? pbmpm_world_step_end(ids->world, 1) : begun;
}

static pbmpm_result call_step_end(const target *ids)
{
    pbmpm_world_step_begin(ids->world, 0.001f);
    return pbmpm_world_step_end(ids->world, 1);
}

static pbmpm_result call_step_done(const target *ids)
{
    int32_t done;
    const pbmpm_result begun = pbmpm_world_step_begin(ids->world, 0.001f), result = pbmpm_world_step_done(ids->world, &done);
    return begun == PBMPM_OK ? pbmpm_world_step_end(ids->world, 1) : result;
}

static pbmpm_result call_particles_remove(const target *ids)
{
    return pbmpm_particles_remove(ids->world, &ids->particle, 1);
}

static pbmpm_result call_particles_remove_in(const target *ids)
{
    const pbmpm_shape shape = unit_box();
    return pbmpm_particles_remove_in(ids->world, &shape, NULL);
}

static pbmpm_result call_emitter_create(const target *ids)
{
    const pbmpm_shape shape = unit_box();
    pbmpm_emitter_def def;
    pbmpm_emitter_id emitter;
    pbmpm_emitter_def_init(&def, sizeof def);
    def.material = ids->material;
    return pbmpm_emitter_create(ids->world, &def, &shape, &emitter);
}

static pbmpm_result call_emitter_get(const target *ids)
{
    pbmpm_emitter_def def = {.size = sizeof def};
    pbmpm_shape shape = {.size = sizeof shape};
    return pbmpm_emitter_get(ids->world, ids->emitter, &def, &shape);
}

static pbmpm_result call_emitter_set(const target *ids)
{
    const pbmpm_shape shape = unit_box();
    pbmpm_emitter_def def;
    pbmpm_emitter_def_init(&def, sizeof def);
    def.material = ids->material;
    return pbmpm_emitter_set(ids->world, ids->emitter, &def, &shape);
}

static pbmpm_result call_emitter_move(const target *ids)
{
    const float position[3] = {0.5f, 0.5f, 0};
    return pbmpm_emitter_move(ids->world, ids->emitter, position, NULL);
}

static pbmpm_result call_emitter_status(const target *ids)
{
    pbmpm_emitter_status status = {.size = sizeof status};
    return pbmpm_emitter_status_get(ids->world, ids->emitter, &status);
}

static pbmpm_result call_emitter_destroy(const target *ids)
{
    return pbmpm_emitter_destroy(ids->world, ids->emitter);
}

static pbmpm_result call_drain_create(const target *ids)
{
    const pbmpm_shape shape = unit_box();
    pbmpm_drain_def def;
    pbmpm_drain_id drain;
    pbmpm_drain_def_init(&def, sizeof def);
    return pbmpm_drain_create(ids->world, &def, &shape, &drain);
}

static pbmpm_result call_drain_get(const target *ids)
{
    pbmpm_drain_def def = {.size = sizeof def};
    pbmpm_shape shape = {.size = sizeof shape};
    return pbmpm_drain_get(ids->world, ids->drain, &def, &shape);
}

static pbmpm_result call_drain_set(const target *ids)
{
    const pbmpm_shape shape = unit_box();
    pbmpm_drain_def def;
    pbmpm_drain_def_init(&def, sizeof def);
    return pbmpm_drain_set(ids->world, ids->drain, &def, &shape);
}

static pbmpm_result call_drain_status(const target *ids)
{
    pbmpm_drain_status status = {.size = sizeof status};
    return pbmpm_drain_status_get(ids->world, ids->drain, &status);
}

static pbmpm_result call_drain_destroy(const target *ids)
{
    return pbmpm_drain_destroy(ids->world, ids->drain);
}

static pbmpm_result call_set_kill_bounds(const target *ids)
{
    pbmpm_kill_bounds bounds;
    pbmpm_kill_bounds_init(&bounds, sizeof bounds);
    return pbmpm_world_set_kill_bounds(ids->world, &bounds);
}

static pbmpm_result call_get_kill_bounds(const target *ids)
{
    pbmpm_kill_bounds bounds = {.size = sizeof bounds};
    return pbmpm_world_get_kill_bounds(ids->world, &bounds);
}

static pbmpm_result call_get_flow(const target *ids)
{
    pbmpm_flow flow = {.size = sizeof flow};
    return pbmpm_world_get_flow(ids->world, &flow);
}

static pbmpm_result call_advice(const target *ids)
{
    uint32_t count;
    return pbmpm_world_advice(ids->world, 0.01f, NULL, 0, &count);
}

static pbmpm_result call_force_create(const target *ids)
{
    const pbmpm_shape shape = unit_box();
    pbmpm_force_def def;
    pbmpm_force_id force;
    pbmpm_force_def_init(&def, sizeof def);
    return pbmpm_force_create(ids->world, &def, &shape, &force);
}

static pbmpm_result call_force_get(const target *ids)
{
    pbmpm_force_def def = {.size = sizeof def};
    pbmpm_shape shape = {.size = sizeof shape};
    return pbmpm_force_get(ids->world, ids->force, &def, &shape);
}

static pbmpm_result call_force_set(const target *ids)
{
    const pbmpm_shape shape = unit_box();
    pbmpm_force_def def;
    pbmpm_force_def_init(&def, sizeof def);
    return pbmpm_force_set(ids->world, ids->force, &def, &shape);
}

static pbmpm_result call_force_status(const target *ids)
{
    pbmpm_force_status status = {.size = sizeof status};
    return pbmpm_force_status_get(ids->world, ids->force, &status);
}

static pbmpm_result call_force_destroy(const target *ids)
{
    return pbmpm_force_destroy(ids->world, ids->force);
}

static pbmpm_result call_world_destroy(const target *ids)
{
    return pbmpm_world_destroy(ids->world);
}

const world_call world_calls[] = {
    {"pbmpm_world_get_def", call_get_def, 0},
    {"pbmpm_world_get_settings", call_get_settings, 0},
    {"pbmpm_world_set_settings", call_set_settings, 0},
    {"pbmpm_world_step", call_step, 0},
    {"pbmpm_world_wake", call_wake, 0},
    {"pbmpm_world_generation", call_generation, 0},
    {"pbmpm_world_hash", call_hash, 0},
    {"pbmpm_world_get_stats", call_get_stats, 0},
    {"pbmpm_world_get_step_stats", call_get_step_stats, 0},
    {"pbmpm_world_events", call_events, 0},
    {"pbmpm_material_create", call_material_create, 0},
    {"pbmpm_material_get", call_material_get, USES_MATERIAL},
    {"pbmpm_material_effective", call_material_effective, USES_MATERIAL},
    {"pbmpm_material_set", call_material_set, USES_MATERIAL},
    {"pbmpm_material_destroy", call_material_destroy, USES_SPARE},
    {"pbmpm_collider_create", call_collider_create, 0},
    {"pbmpm_collider_get", call_collider_get, USES_COLLIDER},
    {"pbmpm_collider_set", call_collider_set, USES_COLLIDER},
    {"pbmpm_domain_wall_get", call_domain_wall_get, 0},
    {"pbmpm_domain_wall_set", call_domain_wall_set, 0},
    {"pbmpm_world_shift_origin", call_shift_origin, 0},
    {"pbmpm_world_touches", call_touches, 0},
    {"pbmpm_world_debug_lines", call_debug_lines, 0},
    {"pbmpm_world_get_materials", call_get_materials, 0},
    {"pbmpm_world_get_colliders", call_get_colliders, 0},
    {"pbmpm_world_get_emitters", call_get_emitters, 0},
    {"pbmpm_world_get_drains", call_get_drains, 0},
    {"pbmpm_world_get_forces", call_get_forces, 0},
    {"pbmpm_collider_move", call_collider_move, USES_COLLIDER},
    {"pbmpm_collider_teleport", call_collider_teleport, USES_COLLIDER},
    {"pbmpm_query_collider", call_query_collider, USES_COLLIDER},
    {"pbmpm_collider_impulse", call_collider_impulse, USES_COLLIDER},
    {"pbmpm_domain_impulse", call_domain_impulse, 0},
    {"pbmpm_collider_submerged", call_collider_submerged, USES_COLLIDER},
    {"pbmpm_shape_mass", call_shape_mass, 0},
    {"pbmpm_rigid_begin", call_rigid_begin, USES_COLLIDER},
    {"pbmpm_rigid_advance", call_rigid_advance, USES_COLLIDER},
    {"pbmpm_collider_destroy", call_collider_destroy, USES_COLLIDER},
    {"pbmpm_baked_create", call_baked_create, 0},
    {"pbmpm_baked_get", call_baked_get, USES_BAKED},
    {"pbmpm_baked_destroy", call_baked_destroy, USES_BAKED},
    {"pbmpm_particles_add", call_particles_add, USES_MATERIAL},
    {"pbmpm_particles_fill", call_particles_fill, USES_MATERIAL},
    {"pbmpm_particles_count", call_particles_count, 0},
    {"pbmpm_particles_view", call_particles_view, 0},
    {"pbmpm_particles_copy", call_particles_copy, 0},
    {"pbmpm_surface_extract", call_surface_extract, 0},
    {"pbmpm_surface_points", call_surface_points, 0},
    {"pbmpm_particles_set", call_particles_set, USES_PARTICLE},
    {"pbmpm_particles_find", call_particles_find, USES_PARTICLE},
    {"pbmpm_query_shape", call_query_shape, 0},
    {"pbmpm_query_region", call_query_region, 0},
    {"pbmpm_query_points", call_query_points, 0},
    {"pbmpm_query_heights", call_query_heights, 0},
    {"pbmpm_query_ray", call_query_ray, 0},
    {"pbmpm_snapshot_size", call_snapshot_size, 0},
    {"pbmpm_snapshot_save", call_snapshot_save, 0},
    {"pbmpm_snapshot_restore", call_snapshot_restore, 0},
    {"pbmpm_world_publish", call_publish, 0},
    {"pbmpm_world_step_begin", call_step_begin, 0},
    {"pbmpm_world_step_end", call_step_end, 0},
    {"pbmpm_world_step_done", call_step_done, 0},
    {"pbmpm_particles_remove", call_particles_remove, USES_PARTICLE},
    {"pbmpm_particles_remove_in", call_particles_remove_in, 0},
    {"pbmpm_emitter_create", call_emitter_create, USES_MATERIAL},
    {"pbmpm_emitter_get", call_emitter_get, USES_EMITTER},
    {"pbmpm_emitter_set", call_emitter_set, USES_EMITTER | USES_MATERIAL},
    {"pbmpm_emitter_move", call_emitter_move, USES_EMITTER},
    {"pbmpm_emitter_status_get", call_emitter_status, USES_EMITTER},
    {"pbmpm_emitter_destroy", call_emitter_destroy, USES_EMITTER},
    {"pbmpm_drain_create", call_drain_create, 0},
    {"pbmpm_drain_get", call_drain_get, USES_DRAIN},
    {"pbmpm_drain_set", call_drain_set, USES_DRAIN},
    {"pbmpm_drain_status_get", call_drain_status, USES_DRAIN},
    {"pbmpm_drain_destroy", call_drain_destroy, USES_DRAIN},
    {"pbmpm_world_set_kill_bounds", call_set_kill_bounds, 0},
    {"pbmpm_world_get_kill_bounds", call_get_kill_bounds, 0},
    {"pbmpm_world_get_flow", call_get_flow, 0},
    {"pbmpm_world_advice", call_advice, 0},
    {"pbmpm_force_create", call_force_create, 0},
    {"pbmpm_force_get", call_force_get, USES_FORCE},
    {"pbmpm_force_set", call_force_set, USES_FORCE},
    {"pbmpm_force_status_get", call_force_status, USES_FORCE},
    {"pbmpm_force_destroy", call_force_destroy, USES_FORCE},
    {"pbmpm_world_destroy", call_world_destroy, 0},
};
const int world_call_count = (int)(sizeof world_calls / sizeof *world_calls);

target target_create(scene_tweak *tweak, void *user)
{
    pbmpm_world_def def = default_world(2, 0.1f, 2048);
    def.domain_enabled = 1;
    for (int a = 0; a < 3; a++)
        def.domain_max[a] = 2;
    def.domain_measures_impulse = 1;
    if (tweak)
        tweak(&def, user);
    target made = {.world = create_world(&def)};
    made.material = create_material(made.world, PBMPM_ELASTIC);
    made.spare = create_material(made.world, PBMPM_LIQUID);
    const pbmpm_shape block = box_shape(0.5f, 0.5f, 0, 0.1f, 0.1f, 0.1f);
    pbmpm_collider_def collider = default_collider();
    collider.kinematic = collider.measures_impulse = 1;
    OK(pbmpm_collider_create(made.world, &collider, &block, &made.collider));
    OK(load_triangle(made.world, &made.baked));
    fill_shape(made.world, made.material, box_shape(1, 1, 0, 0.4f, 0.4f, 0.5f), (const float[3]){0.5f, 0, 0});
    made.emitter = create_emitter(made.world, made.material);
    made.drain = create_drain(made.world, box_shape(0.1f, 0.1f, 0, 0.05f, 0.05f, 0.05f));
    made.force = create_force(made.world);
    const pbmpm_view identity = view_of(made.world, PBMPM_PARTICLE);
    made.particle = (pbmpm_particle_id){view_uint(&identity, 7, 0), view_uint(&identity, 7, 1)};
    return made;
}

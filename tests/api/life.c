#include "life.h"

#include <string.h>

enum { MOST = 1024, MATERIALS = 4, BAKED_ROOM = 1 << 16, SAVED_ROOM = 1 << 18 };

static const float DT = 1.0f / 60;

/* What a world of the life holds; of its twin the same. */
typedef struct room {
    pbmpm_material_id material[MATERIALS];
    pbmpm_material_id spare;
    pbmpm_baked_id baked;
    pbmpm_collider_id ball, wedge; /* the wedge is the baked solid */
    pbmpm_emitter_id emitter;
    pbmpm_drain_id drain;
    pbmpm_force_id force;
} room;

static unsigned char baked[BAKED_ROOM], saved[SAVED_ROOM];

/* Makes a call, perhaps more than once, and leaves the function with false where the life ends. */
#define CALL(call)                                                       \
    do {                                                                 \
        life_turn turn_;                                                 \
        do {                                                             \
            watch->before(#call, it->world, watch->user);                \
            turn_ = watch->after((call), it->world, watch->user);        \
        } while (turn_ == LIFE_TRIES_AGAIN);                             \
        if (turn_ == LIFE_ENDS) return false;                            \
    } while (0)

/* Worlds in 2D have no surface, which is no failure of theirs. */
static pbmpm_result if_3d(pbmpm_result result) { return result == PBMPM_ERROR_UNSUPPORTED ? PBMPM_OK : result; }

/* The same for one that always succeeds. */
#define TELLS(call) CALL(((void)(call), PBMPM_OK))

static void ignore_line(pbmpm_log_level level, const char *line, void *user)
{
    (void)level;
    (void)line;
    (void)user;
}

static bool ask_the_library(const life_watch *watch, const life *it)
{
    const pbmpm_layout_entry *entries;
    uint32_t count;
    TELLS(pbmpm_version());
    TELLS(pbmpm_abi_version());
    TELLS(pbmpm_active_isa());
    TELLS(pbmpm_isa_name(PBMPM_ISA_SSE4));
    TELLS(pbmpm_build_is_strict());
    TELLS(pbmpm_materials_built());
    TELLS(pbmpm_result_name(PBMPM_OK));
    TELLS(pbmpm_last_error());
    TELLS(pbmpm_advice_name(PBMPM_ADVICE_NO_GRAVITY));
    TELLS(pbmpm_advice_unit(PBMPM_ADVICE_NO_GRAVITY));
    CALL(pbmpm_layout_table(&entries, &count));
    CALL(pbmpm_set_log_callback(ignore_line, NULL));
    TELLS(pbmpm_set_assert_callback(NULL, NULL)); /* refused in builds without assertions */
    return true;
}

/* ---- Solids ---- */

static const float square[] = {0, 0, 0.4f, 0, 0.4f, 0.2f, 0, 0.4f};
static const uint32_t edges[] = {0, 1, 1, 2, 2, 3, 3, 0};
static const float pyramid[] = {0, 0, 0, 0.4f, 0, 0, 0, 0.3f, 0, 0, 0, 0.4f};
static const uint32_t faces[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
static const float heights[] = {0.1f, 0.2f, 0.1f, 0.3f, 0, 0.1f, 0.2f, 0.3f};

/* The mesh comes last: it is what the worlds load. */
static bool bake(const life_watch *watch, const life *it, int32_t dimension, uint64_t *bytes)
{
    const bool flat = dimension == 2;
    pbmpm_baked_info info = {.size = sizeof info};
    pbmpm_mesh_def mesh;
    pbmpm_heights_def land;
    CALL(pbmpm_mesh_def_init(&mesh, sizeof mesh));
    CALL(pbmpm_heights_def_init(&land, sizeof land));
    mesh.dimension = land.dimension = dimension;
    mesh.vertex_count = 4;
    mesh.vertices = flat ? square : pyramid;
    mesh.resolution = 4;
    land.spacing[0] = land.spacing[1] = 0.25f;
    land.count[0] = flat ? 8 : 4;
    land.count[1] = 2;
    land.heights = heights;
    CALL(pbmpm_bake_heights(&land, baked, sizeof baked, bytes));
    CALL(pbmpm_bake_hull(&mesh, baked, sizeof baked, bytes));
    mesh.element_count = 4;
    mesh.elements = flat ? edges : faces;
    CALL(pbmpm_bake_mesh(&mesh, baked, sizeof baked, bytes));
    CALL(pbmpm_baked_inspect(baked, *bytes, &info));
    return true;
}

/* ---- What a world is made of ---- */

static bool open_world(const life_plan *plan, const pbmpm_allocator *allocator, const life_watch *watch, life *it, pbmpm_world_id *world)
{
    pbmpm_world_def def;
    pbmpm_settings settings;
    pbmpm_world_id made;
    CALL(pbmpm_world_def_init(&def, sizeof def));
    CALL(pbmpm_settings_init(&settings, sizeof settings));
    def.dimension = plan->dimension;
    def.particle_capacity = MOST;
    def.thread_count = plan->thread_count;
    def.allocator = allocator;
    def.domain_enabled = def.domain_measures_impulse = 1;
    for (int a = 0; a < 3; a++) def.domain_max[a] = 2;
    settings.solver = plan->solver;
    settings.integrator = plan->integrator;
    settings.pressure = plan->pressure;
    settings.iterations = 2;
    settings.gravity[1] = -5;
    settings.sleeping = plan->sleeping;
    settings.sleep_speed = 1e6f;
    settings.sleep_time = 2 * DT;
    CALL(pbmpm_world_create(&def, &made));
    *world = made;
    CALL(pbmpm_world_set_settings(made, &settings));
    CALL(pbmpm_world_get_settings(made, &settings));
    CALL(pbmpm_world_get_def(made, &def));
    return true;
}

static bool add_materials(const life_watch *watch, const life *it, pbmpm_world_id world, room *in)
{
    static const pbmpm_material_kind kinds[MATERIALS] = {PBMPM_LIQUID, PBMPM_ELASTIC, PBMPM_SAND, PBMPM_VISCO};
    pbmpm_effective effective = {.size = sizeof effective};
    pbmpm_material_def def;
    CALL(pbmpm_material_def_init(&def, sizeof def));
    def.bulk_modulus = 1e5f;
    for (int i = 0; i < MATERIALS; i++) {
        def.kind = kinds[i];
        def.kinematic_viscosity = kinds[i] == PBMPM_LIQUID ? 0.1f : 0.0f;
        CALL(pbmpm_material_create(world, &def, &in->material[i]));
    }
    CALL(pbmpm_material_create(world, &def, &in->spare));
    CALL(pbmpm_material_get(world, in->spare, &def));
    def.relaxation = 1.2f;
    CALL(pbmpm_material_set(world, in->spare, &def));
    CALL(pbmpm_material_effective(world, in->material[1], DT, &effective));
    return true;
}

static bool add_solids(const life_watch *watch, const life *it, pbmpm_world_id world, uint64_t bytes, room *in)
{
    pbmpm_baked_info info = {.size = sizeof info};
    pbmpm_collider_def def;
    pbmpm_shape shape;
    CALL(pbmpm_baked_create(world, baked, bytes, &in->baked));
    CALL(pbmpm_baked_get(world, in->baked, &info));
    CALL(pbmpm_collider_def_init(&def, sizeof def));
    CALL(pbmpm_shape_init(&shape, sizeof shape));
    def.kinematic = def.measures_impulse = 1;
    shape = sphere_shape(1.4f, 0.15f, 0.3f, 0.12f);
    CALL(pbmpm_collider_create(world, &def, &shape, &in->ball));
    shape.kind = PBMPM_BAKED;
    shape.baked = in->baked;
    shape.position[0] = shape.position[1] = shape.position[2] = 0.05f;
    def.kinematic = 0;
    CALL(pbmpm_collider_create(world, &def, &shape, &in->wedge));
    CALL(pbmpm_collider_get(world, in->ball, &def, &shape));
    def.reports_touches = 1;
    CALL(pbmpm_collider_set(world, in->ball, &def, &shape));
    return true;
}

/* What acts on matter keeps it awake and takes it apart, so it may be switched off. */
static bool add_effects(const life_watch *watch, const life *it, pbmpm_world_id world, bool enabled, room *in)
{
    const pbmpm_shape tap = sphere_shape(0.6f, 1.6f, 0.4f, 0.15f), hole = box_shape(1.8f, 0.1f, 0.1f, 0.1f, 0.1f, 0.1f);
    pbmpm_emitter_def emitter;
    pbmpm_drain_def drain;
    pbmpm_force_def force;
    pbmpm_shape shape = {.size = sizeof shape};
    CALL(pbmpm_emitter_def_init(&emitter, sizeof emitter));
    CALL(pbmpm_drain_def_init(&drain, sizeof drain));
    CALL(pbmpm_force_def_init(&force, sizeof force));
    emitter.material = in->material[0];
    emitter.rate = 0.5f;
    emitter.enabled = drain.enabled = force.enabled = enabled;
    force.kind = PBMPM_FORCE_RADIAL;
    force.everywhere = 0;
    force.range = 0.5f;
    force.strength = 1;
    CALL(pbmpm_emitter_create(world, &emitter, &tap, &in->emitter));
    CALL(pbmpm_emitter_get(world, in->emitter, &emitter, &shape));
    CALL(pbmpm_emitter_set(world, in->emitter, &emitter, &tap));
    CALL(pbmpm_drain_create(world, &drain, &hole, &in->drain));
    CALL(pbmpm_drain_get(world, in->drain, &drain, &shape));
    CALL(pbmpm_drain_set(world, in->drain, &drain, &hole));
    CALL(pbmpm_force_create(world, &force, &tap, &in->force));
    CALL(pbmpm_force_get(world, in->force, &force, &shape));
    CALL(pbmpm_force_set(world, in->force, &force, &tap));
    return true;
}

static bool set_bounds(const life_watch *watch, const life *it)
{
    pbmpm_kill_bounds bounds;
    CALL(pbmpm_kill_bounds_init(&bounds, sizeof bounds));
    bounds.enabled = 1;
    for (int a = 0; a < 3; a++) bounds.high[a] = 1.99f;
    CALL(pbmpm_world_set_kill_bounds(it->world, &bounds));
    CALL(pbmpm_world_get_kill_bounds(it->world, &bounds));
    return true;
}

/* A pool with a body on it, a heap of sand and one of clay. */
static bool add_matter(const life_plan *plan, const life_watch *watch, const life *it, const room *in)
{
    const float aside = plan->together ? 0.1f : 0.7f, lone[3] = {0.9f, plan->together ? 0.7f : 1.5f, 0.3f};
    const struct {
        int material;
        float x, y, half;
    } heaps[MATERIALS] = {{0, 1.0f, 0.15f, 0.15f}, {1, 1.0f, 0.45f, 0.15f}, {2, 1.0f + aside, 0.7f, 0.1f}, {3, 1.0f - aside, 0.7f, 0.1f}};
    pbmpm_fill_def fill;
    pbmpm_particles_def def;
    CALL(pbmpm_fill_def_init(&fill, sizeof fill));
    CALL(pbmpm_particles_def_init(&def, sizeof def));
    def.material = in->material[1];
    def.count = 1;
    def.positions = lone;
    CALL(pbmpm_particles_add(it->world, &def, NULL));
    for (int i = 0; i < MATERIALS; i++) {
        const pbmpm_shape box = box_shape(heaps[i].x, heaps[i].y, 0.3f, heaps[i].half, heaps[i].half, heaps[i].half);
        fill.material = in->material[heaps[i].material];
        CALL(pbmpm_particles_fill(it->world, &fill, &box, NULL));
    }
    return true;
}

/* ---- What it is asked ---- */

static bool ask_particles(const life_watch *watch, const life *it, pbmpm_particle_id *first)
{
    static float copies[MOST * 16];
    const float pressure = 10, velocity[3] = {0.1f, 0.2f, 0};
    const uint32_t seven = 7;
    pbmpm_view view = {.size = sizeof view};
    pbmpm_copy_def copy;
    uint32_t count, row, *const ids = (uint32_t *)first;
    uint64_t number;
    CALL(pbmpm_particles_count(it->world, &count));
    CALL(pbmpm_world_generation(it->world, &number));
    CALL(pbmpm_world_hash(it->world, &number));
    CALL(pbmpm_copy_def_init(&copy, sizeof copy));
    CALL(pbmpm_particles_copy(it->world, &copy, copies, sizeof copies, &count));
    CALL(pbmpm_particles_view(it->world, PBMPM_MATERIAL, &view));
    for (row = 0; row + 1 < view.count && view_uint(&view, row, 0) != 0; row++) continue; /* a liquid one */
    CALL(pbmpm_particles_view(it->world, PBMPM_PARTICLE, &view));
    for (uint32_t i = 0; i < 2; i++) ids[i] = view_uint(&view, row, i);
    CALL(pbmpm_particles_set(it->world, PBMPM_PRESSURE, first, 1, &pressure));
    CALL(pbmpm_particles_set(it->world, PBMPM_VELOCITY, first, 1, velocity));
    CALL(pbmpm_particles_set(it->world, PBMPM_USER_VALUE, first, 1, &seven));
    CALL(pbmpm_particles_find(it->world, first, 1, &row));
    return true;
}

static bool ask_where_matter_is(const life_watch *watch, const life *it, const room *in)
{
    const pbmpm_shape box = box_shape(1.0f, 0.3f, 0.3f, 0.3f, 0.3f, 0.3f);
    const float points[6] = {1.0f, 0.1f, 0.3f, 0.1f, 0.3f, 0.1f}, up[3] = {0, 1, 0};
    float filling[3], height[3];
    pbmpm_ray_hit hit = {.size = sizeof hit};
    pbmpm_ray ray;
    static pbmpm_point points_room[MOST];
    pbmpm_surface_def surface;
    pbmpm_surface_mesh mesh = {.size = sizeof mesh};
    pbmpm_points_def look;
    uint32_t count;
    CALL(pbmpm_query_shape(it->world, &box, NULL, 0, &count));
    CALL(pbmpm_query_region(it->world, &box, NULL, 0, &count));
    CALL(pbmpm_query_points(it->world, points, 2, filling, NULL, NULL));
    CALL(pbmpm_query_heights(it->world, points, 2, up, 0.5f, height));
    CALL(pbmpm_query_collider(it->world, in->ball, NULL, 0, &count));
    CALL(pbmpm_ray_init(&ray, sizeof ray));
    ray.origin[0] = 1;
    ray.origin[1] = 1.9f;
    CALL(pbmpm_query_ray(it->world, &ray, &hit));
    CALL(pbmpm_surface_def_init(&surface, sizeof surface));
    CALL(if_3d(pbmpm_surface_extract(it->world, &surface, &mesh)));
    CALL(pbmpm_points_def_init(&look, sizeof look));
    CALL(pbmpm_surface_points(it->world, &look, points_room, MOST, &count));
    return true;
}

static bool ask_books(const life_watch *watch, const life *it, const room *in)
{
    pbmpm_stats stats = {.size = sizeof stats};
    pbmpm_impulse impulse = {.size = sizeof impulse};
    pbmpm_emitter_status emitter = {.size = sizeof emitter};
    pbmpm_drain_status drain = {.size = sizeof drain};
    pbmpm_force_status force = {.size = sizeof force};
    uint32_t count, missed;
    CALL(pbmpm_world_get_stats(it->world, &stats));
    CALL(pbmpm_world_get_step_stats(it->world, &stats));
    CALL(pbmpm_world_events(it->world, NULL, 0, &count, &missed));
    CALL(pbmpm_world_advice(it->world, DT, NULL, 0, &count));
    CALL(pbmpm_collider_impulse(it->world, in->ball, &impulse));
    CALL(pbmpm_domain_impulse(it->world, 1, 0, &impulse));
    CALL(pbmpm_emitter_status_get(it->world, in->emitter, &emitter));
    CALL(pbmpm_drain_status_get(it->world, in->drain, &drain));
    CALL(pbmpm_force_status_get(it->world, in->force, &force));
    return true;
}

static bool ask_what_there_is(const life_watch *watch, const life *it, const room *in)
{
    pbmpm_domain_wall wall = {.size = sizeof wall};
    uint32_t count;
    int32_t valid;
    CALL(pbmpm_world_is_valid(it->world, &valid));
    CALL(pbmpm_material_is_valid(it->world, in->spare, &valid));
    CALL(pbmpm_collider_is_valid(it->world, in->ball, &valid));
    CALL(pbmpm_emitter_is_valid(it->world, in->emitter, &valid));
    CALL(pbmpm_drain_is_valid(it->world, in->drain, &valid));
    CALL(pbmpm_force_is_valid(it->world, in->force, &valid));
    CALL(pbmpm_get_worlds(NULL, 0, &count));
    CALL(pbmpm_world_get_materials(it->world, NULL, 0, &count));
    CALL(pbmpm_world_get_colliders(it->world, NULL, 0, &count));
    CALL(pbmpm_world_get_emitters(it->world, NULL, 0, &count));
    CALL(pbmpm_world_get_drains(it->world, NULL, 0, &count));
    CALL(pbmpm_world_get_forces(it->world, NULL, 0, &count));
    CALL(pbmpm_world_debug_lines(it->world, PBMPM_DEBUG_ALL, NULL, 0, &count));
    CALL(pbmpm_world_touches(it->world, NULL, 0, &count));
    CALL(pbmpm_domain_wall_get(it->world, 0, 1, &wall));
    wall.friction_coefficient = 0.5f;
    CALL(pbmpm_domain_wall_set(it->world, 0, 1, &wall));
    return true;
}

/* ---- What it does ---- */

/* The ball becomes a body that falls. */
static bool let_fall(const life_watch *watch, const life *it, const room *in)
{
    pbmpm_mass_properties mass = {.size = sizeof mass};
    pbmpm_submersion under = {.size = sizeof under};
    pbmpm_rigid_state state = {.size = sizeof state};
    pbmpm_rigid_def def;
    pbmpm_shape shape = {.size = sizeof shape};
    CALL(pbmpm_collider_get(it->world, in->ball, NULL, &shape));
    CALL(pbmpm_shape_mass(it->world, &shape, 500, &mass));
    CALL(pbmpm_collider_submerged(it->world, in->ball, NULL, &under));
    CALL(pbmpm_rigid_def_init(&def, sizeof def));
    def.mass = mass.mass;
    CALL(pbmpm_rigid_begin(it->world, in->ball, &def, &state));
    CALL(pbmpm_rigid_advance(it->world, in->ball, &def, &state, DT));
    return true;
}

static bool step(const life_watch *watch, const life *it, int count)
{
    for (int i = 0; i < count; i++) CALL(pbmpm_world_step(it->world, DT));
    return true;
}

static pbmpm_result end_step(pbmpm_world_id world, bool *begun, pbmpm_result (*end)(pbmpm_world_id world, int32_t wait))
{
    if (!*begun) OK(pbmpm_world_step_begin(world, DT));
    *begun = false;
    return end(world, 1);
}

static bool step_behind(const life_watch *watch, const life *it)
{
    const pbmpm_field fields[] = {PBMPM_POSITION, PBMPM_DEFORMATION};
    int32_t done;
    bool begun = true; /* what was refused at its end has to be begun again */
    CALL(pbmpm_world_publish(it->world, fields, 2));
    CALL(pbmpm_world_step_begin(it->world, DT));
    CALL(pbmpm_world_step_done(it->world, &done));
    CALL(end_step(it->world, &begun, pbmpm_world_step_end));
    return true;
}

static bool save_and_restore(const life_watch *watch, life *it)
{
    uint64_t bytes;
    CALL(pbmpm_snapshot_size(it->world, &bytes, NULL));
    CALL(pbmpm_snapshot_save(it->world, saved, sizeof saved, NULL));
    CALL(pbmpm_snapshot_restore(it->twin, saved, bytes, 0));
    CALL(pbmpm_snapshot_restore(it->twin, saved, bytes, PBMPM_RESTORE_KEEP_PARAMETERS));
    CALL(pbmpm_world_step(it->twin, DT));
    CALL(pbmpm_snapshot_restore(it->world, saved, bytes, 0));
    CALL(pbmpm_world_destroy(it->twin));
    it->twin = (pbmpm_world_id){0, 0};
    return true;
}

static bool take_apart(const life_watch *watch, const life *it, const room *in, const pbmpm_particle_id *first)
{
    const pbmpm_shape box = box_shape(1.0f, 0.3f, 0.3f, 0.1f, 0.5f, 0.5f);
    CALL(pbmpm_particles_remove(it->world, first, 1));
    CALL(pbmpm_particles_remove_in(it->world, &box, NULL));
    CALL(pbmpm_emitter_destroy(it->world, in->emitter));
    CALL(pbmpm_drain_destroy(it->world, in->drain));
    CALL(pbmpm_force_destroy(it->world, in->force));
    CALL(pbmpm_collider_destroy(it->world, in->wedge));
    CALL(pbmpm_baked_destroy(it->world, in->baked));
    CALL(pbmpm_material_destroy(it->world, in->spare));
    return true;
}

static bool furnish(const life_plan *plan, const life_watch *watch, const life *it, pbmpm_world_id world, uint64_t bytes, room *in)
{
    return add_materials(watch, it, world, in) && add_solids(watch, it, world, bytes, in) && add_effects(watch, it, world, !plan->sleeping && !plan->together, in);
}

static bool move_things(const life_watch *watch, const life *it, const room *in)
{
    const float there[3] = {1.3f, 0.2f, 0.3f};
    double moved[3];
    CALL(pbmpm_emitter_move(it->world, in->emitter, (const float[3]){0.7f, 1.5f, 0.3f}, NULL));
    CALL(pbmpm_collider_teleport(it->world, in->ball, there, NULL));
    CALL(pbmpm_collider_move(it->world, in->ball, (const float[3]){1.25f, 0.2f, 0.3f}, NULL));
    CALL(pbmpm_world_shift_origin(it->world, (const double[3]){0}, moved));
    return true;
}

bool live(const life_plan *plan, const pbmpm_allocator *allocator, const life_watch *watch, life *it)
{
    room in, twins;
    pbmpm_particle_id first;
    uint64_t bytes;
    if (!ask_the_library(watch, it) || !bake(watch, it, plan->dimension, &bytes)) return false;
    if (!open_world(plan, allocator, watch, it, &it->world) || !furnish(plan, watch, it, it->world, bytes, &in)) return false;
    if (!set_bounds(watch, it) || !add_matter(plan, watch, it, &in) || !step(watch, it, 2)) return false;
    if (!move_things(watch, it, &in) || !step(watch, it, 1)) return false;
    if (!ask_particles(watch, it, &first) || !ask_where_matter_is(watch, it, &in) || !ask_books(watch, it, &in)) return false;
    if (!ask_what_there_is(watch, it, &in) || !let_fall(watch, it, &in)) return false;
    if (!step_behind(watch, it) || !step(watch, it, 4)) return false;
    if (!open_world(plan, allocator, watch, it, &it->twin) || !furnish(plan, watch, it, it->twin, bytes, &twins)) return false;
    if (!save_and_restore(watch, it)) return false;
    CALL(pbmpm_world_wake(it->world, NULL));
    if (!take_apart(watch, it, &in, &first) || !step(watch, it, 2)) return false;
    it->flow = (pbmpm_flow){.size = sizeof it->flow};
    CALL(pbmpm_world_get_flow(it->world, &it->flow));
    CALL(pbmpm_world_hash(it->world, &it->hash));
    CALL(pbmpm_world_destroy(it->world));
    it->world = (pbmpm_world_id){0, 0};
    CALL(pbmpm_shutdown());
    return true;
}

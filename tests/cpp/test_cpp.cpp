/* The C++ header: each call through the shared library, and what spans, results and worlds of C++ add. Nothing here calls C itself: the names that
 * this file needs are compared with those that the library exports. */
#include <pbmpm/pbmpm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

/* Each identifier is a type of its own, and arrays of another kind are refused. What C++ adds takes no room. */
static_assert(!std::is_convertible_v<pbmpm_material_id, pbmpm_collider_id> && !std::is_convertible_v<pbmpm_particle_id, pbmpm_material_id>);
static_assert(!std::is_invocable_v<decltype(&pbmpm::world_ref::collider_destroy), pbmpm::world_ref, pbmpm_emitter_id>);
static_assert(!std::is_constructible_v<pbmpm::span<const pbmpm_particle_id>, std::vector<pbmpm_material_id> &>);
static_assert(!std::is_constructible_v<pbmpm::span<float>, const std::vector<float> &>);
static_assert(!std::is_copy_constructible_v<pbmpm::world> && std::is_nothrow_move_constructible_v<pbmpm::world>);
static_assert(sizeof(pbmpm::world) == sizeof(pbmpm_world_id) && sizeof(pbmpm::settings) == sizeof(pbmpm_settings));

extern "C" std::uint64_t hash_of_the_scene_in_c(void); /* scene_in_c.c */

static int checks, failures;

static void check(bool holds, const char *what, int line)
{
    checks++;
    if (holds) return;
    failures++;
    std::printf("test_cpp.cpp:%d: does not hold: %s (%s)\n", line, what, pbmpm::last_error());
}
#define CHECK(condition) check(static_cast<bool>(condition), #condition, __LINE__)

/* That a call failed, and with which code. */
template <class T> static bool fails(const pbmpm::expected<T> &result, pbmpm_result code)
{
    return !result && result.error().code == code && result.error().message[0] != '\0';
}

constexpr float dt = 1.0f / 60;

static pbmpm::world make_world(std::int32_t dimension = 2)
{
    pbmpm::world_def def;
    def.dimension = dimension;
    def.cell_size = 0.05f;
    def.particle_capacity = 2000;
    def.thread_count = 1;
    def.domain_enabled = 1;
    def.domain_measures_impulse = 1;
    pbmpm::world world = pbmpm::world::create(def).value();
    pbmpm::settings settings;
    settings.gravity[1] = -9.81f;
    world.set_settings(settings).value();
    return world;
}

static pbmpm::shape box(float x, float y, float half_width, float half_height)
{
    pbmpm::shape shape;
    shape.position[0] = x;
    shape.position[1] = y;
    shape.half_extents[0] = half_width;
    shape.half_extents[1] = half_height;
    return shape;
}

static pbmpm_material_id fill_water(const pbmpm::world_ref &world)
{
    const pbmpm_material_id water = world.material_create(pbmpm::material_def()).value();
    pbmpm::fill_def fill;
    fill.material = water;
    CHECK(world.particles_fill(fill, box(0.5f, 0.25f, 0.5f, 0.25f)).value() == 800);
    return water;
}

static void test_library()
{
    CHECK(pbmpm::version() == PBMPM_VERSION_MAJOR * 1000000u + PBMPM_VERSION_MINOR * 1000u + PBMPM_VERSION_PATCH);
    CHECK(pbmpm::abi_version() == PBMPM_ABI_VERSION);
    CHECK(pbmpm::active_isa() != PBMPM_ISA_NONE && pbmpm::isa_name(pbmpm::active_isa())[0] != '\0');
    CHECK((pbmpm::materials_built() & 1u << PBMPM_SAND) != 0);
    CHECK(!pbmpm::build_is_strict());
    CHECK(std::strcmp(pbmpm::result_name(PBMPM_ERROR_BUSY), "PBMPM_ERROR_BUSY") == 0);
    CHECK(std::strcmp(pbmpm::advice_name(PBMPM_ADVICE_NO_GRAVITY), "PBMPM_ADVICE_NO_GRAVITY") == 0);
    CHECK(std::strcmp(pbmpm::advice_unit(PBMPM_ADVICE_STEP_TOO_LONG), "cells per substep") == 0);
    const auto layouts = pbmpm::layout_table();
    CHECK(layouts && layouts->size() > 100 && (*layouts)[0].structure[0] != '\0');
    const auto asserts = pbmpm::set_assert_callback(nullptr); /* as the library was built */
    CHECK(asserts || fails(asserts, PBMPM_ERROR_UNSUPPORTED));

    int lines = 0;
    CHECK(pbmpm::set_log_callback([](pbmpm_log_level, const char *, void *user) { ++*static_cast<int *>(user); }, &lines));
    CHECK(fails(pbmpm::world_ref().step(dt), PBMPM_ERROR_INVALID_ID));
    CHECK(pbmpm::set_log_callback(nullptr) && lines == 1);
}

static void test_life()
{
    std::array<pbmpm_world_id, 4> ids{};
    pbmpm_world_id id{};
    {
        pbmpm::world world = make_world();
        id = world.id();
        pbmpm::world moved = std::move(world);
        CHECK(moved.id() == id && pbmpm::is_null(world.id()));
        CHECK(pbmpm::get_worlds(ids).value() == 1 && ids[0] == id);
        CHECK(moved.is_valid().value() && moved.get_def()->cell_size == 0.05f);
        pbmpm::world other = make_world();
        const pbmpm_world_id replaced = other.id();
        other = std::move(moved);
        CHECK(other.id() == id && !pbmpm::world_ref(replaced).is_valid().value());
        world = pbmpm::world(other.release());
        CHECK(world.id() == id && pbmpm::is_null(other.id()) && !other.destroy());
        pbmpm::world &itself = world;
        world = std::move(itself);
        CHECK(world.is_valid().value());
    }
    CHECK(!pbmpm::world_ref(id).is_valid().value() && pbmpm::get_worlds({}).value() == 0);
    pbmpm::world world = make_world();
    CHECK(world.destroy() && pbmpm::is_null(world.id()) && fails(world.destroy(), PBMPM_ERROR_INVALID_ID));

    pbmpm::world_def wrong;
    wrong.cell_size = -1;
    auto refused = pbmpm::world::create(wrong);
    CHECK(fails(refused, PBMPM_ERROR_INVALID_ARGUMENT) && std::strcmp(refused.error().name(), "PBMPM_ERROR_INVALID_ARGUMENT") == 0);
    CHECK(pbmpm::is_null(std::move(refused).value_or(pbmpm::world()).id()));
}

static void test_hosts_memory()
{
    std::int64_t held = 0;
    pbmpm::allocator memory;
    memory.allocate = [](std::size_t size, std::size_t alignment, void *user) -> void * {
        *static_cast<std::int64_t *>(user) += static_cast<std::int64_t>(size);
        return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    };
    memory.release = [](void *block, std::size_t size, void *user) {
        *static_cast<std::int64_t *>(user) -= static_cast<std::int64_t>(size);
        std::free(block);
    };
    memory.user = &held;
    pbmpm::task_hooks tasks;
    tasks.enqueue = [](pbmpm_task *task, std::int32_t count, void *context, void *) -> void * {
        for (std::int32_t i = 0; i < count; i++) task(i, context);
        return context;
    };
    tasks.finish = [](void *, void *) {};
    pbmpm::world_def def;
    def.allocator = &memory;
    def.tasks = &tasks;
    {
        auto world = pbmpm::world::create(def);
        CHECK(world && held > 0 && world->step(dt));
    }
    CHECK(held == 0);
}

/* The same scene in C gives the same bits. */
static void test_same_as_c()
{
    const pbmpm::world world = make_world();
    fill_water(world);
    for (int i = 0; i < 10; i++) CHECK(world.step(dt));
    const std::uint64_t hash = world.hash().value();
    CHECK(hash != 0 && hash == hash_of_the_scene_in_c());
}

static void test_step()
{
    const pbmpm::world world = make_world();
    const pbmpm_material_id water = fill_water(world);
    const std::uint64_t generation = world.generation().value();
    CHECK(world.get_settings()->iterations == 5);
    CHECK(world.step(dt) && world.generation().value() > generation);
    CHECK(world.get_stats()->particle_count == 800 && world.get_stats()->max_speed > 0);
    CHECK(world.get_step_stats()->step_count == 1 && world.get_step_stats()->max_speed == 0);
    const auto moved = world.shift_origin({{0.21, 0, 0}}); /* to the nearest four cells, of 0.05 m as a float */
    CHECK(moved && std::fabs((*moved)[0] - 0.2) < 1e-7 && (*moved)[1] == 0 && world.get_def()->origin[0] == (*moved)[0]);

    const std::array<pbmpm_field, 1> published{{PBMPM_POSITION}};
    CHECK(world.publish(published) && world.step_begin(dt));
    CHECK(world.step_done().has_value() && fails(world.particles_view(PBMPM_VELOCITY), PBMPM_ERROR_BUSY));
    CHECK(world.particles_view(PBMPM_POSITION)->count == 800 && world.step_end() && fails(world.step_end(false), PBMPM_ERROR_INVALID_ARGUMENT));

    pbmpm::settings still;
    CHECK(world.set_settings(still));
    std::array<pbmpm_advice, 8> advice{};
    CHECK(world.advice(dt, advice).value() >= 1 && advice[0].code == PBMPM_ADVICE_NO_GRAVITY && world.advice(dt, {}).value() >= 1);
    std::array<pbmpm_line, 4> walls{};
    CHECK(world.debug_lines(PBMPM_DEBUG_DOMAIN, walls).value() == 4 && walls[0].part == PBMPM_DEBUG_DOMAIN);

    pbmpm::fill_def fill;
    fill.material = water;
    fill.particles_per_axis = 16;
    const auto too_many = world.particles_fill(fill, box(0.25f, 0.75f, 0.2f, 0.2f));
    CHECK(fails(too_many, PBMPM_ERROR_CAPACITY) && too_many.error().needed == 128 * 128);
    std::array<pbmpm_event, 2> events{};
    const auto kept = world.events(events);
    CHECK(kept && kept->kept == 1 && kept->missed == 0 && events[0].kind == PBMPM_EVENT_CAPACITY && events[0].count == 128 * 128);
    CHECK(world.wake());
}

static void test_materials()
{
    const pbmpm::world world = make_world();
    pbmpm::material_def def;
    def.kind = PBMPM_ELASTIC;
    const pbmpm_material_id jelly = world.material_create(def).value();
    def.young_modulus = 5e4f;
    CHECK(world.material_set(jelly, def) && world.material_get(jelly)->young_modulus == 5e4f);
    CHECK(world.material_effective(jelly, dt)->young_modulus > 0);
    std::array<pbmpm_material_id, 2> list{};
    CHECK(world.get_materials(list).value() == 1 && list[0] == jelly && list[1] != jelly);
    CHECK(world.material_is_valid(jelly).value() && world.material_destroy(jelly) && !world.material_is_valid(jelly).value());
}

static void test_particles()
{
    const pbmpm::world world = make_world();
    const std::vector<float> positions{0.3f, 0.3f, 0.5f, 0.5f, 0.7f, 0.7f};
    pbmpm::particles_def def;
    def.material = world.material_create(pbmpm::material_def()).value();
    def.count = 3;
    def.positions = positions.data();
    std::vector<pbmpm_particle_id> ids(2), none;
    CHECK(fails(world.particles_add(def, ids), PBMPM_ERROR_INVALID_ARGUMENT) && world.particles_count().value() == 0);
    ids.resize(3);
    CHECK(world.particles_add(def, ids) && world.particles_count().value() == 3 && ids[0] != ids[1]);
    none.reserve(8);
    CHECK(world.particles_remove(none) && world.particles_count().value() == 3);

    const pbmpm::view view = world.particles_view(PBMPM_POSITION).value();
    CHECK(view.count == 3 && view.components == 2 && view.at<float>(1, 0) == 0.5f && view.at<float>(2, 1) == 0.7f);
    CHECK(fails(world.particles_view(PBMPM_USER_VALUE), PBMPM_ERROR_UNSUPPORTED));

    std::vector<float> records(12);
    pbmpm::copy_def copy;
    const std::array<pbmpm_field, 2> fields{{PBMPM_POSITION, PBMPM_VELOCITY}};
    copy.field_count = 2;
    copy.fields = fields.data();
    const auto no_room = world.particles_copy(copy, {});
    CHECK(fails(no_room, PBMPM_ERROR_CAPACITY) && no_room.error().needed == 3);
    CHECK(world.particles_copy(copy, pbmpm::as_writable_bytes(records)).value() == 3 && records[0] == 0.3f && records[8] == 0.7f);

    const std::array<float, 2> velocity{{1, 2}};
    const std::array<pbmpm_particle_id, 1> second{{ids[1]}};
    CHECK(world.particles_set(PBMPM_VELOCITY, second, velocity) && world.particles_view(PBMPM_VELOCITY)->at<float>(1, 1) == 2);
    CHECK(fails(world.particles_set(PBMPM_VELOCITY, ids, velocity), PBMPM_ERROR_INVALID_ARGUMENT)); /* three identifiers, values for one */
    CHECK(fails(world.particles_set(PBMPM_USER_VALUE, second, velocity), PBMPM_ERROR_INVALID_ARGUMENT));
    CHECK(world.particles_set(PBMPM_VELOCITY, none, {}) && world.particles_set(PBMPM_VELOCITY, {}, {}) && world.particles_view(PBMPM_VELOCITY)->at<float>(1, 1) == 2);
    const std::array<float, 12> affine{{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
    CHECK(world.particles_set_all(PBMPM_AFFINE_VELOCITY, affine) && world.particles_view(PBMPM_AFFINE_VELOCITY)->at<float>(2, 3) == 12);
    CHECK(fails(world.particles_set_all(PBMPM_POSITION, velocity), PBMPM_ERROR_INVALID_ARGUMENT)); /* values for one of three */
    const std::array<std::uint32_t, 3> owners{{7, 8, 9}};
    CHECK(world.particles_set_all(owners) && world.particles_set(second, pbmpm::span<const std::uint32_t>(owners.data() + 2, 1)));
    CHECK(world.particles_view(PBMPM_USER_VALUE)->at<std::uint32_t>(1) == 9);

    std::vector<std::uint32_t> rows(2);
    CHECK(fails(world.particles_find(ids, rows), PBMPM_ERROR_INVALID_ARGUMENT));
    rows.resize(3);
    CHECK(world.particles_find(ids, rows) && rows[2] == 2);
    CHECK(world.particles_remove(second) && world.particles_count().value() == 2 && fails(world.particles_remove(second), PBMPM_ERROR_INVALID_ID));
    CHECK(world.particles_remove_in(box(0.3f, 0.3f, 0.1f, 0.1f)).value() == 1);
}

static void test_colliders()
{
    const pbmpm::world world = make_world();
    fill_water(world);
    pbmpm::collider_def def;
    def.kinematic = def.measures_impulse = def.reports_touches = 1;
    const pbmpm_collider_id collider = world.collider_create(def, box(0.5f, 0.6f, 0.1f, 0.1f)).value();
    std::array<pbmpm_collider_id, 2> list{};
    CHECK(world.get_colliders(list).value() == 1 && list[0] == collider && world.collider_is_valid(collider).value());
    CHECK(world.collider_get(collider)->def.kinematic == 1 && world.collider_get(collider)->shape.position[1] == 0.6f);
    def.friction_coefficient = 0.5f;
    const pbmpm::shape wider = box(0.5f, 0.6f, 0.2f, 0.1f);
    CHECK(world.collider_set(collider, &def) && world.collider_get(collider)->def.friction_coefficient == 0.5f);
    CHECK(world.collider_set(collider, nullptr, &wider) && world.collider_get(collider)->shape.half_extents[0] == 0.2f);

    CHECK(world.collider_move(collider, {{0.5f, 0.55f, 0}}) && world.step(dt));
    CHECK(world.collider_move(collider, {{0.5f, 0.5f, 0}}, {{0, 0, 0, 1}}) && world.step(dt));
    CHECK(world.collider_get(collider)->shape.position[1] == 0.5f);
    CHECK(world.collider_impulse(collider)->linear[1] > 0 && world.domain_impulse(1, false)->linear[1] < 0);
    std::array<pbmpm_touch, 2> touches{};
    CHECK(world.touches(touches).value() == 1 && touches[0].collider == collider && touches[0].particles > 0);
    std::vector<pbmpm_particle_id> inside(800);
    CHECK(world.query_collider(collider, inside).has_value());
    CHECK(world.collider_submerged(collider)->share > 0.2);
    const auto wall = world.domain_wall_get(1, true);
    CHECK(wall && wall->open == 0);
    pbmpm_domain_wall open = *wall;
    open.open = 1;
    CHECK(world.domain_wall_set(1, true, open) && world.domain_wall_get(1, true)->open == 1);

    pbmpm::rigid_def body;
    const auto mass = world.shape_mass(wider, 500);
    CHECK(mass && std::fabs(mass->mass - 500 * 0.4 * 0.2) < 1e-3);
    body.mass = mass->mass;
    std::copy(mass->inertia, mass->inertia + 3, body.inertia);
    auto state = world.rigid_begin(collider, body);
    CHECK(state && world.rigid_advance(collider, body, *state, dt) && state->velocity[1] != 0);
    CHECK(world.collider_teleport(collider, {{0.5f, 0.8f, 0}}) && world.collider_teleport(collider, {{0.5f, 0.9f, 0}}, {{0, 0, 0, 1}}));
    CHECK(world.collider_destroy(collider) && !world.collider_is_valid(collider).value());
}

static void test_solids()
{
    const pbmpm::world world = make_world();
    const std::array<float, 6> corners{{0, 0, 0.4f, 0, 0, 0.4f}};
    const std::array<std::uint32_t, 6> edges{{0, 1, 1, 2, 2, 0}};
    pbmpm::mesh_def mesh;
    mesh.dimension = 2;
    mesh.resolution = 16;
    mesh.vertex_count = mesh.element_count = 3;
    mesh.vertices = corners.data();
    mesh.elements = edges.data();
    std::vector<std::byte> baked;
    baked.reserve(16); /* no elements, yet an address */
    const std::uint64_t size = pbmpm::bake_mesh(mesh, baked).value();
    baked.resize(16);
    const auto too_small = pbmpm::bake_mesh(mesh, baked);
    CHECK(fails(too_small, PBMPM_ERROR_CAPACITY) && too_small.error().needed == size);
    baked.resize(size);
    CHECK(pbmpm::bake_mesh(mesh, baked).value() == size && pbmpm::baked_inspect(baked)->dimension == 2);
    mesh.element_count = 0;
    mesh.elements = nullptr;
    CHECK(pbmpm::bake_hull(mesh, {}).value() > 0);
    const std::array<float, 4> samples{{0, 0.1f, 0, 0.1f}};
    pbmpm::heights_def heights;
    heights.dimension = 2;
    heights.count[0] = 4;
    heights.heights = samples.data();
    CHECK(pbmpm::bake_heights(heights, {}).value() > 0);

    const pbmpm_baked_id solid = world.baked_create(baked).value();
    CHECK(world.baked_get(solid)->bytes == size && world.baked_destroy(solid));
    baked[size / 2] ^= std::byte{1};
    CHECK(fails(world.baked_create(baked), PBMPM_ERROR_DAMAGED));
}

static void test_flow()
{
    const pbmpm::world world = make_world();
    const pbmpm_material_id water = fill_water(world);
    pbmpm::emitter_def jet;
    jet.material = water;
    jet.rate = 0.1f;
    const pbmpm_emitter_id emitter = world.emitter_create(jet, box(0.5f, 0.8f, 0.05f, 0.05f)).value();
    const pbmpm_drain_id drain = world.drain_create(pbmpm::drain_def(), box(0.1f, 0.1f, 0.1f, 0.1f)).value();
    pbmpm::force_def wind;
    wind.strength = 3;
    const pbmpm_force_id force = world.force_create(wind, pbmpm::shape()).value();
    CHECK(world.emitter_move(emitter, {{0.5f, 0.8f, 0}}) && world.emitter_move(emitter, {{0.5f, 0.75f, 0}}, {{0, 0, 0, 1}}));
    for (int i = 0; i < 4; i++) CHECK(world.step(dt));
    CHECK(world.emitter_status_get(emitter)->emitted > 0 && world.drain_status_get(drain)->drained > 0 && world.force_status_get(force)->nodes > 0);
    CHECK(world.get_flow()->emitted == world.emitter_status_get(emitter)->emitted);

    jet.rate = 0.2f;
    pbmpm::drain_def resting;
    resting.enabled = 0;
    wind.strength = 4;
    const pbmpm::shape place = box(0.3f, 0.7f, 0.05f, 0.05f);
    CHECK(world.emitter_set(emitter, &jet, &place) && world.emitter_get(emitter)->def.rate == 0.2f && world.emitter_get(emitter)->shape.position[0] == 0.3f);
    CHECK(world.drain_set(drain, &resting) && world.drain_get(drain)->def.enabled == 0 && world.drain_get(drain)->shape.position[0] == 0.1f);
    CHECK(world.force_set(force, &wind, &place) && world.force_get(force)->def.strength == 4 && world.force_get(force)->shape.position[0] == 0.3f);
    std::array<pbmpm_emitter_id, 1> emitters{};
    std::array<pbmpm_drain_id, 1> drains{};
    std::array<pbmpm_force_id, 1> forces{};
    CHECK(world.get_emitters(emitters).value() == 1 && emitters[0] == emitter && world.emitter_is_valid(emitter).value());
    CHECK(world.get_drains(drains).value() == 1 && drains[0] == drain && world.drain_is_valid(drain).value());
    CHECK(world.get_forces(forces).value() == 1 && forces[0] == force && world.force_is_valid(force).value());
    CHECK(world.emitter_destroy(emitter) && world.drain_destroy(drain) && world.force_destroy(force));
    CHECK(!world.emitter_is_valid(emitter).value() && !world.drain_is_valid(drain).value() && !world.force_is_valid(force).value());

    pbmpm::kill_bounds bounds;
    bounds.enabled = 1;
    CHECK(world.set_kill_bounds(bounds) && world.get_kill_bounds()->enabled == 1);
}

static void test_questions()
{
    const pbmpm::world world = make_world();
    const pbmpm_material_id water = fill_water(world);
    std::vector<pbmpm_particle_id> ids(1);
    std::array<pbmpm_region_share, 2> shares{};
    const pbmpm::shape all = box(0.5f, 0.5f, 0.5f, 0.5f);
    CHECK(world.query_shape(all, ids).value() == 800 && !pbmpm::is_null(ids[0]));
    CHECK(world.query_region(all, shares).value() == 1 && shares[0].material == water && shares[0].count == 800);

    const std::array<float, 4> points{{0.5f, 0.25f, 0.5f, 0.9f}};
    std::array<float, 2> filling{}, heights{};
    std::array<float, 4> velocity{};
    std::array<float, 1> one{{-1}};
    const pbmpm::span<float> none(one.data(), 0); /* no elements, yet an address, which must not be written to */
    CHECK(world.query_points(points, filling, none, velocity) && filling[0] > 0.9f && filling[1] == 0 && one[0] == -1);
    CHECK(world.query_points(points, {}, filling) && filling[0] > 900);
    CHECK(world.query_points(none, filling) && fails(world.query_points(points, one), PBMPM_ERROR_INVALID_ARGUMENT));
    CHECK(fails(world.query_points(points, filling, {}, heights), PBMPM_ERROR_INVALID_ARGUMENT));
    CHECK(fails(world.query_points(pbmpm::span<const float>(points.data(), 3), filling), PBMPM_ERROR_INVALID_ARGUMENT));
    const std::array<float, 2> up{{0, 1}};
    CHECK(world.query_heights(points, heights) && std::fabs(heights[0] - 0.5f) < 0.02f);
    CHECK(world.query_heights(points, heights, 0.5f, up) && fails(world.query_heights(points, one), PBMPM_ERROR_INVALID_ARGUMENT));
    CHECK(fails(world.query_heights(points, heights, 0.5f, one), PBMPM_ERROR_INVALID_ARGUMENT));
    pbmpm::ray ray;
    ray.origin[0] = 0.5f;
    ray.origin[1] = 0.9f;
    CHECK(world.query_ray(ray)->hit == 1 && std::fabs(world.query_ray(ray)->distance - 0.4f) < 0.02f && world.query_ray(ray)->material == water);
}

static void test_surfaces()
{
    pbmpm::world_def def;
    def.dimension = 3;
    def.particle_capacity = 1000;
    const pbmpm::world world = pbmpm::world::create(def).value();
    pbmpm::fill_def fill;
    fill.material = world.material_create(pbmpm::material_def()).value();
    pbmpm::shape ball;
    ball.kind = PBMPM_SPHERE;
    ball.radius = 0.25f;
    const std::uint32_t particles = world.particles_fill(fill, ball).value();
    pbmpm::surface_def surface;
    pbmpm_surface_mesh mesh{};
    CHECK(world.surface_extract(surface, mesh) && mesh.vertex_count > 100 && mesh.index_count == 6 * mesh.vertex_count - 12); /* as of a ball */
    std::vector<float> positions(3 * std::size_t{mesh.vertex_count});
    mesh.positions = positions.data();
    CHECK(fails(world.surface_extract(surface, mesh), PBMPM_ERROR_CAPACITY) && mesh.vertex_count * std::size_t{3} == positions.size());
    mesh.vertex_capacity = mesh.vertex_count;
    CHECK(world.surface_extract(surface, mesh) && std::fabs(positions[0]) < 0.3f && positions[0] != 0);
    const auto no_room = world.surface_points(pbmpm::points_def(), {});
    CHECK(fails(no_room, PBMPM_ERROR_CAPACITY) && no_room.error().needed == particles);
    std::vector<pbmpm_point> points(particles);
    CHECK(world.surface_points(pbmpm::points_def(), points).value() == particles && points[0].colour == 0xffffffffu);
}

static void test_saves()
{
    const pbmpm::world world = make_world();
    fill_water(world);
    const std::uint64_t hash = world.hash().value();
    const auto size = world.snapshot_size();
    CHECK(size && size->per_particle > 0 && size->all > std::uint64_t{800} * size->per_particle);
    const auto no_room = world.snapshot_save({});
    CHECK(fails(no_room, PBMPM_ERROR_CAPACITY) && no_room.error().needed == size->all);
    std::vector<std::byte> saved(size->all);
    CHECK(world.snapshot_save(saved).value() == size->all && world.step(dt) && world.hash().value() != hash);
    CHECK(world.snapshot_restore(saved) && world.hash().value() == hash);
    saved.pop_back();
    CHECK(fails(world.snapshot_restore(saved), PBMPM_ERROR_DAMAGED) && world.snapshot_restore(saved, PBMPM_RESTORE_KEEP_PARAMETERS).error().code == PBMPM_ERROR_DAMAGED);
}

int main()
{
    test_library();
    test_life();
    test_hosts_memory();
    test_same_as_c();
    test_step();
    test_materials();
    test_particles();
    test_colliders();
    test_solids();
    test_flow();
    test_questions();
    test_surfaces();
    test_saves();
    CHECK(pbmpm::shutdown());
    std::printf("%d checks, %d failures\n", checks, failures);
    return failures != 0;
}

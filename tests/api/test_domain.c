/* The box that a world is in: its walls, one by one, and the origin that all positions are relative to. */
#include <math.h>
#include <string.h>

#include "scenes.h"

void setUp(void) {}
void tearDown(void) { pbmpm_shutdown(); }

static pbmpm_domain_wall wall_of(pbmpm_world_id world, int32_t axis, int32_t upper)
{
    pbmpm_domain_wall wall = {.size = sizeof wall};
    OK(pbmpm_domain_wall_get(world, axis, upper, &wall));
    return wall;
}

static void open_wall(pbmpm_world_id world, int32_t axis, int32_t upper, int32_t open)
{
    pbmpm_domain_wall wall = wall_of(world, axis, upper);
    wall.open = open;
    OK(pbmpm_domain_wall_set(world, axis, upper, &wall));
}

static uint32_t count_in(pbmpm_world_id world, pbmpm_shape shape)
{
    uint32_t count;
    OK(pbmpm_query_shape(world, &shape, NULL, 0, &count));
    return count;
}

static void run(pbmpm_world_id world, int steps)
{
    for (int i = 0; i < steps; i++) OK(pbmpm_world_step(world, 1.0f / 60));
}

static void test_walls_begin_as_the_definition_says(void)
{
    pbmpm_world_def def = default_world(3, 0.1f, 100);
    def.domain_enabled = 1;
    def.domain_friction = 0.375f;
    const pbmpm_world_id world = create_world(&def);
    for (int32_t place = 0; place < 6; place++) {
        const pbmpm_domain_wall wall = wall_of(world, place / 2, place % 2);
        TEST_ASSERT_EQUAL_INT32(0, wall.open);
        TEST_ASSERT_EQUAL_INT(PBMPM_FRICTION_COULOMB, wall.friction);
        TEST_ASSERT_EQUAL_FLOAT(0.375f, wall.friction_coefficient);
    }
}

static void test_what_is_no_wall_is_refused(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL), unbounded = block_2d(NULL, NULL);
    pbmpm_domain_wall wall = wall_of(world, 0, 0);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_domain_wall_get(world, 2, 0, &wall));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_domain_wall_get(world, -1, 0, &wall));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_domain_wall_set(world, 0, 2, &wall));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_domain_wall_set(unbounded, 0, 0, &wall));
    wall.open = 2;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_domain_wall_set(world, 0, 0, &wall));
    wall.open = 0;
    wall.friction = (pbmpm_friction)-1;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_domain_wall_set(world, 0, 0, &wall));
    wall.friction = PBMPM_FRICTION_SLIP;
    wall.friction_coefficient = NAN;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_domain_wall_set(world, 0, 0, &wall));
    TEST_ASSERT_EQUAL_INT(PBMPM_FRICTION_COULOMB, wall_of(world, 0, 0).friction);
}

/* Water runs out where a wall opens, and stays out when it closes behind it. */
static void test_an_open_wall_lets_matter_out(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const pbmpm_shape outside = box_shape(6.05f, 0.0f, 0, 5.0f, 60.0f, 1.0f);
    const uint32_t all = world_count(world);
    run(world, 20);
    TEST_ASSERT_EQUAL_UINT32(0, count_in(world, outside));
    open_wall(world, 0, 1, 1);
    run(world, 30);
    const uint32_t out = count_in(world, outside);
    TEST_ASSERT_TRUE(out > all / 4);
    TEST_ASSERT_EQUAL_UINT32(all, world_count(world));
    uint32_t removed;
    OK(pbmpm_particles_remove_in(world, &outside, &removed));
    open_wall(world, 0, 1, 0);
    run(world, 30);
    TEST_ASSERT_EQUAL_UINT32(0, count_in(world, outside));
}

/* The floor goes: all falls as if there were no box, and can be put where the floor was. */
static void test_without_a_floor_all_falls(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    run(world, 20);
    open_wall(world, 1, 0, 1);
    run(world, 60);
    TEST_ASSERT_EQUAL_UINT32(world_count(world), count_in(world, box_shape(0.5f, -10.0f, 0, 0.6f, 9.9f, 1.0f)));
    const float below[2] = {0.5f, -3.0f};
    pbmpm_particles_def def;
    OK(pbmpm_particles_def_init(&def, sizeof def));
    def.count = 1;
    def.positions = below;
    def.material = create_material(world, PBMPM_LIQUID);
    OK(pbmpm_particles_add(world, &def, NULL));
    const float beside[2] = {-0.5f, -3.0f};
    def.positions = beside;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_add(world, &def, NULL));
}

/* How far a block of jelly slides on a floor like this, pushed at 2 m/s. */
static float slide(pbmpm_friction friction, float coefficient)
{
    pbmpm_world_def def = default_world(2, 0.05f, 4000);
    def.domain_enabled = 1;
    def.domain_max[0] = 4.0f;
    const pbmpm_world_id world = create_world(&def);
    set_gravity(world, 0, -9.81f, 0);
    pbmpm_domain_wall wall = wall_of(world, 1, 0);
    wall.friction = friction;
    wall.friction_coefficient = coefficient;
    OK(pbmpm_domain_wall_set(world, 1, 0, &wall));
    pbmpm_material_def jelly = default_material(PBMPM_ELASTIC);
    pbmpm_material_id material;
    jelly.young_modulus = 1e5f;
    OK(pbmpm_material_create(world, &jelly, &material));
    fill_shape(world, material, box_shape(0.4f, 0.1f, 0, 0.3f, 0.1f, 0), (const float[3]){2, 0, 0});
    const double mass = world_stats(world).mass;
    run(world, 30);
    const float speed = (float)(world_stats(world).momentum[0] / mass);
    OK(pbmpm_world_destroy(world));
    return speed;
}

static void test_each_wall_has_its_own_friction(void)
{
    TEST_ASSERT_FLOAT_WITHIN(0.02f, 2.0f, slide(PBMPM_FRICTION_SLIP, 0.9f));
    TEST_ASSERT_FLOAT_WITHIN(0.02f, 2.0f, slide(PBMPM_FRICTION_COULOMB, 0.0f));
    TEST_ASSERT_FLOAT_WITHIN(0.1f, 2.0f - 0.2f * 9.81f * 0.5f, slide(PBMPM_FRICTION_COULOMB, 0.2f)); /* mu g t */
    TEST_ASSERT_FLOAT_WITHIN(0.1f, 0.0f, slide(PBMPM_FRICTION_STICK, 0.0f));
}

static char saved[1 << 20];

static void test_walls_are_saved(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL), other = tank_2d(NULL, NULL);
    uint64_t bytes;
    OK(pbmpm_snapshot_save(world, saved, sizeof saved, &bytes));
    const uint64_t closed = bytes;
    open_wall(world, 0, 1, 1);
    OK(pbmpm_snapshot_save(world, saved, sizeof saved, &bytes));
    TEST_ASSERT_TRUE(bytes > closed);
    OK(pbmpm_snapshot_restore(other, saved, bytes, PBMPM_RESTORE_KEEP_PARAMETERS));
    TEST_ASSERT_EQUAL_INT32(0, wall_of(other, 0, 1).open);
    OK(pbmpm_snapshot_restore(other, saved, bytes, 0));
    TEST_ASSERT_EQUAL_INT32(1, wall_of(other, 0, 1).open);
    TEST_ASSERT_EQUAL_INT32(0, wall_of(other, 0, 0).open);
    run(world, 30);
    run(other, 30);
    TEST_ASSERT_EQUAL_HEX64(world_hash(world), world_hash(other));
}

static void test_a_wall_wakes_what_sleeps(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    pbmpm_settings settings = {.size = sizeof settings};
    OK(pbmpm_world_get_settings(world, &settings));
    settings.sleeping = 1;
    settings.sleep_speed = 1.0f;
    settings.sleep_time = 0.1f;
    OK(pbmpm_world_set_settings(world, &settings));
    run(world, 240);
    TEST_ASSERT_EQUAL_UINT32(world_count(world), world_stats(world).particles_asleep);
    open_wall(world, 0, 1, 1);
    run(world, 30);
    TEST_ASSERT_TRUE(count_in(world, box_shape(6.05f, 0.0f, 0, 5.0f, 60.0f, 1.0f)) > 50);
}

/* ---- The origin ---- */

/* Cells of 1/8 m, so that positions are exact: then obstacles too are where they were. */
static pbmpm_world_id far_scene(bool sleeping)
{
    pbmpm_world_def def = default_world(2, 0.125f, 2000);
    def.domain_enabled = 1;
    def.domain_min[0] = 1000.0f;
    def.domain_max[0] = 1004.0f;
    def.domain_max[1] = 4.0f;
    const pbmpm_world_id world = create_world(&def);
    set_gravity(world, 0, -9.81f, 0);
    pbmpm_settings settings = {.size = sizeof settings};
    OK(pbmpm_world_get_settings(world, &settings));
    settings.sleeping = sleeping;
    settings.sleep_speed = 1.0f;
    settings.sleep_time = 0.1f;
    OK(pbmpm_world_set_settings(world, &settings));
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    fill_shape(world, water, box_shape(1002, 0.5f, 0, 2, 0.5f, 0), (const float[3]){0, 0, 0});
    create_collider(world, box_shape(1003, 0.5f, 0, 0.25f, 1.0f, 0.5f), false);
    pbmpm_emitter_def tap;
    const pbmpm_shape mouth = box_shape(1001, 2, 0, 0.25f, 0.25f, 0.5f);
    pbmpm_emitter_id emitter;
    OK(pbmpm_emitter_def_init(&tap, sizeof tap));
    tap.material = water;
    tap.rate = sleeping ? 0.0f : 0.2f;
    OK(pbmpm_emitter_create(world, &tap, &mouth, &emitter));
    create_drain(world, box_shape(1003.5f, 0.25f, 0, 0.125f, 0.125f, 0.5f));
    return world;
}

static void test_a_shifted_world_goes_on_as_before(void)
{
    const pbmpm_world_id stays = far_scene(false), moves = far_scene(false);
    const double wanted[3] = {1000.1, 0.2, 77.0};
    double moved[3];
    run(stays, 20);
    run(moves, 20);
    OK(pbmpm_world_shift_origin(moves, wanted, moved));
    TEST_ASSERT_EQUAL_DOUBLE(1000.0, moved[0]); /* whole blocks of 1/2 m */
    TEST_ASSERT_EQUAL_DOUBLE(0.0, moved[1]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, moved[2]);
    pbmpm_world_def def = {.size = sizeof def};
    OK(pbmpm_world_get_def(moves, &def));
    TEST_ASSERT_EQUAL_DOUBLE(1000.0, def.origin[0]);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, def.domain_min[0]);
    run(stays, 40);
    run(moves, 40);
    const pbmpm_view a = view_of(stays, PBMPM_POSITION), b = view_of(moves, PBMPM_POSITION);
    const pbmpm_view u = view_of(stays, PBMPM_VELOCITY), v = view_of(moves, PBMPM_VELOCITY);
    TEST_ASSERT_EQUAL_UINT32(a.count, b.count);
    TEST_ASSERT_TRUE(a.count > 600);
    for (uint32_t i = 0; i < a.count; i++) {
        TEST_ASSERT_FLOAT_WITHIN(1e-4f, view_float(&a, i, 0), 1000.0f + view_float(&b, i, 0)); /* the rounding of a float at 1000 m */
        TEST_ASSERT_EQUAL_FLOAT(view_float(&a, i, 1), view_float(&b, i, 1));
        TEST_ASSERT_EQUAL_FLOAT(view_float(&u, i, 0), view_float(&v, i, 0));
        TEST_ASSERT_EQUAL_FLOAT(view_float(&u, i, 1), view_float(&v, i, 1));
    }
}

static void test_what_sleeps_sleeps_on(void)
{
    const pbmpm_world_id world = far_scene(true);
    const double wanted[3] = {1002.0, -3.0, 0.0};
    double moved[3];
    run(world, 300);
    const uint32_t asleep = world_stats(world).particles_asleep;
    TEST_ASSERT_EQUAL_UINT32(world_count(world), asleep);
    OK(pbmpm_world_shift_origin(world, wanted, moved));
    run(world, 2);
    TEST_ASSERT_EQUAL_UINT32(asleep, world_stats(world).particles_asleep);
    const pbmpm_shape there = box_shape(1000.5f - 1002.0f, 0.5f + 3.0f, 0, 0.25f, 0.25f, 1.0f);
    OK(pbmpm_world_wake(world, &there));
    run(world, 1);
    const uint32_t still = world_stats(world).particles_asleep;
    TEST_ASSERT_TRUE(still > 0 && still < asleep); /* it found those that are there, and no others */
}

/* What an obstacle was given does not depend on where the origin is; a body that is moved along floats on. */
static void test_impulses_and_bodies_stay_what_they_are(void)
{
    const pbmpm_world_id stays = far_scene(false), moves = far_scene(false), worlds[2] = {stays, moves};
    pbmpm_collider_def def = default_collider();
    pbmpm_collider_id box[2];
    pbmpm_rigid_def body;
    pbmpm_rigid_state state[2];
    double moved[3] = {0};
    const pbmpm_shape shape = box_shape(1002, 1.25f, 0, 0.25f, 0.25f, 0.25f);
    def.kinematic = def.measures_impulse = 1;
    OK(pbmpm_rigid_def_init(&body, sizeof body));
    body.mass = 100;
    for (int k = 0; k < 2; k++) {
        state[k].size = sizeof state[k];
        OK(pbmpm_collider_create(worlds[k], &def, &shape, &box[k]));
        OK(pbmpm_rigid_begin(worlds[k], box[k], &body, &state[k]));
        for (int step = 0; step < 30; step++) {
            OK(pbmpm_rigid_advance(worlds[k], box[k], &body, &state[k], 1.0f / 60));
            run(worlds[k], 1);
        }
    }
    pbmpm_impulse before = {.size = sizeof before}, after = {.size = sizeof after};
    OK(pbmpm_collider_impulse(moves, box[1], &before));
    TEST_ASSERT_TRUE(before.linear[1] > 1.0);
    OK(pbmpm_world_shift_origin(moves, (const double[3]){1000, 0, 0}, moved));
    OK(pbmpm_collider_impulse(moves, box[1], &after));
    TEST_ASSERT_EQUAL_DOUBLE(before.linear[1], after.linear[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3 * before.linear[1], before.angular[2], after.angular[2]);
    for (int a = 0; a < 3; a++) {
        state[1].position[a] -= moved[a];
        state[1].point[a] -= moved[a];
    }
    for (int k = 0; k < 2; k++)
        for (int step = 0; step < 30; step++) {
            OK(pbmpm_rigid_advance(worlds[k], box[k], &body, &state[k], 1.0f / 60));
            run(worlds[k], 1);
        }
    TEST_ASSERT_DOUBLE_WITHIN(0.02, state[0].position[0] - 1000.0, state[1].position[0]); /* floats round otherwise at 1000 m */
    TEST_ASSERT_DOUBLE_WITHIN(0.02, state[0].position[1], state[1].position[1]);
}

static void test_bounds_at_the_end_of_the_range_stay_there(void)
{
    const pbmpm_world_id world = block_2d(NULL, NULL);
    pbmpm_kill_bounds bounds;
    double moved[3];
    OK(pbmpm_kill_bounds_init(&bounds, sizeof bounds));
    bounds.enabled = 1;
    bounds.low[0] = -1e9f;
    bounds.low[1] = -5;
    bounds.high[0] = bounds.high[1] = 1e9f;
    OK(pbmpm_world_set_kill_bounds(world, &bounds));
    OK(pbmpm_world_shift_origin(world, (const double[3]){4000, 4000, 0}, moved));
    OK(pbmpm_world_get_kill_bounds(world, &bounds));
    TEST_ASSERT_EQUAL_FLOAT(-1e9f, bounds.low[0]);
    TEST_ASSERT_EQUAL_FLOAT((float)(-5 - moved[1]), bounds.low[1]);
}

static void test_a_shift_that_does_not_fit_changes_nothing(void)
{
    const pbmpm_world_id world = far_scene(false);
    const snapshot was = snapshot_take(world);
    double moved[3] = {5, 5, 5};
    const double far[3] = {3e5, 0, 0}, nowhere[3] = {NAN, 0, 0}, endless[3] = {0, INFINITY, 0};
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_shift_origin(world, far, moved));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_shift_origin(world, nowhere, moved));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_shift_origin(world, endless, moved));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_shift_origin(world, NULL, moved));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_shift_origin(world, far, NULL));
    TEST_ASSERT_EQUAL_DOUBLE(5.0, moved[0]);
    snapshot_expect_same(&was, world, "after shifts that were refused");
}

static void test_a_save_brings_its_origin_back(void)
{
    const pbmpm_world_id world = block_2d(NULL, NULL);
    double moved[3];
    uint64_t bytes;
    OK(pbmpm_snapshot_save(world, saved, sizeof saved, &bytes));
    const uint64_t hash = world_hash(world);
    OK(pbmpm_world_shift_origin(world, (const double[3]){40, 80, 0}, moved));
    TEST_ASSERT_FALSE(hash == world_hash(world));
    OK(pbmpm_snapshot_restore(world, saved, bytes, 0));
    pbmpm_world_def def = {.size = sizeof def};
    OK(pbmpm_world_get_def(world, &def));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, def.origin[0]);
    TEST_ASSERT_EQUAL_HEX64(hash, world_hash(world));
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_walls_begin_as_the_definition_says);
    RUN_TEST(test_what_is_no_wall_is_refused);
    RUN_TEST(test_an_open_wall_lets_matter_out);
    RUN_TEST(test_without_a_floor_all_falls);
    RUN_TEST(test_each_wall_has_its_own_friction);
    RUN_TEST(test_walls_are_saved);
    RUN_TEST(test_a_wall_wakes_what_sleeps);
    RUN_TEST(test_a_shifted_world_goes_on_as_before);
    RUN_TEST(test_what_sleeps_sleeps_on);
    RUN_TEST(test_impulses_and_bodies_stay_what_they_are);
    RUN_TEST(test_bounds_at_the_end_of_the_range_stay_there);
    RUN_TEST(test_a_shift_that_does_not_fit_changes_nothing);
    RUN_TEST(test_a_save_brings_its_origin_back);
    return UNITY_END();
}

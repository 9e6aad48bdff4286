/* Colliders and the walls of the domain: each public call of collider.h and shape.h keeps its word. */
#include <math.h>
#include <string.h>

#include "scenes.h"

static const float at_rest[3] = {0, 0, 0};

void setUp(void)
{
}

void tearDown(void)
{
    pbmpm_shutdown();
}

static pbmpm_world_id open_world(int32_t dimension)
{
    const pbmpm_world_def def = default_world(dimension, 0.1f, 8192);
    return create_world(&def);
}

static pbmpm_shape shape_of(pbmpm_world_id world, pbmpm_collider_id collider)
{
    pbmpm_shape shape = {.size = sizeof shape};
    OK(pbmpm_collider_get(world, collider, NULL, &shape));
    return shape;
}

/* ---- definitions ---- */

static void test_shape_has_the_documented_defaults(void)
{
    static const float rotation[4] = {0, 0, 0, 1}, normal[3] = {0, 1, 0}, halves[3] = {0.5f, 0.5f, 0.5f};
    pbmpm_shape shape;
    memset(&shape, 0xA5, sizeof shape);
    OK(pbmpm_shape_init(&shape, sizeof shape));
    TEST_ASSERT_EQUAL_UINT32(sizeof shape, shape.size);
    TEST_ASSERT_EQUAL_INT(PBMPM_BOX, shape.kind);
    TEST_ASSERT_EQUAL_MEMORY(at_rest, shape.position, sizeof at_rest);
    TEST_ASSERT_EQUAL_MEMORY(rotation, shape.rotation, sizeof rotation);
    TEST_ASSERT_EQUAL_MEMORY(halves, shape.half_extents, sizeof halves);
    TEST_ASSERT_EQUAL_FLOAT(0.5f, shape.radius);
    TEST_ASSERT_EQUAL_MEMORY(normal, shape.normal, sizeof normal);
}

static void test_collider_has_the_documented_defaults(void)
{
    pbmpm_collider_def def;
    memset(&def, 0xA5, sizeof def);
    OK(pbmpm_collider_def_init(&def, sizeof def));
    TEST_ASSERT_EQUAL_UINT32(sizeof def, def.size);
    TEST_ASSERT_EQUAL_INT(PBMPM_FRICTION_COULOMB, def.friction);
    TEST_ASSERT_EQUAL_FLOAT(0.2f, def.friction_coefficient);
    TEST_ASSERT_EQUAL_INT32(0, def.kinematic);
    TEST_ASSERT_EQUAL_INT32(0, def.measures_impulse);
    TEST_ASSERT_EQUAL_UINT64(0, def.key);
    TEST_ASSERT_EQUAL_UINT64(0, def.user_data);
}

static void test_collider_is_read_back_and_destroyed(void)
{
    const pbmpm_world_id world = open_world(3);
    const pbmpm_shape shape = sphere_shape(1, 2, 3, 0.75f);
    pbmpm_collider_def def = default_collider(), read = {.size = sizeof read};
    pbmpm_collider_id collider;
    def.friction = PBMPM_FRICTION_STICK;
    def.friction_coefficient = 1.5f;
    def.kinematic = 1;
    def.user_data = UINT64_MAX;
    OK(pbmpm_collider_create(world, &def, &shape, &collider));
    OK(pbmpm_collider_get(world, collider, &read, NULL));
    TEST_ASSERT_EQUAL_MEMORY(&def, &read, sizeof def);
    const pbmpm_shape placed = shape_of(world, collider);
    TEST_ASSERT_EQUAL_MEMORY(&shape, &placed, sizeof shape);
    OK(pbmpm_collider_get(world, collider, NULL, NULL));
    OK(pbmpm_collider_destroy(world, collider));
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_collider_destroy(world, collider));
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_collider_get(world, collider, &def, NULL));
}

/* The length of a quaternion does not matter. */
static void test_rotation_is_normalised(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    pbmpm_shape shape = box_shape(0.5f, 0.3f, 0, 0.4f, 0.05f, 0.5f);
    const pbmpm_collider_id collider = create_collider(world, shape, false);
    uint32_t level, counts[3];
    OK(pbmpm_query_collider(world, collider, NULL, 0, &level));
    for (int i = 0; i < 3; i++) {
        const float scale[3] = {0.55f, 1.0f, 1.9f};
        const float turned[4] = {0, 0, scale[i] * 0.6f, scale[i] * 0.8f};
        OK(pbmpm_collider_teleport(world, collider, shape.position, turned));
        OK(pbmpm_query_collider(world, collider, NULL, 0, &counts[i]));
    }
    TEST_ASSERT_TRUE(counts[1] > 0 && counts[1] != level);
    TEST_ASSERT_EQUAL_UINT32(counts[1], counts[0]);
    TEST_ASSERT_EQUAL_UINT32(counts[1], counts[2]);
}

/* ---- poses ---- */

static void test_move_is_reached_at_the_end_of_the_next_step(void)
{
    const pbmpm_world_id world = open_world(2);
    const pbmpm_collider_id collider = create_collider(world, box_shape(0, 0, 0, 0.2f, 0.2f, 0.5f), true);
    const float far_away[3] = {123.456f, -7.5f, 0}, turned[4] = {0, 0, 0.6f, 0.8f};
    set_rate(world, 3, 1);
    OK(pbmpm_collider_move(world, collider, far_away, turned));
    OK(pbmpm_world_step(world, 0.01f));
    pbmpm_shape read = shape_of(world, collider);
    TEST_ASSERT_TRUE(read.position[0] == far_away[0] && read.position[1] == far_away[1]);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.6f, read.rotation[2]);
    const float back[3] = {0.25f, 0, 0};
    OK(pbmpm_collider_move(world, collider, back, NULL));
    OK(pbmpm_world_step(world, 0.01f));
    read = shape_of(world, collider);
    TEST_ASSERT_TRUE(read.position[0] == 0.25f && read.position[1] == 0.0f);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.6f, read.rotation[2]);
    OK(pbmpm_world_step(world, 0.01f)); /* it stays where it was put */
    TEST_ASSERT_TRUE(shape_of(world, collider).position[0] == 0.25f);
}

static void test_static_colliders_teleport_but_do_not_move(void)
{
    const pbmpm_world_id world = open_world(2);
    const pbmpm_collider_id collider = create_collider(world, sphere_shape(0, 0, 0, 0.3f), false);
    const float target[3] = {4, 5, 0};
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_move(world, collider, target, NULL));
    TEST_ASSERT_TRUE(shape_of(world, collider).position[0] == 0.0f);
    OK(pbmpm_collider_teleport(world, collider, target, NULL));
    TEST_ASSERT_TRUE(shape_of(world, collider).position[1] == 5.0f);
}

/* ---- what matter feels ---- */

static double mean_of(pbmpm_world_id world, pbmpm_field field, uint32_t component)
{
    const pbmpm_view view = view_of(world, field);
    double sum = 0;
    for (uint32_t i = 0; i < view.count; i++)
        sum += (double)view_float(&view, i, component);
    return sum / view.count;
}

/* A blob falls on an obstacle; afterwards nothing may be inside it. */
static void check_nothing_enters(pbmpm_shape shape, int32_t dimension, pbmpm_material_kind kind)
{
    const pbmpm_world_id world = open_world(dimension);
    const pbmpm_collider_id collider = create_collider(world, shape, false);
    const pbmpm_material_id matter = create_material(world, kind);
    uint32_t inside = 1, contacts = 0;
    fill_shape(world, matter, sphere_shape(0, 0.75f, 0, 0.3f), (const float[3]){0, -4, 0});
    set_gravity(world, 0, -9.81f, 0);
    for (int i = 0; i < 60; i++) {
        OK(pbmpm_world_step(world, 0.01f));
        OK(pbmpm_query_collider(world, collider, NULL, 0, &inside));
        TEST_ASSERT_EQUAL_UINT32(0, inside);
        contacts += world_stats(world).contacts;
    }
    TEST_ASSERT_TRUE(contacts > 0);
    world_expect_finite(world, "after the fall");
}

static void test_nothing_enters_an_obstacle(void)
{
    pbmpm_shape capsule = sphere_shape(0.1f, 0, 0, 0.25f);
    capsule.kind = PBMPM_CAPSULE;
    capsule.half_extents[0] = 0.5f;
    pbmpm_shape slope = box_shape(0, 0, 0, 1, 0.2f, 1);
    slope.rotation[2] = 0.25881905f;
    slope.rotation[3] = 0.96592583f;
    for (int dimension = 2; dimension <= 3; dimension++) {
        check_nothing_enters(plane_shape(0, 0, 0, 0, 2, 0), dimension, PBMPM_LIQUID);
        check_nothing_enters(plane_shape(0, 0, 0, 0.2f, 1, 0), dimension, PBMPM_ELASTIC);
        check_nothing_enters(sphere_shape(0.1f, 0, 0, 0.35f), dimension, PBMPM_LIQUID);
        check_nothing_enters(capsule, dimension, PBMPM_ELASTIC);
        check_nothing_enters(slope, dimension, PBMPM_LIQUID);
    }
}

/* A ball flies at 4 cells per step at a wall a fifth of a cell thick, which comes towards it or stands still: all of it stays before the wall,
 * and what it loses of its momentum the wall gets. */
static void check_nothing_passes(int32_t dimension, pbmpm_solver solver, pbmpm_material_kind kind, float wall_speed)
{
    const float dt = 0.01f, half = 0.01f;
    const pbmpm_world_id world = open_world(dimension);
    pbmpm_settings settings = default_settings();
    settings.solver = solver;
    settings.iterations = 5;
    OK(pbmpm_world_set_settings(world, &settings));
    const pbmpm_shape plate = box_shape(0, 0, 0, half, 50, 50);
    pbmpm_collider_def wall = default_collider();
    wall.kinematic = wall.measures_impulse = 1;
    wall.friction = PBMPM_FRICTION_SLIP;
    pbmpm_collider_id id;
    OK(pbmpm_collider_create(world, &wall, &plate, &id));
    fill_shape(world, create_material(world, kind), sphere_shape(-0.45f, 0.02f, 0, 0.25f), (const float[3]){40, 0, 0});
    double given = 0, start = world_stats(world).momentum[0];
    for (int i = 1; i <= 30; i++) {
        const float x = -wall_speed * dt * (float)i;
        if (wall_speed > 0) OK(pbmpm_collider_move(world, id, (const float[3]){x, 0, 0}, NULL));
        OK(pbmpm_world_step(world, dt));
        const pbmpm_view position = view_of(world, PBMPM_POSITION);
        for (uint32_t p = 0; p < position.count; p++) TEST_ASSERT_TRUE(view_float(&position, p, 0) <= x - half + 1e-5f);
        pbmpm_impulse impulse = {.size = sizeof impulse};
        OK(pbmpm_collider_impulse(world, id, &impulse));
        given += impulse.linear[0];
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-5 * start, start, world_stats(world).momentum[0] + given);
    TEST_ASSERT_TRUE(given > 0.9 * start);
}

static void test_nothing_passes_a_thin_wall(void)
{
    static const pbmpm_solver solvers[] = {PBMPM_SOLVER_PAPER, PBMPM_SOLVER_DUAL, PBMPM_SOLVER_PRIMAL};
    for (int i = 0; i < 3; i++) {
        check_nothing_passes(2, solvers[i], PBMPM_LIQUID, 0);
        check_nothing_passes(2, solvers[i], PBMPM_ELASTIC, 5);
        check_nothing_passes(3, solvers[i], PBMPM_ELASTIC, 0);
        check_nothing_passes(3, solvers[i], PBMPM_LIQUID, 5);
    }
}

/* Particles under a new obstacle are pushed out over the next steps. */
static void test_an_obstacle_on_top_of_matter_pushes_it_out(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const pbmpm_collider_id collider = create_collider(world, sphere_shape(0.5f, 0.3f, 0, 0.15f), false);
    uint32_t inside = 0;
    OK(pbmpm_query_collider(world, collider, NULL, 0, &inside));
    TEST_ASSERT_TRUE(inside > 0);
    for (int i = 0; i < 100; i++)
        OK(pbmpm_world_step(world, 0.005f));
    OK(pbmpm_query_collider(world, collider, NULL, 0, &inside));
    TEST_ASSERT_EQUAL_UINT32(0, inside);
}

/* Speed along the ground that is left to an elastic block after sliding for a while. */
static double speed_after_sliding(pbmpm_friction friction, float coefficient)
{
    const pbmpm_world_id world = open_world(2);
    set_solver(world, PBMPM_SOLVER_PAPER); /* its body is stiff at this rate; one of 1e5 Pa goes on swinging on the ground that it sticks to */
    const pbmpm_shape plane = plane_shape(0, 0, 0, 0, 1, 0);
    pbmpm_collider_def ground = default_collider();
    pbmpm_collider_id collider;
    ground.friction = friction;
    ground.friction_coefficient = coefficient;
    OK(pbmpm_collider_create(world, &ground, &plane, &collider));
    const pbmpm_material_id jelly = create_material(world, PBMPM_ELASTIC);
    fill_shape(world, jelly, box_shape(0, 0.25f, 0, 0.5f, 0.25f, 0.5f), (const float[3]){2, 0, 0});
    set_gravity(world, 0, -10, 0);
    for (int i = 0; i < 100; i++)
        OK(pbmpm_world_step(world, 0.005f));
    return mean_of(world, PBMPM_VELOCITY, 0);
}

/* A block with 2 m/s and friction 0.2 under 10 m/s^2 has 1 m/s left after half a second. */
static void test_friction(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 2.0, speed_after_sliding(PBMPM_FRICTION_SLIP, 0.2f));
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 2.0, speed_after_sliding(PBMPM_FRICTION_COULOMB, 0));
    TEST_ASSERT_DOUBLE_WITHIN(0.25, 1.0, speed_after_sliding(PBMPM_FRICTION_COULOMB, 0.2f));
    TEST_ASSERT_DOUBLE_WITHIN(0.2, 0.0, speed_after_sliding(PBMPM_FRICTION_STICK, 0));
}

/* A pusher that moves at 1 m/s takes matter along; one that is teleported the same way does not. */
static double speed_after_pushing(bool teleport)
{
    const pbmpm_world_id world = open_world(2);
    const pbmpm_collider_id pusher = create_collider(world, box_shape(-0.6f, 0, 0, 0.2f, 1, 0.5f), true);
    const pbmpm_material_id jelly = create_material(world, PBMPM_ELASTIC);
    fill_shape(world, jelly, box_shape(0, 0, 0, 0.3f, 0.3f, 0.5f), at_rest);
    const int steps = teleport ? 10 : 60;
    for (int i = 1; i <= steps; i++) {
        const float position[3] = {-0.6f + 0.01f * (float)i, 0, 0};
        OK(teleport ? pbmpm_collider_teleport(world, pusher, position, NULL) : pbmpm_collider_move(world, pusher, position, NULL));
        OK(pbmpm_world_step(world, 0.01f));
    }
    return mean_of(world, PBMPM_VELOCITY, 0);
}

static void test_a_moving_obstacle_takes_matter_along(void)
{
    TEST_ASSERT_TRUE(speed_after_pushing(false) > 0.7);
    TEST_ASSERT_TRUE(fabs(speed_after_pushing(true)) < 0.05);
}

/* However fast an obstacle is moved, what matter feels is clamped: it ends up at finite, bounded speed. */
static void test_the_speed_of_an_obstacle_is_clamped(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const pbmpm_collider_id paddle = create_collider(world, box_shape(0.1f, 0.3f, 0, 0.05f, 0.3f, 0.5f), true);
    const uint32_t before = world_count(world);
    const float dt = 0.01f;
    for (int i = 0; i < 50; i++) {
        const float position[3] = {i % 2 ? 0.1f : 1e5f, 0.3f, 0};
        OK(pbmpm_collider_move(world, paddle, position, NULL));
        OK(pbmpm_world_step(world, dt));
        TEST_ASSERT_TRUE(world_stats(world).max_speed <= 32.0f * 0.05f / dt * 1.5f);
    }
    world_expect_finite(world, "after a mad paddle");
    TEST_ASSERT_EQUAL_UINT64(before, world_count(world) + world_stats(world).deleted_total);
}

/* ---- walls of the domain ---- */

static void check_walls_hold(int32_t dimension, pbmpm_material_kind kind)
{
    pbmpm_world_def def = default_world(dimension, 0.1f, 8192);
    def.domain_enabled = 1;
    for (int a = 0; a < 3; a++) {
        def.domain_min[a] = -0.53f; /* not a multiple of the cell size */
        def.domain_max[a] = 0.61f;
    }
    const pbmpm_world_id world = create_world(&def);
    const pbmpm_material_id matter = create_material(world, kind);
    const uint32_t added = fill_shape(world, matter, sphere_shape(0, 0, 0, 0.35f), (const float[3]){30, -20, 10});
    set_gravity(world, 5, -9.81f, -3);
    for (int i = 0; i < 100; i++) {
        OK(pbmpm_world_step(world, 0.01f));
        const pbmpm_view position = view_of(world, PBMPM_POSITION);
        for (uint32_t p = 0; p < position.count; p++)
            for (uint32_t a = 0; a < position.components; a++) {
                const float x = view_float(&position, p, a);
                TEST_ASSERT_TRUE(x >= -0.53f - 1e-6f && x <= 0.61f + 1e-6f);
            }
    }
    TEST_ASSERT_EQUAL_UINT32(added, world_count(world));
}

static void test_walls_hold_matter_in(void)
{
    check_walls_hold(2, PBMPM_LIQUID);
    check_walls_hold(2, PBMPM_ELASTIC);
    check_walls_hold(3, PBMPM_LIQUID);
    check_walls_hold(3, PBMPM_ELASTIC);
}

/* Water beside a box that stands on the floor of the domain does not seep below it, and what gets onto the floor stays out. */
static void check_nothing_seeps_below(int32_t dimension, pbmpm_solver solver)
{
    pbmpm_world_def def = default_world(dimension, 0.1f, 8192);
    def.domain_enabled = 1;
    def.domain_max[0] = 1.6f;
    def.domain_max[1] = 1.0f;
    def.domain_max[2] = 0.4f;
    const pbmpm_world_id world = create_world(&def);
    pbmpm_settings settings = {.size = sizeof settings};
    OK(pbmpm_world_get_settings(world, &settings));
    settings.solver = solver;
    settings.iterations = 10;
    OK(pbmpm_world_set_settings(world, &settings));
    set_gravity(world, 0, -9.81f, 0);
    const pbmpm_shape box = box_shape(0.8f, 0.2f, 0.2f, 0.3f, 0.2f, 0.2f);
    create_collider(world, box, false);
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    fill_shape(world, water, box_shape(0.25f, 0.3f, 0.2f, 0.25f, 0.3f, 0.2f), at_rest);
    fill_shape(world, water, box_shape(1.35f, 0.3f, 0.2f, 0.25f, 0.3f, 0.2f), at_rest);
    for (int i = 0; i < 240; i++) OK(pbmpm_world_step(world, 1.0f / 120));
    const pbmpm_view position = view_of(world, PBMPM_POSITION);
    for (uint32_t p = 0; p < position.count; p++)
        TEST_ASSERT_TRUE(fabsf(view_float(&position, p, 0) - 0.8f) > 0.3f - 1e-5f || view_float(&position, p, 1) > 0.4f - 1e-5f);
    OK(pbmpm_world_destroy(world));
}

static void test_nothing_seeps_below_a_box(void)
{
    check_nothing_seeps_below(2, PBMPM_SOLVER_PAPER);
    check_nothing_seeps_below(2, PBMPM_SOLVER_DUAL);
    check_nothing_seeps_below(3, PBMPM_SOLVER_DUAL);
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_shape_has_the_documented_defaults);
    RUN_TEST(test_collider_has_the_documented_defaults);
    RUN_TEST(test_collider_is_read_back_and_destroyed);
    RUN_TEST(test_rotation_is_normalised);
    RUN_TEST(test_move_is_reached_at_the_end_of_the_next_step);
    RUN_TEST(test_static_colliders_teleport_but_do_not_move);
    RUN_TEST(test_nothing_enters_an_obstacle);
    RUN_TEST(test_nothing_passes_a_thin_wall);
    RUN_TEST(test_an_obstacle_on_top_of_matter_pushes_it_out);
    RUN_TEST(test_friction);
    RUN_TEST(test_a_moving_obstacle_takes_matter_along);
    RUN_TEST(test_the_speed_of_an_obstacle_is_clamped);
    RUN_TEST(test_walls_hold_matter_in);
    RUN_TEST(test_nothing_seeps_below_a_box);
    return UNITY_END();
}

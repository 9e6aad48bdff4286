/* Touches and sensors: when matter comes to a collider and when it leaves. */
#include <math.h>
#include <string.h>

#include "scenes.h"

enum { ROOM = 8 };

static pbmpm_touch touches[ROOM];

void setUp(void) {}
void tearDown(void) { pbmpm_shutdown(); }

static uint32_t look(pbmpm_world_id world)
{
    uint32_t count;
    memset(touches, 0, sizeof touches);
    touches[0].size = sizeof touches[0];
    OK(pbmpm_world_touches(world, touches, ROOM, &count));
    return count;
}

static pbmpm_collider_id reporting(pbmpm_world_id world, pbmpm_shape shape, bool sensor)
{
    pbmpm_collider_def def = default_collider();
    pbmpm_collider_id collider;
    def.sensor = sensor;
    def.reports_touches = 1;
    def.measures_impulse = !sensor;
    OK(pbmpm_collider_create(world, &def, &shape, &collider));
    return collider;
}

/* A block of jelly, 0.4 m wide, that flies to the right at 1 m/s. */
static pbmpm_world_id flying_block(pbmpm_material_id *jelly)
{
    const pbmpm_world_def def = default_world(2, 0.1f, 1000);
    const pbmpm_world_id world = create_world(&def);
    *jelly = create_material(world, PBMPM_ELASTIC);
    fill_shape(world, *jelly, box_shape(0, 0, 0, 0.2f, 0.2f, 0), (const float[3]){1, 0, 0});
    return world;
}

static void run(pbmpm_world_id world, double seconds)
{
    for (int i = 0; i < (int)(seconds * 60 + 0.5); i++) OK(pbmpm_world_step(world, 1.0f / 60));
}

/* Through a sensor matter goes as if there were none, and is seen to come and to leave. */
static void test_a_sensor_sees_matter_come_and_go(void)
{
    pbmpm_material_id jelly, same;
    const pbmpm_world_id world = flying_block(&jelly), alone = flying_block(&same);
    const pbmpm_collider_id gate = reporting(world, box_shape(1, 0, 0, 0.1f, 1, 1), true);
    TEST_ASSERT_EQUAL_UINT32(0, look(world));
    run(world, 0.5);
    TEST_ASSERT_EQUAL_UINT32(0, look(world)); /* its front is at 0.7 m */
    run(world, 0.4);
    TEST_ASSERT_EQUAL_UINT32(1, look(world));
    TEST_ASSERT_EQUAL_INT(PBMPM_TOUCH_BEGAN, touches[0].state);
    TEST_ASSERT_EQUAL_MEMORY(&gate, &touches[0].collider, sizeof gate);
    TEST_ASSERT_EQUAL_MEMORY(&jelly, &touches[0].material, sizeof jelly);
    TEST_ASSERT_TRUE(touches[0].particles > 5 && touches[0].particles < world_count(world));
    TEST_ASSERT_EQUAL_UINT32(1, look(world));
    TEST_ASSERT_EQUAL_INT(PBMPM_TOUCH_STAYS, touches[0].state);
    run(world, 0.6);
    TEST_ASSERT_EQUAL_UINT32(1, look(world));
    TEST_ASSERT_EQUAL_INT(PBMPM_TOUCH_ENDED, touches[0].state);
    TEST_ASSERT_EQUAL_UINT32(0, touches[0].particles);
    TEST_ASSERT_EQUAL_UINT32(0, look(world));
    run(alone, 1.5);
    TEST_ASSERT_EQUAL_HEX64(world_hash(alone), world_hash(world));
}

static void test_an_obstacle_tells_what_it_was_given(void)
{
    pbmpm_material_id jelly;
    const pbmpm_world_id world = flying_block(&jelly);
    const pbmpm_collider_id wall = reporting(world, box_shape(1, 0, 0, 0.5f, 1, 1), false);
    double push = 0.0;
    bool began = false, ended = false;
    for (int step = 0; step < 120 && !ended; step++) {
        run(world, 1.0 / 60);
        pbmpm_impulse impulse = {.size = sizeof impulse};
        OK(pbmpm_collider_impulse(world, wall, &impulse));
        push += impulse.linear[0];
        if (look(world) == 0) continue;
        began = began || touches[0].state == PBMPM_TOUCH_BEGAN;
        ended = touches[0].state == PBMPM_TOUCH_ENDED;
        TEST_ASSERT_EQUAL_DOUBLE(impulse.linear[0], touches[0].impulse[0]);
    }
    TEST_ASSERT_TRUE(began && ended); /* it came and bounced */
    const pbmpm_stats stats = world_stats(world);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3 * stats.mass, stats.mass - stats.momentum[0], push); /* what it had and has not */
}

static void test_water_at_rest_touches_its_floor(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    reporting(world, box_shape(0.5f, 0.05f, 0, 0.6f, 0.05f, 1), false);
    const pbmpm_collider_id above = reporting(world, box_shape(0.5f, 0.9f, 0, 0.6f, 0.05f, 1), false);
    run(world, 3.0);
    TEST_ASSERT_EQUAL_UINT32(1, look(world));
    TEST_ASSERT_TRUE(touches[0].particles >= 20); /* of 40 in the lowest row */
    TEST_ASSERT_FALSE(touches[0].collider.index == above.index);
}

static void test_each_material_touches_for_itself(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const pbmpm_material_id jelly = create_material(world, PBMPM_ELASTIC);
    fill_shape(world, jelly, box_shape(0.5f, 0.7f, 0, 0.1f, 0.1f, 0), (const float[3]){0, 0, 0});
    reporting(world, box_shape(0.5f, 0.55f, 0, 0.4f, 0.4f, 1), true);
    TEST_ASSERT_EQUAL_UINT32(2, look(world));
    const pbmpm_shape all = box_shape(0.5f, 0.5f, 0, 2, 2, 1);
    OK(pbmpm_particles_remove_in(world, &all, NULL));
    OK(pbmpm_material_destroy(world, jelly));
    TEST_ASSERT_EQUAL_UINT32(2, look(world));
    TEST_ASSERT_EQUAL_INT(PBMPM_TOUCH_ENDED, touches[1].state);
    TEST_ASSERT_EQUAL_UINT32(0, touches[1].material.generation); /* it is gone */
}

/* A material in the place of another has touched nothing; nor has anything touched what begins to report. */
static void test_what_is_new_begins(void)
{
    pbmpm_material_id jelly;
    const pbmpm_world_id world = flying_block(&jelly);
    const pbmpm_shape all = box_shape(0, 0, 0, 2, 2, 1);
    const pbmpm_collider_id sensor = reporting(world, all, true);
    TEST_ASSERT_EQUAL_UINT32(1, look(world));
    OK(pbmpm_particles_remove_in(world, &all, NULL));
    OK(pbmpm_material_destroy(world, jelly));
    const pbmpm_material_id other = create_material(world, PBMPM_LIQUID);
    TEST_ASSERT_EQUAL_UINT32(jelly.index, other.index);
    fill_shape(world, other, box_shape(0, 0, 0, 0.2f, 0.2f, 0), (const float[3]){0, 0, 0});
    TEST_ASSERT_EQUAL_UINT32(1, look(world));
    TEST_ASSERT_EQUAL_INT(PBMPM_TOUCH_BEGAN, touches[0].state);
    pbmpm_collider_def def = {.size = sizeof def};
    OK(pbmpm_collider_get(world, sensor, &def, NULL));
    def.reports_touches = 0;
    OK(pbmpm_collider_set(world, sensor, &def, NULL));
    TEST_ASSERT_EQUAL_UINT32(0, look(world));
    def.reports_touches = 1;
    OK(pbmpm_collider_set(world, sensor, &def, NULL));
    TEST_ASSERT_EQUAL_UINT32(1, look(world));
    TEST_ASSERT_EQUAL_INT(PBMPM_TOUCH_BEGAN, touches[0].state);
}

/* How much of a sensor is under water, whatever was asked before. */
static void test_a_sensor_tells_how_much_of_it_is_under(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const pbmpm_collider_id under = reporting(world, box_shape(0.5f, 0.2f, 0, 0.1f, 0.1f, 1), true);
    const pbmpm_collider_id above = reporting(world, box_shape(0.5f, 0.9f, 0, 0.1f, 0.1f, 1), true);
    pbmpm_submersion found = {.size = sizeof found};
    for (int twice = 0; twice < 2; twice++) {
        OK(pbmpm_collider_submerged(world, above, NULL, &found));
        TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.0, found.share);
        OK(pbmpm_collider_submerged(world, under, NULL, &found));
        TEST_ASSERT_DOUBLE_WITHIN(0.05, 1.0, found.share);
    }
}

static void test_with_too_little_room_nothing_is_forgotten(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    uint32_t count = 0;
    reporting(world, box_shape(0.5f, 0.2f, 0, 0.4f, 0.1f, 1), true);
    reporting(world, box_shape(0.5f, 0.2f, 0, 0.4f, 0.1f, 1), true);
    OK(pbmpm_world_touches(world, NULL, 0, &count));
    TEST_ASSERT_EQUAL_UINT32(2, count);
    TEST_ASSERT_EQUAL_UINT32(2, look(world));
    TEST_ASSERT_EQUAL_INT(PBMPM_TOUCH_BEGAN, touches[0].state);
    TEST_ASSERT_EQUAL_INT(PBMPM_TOUCH_BEGAN, touches[1].state);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_touches(world, NULL, 1, &count));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_touches(world, touches, ROOM, NULL));
}

static void test_definitions_of_sensors_are_checked(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const pbmpm_shape ball = sphere_shape(0.5f, 0.5f, 0, 0.1f);
    pbmpm_collider_def def = default_collider();
    pbmpm_collider_id collider;
    def.sensor = 2;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_create(world, &def, &ball, &collider));
    def.sensor = def.measures_impulse = 1;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_create(world, &def, &ball, &collider));
    def.measures_impulse = 0;
    def.reports_touches = -1;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_create(world, &def, &ball, &collider));
}

/* A sensor that goes through sleeping water wakes nobody. */
static void test_a_sensor_wakes_nothing(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    pbmpm_settings settings = {.size = sizeof settings};
    OK(pbmpm_world_get_settings(world, &settings));
    settings.sleeping = 1;
    settings.sleep_speed = 1.0f;
    settings.sleep_time = 0.1f;
    OK(pbmpm_world_set_settings(world, &settings));
    run(world, 4.0);
    TEST_ASSERT_EQUAL_UINT32(world_count(world), world_stats(world).particles_asleep);
    pbmpm_collider_def def = default_collider();
    pbmpm_collider_id probe;
    const pbmpm_shape ball = sphere_shape(0.2f, 0.2f, 0, 0.1f);
    def.sensor = def.reports_touches = def.kinematic = 1;
    OK(pbmpm_collider_create(world, &def, &ball, &probe));
    OK(pbmpm_collider_move(world, probe, (const float[3]){0.3f, 0.2f, 0}, NULL));
    run(world, 0.1);
    TEST_ASSERT_EQUAL_UINT32(world_count(world), world_stats(world).particles_asleep);
    TEST_ASSERT_EQUAL_UINT32(1, look(world));
    def.sensor = 0; /* it becomes an obstacle */
    OK(pbmpm_collider_set(world, probe, &def, NULL));
    run(world, 0.1);
    TEST_ASSERT_TRUE(world_stats(world).particles_asleep < world_count(world));
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_a_sensor_sees_matter_come_and_go);
    RUN_TEST(test_an_obstacle_tells_what_it_was_given);
    RUN_TEST(test_water_at_rest_touches_its_floor);
    RUN_TEST(test_each_material_touches_for_itself);
    RUN_TEST(test_what_is_new_begins);
    RUN_TEST(test_a_sensor_tells_how_much_of_it_is_under);
    RUN_TEST(test_with_too_little_room_nothing_is_forgotten);
    RUN_TEST(test_definitions_of_sensors_are_checked);
    RUN_TEST(test_a_sensor_wakes_nothing);
    return UNITY_END();
}

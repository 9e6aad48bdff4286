/* What a host asks about the things of its worlds: whether they exist, which there are, and changing a collider in place. */
#include <math.h>
#include <string.h>

#include "rules.h"

void setUp(void) { rules_set_up(); }
void tearDown(void) { pbmpm_shutdown(); }

static int32_t collider_is_valid(pbmpm_world_id world, pbmpm_collider_id collider)
{
    int32_t valid = -1;
    OK(pbmpm_collider_is_valid(world, collider, &valid));
    return valid;
}

static void test_identifiers_are_valid_until_their_thing_goes(void)
{
    int32_t valid = -1;
    const pbmpm_collider_id none = {0, 0}, made_up = {7777, 3};
    TEST_ASSERT_EQUAL_INT32(1, collider_is_valid(good.world, good.collider));
    TEST_ASSERT_EQUAL_INT32(0, collider_is_valid(good.world, none));
    TEST_ASSERT_EQUAL_INT32(0, collider_is_valid(good.world, made_up));
    OK(pbmpm_material_is_valid(good.world, good.material, &valid));
    TEST_ASSERT_EQUAL_INT32(1, valid);
    OK(pbmpm_emitter_is_valid(good.world, good.emitter, &valid));
    TEST_ASSERT_EQUAL_INT32(1, valid);
    OK(pbmpm_drain_is_valid(good.world, good.drain, &valid));
    TEST_ASSERT_EQUAL_INT32(1, valid);
    OK(pbmpm_force_is_valid(good.world, good.force, &valid));
    TEST_ASSERT_EQUAL_INT32(1, valid);
    OK(pbmpm_collider_destroy(good.world, good.collider));
    TEST_ASSERT_EQUAL_INT32(0, collider_is_valid(good.world, good.collider));
    const pbmpm_collider_id next = create_collider(good.world, sphere_shape(3.0f, 0.0f, 0.0f, 0.5f), false); /* in the same slot */
    TEST_ASSERT_EQUAL_UINT32(good.collider.index, next.index);
    TEST_ASSERT_EQUAL_INT32(0, collider_is_valid(good.world, good.collider));
}

static void test_a_world_that_is_gone_has_nothing(void)
{
    int32_t valid = -1;
    OK(pbmpm_world_is_valid(good.world, &valid));
    TEST_ASSERT_EQUAL_INT32(1, valid);
    OK(pbmpm_world_destroy(good.world));
    OK(pbmpm_world_is_valid(good.world, &valid));
    TEST_ASSERT_EQUAL_INT32(0, valid);
    TEST_ASSERT_EQUAL_INT32(0, collider_is_valid(good.world, good.collider));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_is_valid(good.world, NULL));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_is_valid(good.world, good.collider, NULL));
}

static void test_lists_hold_what_is_there(void)
{
    pbmpm_collider_id found[4] = {{0, 0}};
    uint32_t count = 0;
    const pbmpm_collider_id second = create_collider(good.world, sphere_shape(3.0f, 0.0f, 0.0f, 0.5f), false), third = create_collider(good.world, sphere_shape(3.0f, 0.0f, 0.0f, 0.5f), true);
    OK(pbmpm_world_get_colliders(good.world, NULL, 0, &count));
    TEST_ASSERT_EQUAL_UINT32(3, count);
    OK(pbmpm_collider_destroy(good.world, second));
    OK(pbmpm_world_get_colliders(good.world, found, 4, &count));
    TEST_ASSERT_EQUAL_UINT32(2, count);
    TEST_ASSERT_EQUAL_MEMORY(&good.collider, &found[0], sizeof found[0]);
    TEST_ASSERT_EQUAL_MEMORY(&third, &found[1], sizeof found[1]);
    TEST_ASSERT_EQUAL_UINT32(0, found[2].generation);
    found[1] = (pbmpm_collider_id){0, 0};
    OK(pbmpm_world_get_colliders(good.world, found, 1, &count)); /* no more than there is room for */
    TEST_ASSERT_EQUAL_UINT32(2, count);
    TEST_ASSERT_EQUAL_UINT32(0, found[1].generation);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_get_colliders(good.world, NULL, 1, &count));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_get_colliders(good.world, found, 1, NULL));
}

static void test_every_kind_has_a_list(void)
{
    pbmpm_material_id materials[4];
    pbmpm_emitter_id emitter;
    pbmpm_drain_id drain;
    pbmpm_force_id force;
    uint32_t count = 0;
    OK(pbmpm_world_get_materials(good.world, materials, 4, &count));
    TEST_ASSERT_EQUAL_UINT32(2, count);
    TEST_ASSERT_EQUAL_MEMORY(&good.material, &materials[0], sizeof materials[0]);
    TEST_ASSERT_EQUAL_MEMORY(&good.spare, &materials[1], sizeof materials[1]);
    OK(pbmpm_world_get_emitters(good.world, &emitter, 1, &count));
    TEST_ASSERT_EQUAL_UINT32(1, count);
    TEST_ASSERT_EQUAL_MEMORY(&good.emitter, &emitter, sizeof emitter);
    OK(pbmpm_world_get_drains(good.world, &drain, 1, &count));
    TEST_ASSERT_EQUAL_UINT32(1, count);
    TEST_ASSERT_EQUAL_MEMORY(&good.drain, &drain, sizeof drain);
    OK(pbmpm_world_get_forces(good.world, &force, 1, &count));
    TEST_ASSERT_EQUAL_UINT32(1, count);
    TEST_ASSERT_EQUAL_MEMORY(&good.force, &force, sizeof force);
}

static void test_worlds_are_listed(void)
{
    pbmpm_world_id worlds[3];
    uint32_t count = 0;
    const pbmpm_world_id second = tank_2d(NULL, NULL);
    OK(pbmpm_get_worlds(worlds, 3, &count));
    TEST_ASSERT_EQUAL_UINT32(2, count);
    TEST_ASSERT_EQUAL_MEMORY(&good.world, &worlds[0], sizeof worlds[0]);
    TEST_ASSERT_EQUAL_MEMORY(&second, &worlds[1], sizeof worlds[1]);
    OK(pbmpm_shutdown());
    OK(pbmpm_get_worlds(NULL, 0, &count));
    TEST_ASSERT_EQUAL_UINT32(0, count);
}

/* ---- A collider is changed in place ---- */

static pbmpm_world_id pool_with_gate(pbmpm_collider_id *gate)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    *gate = create_collider(world, box_shape(0.5f, 0.5f, 0, 0.05f, 0.6f, 0.5f), false);
    return world;
}

static uint32_t right_of(pbmpm_world_id world, float x)
{
    const pbmpm_shape right = box_shape(x + 1.0f, 0.5f, 0, 1.0f, 1.0f, 1.0f);
    uint32_t count;
    OK(pbmpm_query_shape(world, &right, NULL, 0, &count));
    return count;
}

static void test_a_change_is_felt_and_keeps_the_identifier(void)
{
    pbmpm_collider_id gate;
    const pbmpm_world_id world = pool_with_gate(&gate);
    const pbmpm_shape left = box_shape(0.75f, 0.3f, 0, 0.25f, 0.3f, 0.5f), aside = box_shape(0.5f, 5.0f, 0, 0.05f, 0.6f, 0.5f);
    uint32_t removed;
    OK(pbmpm_particles_remove_in(world, &left, &removed));
    TEST_ASSERT_TRUE(removed > 50);
    for (int i = 0; i < 30; i++) OK(pbmpm_world_step(world, 1.0f / 60));
    TEST_ASSERT_EQUAL_UINT32(0, right_of(world, 0.52f)); /* the gate holds */
    OK(pbmpm_collider_set(world, gate, NULL, &aside));
    for (int i = 0; i < 30; i++) OK(pbmpm_world_step(world, 1.0f / 60));
    TEST_ASSERT_TRUE(right_of(world, 0.52f) > 50); /* it is open */
    TEST_ASSERT_EQUAL_INT32(1, collider_is_valid(world, gate));
}

static void test_a_half_of_it_stays(void)
{
    pbmpm_collider_def def = {.size = sizeof def}, back = {.size = sizeof back};
    pbmpm_shape shape = {.size = sizeof shape}, ball = sphere_shape(3.0f, 0.0f, 0.0f, 0.5f);
    OK(pbmpm_collider_get(good.world, good.collider, &def, &shape));
    def.friction = PBMPM_FRICTION_SLIP;
    def.user_data = 99;
    OK(pbmpm_collider_set(good.world, good.collider, &def, NULL));
    pbmpm_shape same = {.size = sizeof same};
    OK(pbmpm_collider_get(good.world, good.collider, &back, &same));
    TEST_ASSERT_EQUAL_MEMORY(&def, &back, sizeof def);
    TEST_ASSERT_EQUAL_MEMORY(&shape, &same, sizeof shape);
    OK(pbmpm_collider_set(good.world, good.collider, NULL, &ball));
    OK(pbmpm_collider_get(good.world, good.collider, &back, &same));
    TEST_ASSERT_EQUAL_MEMORY(&def, &back, sizeof def);
    TEST_ASSERT_EQUAL_MEMORY(&ball, &same, sizeof ball);
}

static float height_after(pbmpm_world_id world, pbmpm_collider_id collider)
{
    pbmpm_shape shape = {.size = sizeof shape};
    OK(pbmpm_world_step(world, 0.01f));
    OK(pbmpm_collider_get(world, collider, NULL, &shape));
    return shape.position[1];
}

static void test_a_way_survives_other_changes_but_not_a_new_shape(void)
{
    static const float up[3] = {0.0f, 0.75f, 0.0f};
    pbmpm_collider_def def = {.size = sizeof def};
    const pbmpm_shape ball = sphere_shape(0.0f, -0.5f, 0.0f, 0.1f);
    OK(pbmpm_collider_get(good.world, good.collider, &def, NULL));
    OK(pbmpm_collider_move(good.world, good.collider, up, NULL));
    def.friction_coefficient = 0.75f;
    OK(pbmpm_collider_set(good.world, good.collider, &def, NULL));
    TEST_ASSERT_EQUAL_FLOAT(0.75f, height_after(good.world, good.collider));
    OK(pbmpm_collider_move(good.world, good.collider, (const float[3]){0, 0, 0}, NULL));
    OK(pbmpm_collider_set(good.world, good.collider, NULL, &ball));
    TEST_ASSERT_EQUAL_FLOAT(-0.5f, height_after(good.world, good.collider));
    OK(pbmpm_collider_move(good.world, good.collider, up, NULL));
    def.kinematic = 0;
    OK(pbmpm_collider_set(good.world, good.collider, &def, NULL));
    TEST_ASSERT_EQUAL_FLOAT(-0.5f, height_after(good.world, good.collider));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_move(good.world, good.collider, up, NULL));
}

static void test_a_collider_begins_to_measure(void)
{
    pbmpm_collider_id gate;
    pbmpm_collider_def def = {.size = sizeof def};
    pbmpm_impulse impulse = {.size = sizeof impulse};
    const pbmpm_world_id world = pool_with_gate(&gate);
    const pbmpm_shape floor = box_shape(0.5f, 0.0f, 0, 0.6f, 0.05f, 0.5f);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_impulse(world, gate, &impulse));
    OK(pbmpm_collider_get(world, gate, &def, NULL));
    def.measures_impulse = 1;
    OK(pbmpm_collider_set(world, gate, &def, &floor));
    OK(pbmpm_collider_impulse(world, gate, &impulse));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, impulse.linear[1]);
    for (int i = 0; i < 30; i++) OK(pbmpm_world_step(world, 1.0f / 60));
    OK(pbmpm_collider_impulse(world, gate, &impulse));
    TEST_ASSERT_TRUE(impulse.linear[1] < 0.0); /* water stands on it */
}

static void test_a_refused_change_changes_nothing(void)
{
    pbmpm_collider_def def = {.size = sizeof def}, wrong;
    pbmpm_shape shape = {.size = sizeof shape}, bad = sphere_shape(3.0f, 0.0f, 0.0f, 0.5f);
    OK(pbmpm_collider_get(good.world, good.collider, &def, &shape));
    wrong = def;
    wrong.friction_coefficient = -1.0f;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_set(good.world, good.collider, &wrong, &bad));
    bad.radius = NAN;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_set(good.world, good.collider, &def, &bad));
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_collider_set(good.world, (pbmpm_collider_id){0, 0}, NULL, NULL));
    pbmpm_collider_def back = {.size = sizeof back};
    pbmpm_shape same = {.size = sizeof same};
    OK(pbmpm_collider_get(good.world, good.collider, &back, &same));
    TEST_ASSERT_EQUAL_MEMORY(&def, &back, sizeof def);
    TEST_ASSERT_EQUAL_MEMORY(&shape, &same, sizeof shape);
    snapshot_expect_same(&before, good.world, "after refused changes");
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_identifiers_are_valid_until_their_thing_goes);
    RUN_TEST(test_a_world_that_is_gone_has_nothing);
    RUN_TEST(test_lists_hold_what_is_there);
    RUN_TEST(test_every_kind_has_a_list);
    RUN_TEST(test_worlds_are_listed);
    RUN_TEST(test_a_change_is_felt_and_keeps_the_identifier);
    RUN_TEST(test_a_half_of_it_stays);
    RUN_TEST(test_a_way_survives_other_changes_but_not_a_new_shape);
    RUN_TEST(test_a_collider_begins_to_measure);
    RUN_TEST(test_a_refused_change_changes_nothing);
    return UNITY_END();
}

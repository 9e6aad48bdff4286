/* Rigid bodies that meet matter: on solids, and in water; and what the advice tells of bodies. */
#include <math.h>
#include <stdio.h>

#include "advised.h"
#include "rigid.h"

void setUp(void) {}

void tearDown(void)
{
    pbmpm_shutdown();
}

/* ---- On solids ---- */

static pbmpm_material_id create_elastic(pbmpm_world_id world, float modulus)
{
    pbmpm_material_def matter = default_material(PBMPM_ELASTIC);
    pbmpm_material_id material;
    matter.young_modulus = modulus;
    OK(pbmpm_material_create(world, &matter, &material));
    return material;
}

/* Two crates of 0.4 m on a floor, with room above. */
static pbmpm_world_id two_crates(int32_t dimension, float modulus)
{
    pbmpm_world_def def = default_world(dimension, dimension == 2 ? 0.05f : 0.1f, 20000);
    def.domain_enabled = 1;
    def.domain_max[0] = def.domain_max[1] = 2;
    def.domain_max[2] = 0.8f;
    const pbmpm_world_id world = create_world(&def);
    const pbmpm_material_id material = create_elastic(world, modulus);
    for (int i = 0; i < 2; i++) fill_shape(world, material, box_shape(0.5f + (float)i, 0.2f, 0.4f, 0.2f, 0.2f, 0.2f), STILL);
    set_gravity(world, 0, -10, 0);
    set_rate(world, 1, 5);
    return world;
}

/* Of matter and the body, but the elastic part, which is what they fell in. */
static double energy_with(const rigid *body)
{
    pbmpm_stats stats = {.size = sizeof stats};
    double motion = 0.0;
    OK(pbmpm_world_get_stats(body->world, &stats));
    for (int a = 0; a < 3; a++) motion += 0.5 * body->def.mass * body->state.velocity[a] * body->state.velocity[a];
    motion += 0.5 * body->def.inertia[2] * body->state.angular_velocity[2] * body->state.angular_velocity[2];
    return stats.kinetic_energy + stats.potential_energy + motion + 10.0 * body->def.mass * body->state.position[1];
}

/* A plank is laid on the crates, for a second: its energy never grows, and in the end it rests. A hundredth is the step's fall of all, 1e-3 of it, and what is elastic. */
static void lay_plank(int32_t dimension, float modulus, float density)
{
    rigid body = make_rigid(two_crates(dimension, modulus), box_shape(1.0f, 0.45f, 0.4f, 0.7f, 0.05f, 0.2f), density, NULL);
    char what[64];
    double first = 0.0, fastest = 0.0;
    snprintf(what, sizeof what, "%dD, %g Pa, %g kg/m^3", (int)dimension, (double)modulus, (double)density);
    for (int n = 0; n < 90; n++) {
        step(&body);
        if (n == 0) first = energy_with(&body);
        TEST_ASSERT_TRUE_MESSAGE(energy_with(&body) <= 1.01 * first, what);
        TEST_ASSERT_TRUE_MESSAGE(body.state.position[1] > 0.3 && body.state.position[1] < 0.46, what);
        if (n >= 75) fastest = fmax(fastest, fabs(body.state.velocity[1]));
    }
    const bool swings = modulus < 2e5f; /* under the heaviest plank to both sides, by 10 mm with 60 iterations, by 11 at 240 Hz x 30 */
    if (!swings) TEST_ASSERT_TRUE_MESSAGE(fastest < 0.03, what);
    TEST_ASSERT_DOUBLE_WITHIN(swings ? 0.022 : 0.01, 1.0, body.state.position[0]); /* twice what it swings when solved well */
    OK(pbmpm_world_destroy(body.world));
}

/* Light or heavy, on soft or stiff ones. One step late k dt^2 / m, up to 1e5 here, threw off what it was above 4 for. */
static void test_planks_rest_on_crates(void)
{
    static const float modulus[] = {1e5f, 1e6f, 1e7f}, density[] = {50, 500, 5000};
    for (int e = 0; e < 3; e++)
        for (int d = 0; d < 3; d++) lay_plank(2, modulus[e], density[d]);
    lay_plank(3, 1e6f, 50);
    lay_plank(3, 1e7f, 500);
}

/* A crate that lies on a body that lies on a floor lies still: what walls of the domain hold does not yield. */
static void test_a_crate_lies_on_what_lies_on_a_floor(void)
{
    pbmpm_world_def def = default_world(2, 0.05f, 4000);
    def.domain_enabled = 1;
    def.domain_max[0] = def.domain_max[1] = 2;
    rigid body = make_rigid(create_world(&def), box_shape(1, 0.05f, 0, 0.6f, 0.05f, 0), 50, NULL);
    pbmpm_stats stats = {.size = sizeof stats};
    fill_shape(body.world, create_elastic(body.world, 1e6f), box_shape(1, 0.3f, 0, 0.2f, 0.2f, 0), STILL);
    set_gravity(body.world, 0, -10, 0);
    set_rate(body.world, 1, 5);
    for (int n = 0; n < 60; n++) step(&body);
    OK(pbmpm_world_get_stats(body.world, &stats));
    TEST_ASSERT_TRUE(stats.max_speed < 0.01f);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.05, body.state.position[1]);
    TEST_ASSERT_DOUBLE_WITHIN(2e-3, 1.0, body.state.position[0]);
}

/* A crate flies into a body: what one loses the other gets, to rounding, along both axes and about the origin. */
static void test_a_hit_keeps_momentum(void)
{
    const pbmpm_world_def def = default_world(2, 0.05f, 4000);
    static const float speed[3] = {2, 0, 0};
    rigid body = make_rigid(create_world(&def), box_shape(0.4f, 0.1f, 0, 0.15f, 0.2f, 0), 200, NULL);
    pbmpm_stats stats = {.size = sizeof stats};
    fill_shape(body.world, create_elastic(body.world, 1e6f), box_shape(0, 0, 0, 0.2f, 0.2f, 0), speed);
    set_rate(body.world, 1, 5);
    for (int n = 0; n < 30; n++) step(&body);
    OK(pbmpm_world_get_stats(body.world, &stats));
    advance(&body); /* it has the last step's impulse now */
    TEST_ASSERT_TRUE(body.state.velocity[0] > 1.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 2.0 * stats.mass, stats.momentum[0] + body.def.mass * body.state.velocity[0]);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.0, stats.momentum[1] + body.def.mass * body.state.velocity[1]);
}

/* The same of one that solids make yield, in another world. */
static void test_a_body_on_crates_goes_on_from_a_save(void)
{
    static char saved[1 << 21];
    uint64_t bytes, hash[2];
    rigid body[2];
    for (int i = 0; i < 2; i++) body[i] = make_rigid(two_crates(2, 1e6f), box_shape(1.0f, 0.47f, 0.4f, 0.7f, 0.05f, 0.2f), 100, NULL);
    for (int n = 0; n < 20; n++) step(&body[0]);
    OK(pbmpm_snapshot_save(body[0].world, saved, sizeof saved, &bytes));
    OK(pbmpm_snapshot_restore(body[1].world, saved, bytes, 0));
    body[1].state = body[0].state;
    for (int i = 0; i < 2; i++) {
        for (int n = 0; n < 20; n++) step(&body[i]);
        hash[i] = world_hash(body[i].world);
    }
    TEST_ASSERT_EQUAL_HEX64(hash[0], hash[1]);
    TEST_ASSERT_EQUAL_MEMORY(&body[0].state, &body[1].state, sizeof body[0].state);
}

/* ---- In water ---- */

/* A box of 0.1 of the liquid's density, held under at `start` and let go, in seconds 5 to 9: its mean height, and how far it bobs. */
static void let_a_light_box_go(float start, double *mean, double *bob)
{
    pbmpm_world_def def = default_world(2, 0.05f, 20000);
    def.domain_enabled = 1;
    def.domain_max[0] = 1.6f;
    def.domain_max[1] = 3.0f;
    const pbmpm_world_id world = create_world(&def);
    set_gravity(world, 0, -9.81f, 0);
    set_rate(world, 1, 5);
    rigid body = make_rigid(world, box_shape(0.8f, start, 0, 0.2f, 0.2f, 0), 100, NULL);
    fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0.8f, 0.4f, 0, 0.8f, 0.4f, 0), STILL);
    double low = 9, high = 0;
    *mean = 0;
    for (int n = 0; n < 60; n++) OK(pbmpm_world_step(world, DT));
    for (int n = 0; n < 480; n++) {
        step(&body);
        TEST_ASSERT_TRUE(body.state.position[1] < 1.3); /* it does not leap */
        if (n < 240) continue;
        low = fmin(low, body.state.position[1]);
        high = fmax(high, body.state.position[1]);
        *mean += body.state.position[1] / 240;
    }
    *bob = high - low;
}

/* It comes up and comes to lie still. How the tank sloshes on depends on the last bit: single starts bob by 0.03 to 0.21 m, many by 0.1 on average. */
static void test_light_boxes_let_go_under_water_are_stable(void)
{
    enum { STARTS = 9 };
    const double level = (1.6 * 0.8 - 0.16 + 0.016) / 1.6; /* of the liquid and what the box displaces */
    double bobs = 0;
    for (int i = 0; i < STARTS; i++) {
        double mean, bob;
        let_a_light_box_go(0.36f + 0.01f * (float)i, &mean, &bob);
        TEST_ASSERT_DOUBLE_WITHIN(0.4 * 0.05, level + 0.2 - 0.04, mean);
        bobs += bob;
    }
    TEST_ASSERT_TRUE(bobs / STARTS < 0.15); /* less and less: 0.6 m at first */
}

/* ---- What the advice tells ---- */

/* What is advised of a plank of this density on a block of 1e6 Pa, at this step; `pool`: there is water in the world. */
static bool told_that_it_is_thrown_off(float density, float dt, bool pool)
{
    pbmpm_world_def def = default_world(2, 0.05f, 4000);
    def.domain_enabled = 1;
    def.domain_max[0] = def.domain_max[1] = 4;
    rigid body = make_rigid(create_world(&def), box_shape(2, 0.66f, 0, 0.6f, 0.1f, 0), density, NULL);
    fill_shape(body.world, create_elastic(body.world, 1e6f), box_shape(2, 0.3f, 0, 0.3f, 0.25f, 0), STILL);
    if (pool) fill_shape(body.world, create_material(body.world, PBMPM_LIQUID), box_shape(3.5f, 0.2f, 0, 0.5f, 0.2f, 0), STILL);
    set_gravity(body.world, 0, -10, 0);
    advance(&body);
    const bool found = advised(body.world, dt, "thrown off");
    OK(pbmpm_world_destroy(body.world));
    return found;
}

/* k dt^2 / m = (c dt / T)^2 M / m is 1.11 * 300 kg / m at 60 Hz: the block is 0.5 m thick, its sound goes at 31.6 m/s. Planks of 0.24 m^2.
 * Among solids alone they yield within the step. */
static void test_it_is_told_where_solids_throw_it_off(void)
{
    TEST_ASSERT_TRUE(told_that_it_is_thrown_off(100.0f, 1.0f / 60.0f, true));
    TEST_ASSERT_FALSE(told_that_it_is_thrown_off(100.0f, 1.0f / 60.0f, false));
    TEST_ASSERT_FALSE(told_that_it_is_thrown_off(2000.0f, 1.0f / 60.0f, true));
    TEST_ASSERT_FALSE(told_that_it_is_thrown_off(100.0f, 1.0f / 240.0f, true));
}

/* It lies on a floor without friction; before it got there, and with friction, nothing is told. */
static void test_it_is_told_where_a_body_glides(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++)
        for (int rough = 0; rough < 2; rough++) {
            rigid body = put_on_floor(dimension, box_shape(5, 0.3f, 5, 0.2f, 0.1f, 0.2f), 0.2f, rough ? 0.1f : 0.0f);
            step(&body);
            TEST_ASSERT_FALSE(advised(body.world, DT, "glides"));
            for (int n = 0; n < 30; n++) step(&body);
            TEST_ASSERT_EQUAL(!rough, advised(body.world, DT, "glides"));
        }
}

/* A box that lies half a cell above a box, a plane, or a box that is a body, too, and falls into it. Beside an obstacle nothing is told; nor of a wheel about its axle. */
static void test_it_is_told_where_a_body_enters_another(void)
{
    static const char *const what[] = {"a box", "a plane", "a body", "beside"};
    for (int32_t dimension = 2; dimension <= 3; dimension++)
        for (int other = 0; other < 4; other++) {
            rigid body = make_rigid(empty_world(dimension, 0.1f), box_shape(0, 0.35f, 0, 0.2f, 0.1f, 0.2f), 500, NULL), below;
            const pbmpm_shape box = box_shape(other == 3 ? 1 : 0, 0, 0, 0.4f, 0.2f, 0.4f);
            if (other == 0 || other == 3) create_collider(body.world, box, false);
            if (other == 1) create_collider(body.world, plane_shape(0, 0.2f, 0, 0, 1, 0), false);
            if (other == 2) below = make_rigid(body.world, box, 500, NULL);
            advance(&body);
            if (other == 2) advance(&below);
            TEST_ASSERT_FALSE(advised(body.world, DT, "obstacle"));
            set_gravity(body.world, 0, -10, 0);
            TEST_ASSERT_EQUAL_INT_MESSAGE(other != 3, advised(body.world, DT, "falls through"), what[other]);
            TEST_ASSERT_FALSE(advised(body.world, DT, "has entered"));
            for (int n = 0; n < 15; n++) step(&body);
            TEST_ASSERT_EQUAL_INT_MESSAGE(other != 3, advised(body.world, DT, "has entered"), what[other]);
        }
    rigid wheel = make_rigid(empty_world(2, 0.1f), box_shape(0, -0.5f, 0, 0.1f, 0.6f, 0), 500, short_pendulum);
    create_collider(wheel.world, sphere_shape(0, 0, 0, 0.05f), false); /* where it turns */
    advance(&wheel);
    TEST_ASSERT_FALSE(advised(wheel.world, DT, "has entered"));
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_planks_rest_on_crates);
    RUN_TEST(test_a_crate_lies_on_what_lies_on_a_floor);
    RUN_TEST(test_a_hit_keeps_momentum);
    RUN_TEST(test_a_body_on_crates_goes_on_from_a_save);
    RUN_TEST(test_it_is_told_where_solids_throw_it_off);
    RUN_TEST(test_it_is_told_where_a_body_glides);
    RUN_TEST(test_it_is_told_where_a_body_enters_another);
    RUN_TEST(test_light_boxes_let_go_under_water_are_stable);
    return UNITY_END();
}

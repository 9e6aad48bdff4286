/* What elastic bodies do that a textbook says: they keep their momentum and spin, slide and stick by Coulomb's law, and pay for all that obstacles get.
 * Bodies are small, so that the whole takes seconds. */
#include <float.h>
#include <math.h>
#include <stdio.h>

#include "solvers.h"

static const float DT = 1.0f / 60, FALL = 9.81f, SIDE = 0.4f; /* the body's length and twice its height [m] */

void setUp(void) {}
void tearDown(void) { pbmpm_shutdown(); }

static double length(const double a[3]) { return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

/* A block of 1:0.5:0.5 around (0, height, 0). */
static pbmpm_world_id open_world(int32_t dimension, const way *chosen, int32_t iterations, float height)
{
    pbmpm_world_def def = default_world(dimension, 0.1f, 4096);
    pbmpm_material_def jelly = default_material(PBMPM_ELASTIC);
    pbmpm_material_id id;
    def.thread_count = 1;
    jelly.young_modulus = 2e5f;
    const pbmpm_world_id world = create_world(&def);
    OK(pbmpm_material_create(world, &jelly, &id));
    fill_shape(world, id, box_shape(0, height, 0, SIDE, 0.5f * SIDE, 0.5f * SIDE), (const float[3]){0, 0, 0});
    use_way(world, chosen);
    set_rate(world, 1, iterations);
    return world;
}

/* ---- In free flight ---- */

static void spin(pbmpm_world_id world, const double axis[3])
{
    enum { ROOM = 4096 };
    static float velocities[3 * ROOM], gradients[9 * ROOM];
    const double turn[3][3] = {{0, -axis[2], axis[1]}, {axis[2], 0, -axis[0]}, {-axis[1], axis[0], 0}};
    const pbmpm_view x = view_of(world, PBMPM_POSITION);
    const uint32_t d = x.components;
    TEST_ASSERT_TRUE(x.count <= ROOM);
    for (uint32_t i = 0; i < x.count; i++)
        for (uint32_t a = 0; a < d; a++) {
            double v = 0.5;
            for (uint32_t b = 0; b < d; b++) {
                v += turn[a][b] * (double)view_float(&x, i, b);
                gradients[(i * d + a) * d + b] = (float)turn[a][b];
            }
            velocities[i * d + a] = (float)v;
        }
    OK(pbmpm_particles_set(world, PBMPM_VELOCITY, NULL, x.count, velocities));
    OK(pbmpm_particles_set(world, PBMPM_AFFINE_VELOCITY, NULL, x.count, gradients));
}

/* The angular momentum about the body's middle, which moves. */
static void own_spin(const pbmpm_stats *stats, const double middle[3], double own[3])
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        own[a] = stats->angular_momentum[a] - middle[b] * stats->momentum[c] + middle[c] * stats->momentum[b];
    }
}

static void middle_of(pbmpm_world_id world, double middle[3])
{
    const pbmpm_view x = view_of(world, PBMPM_POSITION);
    for (uint32_t a = 0; a < 3; a++) middle[a] = 0;
    for (uint32_t i = 0; i < x.count; i++)
        for (uint32_t a = 0; a < x.components; a++) middle[a] += (double)view_float(&x, i, a) / x.count;
}

/* A body that turns for a second; returns how much of its spin is lost between a third of it and the end. */
static double check_flight(int32_t dimension, const way *chosen, int32_t iterations, double allowed)
{
    const double axis[3] = {dimension == 3 ? 2 : 0, dimension == 3 ? -1 : 0, 4};
    const pbmpm_world_id world = open_world(dimension, chosen, iterations, 0);
    double middle[3], first[3], own[3], off[3], third = 0;
    char label[100];
    spin(world, axis);
    const pbmpm_stats begin = world_stats(world);
    middle_of(world, middle);
    own_spin(&begin, middle, first);
    snprintf(label, sizeof label, "%s, %dD, %d iterations", chosen->name, (int)dimension, (int)iterations);
    for (int step = 1; step <= 60; step++) {
        OK(pbmpm_world_step(world, DT));
        const pbmpm_stats now = world_stats(world);
        middle_of(world, middle);
        own_spin(&now, middle, own);
        for (int a = 0; a < 3; a++) {
            off[a] = own[a] - first[a];
            TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-5 * begin.mass, begin.momentum[a], now.momentum[a], label);
        }
        TEST_ASSERT_TRUE_MESSAGE(length(off) <= allowed * length(first), label);
        TEST_ASSERT_TRUE_MESSAGE(now.kinetic_energy <= 1.0001 * begin.kinetic_energy, label);
        TEST_ASSERT_TRUE_MESSAGE(now.kinetic_energy >= 0.9 * begin.kinetic_energy, label);
        if (step == 20) third = length(own);
    }
    OK(pbmpm_world_destroy(world));
    return (third - length(own)) / length(first);
}

static const way dual = {"dual", PBMPM_SOLVER_DUAL, 0, 0, 0}, primal = {"primal", PBMPM_SOLVER_PRIMAL, 0, 0, 0},
                 bdf2 = {"primal, BDF2", PBMPM_SOLVER_PRIMAL, 0, PBMPM_INTEGRATOR_BDF2, 0}, paper = {"paper", PBMPM_SOLVER_PAPER, 0, 0, 0},
                 convergent = {"convergent", PBMPM_SOLVER_CONVERGENT, 0, 0, 0};

static void test_bodies_in_flight_keep_what_they_have(void)
{
    for (int32_t d = 2; d <= 3; d++) {
        check_flight(d, &dual, 5, 1e-4);
        check_flight(d, &primal, 5, 0.06);
        check_flight(d, &convergent, 20, 0.02);
        check_flight(d, &bdf2, 5, 0.06);
    }
}

/* Second order: what damps a spin is a small part of what it is with backward Euler. */
static void test_bdf2_hardly_damps_a_spin(void)
{
    for (int32_t d = 2; d <= 3; d++) TEST_ASSERT_TRUE(fabs(check_flight(d, &bdf2, 20, 0.01)) < 0.3 * check_flight(d, &primal, 20, 0.02));
}

/* ---- On a slope ---- */

/* A body on a plane that is inclined by `angle`: after a second it slides as Coulomb says, to a part of the speed without friction. All that the plane
 * gets the body pays, in each step. */
static void check_slope(int32_t dimension, const way *chosen, float friction, float angle)
{
    const pbmpm_world_id world = open_world(dimension, chosen, 10, 0.5f * SIDE + 0.02f);
    const double pull[3] = {(double)(FALL * sinf(angle)), (double)(-FALL * cosf(angle)), 0}, second = 60.0 * (double)DT;
    const double coulomb = fmax(0.0, pull[0] + (double)friction * pull[1]) * second;
    const pbmpm_shape ground = plane_shape(0, 0, 0, 0, 1, 0);
    pbmpm_collider_def def = default_collider();
    pbmpm_collider_id plane;
    char label[100];
    def.friction_coefficient = friction;
    def.measures_impulse = 1;
    OK(pbmpm_collider_create(world, &def, &ground, &plane));
    set_gravity(world, (float)pull[0], (float)pull[1], 0);
    snprintf(label, sizeof label, "%s, %dD, friction %.1f", chosen->name, (int)dimension, (double)friction);
    pbmpm_stats now = world_stats(world);
    for (int step = 0; step < 60; step++) {
        const pbmpm_stats old = now;
        pbmpm_impulse given = {.size = sizeof given};
        OK(pbmpm_world_step(world, DT));
        OK(pbmpm_collider_impulse(world, plane, &given));
        now = world_stats(world);
        for (int a = 0; a < dimension; a++) {
            const double pulled = now.mass * pull[a] * (double)DT;
            TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-5 * now.mass * (double)(FALL * DT), old.momentum[a] + pulled, now.momentum[a] + given.linear[a], label);
        }
        /* Matter pushes the plane; nodes hold momenta as floats, so a body that has just left may seem to pull by a unit in the last place of its weight's impulse. */
        TEST_ASSERT_TRUE_MESSAGE(given.linear[1] <= (double)FLT_EPSILON * now.mass * (double)(FALL * DT), label);
    }
    TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(0.02 * pull[0] * second, coulomb, now.momentum[0] / now.mass, label);
    TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(0.01, 0.0, now.momentum[1] / now.mass, label);
    OK(pbmpm_world_destroy(world));
}

static void test_bodies_slide_and_stick(void)
{
    const way *const solved[] = {&paper, &dual, &primal, &convergent};
    for (int32_t d = 2; d <= 3; d++)
        for (int i = 0; i < 4; i++) {
            check_slope(d, solved[i], 0.0f, 0.4f);
            check_slope(d, solved[i], 0.2f, 0.4f);
            check_slope(d, solved[i], 0.6f, 0.4f);
        }
}

/* ---- Clay ---- */

/* So soft that nothing moves it, it forgets what it is strained by beyond its yield strain as fast as its flow rate says, and keeps the rest. */
static void test_clay_flows_as_fast_as_it_says(void)
{
    enum { ROOM = 256 };
    static float strained[4 * ROOM];
    const double yield = 0.1, rate = 20, h = 0.4;
    const pbmpm_world_def def = default_world(2, 0.1f, ROOM);
    pbmpm_material_def clay = default_material(PBMPM_VISCO);
    pbmpm_material_id id;
    const pbmpm_world_id world = create_world(&def);
    clay.young_modulus = 1e-3f;
    clay.yield_strain = (float)yield;
    clay.flow_rate = (float)rate;
    OK(pbmpm_material_create(world, &clay, &id));
    use_way(world, &primal);
    const uint32_t count = fill_shape(world, id, box_shape(0, 0, 0, SIDE, SIDE, SIDE), (const float[3]){0, 0, 0});
    TEST_ASSERT_TRUE(count > 100 && count <= ROOM);
    for (uint32_t i = 0; i < count; i++) {
        strained[4 * i] = (float)exp(h);
        strained[4 * i + 3] = (float)exp(-h);
    }
    OK(pbmpm_particles_set(world, PBMPM_DEFORMATION, NULL, count, strained));
    for (int step = 0; step <= 12; step++) {
        const double norm = yield + (sqrt(2.0) * h - yield) * exp(-rate * (double)DT * step);
        const pbmpm_view F = view_of(world, PBMPM_DEFORMATION);
        for (uint32_t i = 0; i < count; i++) {
            TEST_ASSERT_DOUBLE_WITHIN(1e-4, norm, sqrt(2.0) * log((double)view_float(&F, i, 0)));
            TEST_ASSERT_DOUBLE_WITHIN(1e-4, norm, -sqrt(2.0) * log((double)view_float(&F, i, 3)));
        }
        OK(pbmpm_world_step(world, DT));
    }
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_bodies_in_flight_keep_what_they_have);
    RUN_TEST(test_bdf2_hardly_damps_a_spin);
    RUN_TEST(test_bodies_slide_and_stick);
    RUN_TEST(test_clay_flows_as_fast_as_it_says);
    return UNITY_END();
}

/* What a liquid that is let go in a tank does with every solver: it gains no energy, keeps its volume, pays for all that the walls get, and comes to
 * lie level. And how viscosity slows it. Tanks are small, so that the whole takes seconds. */
#include <math.h>
#include <stdio.h>

#include "solvers.h"

static const float DT = 1.0f / 60, FALL = 9.81f, WIDTH = 1.2f, DEEP = 0.2f; /* of the tank in 3D [m] */
static const double COLUMN = 0.8, DEPTH = 0.6;                               /* of the liquid at first [m] */

void setUp(void) {}
void tearDown(void) { pbmpm_shutdown(); }

static pbmpm_world_id open_tank(int32_t dimension, const way *chosen)
{
    const bool papers = chosen->solver == PBMPM_SOLVER_PAPER;
    pbmpm_world_def def = default_world(dimension, 0.1f, 2048);
    pbmpm_material_def water = default_material(PBMPM_LIQUID);
    pbmpm_material_id id;
    def.thread_count = 1;
    def.domain_enabled = def.domain_measures_impulse = 1;
    def.domain_friction = 0.2f;
    def.domain_max[0] = def.domain_max[1] = WIDTH;
    def.domain_max[2] = 2 * DEEP;
    water.bulk_modulus = papers ? 0 : 2e5f;
    const pbmpm_world_id world = create_world(&def);
    OK(pbmpm_material_create(world, &water, &id));
    fill_shape(world, id, box_shape((float)COLUMN / 2, (float)DEPTH / 2, DEEP, (float)COLUMN / 2, (float)DEPTH / 2, DEEP), (const float[3]){0, 0, 0});
    use_way(world, chosen);
    set_rate(world, chosen->solver == PBMPM_SOLVER_EXPLICIT ? 16 : 2, 10);
    set_gravity(world, 0, -FALL, 0);
    return world;
}

static void add_impulses(pbmpm_world_id world, int32_t dimension, double sum[3])
{
    for (int32_t axis = 0; axis < dimension; axis++)
        for (int32_t upper = 0; upper < 2; upper++) {
            pbmpm_impulse given = {.size = sizeof given};
            OK(pbmpm_domain_impulse(world, axis, upper, &given));
            for (int a = 0; a < 3; a++) sum[a] += given.linear[a];
        }
}

static void check_step(pbmpm_world_id world, int32_t dimension, double *energy, const char *label)
{
    const pbmpm_stats old = world_stats(world);
    double given[3] = {0};
    OK(pbmpm_world_step(world, DT));
    add_impulses(world, dimension, given);
    const pbmpm_stats now = world_stats(world);
    const double weight = now.mass * (double)(FALL * DT);
    for (int a = 0; a < dimension; a++)
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-5 * weight, old.momentum[a] - (a == 1 ? weight : 0.0), now.momentum[a] + given[a], label);
    TEST_ASSERT_TRUE_MESSAGE(now.volume_error_rms < 0.08f, label);
    const double left = now.kinetic_energy + now.potential_energy;
    TEST_ASSERT_TRUE_MESSAGE(left <= *energy + 0.02 * weight * COLUMN / (double)DT, label); /* what it was compressed by comes back */
    *energy = fmin(*energy, left);
}

/* sqrt(g k tanh(k h)), k = pi / WIDTH, of a wave that goes to and fro in the tank takes 84 steps. */
enum { PERIOD = 84 };

/* In the last period of `steps` steps it swings about the level that its volume says, to `tolerance`: what waves lift and what they move are alike on average. */
static void check_tank(int32_t dimension, const way *chosen, int steps, double tolerance)
{
    const double level = COLUMN * DEPTH / (double)WIDTH;
    const pbmpm_world_id world = open_tank(dimension, chosen);
    double energy = world_stats(world).potential_energy, excess = 0;
    char label[100];
    snprintf(label, sizeof label, "%s, %dD", chosen->name, (int)dimension);
    for (int step = 0; step < steps; step++) {
        check_step(world, dimension, &energy, label);
        const pbmpm_stats now = world_stats(world);
        if (steps - step <= PERIOD) excess += (now.potential_energy - now.kinetic_energy) / now.mass;
    }
    const pbmpm_stats last = world_stats(world);
    TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(tolerance * 0.5 * level, 0.5 * level, excess / fmin(steps, PERIOD) / (double)FALL, label);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(0, last.deleted_total + last.clamped_total, label);
    OK(pbmpm_world_destroy(world));
}

static void test_a_dam_breaks_in_2d(void)
{
    for (int i = 0; i < way_count; i++) check_tank(2, &ways[i], 150, 0.04);
}

static void test_a_dam_breaks_in_3d(void)
{
    for (int i = 0; i < way_count; i++)
        if (ways[i].integrator == PBMPM_INTEGRATOR_EULER && ways[i].solver != PBMPM_SOLVER_EXPLICIT) check_tank(3, &ways[i], 30, 0.3);
}

/* ---- Viscosity ---- */

/* What is left of a shear flow v = sin(k y) between two free surfaces, half a wave apart, in the middle of a long layer. */
static double shear_left(const way *chosen, float viscosity, int steps)
{
    enum { ROOM = 2048 };
    static float velocities[2 * ROOM], gradients[4 * ROOM];
    const double height = 1.2, k = 3.14159265358979 / height, speed = 0.2;
    const pbmpm_world_def def = default_world(2, 0.1f, ROOM);
    pbmpm_material_def syrup = default_material(PBMPM_LIQUID);
    pbmpm_material_id id;
    double held = 0, all = 0;
    const pbmpm_world_id world = create_world(&def);
    syrup.bulk_modulus = chosen->solver == PBMPM_SOLVER_PAPER ? 0 : 1e5f;
    syrup.kinematic_viscosity = viscosity;
    OK(pbmpm_material_create(world, &syrup, &id));
    use_way(world, chosen);
    set_rate(world, chosen->solver == PBMPM_SOLVER_EXPLICIT ? 8 : 1, 10);
    fill_shape(world, id, box_shape(0, 0, 0, 1.2f, 0.5f * (float)height, 0), (const float[3]){0, 0, 0});
    pbmpm_view x = view_of(world, PBMPM_POSITION);
    TEST_ASSERT_TRUE(x.count <= ROOM);
    for (uint32_t i = 0; i < x.count; i++) {
        const double y = (double)view_float(&x, i, 1);
        velocities[2 * i] = (float)(speed * sin(k * y));
        gradients[4 * i + 1] = (float)(speed * k * cos(k * y));
    }
    OK(pbmpm_particles_set(world, PBMPM_VELOCITY, NULL, x.count, velocities));
    OK(pbmpm_particles_set(world, PBMPM_AFFINE_VELOCITY, NULL, x.count, gradients));
    for (int step = 0; step < steps; step++) OK(pbmpm_world_step(world, DT));
    x = view_of(world, PBMPM_POSITION);
    const pbmpm_view v = view_of(world, PBMPM_VELOCITY);
    for (uint32_t i = 0; i < x.count; i++) {
        if (fabs((double)view_float(&x, i, 0)) > 0.6) continue;
        const double wave = sin(k * (double)view_float(&x, i, 1));
        held += wave * (double)view_float(&v, i, 0);
        all += wave * wave * speed;
    }
    OK(pbmpm_world_destroy(world));
    return held / all;
}

/* It fades by exp(-nu k^2 t), and without viscosity hardly. */
static void test_shear_fades_as_viscosity_says(void)
{
    enum { STEPS = 24 };
    const double k = 3.14159265358979 / 1.2, viscosity = 0.1, fading = exp(-viscosity * k * k * STEPS * (double)DT);
    for (int i = 0; i < way_count; i++) {
        const double without = shear_left(&ways[i], 0, STEPS), with = shear_left(&ways[i], (float)viscosity, STEPS);
        TEST_ASSERT_TRUE_MESSAGE(without > 0.96 && without < 1.001, ways[i].name);
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(0.015, fading, with / without, ways[i].name);
    }
}

/* ---- Edges ---- */

/* What a sheet keeps of its velocity when it slides along a wall `thick` cells thick and off its edge, without gravity; the edge lies `off` cells from a node. */
static double kept_over_edge(const way *chosen, float thick, float off)
{
    const float cell = 0.1f, speed = 0.6f, edge = off * cell;
    const pbmpm_world_def def = default_world(2, cell, 256);
    pbmpm_material_def water = default_material(PBMPM_LIQUID);
    pbmpm_material_id id;
    const pbmpm_world_id world = create_world(&def);
    water.bulk_modulus = chosen->solver == PBMPM_SOLVER_DUAL ? 0 : 1e5f;
    OK(pbmpm_material_create(world, &water, &id));
    use_way(world, chosen);
    set_rate(world, chosen->solver == PBMPM_SOLVER_EXPLICIT ? 8 : 1, 5);
    create_collider(world, box_shape(edge + 0.5f * thick * cell, edge - 1, 0, 0.5f * thick * cell, 1, 0), false);
    fill_shape(world, id, box_shape(edge - 0.05f, edge - 0.6f, 0, 0.05f, 0.4f, 0), (const float[3]){0, speed, 0});
    for (int step = 0; step < 160; step++) OK(pbmpm_world_step(world, DT));
    const pbmpm_stats last = world_stats(world);
    OK(pbmpm_world_destroy(world));
    return last.momentum[1] / last.mass / (double)speed;
}

/* A wall pushes and does not pull: what leaves it flies on, however thick the wall is and wherever its edge lies on the grid. */
static void test_a_sheet_flies_on_over_an_edge(void)
{
    static const float thick[] = {1, 2, 4}, off[] = {0, 0.3f, 0.5f, 0.7f};
    for (int i = 0; i < way_count; i++)
        for (int k = 0; k < 12; k++) {
            char label[100];
            snprintf(label, sizeof label, "%s, %g cells thick, %g off", ways[i].name, (double)thick[k / 4], (double)off[k % 4]);
            TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(0.1, 1.0, kept_over_edge(&ways[i], thick[k / 4], off[k % 4]), label);
        }
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_a_dam_breaks_in_2d);
    RUN_TEST(test_a_dam_breaks_in_3d);
    RUN_TEST(test_shear_fades_as_viscosity_says);
    RUN_TEST(test_a_sheet_flies_on_over_an_edge);
    return UNITY_END();
}

/* Sand of the convergent solver: the primal solves it while it rests, the dual while it flows. What the state is, how it changes, that it is saved, and that
 * going over from one solver to the other moves nothing. */
#include <math.h>
#include <stdlib.h>

#include "scenes.h"

static const float DT = 1.0f / 60, REST[3] = {0, 0, 0};

void setUp(void) {}

void tearDown(void) { pbmpm_shutdown(); }

/* A box, 20 cells wide, with so many cells of sand in it and three of air above. */
static pbmpm_world_id bin_of(float depth, pbmpm_material_id *sand)
{
    const float cell = 0.05f;
    pbmpm_world_def def = default_world(2, cell, 4096);
    pbmpm_material_def material = default_material(PBMPM_SAND);
    def.domain_enabled = 1;
    def.domain_max[0] = 20 * cell;
    def.domain_max[1] = (depth + 3) * cell;
    def.domain_friction = 0.5f;
    const pbmpm_world_id world = create_world(&def);
    material.density = 1600;
    material.young_modulus = 1e6f;
    OK(pbmpm_material_create(world, &material, sand));
    fill_shape(world, *sand, box_shape(10 * cell, 0.5f * depth * cell, 0, 10 * cell, 0.5f * depth * cell, 0), REST);
    set_gravity(world, 0, -9.81f, 0);
    set_rate(world, 1, 5);
    return world;
}

static pbmpm_world_id bin(pbmpm_material_id *sand) { return bin_of(5, sand); }

static pbmpm_solver step(pbmpm_world_id world)
{
    OK(pbmpm_world_step(world, DT));
    return world_stats(world).solver;
}

/* Runs some steps, each of which has to be solved so. */
static void expect_solver(pbmpm_world_id world, pbmpm_solver expected, int steps)
{
    for (int i = 0; i < steps; i++) TEST_ASSERT_EQUAL_INT32(expected, step(world));
}

/* How many steps until it is solved so. */
static int steps_until(pbmpm_world_id world, pbmpm_solver expected, int most)
{
    int steps = 0;
    while (step(world) != expected) TEST_ASSERT_LESS_THAN_INT32_MESSAGE(most, ++steps, "the state did not change");
    return steps;
}

static void throw_all(pbmpm_world_id world, float x, float y)
{
    const uint32_t count = world_count(world);
    float *velocities = malloc(2 * count * sizeof *velocities);
    TEST_ASSERT_NOT_NULL(velocities);
    for (uint32_t i = 0; i < count; i++) {
        velocities[2 * i] = x;
        velocities[2 * i + 1] = y;
    }
    const pbmpm_result result = pbmpm_particles_set(world, PBMPM_VELOCITY, NULL, count, velocities);
    free(velocities);
    OK(result);
}

/* A fall through a cell of 0.05 m ends with 0.99 m/s. */
static void test_sand_rests_then_flows_then_rests(void)
{
    pbmpm_material_id sand;
    const pbmpm_world_id world = bin(&sand);
    expect_solver(world, PBMPM_SOLVER_PRIMAL, 60);
    throw_all(world, 2.0f, 0);
    TEST_ASSERT_LESS_OR_EQUAL_INT32(2, steps_until(world, PBMPM_SOLVER_DUAL, 5)); /* it is judged after a step */
    expect_solver(world, PBMPM_SOLVER_DUAL, 17);                                    /* 0.3 s are 18 */
    int rests = 0; /* the foot of the slope may slide once more */
    for (int steps = 0; rests < 60; rests = step(world) == PBMPM_SOLVER_PRIMAL ? rests + 1 : 0) TEST_ASSERT_LESS_THAN_INT32(900, ++steps);
}

/* What creeps goes after 0.3 s at the latest. */
static void test_slow_sand_flows_after_a_while(void)
{
    pbmpm_material_id sand;
    const pbmpm_world_id world = bin(&sand);
    expect_solver(world, PBMPM_SOLVER_PRIMAL, 60);
    set_gravity(world, 9.81f, -9.81f, 0); /* 45 degrees, above the 30 of its friction */
    const int steps = steps_until(world, PBMPM_SOLVER_DUAL, 60);
    TEST_ASSERT_GREATER_OR_EQUAL_INT32(2, steps);
}

static void set_sleeping(pbmpm_world_id world)
{
    pbmpm_settings settings = {.size = sizeof settings};
    OK(pbmpm_world_get_settings(world, &settings));
    settings.sleeping = 1;
    OK(pbmpm_world_set_settings(world, &settings));
}

static pbmpm_collider_id add_box(pbmpm_world_id world, float across) { return create_collider(world, box_shape(across, 0.4f, 0, 0.15f, 0.1f, 0), false); }

/* A box beside the sand is taken away: what it held would fall from the next step on, also if it slept. One that stands elsewhere is nothing to it. */
static void test_sand_flows_where_something_goes(void)
{
    static const float across[3] = {0.5f, 50.0f, 0.5f};
    static const pbmpm_solver after[3] = {PBMPM_SOLVER_DUAL, PBMPM_SOLVER_PRIMAL, PBMPM_SOLVER_DUAL};
    for (int i = 0; i < 3; i++) {
        pbmpm_material_id sand;
        const pbmpm_world_id world = bin(&sand);
        const pbmpm_collider_id box = add_box(world, across[i]);
        if (i == 2) set_sleeping(world);
        expect_solver(world, PBMPM_SOLVER_PRIMAL, 20); /* what came before the first step is nothing new */
        for (int k = 0; i == 2 && k < 240; k++) step(world);
        if (i == 2) TEST_ASSERT_EQUAL_UINT32(world_count(world), world_stats(world).particles_asleep);
        OK(pbmpm_collider_destroy(world, box));
        step(world);
        expect_solver(world, after[i], 2);
    }
}

static void test_a_wall_that_opens_lets_sand_flow(void)
{
    pbmpm_material_id sand;
    const pbmpm_world_id world = bin(&sand);
    pbmpm_domain_wall wall;
    expect_solver(world, PBMPM_SOLVER_PRIMAL, 60);
    wall.size = sizeof wall;
    OK(pbmpm_domain_wall_get(world, 1, 0, &wall));
    wall.open = 1;
    OK(pbmpm_domain_wall_set(world, 1, 0, &wall));
    step(world);
    expect_solver(world, PBMPM_SOLVER_DUAL, 2);
}

/* Saved between the call that takes it away and the step, or shifted: that is known, too. */
static void test_what_went_is_saved(void)
{
    pbmpm_material_id sand;
    uint64_t bytes;
    double moved[3];
    const pbmpm_world_id world = bin(&sand);
    const pbmpm_collider_id box = add_box(world, 0.5f);
    expect_solver(world, PBMPM_SOLVER_PRIMAL, 60);
    OK(pbmpm_collider_destroy(world, box));
    OK(pbmpm_snapshot_size(world, &bytes, NULL));
    void *data = malloc(bytes);
    TEST_ASSERT_NOT_NULL(data);
    OK(pbmpm_snapshot_save(world, data, bytes, NULL));
    for (int i = 0; i < 5; i++) step(world);
    const uint64_t hash = world_hash(world);
    const pbmpm_result restored = pbmpm_snapshot_restore(world, data, bytes, 0);
    free(data);
    OK(restored);
    for (int i = 0; i < 5; i++) step(world);
    TEST_ASSERT_EQUAL_UINT64(hash, world_hash(world));
    const pbmpm_world_id shifted = bin(&sand);
    const pbmpm_collider_id gate = add_box(shifted, 0.5f);
    expect_solver(shifted, PBMPM_SOLVER_PRIMAL, 60);
    OK(pbmpm_collider_destroy(shifted, gate));
    OK(pbmpm_world_shift_origin(shifted, (const double[3]){100, 0, 0}, moved));
    step(shifted);
    expect_solver(shifted, PBMPM_SOLVER_DUAL, 2);
}

static float mean_height(pbmpm_world_id world)
{
    const pbmpm_view view = view_of(world, PBMPM_POSITION);
    double sum = 0;
    for (uint32_t i = 0; i < view.count; i++) sum += (double)view_float(&view, i, 1);
    return (float)(sum / view.count);
}

static float rms_speed(pbmpm_world_id world)
{
    const pbmpm_view view = view_of(world, PBMPM_VELOCITY);
    double sum = 0;
    for (uint32_t i = 0; i < view.count; i++) sum += pow((double)view_float(&view, i, 0), 2) + pow((double)view_float(&view, i, 1), 2);
    return (float)sqrt(sum / view.count);
}

/* Both solvers bear the sand with the same stress: a world at rest that is told to use the other one stays where it is, to a hundredth of a cell.
 * While the dual took the means of pressures, and the primal gradients of its own, it sank by more. */
static void test_going_over_moves_nothing(void)
{
    pbmpm_material_id sand;
    const pbmpm_world_id world = bin_of(15, &sand);
    expect_solver(world, PBMPM_SOLVER_PRIMAL, 120);
    const float before = mean_height(world);
    set_solver(world, PBMPM_SOLVER_DUAL);
    for (int i = 0; i < 6; i++) {
        OK(pbmpm_world_step(world, DT));
        TEST_ASSERT_FLOAT_WITHIN(0.005f, 0, rms_speed(world)); /* a tenth of a cell per second: no eye sees it */
    }
    TEST_ASSERT_FLOAT_WITHIN(0.01f * 0.05f, before, mean_height(world));
    set_solver(world, PBMPM_SOLVER_CONVERGENT);
    expect_solver(world, PBMPM_SOLVER_PRIMAL, 6);
    TEST_ASSERT_FLOAT_WITHIN(0.01f * 0.05f, before, mean_height(world));
}

/* Whichever solver: what F bears is the pressure. */
static void test_deformation_bears_the_pressure(void)
{
    static const pbmpm_solver solvers[] = {PBMPM_SOLVER_CONVERGENT, PBMPM_SOLVER_DUAL};
    const double k = 1e6 / (2 * 1.3 * 0.4); /* plane strain, nu = 0.3: E / (2 (1 + nu) (1 - 2 nu)) */
    for (int s = 0; s < 2; s++) {
        pbmpm_material_id sand;
        const pbmpm_world_id world = bin(&sand);
        set_solver(world, solvers[s]);
        for (int i = 0; i < 60; i++) OK(pbmpm_world_step(world, DT));
        const pbmpm_view F = view_of(world, PBMPM_DEFORMATION), p = view_of(world, PBMPM_PRESSURE);
        for (uint32_t i = 0; i < F.count; i++) {
            const double det = (double)view_float(&F, i, 0) * (double)view_float(&F, i, 3) - (double)view_float(&F, i, 1) * (double)view_float(&F, i, 2);
            if (view_float(&p, i, 0) == 0.0f) continue; /* it may have come apart */
            TEST_ASSERT_FLOAT_WITHIN(1e-6f * (float)k, (float)(-k * log(det)), view_float(&p, i, 0)); /* F has 2^-24 */
        }
    }
}

/* Saved while it flows, and restored while it rests: it goes on as it did. */
static void test_the_state_is_saved(void)
{
    pbmpm_material_id sand;
    uint64_t bytes;
    const pbmpm_world_id world = bin(&sand);
    expect_solver(world, PBMPM_SOLVER_PRIMAL, 10);
    throw_all(world, 2.0f, 0);
    steps_until(world, PBMPM_SOLVER_DUAL, 5);
    for (int i = 0; i < 10; i++) step(world);
    OK(pbmpm_snapshot_size(world, &bytes, NULL));
    void *data = malloc(bytes);
    TEST_ASSERT_NOT_NULL(data);
    OK(pbmpm_snapshot_save(world, data, bytes, NULL));
    const int rests = steps_until(world, PBMPM_SOLVER_PRIMAL, 300);
    const uint64_t hash = world_hash(world);
    const pbmpm_result restored = pbmpm_snapshot_restore(world, data, bytes, 0);
    free(data);
    OK(restored);
    TEST_ASSERT_EQUAL_INT32(rests, steps_until(world, PBMPM_SOLVER_PRIMAL, 300));
    TEST_ASSERT_EQUAL_UINT64(hash, world_hash(world));
}

static void add_cube(pbmpm_world_id world, float young_modulus)
{
    pbmpm_material_def def = default_material(PBMPM_ELASTIC);
    pbmpm_material_id cube;
    def.young_modulus = young_modulus;
    OK(pbmpm_material_create(world, &def, &cube));
    fill_shape(world, cube, box_shape(0.5f, 0.325f, 0, 0.075f, 0.075f, 0), REST);
}

static void test_wet_sand_flows(void)
{
    pbmpm_material_id sand;
    const pbmpm_world_id world = bin(&sand);
    fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0.5f, 0.325f, 0, 0.5f, 0.075f, 0), REST);
    expect_solver(world, PBMPM_SOLVER_DUAL, 5);
}

/* The dual holds 1e5 Pa here, but not 1e8: such a cube would spring up when the primal takes over. */
static void test_sand_below_stiff_solids_rests(void)
{
    static const float moduli[2] = {1e5f, 1e8f};
    static const pbmpm_solver thrown[2] = {PBMPM_SOLVER_DUAL, PBMPM_SOLVER_PRIMAL};
    for (int i = 0; i < 2; i++) {
        pbmpm_material_id sand;
        const pbmpm_world_id world = bin(&sand);
        add_cube(world, moduli[i]);
        expect_solver(world, PBMPM_SOLVER_PRIMAL, 5);
        throw_all(world, 2.0f, 0);
        step(world);
        expect_solver(world, thrown[i], 5);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_sand_rests_then_flows_then_rests);
    RUN_TEST(test_slow_sand_flows_after_a_while);
    RUN_TEST(test_sand_flows_where_something_goes);
    RUN_TEST(test_a_wall_that_opens_lets_sand_flow);
    RUN_TEST(test_what_went_is_saved);
    RUN_TEST(test_going_over_moves_nothing);
    RUN_TEST(test_deformation_bears_the_pressure);
    RUN_TEST(test_the_state_is_saved);
    RUN_TEST(test_wet_sand_flows);
    RUN_TEST(test_sand_below_stiff_solids_rests);
    return UNITY_END();
}

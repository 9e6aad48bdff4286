/* Free flight: particles of liquids that share no node with another one take no blocks, and move as they do in the grid. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "scenes.h"

void setUp(void)
{
}

void tearDown(void)
{
    pbmpm_shutdown();
}

enum { SPRAY = 40, STEPS = 60 };

static const pbmpm_solver solvers[] = {PBMPM_SOLVER_PAPER, PBMPM_SOLVER_DUAL, PBMPM_SOLVER_CONVERGENT};
enum { SOLVERS = sizeof solvers / sizeof *solvers };

/* Particles in a lattice of 1.2 m, twelve cells, each somewhere around its point, all moving along. */
static void add_spray(pbmpm_world_id world, int32_t dimension, pbmpm_material_id material, uint32_t count, float low)
{
    static float positions[3 * 4000], velocities[3 * 4000];
    const uint32_t side = (uint32_t)ceil(pow(count, 1.0 / dimension));
    uint32_t random = 4711;
    pbmpm_particles_def def;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t place = i;
        for (int32_t a = 0; a < dimension; a++) {
            positions[i * (uint32_t)dimension + (uint32_t)a] = 1.2f * (float)(place % side) + random_float(&random, -0.2f, 0.2f) + (a == 1 ? low : 0.0f);
            velocities[i * (uint32_t)dimension + (uint32_t)a] = random_float(&random, -0.2f, 0.2f) - (a == 1 ? 5.0f : 0.0f);
            place /= side;
        }
    }
    OK(pbmpm_particles_def_init(&def, sizeof def));
    def.count = count;
    def.material = material;
    def.positions = positions;
    def.velocities = velocities;
    OK(pbmpm_particles_add(world, &def, NULL));
}

static pbmpm_world_id spray_world(int32_t dimension, pbmpm_solver solver, uint32_t count, int32_t threads)
{
    pbmpm_world_def def = default_world(dimension, 0.1f, 4000);
    def.thread_count = threads;
    const pbmpm_world_id world = create_world(&def);
    set_gravity(world, 0, -9.81f, 0);
    set_solver(world, solver);
    add_spray(world, dimension, create_material(world, PBMPM_LIQUID), count, 0.0f);
    return world;
}

/* Nothing flies where a force is felt everywhere, not even by one that does nothing. */
static void keep_in_grid(pbmpm_world_id world)
{
    const pbmpm_shape everywhere = default_shape();
    pbmpm_force_def def;
    pbmpm_force_id force;
    OK(pbmpm_force_def_init(&def, sizeof def));
    def.strength = 0.0f;
    OK(pbmpm_force_create(world, &def, &everywhere, &force));
}

static void set_sleeping(pbmpm_world_id world)
{
    pbmpm_settings settings = {.size = sizeof settings};
    OK(pbmpm_world_get_settings(world, &settings));
    settings.sleeping = 1;
    OK(pbmpm_world_set_settings(world, &settings));
}

static void step(pbmpm_world_id world, int steps)
{
    for (int i = 0; i < steps; i++) OK(pbmpm_world_step(world, 1.0f / 60));
}

/* ---- what they take ---- */

static void test_lone_particles_take_no_blocks(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++)
        for (int k = 0; k < 2 * SOLVERS; k++) {
            const pbmpm_world_id world = spray_world(dimension, solvers[k / 2], SPRAY, 1);
            if (k % 2) set_sleeping(world);
            step(world, 3);
            const pbmpm_stats stats = world_stats(world);
            TEST_ASSERT_EQUAL_UINT32(0, stats.particle_blocks);
            TEST_ASSERT_EQUAL_UINT32(0, stats.node_blocks);
            TEST_ASSERT_EQUAL_UINT32(SPRAY, stats.particle_count);
            TEST_ASSERT_TRUE(stats.lane_occupancy > 0.5f);
            OK(pbmpm_world_destroy(world));
        }
}

/* A block of nodes alone is a kilobyte in 3D. */
static void test_lone_particles_take_little_memory(void)
{
    enum { MANY = 3000, MOST_BYTES = 400 };
    for (int k = 0; k < SOLVERS; k++) {
        const pbmpm_world_id few = spray_world(3, solvers[k], 1, 1), many = spray_world(3, solvers[k], MANY, 1);
        step(few, 3);
        step(many, 3);
        const uint64_t more = world_stats(many).memory_bytes - world_stats(few).memory_bytes;
        TEST_ASSERT_TRUE_MESSAGE(more < (uint64_t)MANY * MOST_BYTES, "bytes per lone particle");
        OK(pbmpm_world_destroy(few));
        OK(pbmpm_world_destroy(many));
    }
}

static void test_what_touches_is_in_the_grid(void)
{
    static const float positions[] = {0, 0, 0, 0.1f, 0.1f, 0, 1.5f, 0, 0}; /* two together, and one by itself */
    for (int k = 0; k < SOLVERS; k++) {
        const pbmpm_world_def def = default_world(3, 0.1f, 10);
        const pbmpm_world_id world = create_world(&def);
        pbmpm_particles_def particles;
        set_solver(world, solvers[k]);
        OK(pbmpm_particles_def_init(&particles, sizeof particles));
        particles.count = 3;
        particles.material = create_material(world, PBMPM_LIQUID);
        particles.positions = positions;
        OK(pbmpm_particles_add(world, &particles, NULL));
        step(world, 1);
        const pbmpm_stats stats = world_stats(world);
        TEST_ASSERT_TRUE(stats.particle_blocks == 1 || stats.particle_blocks == 2);
        TEST_ASSERT_TRUE(stats.node_blocks <= 8);
        OK(pbmpm_world_destroy(world));
    }
}

/* ---- what they do ---- */

/* By particle, whatever their order: row `index of the identifier` of `out`. */
static void read_field(pbmpm_world_id world, pbmpm_field field, float *out)
{
    const pbmpm_view values = view_of(world, field), ids = view_of(world, PBMPM_PARTICLE);
    for (uint32_t row = 0; row < values.count; row++)
        for (uint32_t c = 0; c < values.components; c++) out[view_uint(&ids, row, 0) * values.components + c] = view_float(&values, row, c);
}

/* Gradients that do not shrink: nothing has to press against them. */
static void stir(pbmpm_world_id world, int32_t dimension)
{
    static float affine[9 * SPRAY];
    uint32_t random = 99;
    const uint32_t d = (uint32_t)dimension;
    for (uint32_t i = 0; i < SPRAY; i++)
        for (uint32_t c = 0; c < d * d; c++) affine[i * d * d + c] = c % (d + 1) ? random_float(&random, -3.0f, 3.0f) : random_float(&random, 0.0f, 1.0f);
    OK(pbmpm_particles_set(world, PBMPM_AFFINE_VELOCITY, NULL, SPRAY, affine));
}

static void expect_near(pbmpm_world_id flying, pbmpm_world_id reference, pbmpm_field field, double most)
{
    static float a[9 * SPRAY], b[9 * SPRAY];
    const uint32_t components = view_of(flying, field).components;
    read_field(flying, field, a);
    read_field(reference, field, b);
    for (uint32_t i = 0; i < SPRAY * components; i++) TEST_ASSERT_DOUBLE_WITHIN(most, (double)b[i], (double)a[i]);
}

/* The transfers of the grid round a way of `way` cells to eight times its last bit or so; velocities and gradients add that up. */
static void test_flight_is_what_the_grid_gives(void)
{
    const double dt = 1.0 / 60, way = 15.0 * dt / 0.1, rounding = 8.0 * (double)FLT_EPSILON * way * STEPS;
    for (int32_t dimension = 2; dimension <= 3; dimension++)
        for (int k = 0; k < 2 * SOLVERS; k++) {
            const pbmpm_world_id flying = spray_world(dimension, solvers[k / 2], SPRAY, 1), reference = spray_world(dimension, solvers[k / 2], SPRAY, 1);
            keep_in_grid(reference);
            stir(flying, dimension);
            stir(reference, dimension);
            if (k % 2) {
                set_sleeping(flying);
                set_sleeping(reference);
            }
            step(flying, STEPS);
            step(reference, STEPS);
            TEST_ASSERT_EQUAL_UINT32(0, world_stats(flying).particle_blocks);
            TEST_ASSERT_TRUE(world_stats(reference).particle_blocks > SPRAY / 2);
            expect_near(flying, reference, PBMPM_POSITION, rounding * 0.1 * STEPS);
            expect_near(flying, reference, PBMPM_VELOCITY, rounding * 0.1 / dt);
            expect_near(flying, reference, PBMPM_AFFINE_VELOCITY, rounding / dt);
            expect_near(flying, reference, PBMPM_VOLUME_RATIO, rounding * STEPS);
            TEST_ASSERT_EQUAL_FLOAT(world_stats(reference).cell_changes, world_stats(flying).cell_changes);
            OK(pbmpm_world_destroy(flying));
            OK(pbmpm_world_destroy(reference));
        }
}

static void test_flight_is_the_same_for_any_number_of_threads(void)
{
    enum { MANY = 3500 };
    for (int k = 0; k < SOLVERS; k++) {
        const pbmpm_world_id one = spray_world(3, solvers[k], MANY, 1), several = spray_world(3, solvers[k], MANY, 3);
        step(one, 5);
        step(several, 5);
        TEST_ASSERT_EQUAL_UINT64(world_hash(one), world_hash(several));
        OK(pbmpm_world_destroy(one));
        OK(pbmpm_world_destroy(several));
    }
}

/* ---- what they meet ---- */

static void test_spray_lands_on_an_obstacle(void)
{
    for (int k = 0; k < SOLVERS; k++) {
        const pbmpm_world_id world = spray_world(3, solvers[k], SPRAY, 1);
        create_collider(world, plane_shape(0, -3.0f, 0, 0, 1, 0), false);
        step(world, 1);
        TEST_ASSERT_EQUAL_UINT32(0, world_stats(world).particle_blocks);
        step(world, 119);
        const pbmpm_view positions = view_of(world, PBMPM_POSITION);
        for (uint32_t row = 0; row < SPRAY; row++) TEST_ASSERT_TRUE(view_float(&positions, row, 1) >= -3.01f);
        TEST_ASSERT_TRUE(world_stats(world).particle_blocks > 0);
        OK(pbmpm_world_destroy(world));
    }
}

static void test_kill_bounds_and_drains_take_what_flies(void)
{
    for (int k = 0; k < SOLVERS; k++) {
        const pbmpm_world_id killing = spray_world(3, solvers[k], SPRAY, 1), draining = spray_world(3, solvers[k], SPRAY, 1);
        pbmpm_kill_bounds bounds;
        pbmpm_event event = {0};
        OK(pbmpm_kill_bounds_init(&bounds, sizeof bounds));
        bounds.enabled = 1;
        for (int a = 0; a < 3; a++) {
            bounds.low[a] = -100;
            bounds.high[a] = 100;
        }
        bounds.low[1] = -2.0f;
        OK(pbmpm_world_set_kill_bounds(killing, &bounds));
        create_drain(draining, box_shape(0, -12, 0, 100, 10, 100));
        uint64_t told = 0;
        for (int i = 0; i < 120; i++) {
            step(killing, 1);
            if (world_events_of(killing, PBMPM_EVENT_KILLED, &event)) told += event.count;
        }
        step(draining, 120);
        TEST_ASSERT_EQUAL_UINT32(0, world_count(killing));
        TEST_ASSERT_EQUAL_UINT32(0, world_count(draining));
        TEST_ASSERT_EQUAL_UINT64(SPRAY, told);
        OK(pbmpm_world_destroy(killing));
        OK(pbmpm_world_destroy(draining));
    }
}

static void test_guards_hold_in_flight(void)
{
    const pbmpm_world_id world = spray_world(3, PBMPM_SOLVER_CONVERGENT, SPRAY, 1);
    pbmpm_settings settings = {.size = sizeof settings};
    pbmpm_event event = {0};
    OK(pbmpm_world_get_settings(world, &settings));
    settings.max_displacement = 0.5f;
    OK(pbmpm_world_set_settings(world, &settings));
    step(world, 1);
    TEST_ASSERT_EQUAL_UINT32(1, world_events_of(world, PBMPM_EVENT_SPEED_CLAMPED, &event));
    TEST_ASSERT_EQUAL_UINT32(SPRAY, event.count);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.5f, world_stats(world).max_displacement);
    TEST_ASSERT_FLOAT_WITHIN(1e-2f, 0.5f * 0.1f * 60, world_stats(world).max_speed);
    static float positions[3 * SPRAY];
    for (int i = 0; i < SPRAY; i++) {
        positions[3 * i] = (float)i;
        positions[3 * i + 1] = -0.1f * (float)(PBMPM_MAX_CELL - 16);
    }
    OK(pbmpm_particles_set(world, PBMPM_POSITION, NULL, SPRAY, positions));
    step(world, 60);
    TEST_ASSERT_EQUAL_UINT32(0, world_count(world));
    TEST_ASSERT_EQUAL_UINT64(SPRAY, world_stats(world).deleted_total);
}

/* Who flies looks out for obstacles that come from any side: a wide one that passes where it is takes it along, and it is in the grid. */
static void test_obstacles_that_come_meet_what_flies(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++)
        for (int side = 0; side < 2 * dimension; side++) {
            const float dt = 1.0f / 60, toward = side % 2 ? -1.0f : 1.0f, still[3] = {0};
            const pbmpm_world_def def = default_world(dimension, 0.1f, 4);
            const pbmpm_world_id world = create_world(&def);
            const int axis = side / 2;
            float half[3] = {0.5f, 0.5f, 0.5f}, from[3] = {0}, to[3] = {0};
            pbmpm_particles_def particles;
            half[axis] = 0.1f;
            from[axis] = -toward * 1.2f;
            to[axis] = -toward * 0.05f; /* its face passes by 0.05 m */
            OK(pbmpm_particles_def_init(&particles, sizeof particles));
            particles.material = create_material(world, PBMPM_LIQUID);
            particles.positions = still;
            particles.count = 1;
            OK(pbmpm_particles_add(world, &particles, NULL));
            const pbmpm_collider_id paddle = create_collider(world, box_shape(from[0], from[1], from[2], half[0], half[1], half[2]), true);
            OK(pbmpm_world_step(world, dt));
            TEST_ASSERT_EQUAL_UINT32(0, world_stats(world).particle_blocks); /* 11 cells away it flies */
            OK(pbmpm_collider_move(world, paddle, to, NULL));
            OK(pbmpm_world_step(world, dt));
            TEST_ASSERT_EQUAL_UINT32(1, world_stats(world).particle_blocks);
            const pbmpm_view x = view_of(world, PBMPM_POSITION);
            TEST_ASSERT_TRUE(toward * view_float(&x, 0, (uint32_t)axis) > 0.04f);
            OK(pbmpm_world_destroy(world));
        }
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_lone_particles_take_no_blocks);
    RUN_TEST(test_lone_particles_take_little_memory);
    RUN_TEST(test_what_touches_is_in_the_grid);
    RUN_TEST(test_flight_is_what_the_grid_gives);
    RUN_TEST(test_flight_is_the_same_for_any_number_of_threads);
    RUN_TEST(test_spray_lands_on_an_obstacle);
    RUN_TEST(test_kill_bounds_and_drains_take_what_flies);
    RUN_TEST(test_guards_hold_in_flight);
    RUN_TEST(test_obstacles_that_come_meet_what_flies);
    return UNITY_END();
}

/* Statistics and events: each public call of stats.h keeps its word. */
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

/* ---- statistics ---- */

static void test_before_the_first_step_times_are_zero(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const pbmpm_stats stats = world_stats(world);
    TEST_ASSERT_EQUAL_UINT32(world_count(world), stats.particle_count);
    TEST_ASSERT_EQUAL_UINT64(0, stats.step_count);
    TEST_ASSERT_TRUE(stats.simulated_seconds == 0.0);
    TEST_ASSERT_TRUE(stats.memory_bytes > 0);
    TEST_ASSERT_TRUE(stats.ms_total == 0.0f && stats.ms_sort == 0.0f && stats.ms_iterate == 0.0f);
    TEST_ASSERT_TRUE(stats.mass > 0 && stats.potential_energy > 0); /* the state is the present one */
    TEST_ASSERT_EQUAL_UINT64(0, stats.deleted_total);
    TEST_ASSERT_EQUAL_UINT64(0, stats.clamped_total);
    TEST_ASSERT_EQUAL_UINT32(0, stats.iterations_used);
    TEST_ASSERT_TRUE(stats.residual == 0.0f && stats.predicted_error == 0.0f);
}

/* The statistics of a tank of liquid after a step with this solver and 7 iterations. */
static pbmpm_stats stats_of_solver(pbmpm_solver solver)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    pbmpm_settings settings = {.size = sizeof settings};
    OK(pbmpm_world_get_settings(world, &settings));
    settings.solver = solver;
    settings.iterations = 7;
    OK(pbmpm_world_set_settings(world, &settings));
    OK(pbmpm_world_step(world, 0.002f));
    const pbmpm_stats stats = world_stats(world);
    OK(pbmpm_world_destroy(world));
    return stats;
}

static void test_the_solver_tells_what_it_did(void)
{
    const pbmpm_stats paper = stats_of_solver(PBMPM_SOLVER_PAPER);
    TEST_ASSERT_EQUAL_INT(PBMPM_SOLVER_PAPER, paper.solver);
    TEST_ASSERT_EQUAL_INT(PBMPM_STOP_ITERATIONS, paper.stop);
    TEST_ASSERT_EQUAL_UINT32(7, paper.iterations_used);
    TEST_ASSERT_TRUE(paper.residual == 0.0f && paper.predicted_error == 0.0f);
    TEST_ASSERT_EQUAL_INT(PBMPM_SOLVER_DUAL, stats_of_solver(PBMPM_SOLVER_CONVERGENT).solver); /* the tank holds liquid */
}

/* The sums in the statistics are those over the views; the affine part of the angular momentum is that of quadratic
 * B-splines, m dx^2/4 times the spin. */
static void check_sums(const scene *plan)
{
    const stage made = plan->build(NULL, NULL);
    pbmpm_settings settings = {.size = sizeof settings};
    scene_run(plan, &made, 0, 20);
    OK(pbmpm_world_get_settings(made.world, &settings));
    pbmpm_world_def def = {.size = sizeof def};
    OK(pbmpm_world_get_def(made.world, &def));
    const pbmpm_stats stats = world_stats(made.world);
    const pbmpm_view x = view_of(made.world, PBMPM_POSITION), v = view_of(made.world, PBMPM_VELOCITY);
    const pbmpm_view c = view_of(made.world, PBMPM_AFFINE_VELOCITY), m = view_of(made.world, PBMPM_MASS);
    const pbmpm_view ratio = view_of(made.world, PBMPM_VOLUME_RATIO);
    const uint32_t d = x.components;
    const double inertia = (double)def.cell_size * (double)def.cell_size / 4;
    double mass = 0, momentum[3] = {0}, spin[3] = {0}, kinetic = 0, potential = 0, square = 0, worst = 0, fastest = 0;
    for (uint32_t i = 0; i < x.count; i++) {
        const double w = (double)view_float(&m, i, 0), error = fabs((double)view_float(&ratio, i, 0) - 1);
        double p[3] = {0}, u[3] = {0}, speed = 0;
        for (uint32_t a = 0; a < d; a++) {
            p[a] = (double)view_float(&x, i, a);
            u[a] = (double)view_float(&v, i, a);
            speed += u[a] * u[a];
            momentum[a] += w * u[a];
            potential -= w * (double)settings.gravity[a] * p[a];
        }
        for (uint32_t a = 0; a < 3; a++) {
            const uint32_t one = (a + 1) % 3, two = (a + 2) % 3;
            spin[a] += w * (p[one] * u[two] - p[two] * u[one]);
            if (one < d && two < d)
                spin[a] += w * inertia * ((double)view_float(&c, i, two * d + one) - (double)view_float(&c, i, one * d + two));
        }
        mass += w;
        kinetic += w * speed / 2;
        square += error * error;
        worst = fmax(worst, error);
        fastest = fmax(fastest, sqrt(speed));
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * mass, mass, stats.mass);
    for (uint32_t a = 0; a < d; a++)
        TEST_ASSERT_DOUBLE_WITHIN(1e-5 * (fabs(momentum[a]) + mass * 0.01), momentum[a], stats.momentum[a]);
    for (uint32_t a = d == 2 ? 2 : 0; a < 3; a++)
        TEST_ASSERT_DOUBLE_WITHIN(1e-4 * (fabs(spin[a]) + mass * 0.01), spin[a], stats.angular_momentum[a]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5 * kinetic, kinetic, stats.kinetic_energy);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5 * (fabs(potential) + mass * 0.01), potential, stats.potential_energy);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f + 1e-3f * (float)worst, (float)worst, stats.volume_error_max);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f + 1e-3f * (float)worst, (float)sqrt(square / x.count), stats.volume_error_rms);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f * (float)fastest, (float)fastest, stats.max_speed);
    OK(pbmpm_world_destroy(made.world));
}

static void test_sums_agree_with_the_views(void)
{
    for (int i = 0; i < scene_count; i++)
        check_sums(&scenes[i]);
}

/* What a step leaves behind comes without the pass, and is the same; what takes a pass is 0. */
static void test_figures_of_the_step_alone(void)
{
    for (int i = 0; i < scene_count; i++) {
        const stage made = scenes[i].build(NULL, NULL);
        scene_run(&scenes[i], &made, 0, 5);
        pbmpm_stats step = {.size = sizeof step}, all = world_stats(made.world);
        OK(pbmpm_world_get_step_stats(made.world, &step));
        TEST_ASSERT_TRUE(all.mass > 0.0 && all.lane_occupancy > 0.0f && all.max_speed > 0.0f);
        all.volume_error_rms = all.volume_error_max = all.max_speed = all.lane_occupancy = 0.0f;
        all.mass = all.kinetic_energy = all.potential_energy = 0.0;
        memset(all.momentum, 0, sizeof all.momentum);
        memset(all.angular_momentum, 0, sizeof all.angular_momentum);
        TEST_ASSERT_EQUAL_MEMORY(&all, &step, sizeof all);
        OK(pbmpm_world_destroy(made.world));
    }
}

static void with_threads(pbmpm_world_def *def, void *user) { def->thread_count = *(const int32_t *)user; }

/* 64 x 2048 particles are the most whose parts are of the least size: more, and parts grow. */
static pbmpm_stats stats_with_threads(uint32_t particles, int32_t threads)
{
    uint32_t seed = 7;
    static float positions[3 * 200000], velocities[3 * 200000];
    pbmpm_world_def def = default_world(3, 0.1f, particles);
    with_threads(&def, &threads);
    const pbmpm_world_id world = create_world(&def);
    pbmpm_particles_def added;
    OK(pbmpm_particles_def_init(&added, sizeof added));
    added.material = create_material(world, PBMPM_LIQUID);
    added.count = particles;
    added.positions = positions;
    added.velocities = velocities;
    for (uint32_t i = 0; i < 3 * particles; i++) {
        positions[i] = random_float(&seed, 0.0f, 5.0f);
        velocities[i] = random_float(&seed, -2.0f, 2.0f);
    }
    set_gravity(world, 0, -10, 0);
    OK(pbmpm_particles_add(world, &added, NULL));
    const pbmpm_stats stats = world_stats(world);
    OK(pbmpm_world_destroy(world));
    return stats;
}

static void test_sums_do_not_depend_on_the_number_of_threads(void)
{
    static const uint32_t counts[] = {1, 2048, 2049, 10000, 64 * 2048, 64 * 2048 + 1, 200000};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        pbmpm_stats one = stats_with_threads(counts[i], 1), three = stats_with_threads(counts[i], 3);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * one.mass, counts[i] * 1000.0 * 1.25e-4, one.mass); /* each counts once */
        one.thread_count = three.thread_count;
        one.memory_bytes = three.memory_bytes;
        TEST_ASSERT_EQUAL_MEMORY(&one, &three, sizeof one);
    }
}

static void test_counts_and_shares_are_in_range(void)
{
    for (int i = 0; i < scene_count; i++) {
        const stage made = scenes[i].build(NULL, NULL);
        scene_run(&scenes[i], &made, 0, 10);
        const pbmpm_stats stats = world_stats(made.world);
        const uint32_t blocks_touched = scenes[i].dimension == 2 ? 9 : 27;
        TEST_ASSERT_EQUAL_UINT32(world_count(made.world), stats.particle_count);
        TEST_ASSERT_EQUAL_UINT64(10, stats.step_count);
        TEST_ASSERT_TRUE(stats.particle_blocks > 0 && stats.particle_blocks <= stats.particle_count);
        TEST_ASSERT_TRUE(stats.node_blocks >= stats.particle_blocks);
        TEST_ASSERT_TRUE(stats.node_blocks <= blocks_touched * stats.particle_blocks);
        TEST_ASSERT_TRUE(stats.thread_count >= 1);
        TEST_ASSERT_TRUE(stats.cell_changes >= 0.0f && stats.cell_changes <= 1.0f);
        TEST_ASSERT_TRUE(stats.lane_occupancy > 0.0f && stats.lane_occupancy <= 1.0f);
        TEST_ASSERT_TRUE(stats.max_displacement >= 0.0f && stats.max_displacement <= 32.01f);
        TEST_ASSERT_TRUE(stats.ms_sort >= 0 && stats.ms_scatter >= 0 && stats.ms_contacts >= 0 && stats.ms_iterate >= 0);
        TEST_ASSERT_TRUE(stats.ms_integrate >= 0 && stats.ms_total > 0);
        const float parts = stats.ms_sort + stats.ms_scatter + stats.ms_contacts + stats.ms_iterate + stats.ms_integrate;
        TEST_ASSERT_TRUE(parts <= stats.ms_total * 1.001f + 0.001f);
        OK(pbmpm_world_destroy(made.world));
    }
}

static void use_ledger(pbmpm_world_def *def, void *user)
{
    def->allocator = ledger_allocator(user);
}

static void test_memory_is_what_the_allocator_gave(void)
{
    static ledger book;
    book = (ledger){0};
    const pbmpm_world_id world = tank_2d(use_ledger, &book);
    TEST_ASSERT_EQUAL_UINT64(book.live_bytes, world_stats(world).memory_bytes);
    OK(pbmpm_world_step(world, 0.01f));
    TEST_ASSERT_EQUAL_UINT64(book.live_bytes, world_stats(world).memory_bytes);
    OK(pbmpm_world_destroy(world));
    ledger_expect_clean(&book, "tank");
}

/* ---- events ---- */

static pbmpm_world_id lone_particle(pbmpm_material_def material, float cell_size, float x, float speed, pbmpm_particle_id *id)
{
    const pbmpm_world_def def = default_world(2, cell_size, 16);
    const pbmpm_world_id world = create_world(&def);
    const float position[2] = {x, 0.5f}, velocity[2] = {speed, 0};
    pbmpm_particles_def particles;
    OK(pbmpm_particles_def_init(&particles, sizeof particles));
    OK(pbmpm_material_create(world, &material, &particles.material));
    particles.count = 1;
    particles.positions = position;
    particles.velocities = velocity;
    OK(pbmpm_particles_add(world, &particles, id));
    return world;
}

static void test_slowed_particles_are_told(void)
{
    pbmpm_particle_id id;
    pbmpm_event event = {0};
    const pbmpm_world_id world = lone_particle(default_material(PBMPM_LIQUID), 0.1f, 0, 1000, &id);
    OK(pbmpm_world_step(world, 0.01f)); /* 100 cells, 32 are allowed */
    TEST_ASSERT_EQUAL_UINT32(1, world_events_of(world, PBMPM_EVENT_SPEED_CLAMPED, &event));
    TEST_ASSERT_EQUAL_UINT32(1, event.count);
    TEST_ASSERT_EQUAL_MEMORY(&id, &event.particle, sizeof id);
    TEST_ASSERT_EQUAL_UINT64(1, world_stats(world).clamped_total);
    const pbmpm_view position = view_of(world, PBMPM_POSITION), velocity = view_of(world, PBMPM_VELOCITY);
    TEST_ASSERT_FLOAT_WITHIN(0.01f, 3.2f, view_float(&position, 0, 0));
    TEST_ASSERT_FLOAT_WITHIN(1.0f, 320.0f, view_float(&velocity, 0, 0));
    pbmpm_settings settings = default_settings();
    settings.max_displacement = PBMPM_MAX_CELLS_PER_SUBSTEP;
    OK(pbmpm_world_set_settings(world, &settings));
    OK(pbmpm_world_step(world, 0.01f));
    TEST_ASSERT_EQUAL_UINT32(0, world_events_of(world, PBMPM_EVENT_SPEED_CLAMPED, NULL)); /* only the last step's */
    TEST_ASSERT_EQUAL_UINT64(1, world_stats(world).clamped_total);
}

static void test_particles_out_of_range_are_deleted_and_told(void)
{
    pbmpm_particle_id id;
    pbmpm_event event = {0};
    uint32_t row;
    const pbmpm_world_id world = lone_particle(default_material(PBMPM_LIQUID), 1, (float)(PBMPM_MAX_CELL - 8), 10, &id);
    int steps = 0;
    while (world_count(world) == 1 && steps < 20) {
        OK(pbmpm_world_step(world, 1.0f));
        steps++;
    }
    TEST_ASSERT_EQUAL_UINT32(0, world_count(world));
    TEST_ASSERT_EQUAL_UINT32(1, world_events_of(world, PBMPM_EVENT_DELETED_OUT_OF_RANGE, &event));
    TEST_ASSERT_EQUAL_UINT32(1, event.count);
    TEST_ASSERT_EQUAL_MEMORY(&id, &event.particle, sizeof id);
    TEST_ASSERT_TRUE(event.position[0] >= (float)(PBMPM_MAX_CELL - 8));
    TEST_ASSERT_EQUAL_UINT64(1, world_stats(world).deleted_total);
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_particles_find(world, &id, 1, &row));
    OK(pbmpm_world_step(world, 1.0f));
    TEST_ASSERT_EQUAL_UINT32(0, world_events_of(world, PBMPM_EVENT_DELETED_OUT_OF_RANGE, NULL));
}

static void test_overstrained_particles_are_deleted_and_told(void)
{
    pbmpm_material_def material = default_material(PBMPM_ELASTIC);
    pbmpm_particle_id id;
    pbmpm_event event = {0};
    material.strain_policy = PBMPM_STRAIN_DELETE;
    material.condition_max = 100;
    const float strained[4] = {1000, 0, 0, 0.001f};
    const pbmpm_world_id world = lone_particle(material, 0.1f, 0, 0, &id);
    OK(pbmpm_particles_set(world, PBMPM_DEFORMATION, &id, 1, strained));
    OK(pbmpm_world_step(world, 0.001f));
    TEST_ASSERT_EQUAL_UINT32(0, world_count(world));
    TEST_ASSERT_EQUAL_UINT32(1, world_events_of(world, PBMPM_EVENT_DELETED_CONDITION, &event));
    TEST_ASSERT_EQUAL_MEMORY(&id, &event.particle, sizeof id);
    TEST_ASSERT_EQUAL_UINT64(1, world_stats(world).deleted_total);
}

/* A velocity gradient so large that sums overflow may cost particles, but each loss is told and the rest stays sound. */
static void test_overflowing_gradients_do_not_spread(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const uint32_t before = world_count(world);
    const float wild[4] = {3e38f, -3e38f, 3e38f, 3e38f};
    const pbmpm_view identity = view_of(world, PBMPM_PARTICLE);
    const pbmpm_particle_id id = {view_uint(&identity, 0, 0), view_uint(&identity, 0, 1)};
    const pbmpm_result result = pbmpm_particles_set(world, PBMPM_AFFINE_VELOCITY, &id, 1, wild);
    TEST_ASSERT_TRUE(result == PBMPM_OK || result == PBMPM_ERROR_INVALID_ARGUMENT);
    for (int i = 0; i < 10; i++)
        OK(pbmpm_world_step(world, 0.01f));
    world_expect_finite(world, "after a wild gradient");
    const pbmpm_stats stats = world_stats(world);
    TEST_ASSERT_EQUAL_UINT64(before, world_count(world) + stats.deleted_total);
    TEST_ASSERT_TRUE(stats.deleted_total <= 64);
}

/* More events than the array holds: the rest is counted. */
static void test_events_that_did_not_fit_are_counted(void)
{
    const pbmpm_world_def def = default_world(2, 0.1f, 60000);
    const pbmpm_world_id world = create_world(&def);
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    const uint32_t added = fill_shape(world, water, box_shape(0, 0, 0, 5, 5, 5), (const float[3]){1000, 0, 0});
    pbmpm_event events[PBMPM_MAX_EVENTS] = {{.size = sizeof *events}};
    uint32_t count = 0, missed = 0, told = 0;
    OK(pbmpm_world_step(world, 0.01f));
    OK(pbmpm_world_events(world, events, PBMPM_MAX_EVENTS, &count, &missed));
    for (uint32_t i = 0; i < count; i++) {
        TEST_ASSERT_EQUAL_INT(PBMPM_EVENT_SPEED_CLAMPED, events[i].kind);
        told += events[i].count;
    }
    TEST_ASSERT_TRUE(added > 30000);
    TEST_ASSERT_EQUAL_UINT64(added, world_stats(world).clamped_total);
    TEST_ASSERT_EQUAL_UINT32(added, told + missed);
}

/* Offers a world of one particle more of them than it has room for: one event each time. */
static void refuse_particles(pbmpm_world_id world, uint32_t times)
{
    static const float positions[2 * 64];
    pbmpm_particles_def def;
    OK(pbmpm_particles_def_init(&def, sizeof def));
    def.material = create_material(world, PBMPM_LIQUID);
    def.positions = positions;
    for (uint32_t i = 0; i < times; i++) {
        def.count = 2 + i % 62;
        EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_particles_add(world, &def, NULL));
    }
}

/* The caller's array may be shorter than what the world keeps, or none. */
static void test_events_are_copied_as_far_as_there_is_room(void)
{
    enum { TOLD = 5, ROOM = 2 };
    const pbmpm_world_def def = default_world(2, 0.1f, 1);
    const pbmpm_world_id world = create_world(&def);
    pbmpm_event all[TOLD + 1] = {{.size = sizeof *all}}, few[ROOM + 1];
    uint32_t count = 0, missed = 9;
    refuse_particles(world, TOLD);
    OK(pbmpm_world_events(world, all, TOLD + 1, &count, &missed));
    TEST_ASSERT_EQUAL_UINT32(TOLD, count);
    TEST_ASSERT_EQUAL_UINT32(0, missed);
    for (uint32_t i = 0; i < TOLD; i++) {
        TEST_ASSERT_EQUAL_UINT32(sizeof *all, all[i].size);
        TEST_ASSERT_EQUAL_INT(PBMPM_EVENT_CAPACITY, all[i].kind);
        TEST_ASSERT_EQUAL_UINT32(2 + i, all[i].count);
    }
    memset(few, 0xA5, sizeof few);
    few[0].size = sizeof *few;
    OK(pbmpm_world_events(world, few, ROOM, &count, NULL));
    TEST_ASSERT_EQUAL_UINT32(TOLD, count);
    TEST_ASSERT_EQUAL_MEMORY(all, few, ROOM * sizeof *few);
    TEST_ASSERT_EACH_EQUAL_HEX8(0xA5, &few[ROOM], sizeof *few);
    count = 0;
    OK(pbmpm_world_events(world, NULL, 0, &count, NULL));
    TEST_ASSERT_EQUAL_UINT32(TOLD, count);
}

static void test_a_world_keeps_so_many_events(void)
{
    static pbmpm_event events[PBMPM_MAX_EVENTS + 1];
    const pbmpm_world_def def = default_world(2, 0.1f, 1);
    const pbmpm_world_id world = create_world(&def);
    uint32_t count = 0, missed = 0;
    refuse_particles(world, PBMPM_MAX_EVENTS + 3);
    events[0].size = sizeof *events;
    OK(pbmpm_world_events(world, events, PBMPM_MAX_EVENTS + 1, &count, &missed));
    TEST_ASSERT_EQUAL_UINT32(PBMPM_MAX_EVENTS, count);
    TEST_ASSERT_EQUAL_UINT32(3, missed);
    OK(pbmpm_world_step(world, 0.01f));
    OK(pbmpm_world_events(world, NULL, 0, &count, &missed));
    TEST_ASSERT_EQUAL_UINT32(0, count);
    TEST_ASSERT_EQUAL_UINT32(0, missed);
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_before_the_first_step_times_are_zero);
    RUN_TEST(test_the_solver_tells_what_it_did);
    RUN_TEST(test_sums_agree_with_the_views);
    RUN_TEST(test_figures_of_the_step_alone);
    RUN_TEST(test_sums_do_not_depend_on_the_number_of_threads);
    RUN_TEST(test_counts_and_shares_are_in_range);
    RUN_TEST(test_memory_is_what_the_allocator_gave);
    RUN_TEST(test_slowed_particles_are_told);
    RUN_TEST(test_particles_out_of_range_are_deleted_and_told);
    RUN_TEST(test_overstrained_particles_are_deleted_and_told);
    RUN_TEST(test_overflowing_gradients_do_not_spread);
    RUN_TEST(test_events_that_did_not_fit_are_counted);
    RUN_TEST(test_events_are_copied_as_far_as_there_is_room);
    RUN_TEST(test_a_world_keeps_so_many_events);
    return UNITY_END();
}

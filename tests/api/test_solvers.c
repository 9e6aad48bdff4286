/* All ways to solve a substep: repeatable, changeable between steps, without allocations, ended by the rule that is asked for. */
#include <math.h>
#include <stdio.h>

#include "solvers.h"

void setUp(void)
{
}

void tearDown(void)
{
    pbmpm_shutdown();
}

static const way plain_dual = {"dual", PBMPM_SOLVER_DUAL, PBMPM_PRESSURE_PARTICLES, PBMPM_INTEGRATOR_EULER, 0};

/* ---- Any number of threads ---- */

#ifdef PBMPM_SANITIZED
enum { STEPS = 4 };
#else
enum { STEPS = 24 };
#endif

static void use_threads(pbmpm_world_def *def, void *user)
{
    def->thread_count = *(const int32_t *)user;
}

static uint64_t hash_with(int32_t dimension, const way *chosen, int32_t thread_count)
{
    const stage made = stirred_pool(dimension, chosen, use_threads, &thread_count);
    stirred_pool_run(&made, 0, STEPS);
    const uint64_t hash = world_hash(made.world);
    world_expect_finite(made.world, chosen->name);
    TEST_ASSERT_EQUAL_UINT32(thread_count, world_stats(made.world).thread_count);
    OK(pbmpm_world_destroy(made.world));
    return hash;
}

static void check_threads(int32_t dimension)
{
    for (int w = 0; w < way_count; w++) {
        const uint64_t right = hash_with(dimension, &ways[w], 1);
        TEST_ASSERT_EQUAL_HEX64_MESSAGE(right, hash_with(dimension, &ways[w], 3), ways[w].name);
        TEST_ASSERT_EQUAL_HEX64_MESSAGE(right, hash_with(dimension, &ways[w], 4), ways[w].name);
    }
}

static void test_any_number_of_threads_gives_the_same_hash_in_2d(void)
{
    check_threads(2);
}

static void test_any_number_of_threads_gives_the_same_hash_in_3d(void)
{
    check_threads(3);
}

/* The control: each setting does something. BDF2 gives way to backward Euler where liquid or obstacles push, see below. */
static void test_each_way_is_another(void)
{
    uint64_t hashes[16];
    for (int w = 0; w < way_count; w++) {
        if (ways[w].solver == PBMPM_SOLVER_PRIMAL && ways[w].integrator == PBMPM_INTEGRATOR_BDF2) {
            hashes[w] = 0;
            continue;
        }
        hashes[w] = hash_with(2, &ways[w], 2);
        for (int v = 0; v < w; v++)
            TEST_ASSERT_TRUE_MESSAGE(hashes[v] != hashes[w], ways[w].name);
    }
}

/* ---- The convergent solver ---- */

static uint64_t hash_of_pool(pbmpm_material_kind kind, pbmpm_solver solver, pbmpm_integrator integrator)
{
    const pbmpm_world_def def = default_world(2, 0.05f, 4096);
    const pbmpm_world_id world = create_world(&def);
    const way chosen = {"", solver, PBMPM_PRESSURE_PARTICLES, integrator, 0};
    create_material(world, kind == PBMPM_LIQUID ? PBMPM_ELASTIC : PBMPM_LIQUID); /* a material without particles does not count */
    fill_shape(world, create_material(world, kind), box_shape(0, 0, 0, 0.4f, 0.3f, 0), (const float[3]){0.1f, 0, 0});
    create_collider(world, plane_shape(0, -0.3f, 0, 0.3f, 1, 0), false);
    set_gravity(world, 0, -9.81f, 0);
    set_rate(world, 1, 60);
    use_way(world, &chosen);
    for (int i = 0; i < 20; i++)
        OK(pbmpm_world_step(world, 1.0f / 120));
    const uint64_t hash = world_hash(world);
    OK(pbmpm_world_destroy(world));
    return hash;
}

static void test_the_convergent_solver_is_the_dual_with_liquid_and_else_the_primal(void)
{
    const pbmpm_integrator euler = PBMPM_INTEGRATOR_EULER, bdf2 = PBMPM_INTEGRATOR_BDF2;
    const uint64_t primal = hash_of_pool(PBMPM_ELASTIC, PBMPM_SOLVER_PRIMAL, euler);
    TEST_ASSERT_EQUAL_HEX64(hash_of_pool(PBMPM_LIQUID, PBMPM_SOLVER_DUAL, euler), hash_of_pool(PBMPM_LIQUID, PBMPM_SOLVER_CONVERGENT, euler));
    TEST_ASSERT_EQUAL_HEX64(primal, hash_of_pool(PBMPM_ELASTIC, PBMPM_SOLVER_CONVERGENT, euler));
    TEST_ASSERT_TRUE(primal != hash_of_pool(PBMPM_ELASTIC, PBMPM_SOLVER_DUAL, euler));
    TEST_ASSERT_EQUAL_HEX64(primal, hash_of_pool(PBMPM_ELASTIC, PBMPM_SOLVER_PRIMAL, bdf2)); /* pushed by an obstacle: backward Euler */
}

/* A body that turns and that nothing pushes. */
static uint64_t hash_of_flight(pbmpm_integrator integrator)
{
    enum { COUNT = 256 };
    const pbmpm_world_id world = block_2d(NULL, NULL);
    const way chosen = {"", PBMPM_SOLVER_PRIMAL, PBMPM_PRESSURE_PARTICLES, integrator, 0};
    const pbmpm_view place = view_of(world, PBMPM_POSITION);
    float velocity[2 * COUNT];
    TEST_ASSERT_EQUAL_UINT32(COUNT, place.count);
    for (uint32_t i = 0; i < COUNT; i++) {
        velocity[2 * i] = -3 * view_float(&place, i, 1);
        velocity[2 * i + 1] = 3 * view_float(&place, i, 0);
    }
    OK(pbmpm_particles_set(world, PBMPM_VELOCITY, NULL, COUNT, velocity));
    set_rate(world, 1, 40);
    use_way(world, &chosen);
    for (int i = 0; i < 10; i++)
        OK(pbmpm_world_step(world, 1.0f / 120));
    const uint64_t hash = world_hash(world);
    OK(pbmpm_world_destroy(world));
    return hash;
}

static void test_the_integrator_makes_a_difference_in_flight(void)
{
    TEST_ASSERT_TRUE(hash_of_flight(PBMPM_INTEGRATOR_EULER) != hash_of_flight(PBMPM_INTEGRATOR_BDF2));
}

/* ---- Changes between steps ---- */

/* A step each way in turn, with the length of steps going up and down by up to 20. */
static uint64_t run_changing(int32_t dimension, int32_t thread_count)
{
    static const float lengths[] = {1.0f / 120, 1.0f / 600, 1.0f / 30, 1.0f / 240, 1.0f / 60, 1.0f / 400, 1.0f / 120};
    const stage made = stirred_pool(dimension, &plain_dual, use_threads, &thread_count);
    const pbmpm_stats first = world_stats(made.world);
    for (int step = 0; step < 3 * way_count * (STEPS / 8 + 1) / 2; step++) {
        char label[64];
        const way *chosen = &ways[step * 4 % way_count];
        snprintf(label, sizeof label, "step %d, %s", step, chosen->name);
        use_way(made.world, chosen);
        set_rate(made.world, chosen->solver == PBMPM_SOLVER_EXPLICIT ? 16 : 1 + step % 3, 1 + step % 5);
        OK(pbmpm_world_step(made.world, lengths[step % 7]));
        const pbmpm_stats now = world_stats(made.world);
        world_expect_finite(made.world, label);
        TEST_ASSERT_EQUAL_UINT32_MESSAGE(first.particle_count, now.particle_count, label);
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-13 * first.mass, first.mass, now.mass, label);
    }
    const uint64_t hash = world_hash(made.world);
    OK(pbmpm_world_destroy(made.world));
    return hash;
}

static void test_everything_may_change_between_steps(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++)
        TEST_ASSERT_EQUAL_HEX64(run_changing(dimension, 1), run_changing(dimension, 3));
}

/* ---- Memory ---- */

static void use_ledger(pbmpm_world_def *def, void *user)
{
    def->allocator = ledger_allocator(user);
}

/* A tank at rest: no new blocks. A second round of all ways needs nothing that the first did not take. */
static void test_a_warm_step_allocates_nothing(void)
{
    static ledger book;
    for (int32_t dimension = 2; dimension <= 3; dimension++) {
        uint64_t calls = 0, releases = 0;
        book = (ledger){0};
        const stage made = stirred_pool(dimension, &plain_dual, use_ledger, &book);
        for (int round = 0; round < 2; round++) {
            calls = book.calls;
            releases = book.releases;
            for (int w = 0; w < way_count; w++) {
                use_way(made.world, &ways[w]);
                for (int step = 0; step < (round ? 2 : 6); step++)
                    OK(pbmpm_world_step(made.world, round ? 1e-6f : 1.0f / 480));
            }
        }
        TEST_ASSERT_EQUAL_UINT64(calls, book.calls);
        TEST_ASSERT_EQUAL_UINT64(releases, book.releases);
        OK(pbmpm_world_destroy(made.world));
        ledger_expect_clean(&book, "all ways");
    }
}

/* Each allocation refused in turn: the step says so, the world lives on, and the step after it succeeds. */
static void test_refused_memory_is_reported_and_forgiven(void)
{
    enum { MOST_ALLOCATIONS = 512 }; /* more than any first step of several groups of islands makes: ends the loop of a step that never succeeds */
    static ledger book;
    for (int w = 0; w < way_count; w++)
        for (uint64_t nth = 1; nth < MOST_ALLOCATIONS; nth++) {
            book = (ledger){0};
            const stage made = stirred_pool(2, &ways[w], use_ledger, &book);
            const uint32_t count = world_count(made.world);
            book.fail_at = book.calls + nth;
            const pbmpm_result result = pbmpm_world_step(made.world, 1.0f / 240);
            if (book.failures == 0)
                OK(result);
            else
                EXPECT(PBMPM_ERROR_OUT_OF_MEMORY, result);
            TEST_ASSERT_EQUAL_UINT32(count, world_count(made.world));
            OK(pbmpm_world_step(made.world, 1.0f / 240));
            world_expect_finite(made.world, ways[w].name);
            OK(pbmpm_world_destroy(made.world));
            ledger_expect_clean(&book, ways[w].name);
            if (book.failures == 0)
                break;
            TEST_ASSERT_TRUE_MESSAGE(nth + 1 < MOST_ALLOCATIONS, ways[w].name);
        }
}

/* ---- Stop rules ---- */

typedef struct rules {
    int32_t iterations;
    float target_error, time_budget_ms;
} rules;

static pbmpm_stats stats_under(const way *chosen, rules given)
{
    const stage made = stirred_pool(2, chosen, NULL, NULL);
    pbmpm_settings settings = {.size = sizeof settings};
    OK(pbmpm_world_get_settings(made.world, &settings));
    settings.substeps = 1;
    settings.iterations = given.iterations;
    settings.target_error = given.target_error;
    settings.time_budget_ms = given.time_budget_ms;
    OK(pbmpm_world_set_settings(made.world, &settings));
    for (int i = 0; i < 3; i++)
        OK(pbmpm_world_step(made.world, 1.0f / 120));
    const pbmpm_stats stats = world_stats(made.world);
    OK(pbmpm_world_destroy(made.world));
    return stats;
}

static bool iterates_freely(const way *chosen)
{
    return chosen->solver == PBMPM_SOLVER_DUAL || chosen->solver == PBMPM_SOLVER_PRIMAL;
}

static void test_without_other_rules_all_iterations_are_done(void)
{
    for (int w = 0; w < way_count; w++) {
        const pbmpm_stats stats = stats_under(&ways[w], (rules){.iterations = 13});
        TEST_ASSERT_EQUAL_INT_MESSAGE(PBMPM_STOP_ITERATIONS, stats.stop, ways[w].name);
        if (!iterates_freely(&ways[w]))
            continue;
        TEST_ASSERT_TRUE_MESSAGE(stats.iterations_used <= 13 && stats.iterations_used >= 1, ways[w].name);
        TEST_ASSERT_TRUE_MESSAGE(stats.residual > 0 && stats.predicted_error > 0, ways[w].name);
        if (ways[w].solver == PBMPM_SOLVER_DUAL)
            TEST_ASSERT_EQUAL_UINT32_MESSAGE(13, stats.iterations_used, ways[w].name);
    }
}

static void test_a_target_error_ends_the_iterations(void)
{
    for (int w = 0; w < way_count; w++) {
        if (!iterates_freely(&ways[w]))
            continue;
        const pbmpm_stats all = stats_under(&ways[w], (rules){.iterations = 200});
        const pbmpm_stats loose = stats_under(&ways[w], (rules){.iterations = 200, .target_error = 0.1f});
        const pbmpm_stats strict = stats_under(&ways[w], (rules){.iterations = 200, .target_error = 1e-12f});
        TEST_ASSERT_EQUAL_INT_MESSAGE(PBMPM_STOP_ERROR, loose.stop, ways[w].name);
        TEST_ASSERT_TRUE_MESSAGE(loose.predicted_error < 0.1f && loose.iterations_used < all.iterations_used, ways[w].name);
        TEST_ASSERT_EQUAL_INT_MESSAGE(PBMPM_STOP_ITERATIONS, strict.stop, ways[w].name);
        TEST_ASSERT_EQUAL_UINT32_MESSAGE(all.iterations_used, strict.iterations_used, ways[w].name);
    }
}

/* A target met by the first iteration but not before it, and one that is met exactly where the error falls below it. */
static void test_no_iteration_is_done_beyond_the_target(void)
{
    for (int32_t iterations = 1; iterations <= 30; iterations++) {
        const pbmpm_stats plain = stats_under(&plain_dual, (rules){.iterations = iterations});
        const rules given = {.iterations = iterations, .target_error = 0.5f * plain.predicted_error};
        const pbmpm_stats same = stats_under(&plain_dual, given);
        TEST_ASSERT_TRUE(same.stop == PBMPM_STOP_ERROR ? same.predicted_error < given.target_error
                                                       : same.iterations_used == (uint32_t)iterations);
    }
}

static void test_a_time_budget_ends_the_iterations(void)
{
    for (int w = 0; w < way_count; w++) {
        if (!iterates_freely(&ways[w]))
            continue;
        const pbmpm_stats hurried = stats_under(&ways[w], (rules){.iterations = 1000, .time_budget_ms = 1e-6f});
        TEST_ASSERT_EQUAL_INT_MESSAGE(PBMPM_STOP_TIME, hurried.stop, ways[w].name);
        TEST_ASSERT_TRUE_MESSAGE(hurried.iterations_used <= 1, ways[w].name);
        const pbmpm_stats patient = stats_under(&ways[w], (rules){.iterations = 4, .time_budget_ms = 1e6f});
        TEST_ASSERT_EQUAL_INT_MESSAGE(PBMPM_STOP_ITERATIONS, patient.stop, ways[w].name);
    }
}

/* More iterations: a smaller residual. A liquid that converges loses a factor of 10 from 10 iterations to 200. */
static void test_the_residual_falls(void)
{
    for (int w = 0; w < way_count; w++) {
        if (ways[w].solver != PBMPM_SOLVER_DUAL)
            continue;
        const pbmpm_stats few = stats_under(&ways[w], (rules){.iterations = 10}), many = stats_under(&ways[w], (rules){.iterations = 200});
        char label[96];
        snprintf(label, sizeof label, "%s: %g after 10, %g after 200", ways[w].name, (double)few.residual, (double)many.residual);
        TEST_ASSERT_TRUE_MESSAGE(many.residual < 0.1f * few.residual, label);
    }
}

/* ---- The explicit solver and liquids ---- */

static const way plain_explicit = {"explicit", PBMPM_SOLVER_EXPLICIT, PBMPM_PRESSURE_PARTICLES, PBMPM_INTEGRATOR_EULER, 0};

static void test_the_explicit_solver_refuses_an_incompressible_liquid(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    use_way(world, &plain_explicit);
    const snapshot before = snapshot_take(world);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_step(world, 1e-4f));
    snapshot_expect_same(&before, world, "refused step");
    use_way(world, &plain_dual);
    OK(pbmpm_world_step(world, 1e-4f));
}

/* Also when a liquid becomes incompressible later. */
static void test_the_explicit_solver_sees_a_changed_liquid(void)
{
    const pbmpm_world_def def = default_world(2, 0.05f, 4096);
    const pbmpm_world_id world = create_world(&def);
    pbmpm_material_def liquid = soft_material(PBMPM_LIQUID);
    pbmpm_material_id material;
    OK(pbmpm_material_create(world, &liquid, &material));
    fill_shape(world, material, box_shape(0, 0, 0, 0.2f, 0.2f, 0), (const float[3]){0, 0, 0});
    use_way(world, &plain_explicit);
    OK(pbmpm_world_step(world, 1e-4f));
    liquid.bulk_modulus = 0;
    OK(pbmpm_material_set(world, material, &liquid));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_step(world, 1e-4f));
    liquid.bulk_modulus = 1e4f;
    OK(pbmpm_material_set(world, material, &liquid));
    OK(pbmpm_world_step(world, 1e-4f));
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_any_number_of_threads_gives_the_same_hash_in_2d);
    RUN_TEST(test_any_number_of_threads_gives_the_same_hash_in_3d);
    RUN_TEST(test_each_way_is_another);
    RUN_TEST(test_the_convergent_solver_is_the_dual_with_liquid_and_else_the_primal);
    RUN_TEST(test_the_integrator_makes_a_difference_in_flight);
    RUN_TEST(test_everything_may_change_between_steps);
    RUN_TEST(test_a_warm_step_allocates_nothing);
    RUN_TEST(test_refused_memory_is_reported_and_forgiven);
    RUN_TEST(test_without_other_rules_all_iterations_are_done);
    RUN_TEST(test_a_target_error_ends_the_iterations);
    RUN_TEST(test_no_iteration_is_done_beyond_the_target);
    RUN_TEST(test_a_time_budget_ends_the_iterations);
    RUN_TEST(test_the_residual_falls);
    RUN_TEST(test_the_explicit_solver_refuses_an_incompressible_liquid);
    RUN_TEST(test_the_explicit_solver_sees_a_changed_liquid);
    return UNITY_END();
}

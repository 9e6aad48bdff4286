/* What a step costs a host's job system: how often it is handed work, with results that do not depend on it. */
#include <stdio.h>

#include "scenes.h"

void setUp(void)
{
}

void tearDown(void)
{
    pbmpm_shutdown();
}

/* ---- A host that counts ---- */

typedef struct host {
    int handed, finished;
    int32_t shares; /* of the last piece of work */
} host;

/* All shares at once, the last one first: the library has to cope with any order. */
static void *host_enqueue(pbmpm_task *task, int32_t count, void *context, void *user)
{
    host *own = user;
    own->handed++;
    own->shares = count;
    for (int32_t i = count - 1; i >= 0; i--)
        task(i, context);
    return own;
}

static void host_finish(void *handle, void *user)
{
    TEST_ASSERT_EQUAL_PTR(user, handle);
    ((host *)user)->finished++;
}

/* ---- A pool of a few thousand particles ---- */

enum { ITERATIONS = 5, WARM_STEPS = 2, THREADS = 4 };

typedef struct pool_plan {
    pbmpm_solver solver;
    float size; /* of the tank [m]: half of it is full, with 8000 particles per cubic metre */
    bool obstacles, floats;
    int32_t substeps;
} pool_plan;

static pbmpm_world_id make_pool(const pool_plan *plan, host *own)
{
    const float size = plan->size, half = size / 2, rest[3] = {0, 0, 0};
    pbmpm_world_def def = default_world(3, 0.1f, (uint32_t)(8000.0f * size * size * size));
    pbmpm_task_hooks hooks;
    def.domain_enabled = 1;
    for (int a = 0; a < 3; a++)
        def.domain_max[a] = size;
    if (own) {
        def.thread_count = THREADS;
        hooks = (pbmpm_task_hooks){sizeof hooks, 0, host_enqueue, host_finish, own};
        def.tasks = &hooks;
    }
    const pbmpm_world_id world = create_world(&def);
    fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(half, half / 2, half, half, half / 2, half), rest);
    if (plan->floats)
        fill_shape(world, create_material(world, PBMPM_ELASTIC), box_shape(half, size * 0.7f, half, 0.2f, 0.15f, 0.2f), rest);
    if (plan->obstacles) {
        create_collider(world, sphere_shape(half, half / 3, half, half / 4), false);
        create_collider(world, box_shape(half / 3, half / 2, half, 0.06f, 0.2f, 0.2f), true);
    }
    set_gravity(world, 0, -9.81f, 0);
    set_rate(world, plan->substeps, ITERATIONS);
    set_solver(world, plan->solver);
    return world;
}

static uint64_t run(pbmpm_world_id world, int steps)
{
    for (int i = 0; i < steps; i++)
        OK(pbmpm_world_step(world, 1.0f / 60));
    return world_hash(world);
}

/* How often a step hands work over, the third one. It does the same as one on the caller alone. */
static int count_joins(const char *name, const pool_plan *plan)
{
    host own = {0};
    char line[128];
    const pbmpm_world_id counted = make_pool(plan, &own), alone = make_pool(plan, NULL);
    run(counted, WARM_STEPS);
    const int before = own.handed;
    const uint64_t hash = run(counted, 1);
    const int joins = own.handed - before;
    snprintf(line, sizeof line, "%s%s, %u particles, %d substeps: %d", name, plan->obstacles ? " among obstacles" : "",
             (unsigned)world_count(counted), (int)plan->substeps, joins);
    TEST_MESSAGE(line);
    TEST_ASSERT_EQUAL_INT(own.handed, own.finished);
    TEST_ASSERT_EQUAL_INT(THREADS, own.shares);
    TEST_ASSERT_EQUAL_HEX64_MESSAGE(run(alone, WARM_STEPS + 1), hash, line);
    OK(pbmpm_world_destroy(counted));
    OK(pbmpm_world_destroy(alone));
    return joins;
}

/* Pools of 4000 and 13,500 particles. */
static void expect_at_most(int most, const char *name, pbmpm_solver solver, bool floats, int32_t substeps)
{
    static const float sizes[] = {1.0f, 1.5f};
    for (int s = 0; s < 2; s++)
        for (int obstacles = 0; obstacles < 2; obstacles++) {
            const pool_plan plan = {solver, sizes[s], obstacles, floats, substeps};
            const int joins = count_joins(name, &plan);
            TEST_ASSERT_TRUE_MESSAGE(joins > 0, "too small to be shared");
            TEST_ASSERT_LESS_OR_EQUAL_INT(most, joins);
        }
}

/* The bounds are promises to hosts. */
static void test_the_papers_solver_hands_over_little(void)
{
    expect_at_most(12, "paper", PBMPM_SOLVER_PAPER, false, 1);
}

static void test_the_dual_solver_hands_over_little(void)
{
    expect_at_most(40, "dual", PBMPM_SOLVER_DUAL, false, 1);
}

static void test_the_dual_solver_with_a_body_hands_over_little(void)
{
    expect_at_most(40, "dual with a body", PBMPM_SOLVER_DUAL, true, 1);
}

static void test_the_default_solver_hands_over_little(void)
{
    expect_at_most(40, "convergent", PBMPM_SOLVER_CONVERGENT, false, 1);
}

static void test_substeps_hand_over_no_more_each(void)
{
    expect_at_most(4 * 40, "dual", PBMPM_SOLVER_DUAL, false, 4);
}

/* Each of a body's steps along a line is judged before the next. */
static void test_the_joint_solver_hands_over_some_hundred(void)
{
    expect_at_most(150, "convergent with a body", PBMPM_SOLVER_CONVERGENT, true, 1);
}

/* ---- A few particles ---- */

static void test_small_worlds_hand_over_nothing(void)
{
    host own = {0};
    const pool_plan plan = {PBMPM_SOLVER_DUAL, 0.5f, true, false, 1};
    const pbmpm_world_id world = make_pool(&plan, &own);
    run(world, WARM_STEPS);
    TEST_ASSERT_EQUAL_INT(0, own.handed);
    OK(pbmpm_world_destroy(world));
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_the_papers_solver_hands_over_little);
    RUN_TEST(test_the_dual_solver_hands_over_little);
    RUN_TEST(test_the_dual_solver_with_a_body_hands_over_little);
    RUN_TEST(test_the_default_solver_hands_over_little);
    RUN_TEST(test_substeps_hand_over_no_more_each);
    RUN_TEST(test_the_joint_solver_hands_over_some_hundred);
    RUN_TEST(test_small_worlds_hand_over_nothing);
    return UNITY_END();
}

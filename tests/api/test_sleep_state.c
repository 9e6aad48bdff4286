/* Sleeping beside other things: threads, snapshots, memory, every solver. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sleep_pool.h"
#include "solvers.h"

void setUp(void) {}

void tearDown(void) { pbmpm_shutdown(); }

/* ---- Threads, snapshots, memory ---- */

static void test_results_do_not_depend_on_the_number_of_threads(void)
{
    uint64_t hashes[64];
    for (int32_t threads = 1; threads <= 4; threads += 3) {
        const pool made = make_pool(threads, NULL);
        int at = 0;
        fill_pool(&made);
        for (int k = 0; k < 40; k++) {
            steps(&made, 10);
            if (k == 25) an_emitter_begins(&made);
            if (k == 30) particles_are_removed(&made);
            const uint64_t hash = world_hash(made.world);
            if (threads == 1) hashes[at] = hash;
            TEST_ASSERT_EQUAL_HEX64(hashes[at], hash);
            at++;
        }
        TEST_ASSERT_TRUE(world_stats(made.world).blocks_asleep > 0);
        OK(pbmpm_world_destroy(made.world));
    }
}

/* Taken while some are awake, some drowsy, and some asleep in more than one piece. */
static void test_a_snapshot_holds_who_sleeps(void)
{
    const pool made = sleeping_pool(NULL), other = make_pool(1, NULL);
    an_emitter_begins(&made);
    steps(&made, 20);
    move_paddle(&made, 0.5f, false);
    steps(&made, 20);
    const pbmpm_stats stats = world_stats(made.world);
    TEST_ASSERT_TRUE(stats.blocks_asleep > 0 && stats.blocks_drowsy > 0 && stats.blocks_drowsy < stats.particle_blocks);
    uint64_t bytes;
    OK(pbmpm_snapshot_size(made.world, &bytes, NULL));
    char *buffer = malloc(bytes);
    OK(pbmpm_snapshot_save(made.world, buffer, bytes, NULL));
    OK(pbmpm_snapshot_restore(other.world, buffer, bytes, 0));
    for (int i = 0; i < 200; i++) {
        steps(&made, 1);
        steps(&other, 1);
        TEST_ASSERT_EQUAL_HEX64(world_hash(made.world), world_hash(other.world));
        TEST_ASSERT_EQUAL_UINT32(world_stats(made.world).particles_asleep, world_stats(other.world).particles_asleep);
    }
    free(buffer);
}

static void test_a_snapshot_without_sleeping_wakes_all(void)
{
    pool awake = make_pool(1, NULL), made;
    fill_pool(&awake);
    change_settings(awake.world, not_at_all);
    steps(&awake, 10);
    uint64_t bytes;
    OK(pbmpm_snapshot_size(awake.world, &bytes, NULL));
    char *buffer = malloc(bytes);
    OK(pbmpm_snapshot_save(awake.world, buffer, bytes, NULL));
    made = sleeping_pool(NULL);
    OK(pbmpm_snapshot_restore(made.world, buffer, bytes, 0));
    TEST_ASSERT_EQUAL_UINT32(0, world_stats(made.world).particles_asleep);
    for (int i = 0; i < 50; i++) {
        steps(&awake, 1);
        steps(&made, 1);
        TEST_ASSERT_EQUAL_HEX64(world_hash(awake.world), world_hash(made.world));
    }
    free(buffer);
}

/* Soft bodies that lie on the floor, so far apart that one may wake without the other. */
typedef struct lying {
    pbmpm_world_id world;
    pbmpm_material_id rubber;
} lying;

static lying lying_body(int32_t dimension, const way *chosen, int32_t threads)
{
    lying made;
    pbmpm_world_def def = default_world(dimension, dimension == 2 ? DX : 2 * DX, MOST);
    def.domain_enabled = 1;
    def.domain_friction = 0.5f;
    def.domain_max[0] = 4.0f;
    def.domain_max[2] = 0.4f;
    def.thread_count = threads;
    made.world = create_world(&def);
    change_settings(made.world, to_sleep);
    use_way(made.world, chosen);
    if (chosen->solver == PBMPM_SOLVER_EXPLICIT) set_rate(made.world, 8, 1);
    const pbmpm_material_def soft = soft_material(PBMPM_ELASTIC);
    OK(pbmpm_material_create(made.world, &soft, &made.rubber));
    fill_shape(made.world, made.rubber, box_shape(0.5f, 0.15f, 0.2f, 0.45f, 0.15f, 0.2f), STILL);
    fill_shape(made.world, made.rubber, box_shape(3.0f, 0.15f, 0.2f, 0.45f, 0.15f, 0.2f), STILL);
    return made;
}

static void fall_asleep(pbmpm_world_id world, const char *name)
{
    pbmpm_stats stats = world_stats(world);
    for (int i = 0; i < 1200 && stats.particles_asleep < stats.particle_count; i++) {
        OK(pbmpm_world_step(world, DT));
        stats = world_stats(world);
    }
    TEST_ASSERT_EQUAL_UINT32_MESSAGE(stats.particle_count, stats.particles_asleep, name);
}

/* Hash and particles asleep every ten steps. */
#ifdef PBMPM_SANITIZED
enum { GO_ON = 120 };
#else
enum { GO_ON = 200 };
#endif
enum { LOOKS = GO_ON / 10 };
typedef struct course {
    uint64_t hash[LOOKS];
    uint32_t asleep[LOOKS];
    uint64_t woken; /* blocks */
} course;

static course go_on(pbmpm_world_id world)
{
    course seen;
    memset(&seen, 0, sizeof seen);
    for (int i = 0; i < GO_ON; i++) {
        OK(pbmpm_world_step(world, DT));
        const pbmpm_stats stats = world_stats(world);
        seen.woken += stats.blocks_woken;
        seen.hash[i / 10] = world_hash(world);
        seen.asleep[i / 10] = stats.particles_asleep;
    }
    return seen;
}

/* A smaller body falls onto one of two that sleep: saved in the air, with both asleep, and in 2D once more when it has landed. */
static void check_half_asleep(int32_t dimension, const way *chosen)
{
    const lying made = lying_body(dimension, chosen, 1), other = lying_body(dimension, chosen, 3);
    fall_asleep(made.world, chosen->name);
    fill_shape(made.world, made.rubber, box_shape(0.3f, 1.0f, 0.2f, 0.1f, 0.1f, 0.1f), (const float[3]){0, -1, 0});
    for (int part = 0; part < (dimension == 2 ? 2 : 1); part++) {
        for (int i = 0; i < 10 + 60 * part; i++) OK(pbmpm_world_step(made.world, DT));
        const pbmpm_stats stats = world_stats(made.world);
        TEST_ASSERT_TRUE_MESSAGE(stats.particles_asleep > 0 && stats.particles_asleep < stats.particle_count, chosen->name);
        uint64_t bytes;
        OK(pbmpm_snapshot_size(made.world, &bytes, NULL));
        void *state = malloc(bytes);
        const pbmpm_result kept = pbmpm_snapshot_save(made.world, state, bytes, NULL);
        const course first = go_on(made.world);
        const pbmpm_result back = pbmpm_snapshot_restore(made.world, state, bytes, 0);
        const course again = go_on(made.world);
        const pbmpm_result twin = pbmpm_snapshot_restore(other.world, state, bytes, 0);
        const course elsewhere = go_on(other.world);
        const pbmpm_result last = pbmpm_snapshot_restore(made.world, state, bytes, 0);
        free(state);
        TEST_ASSERT_TRUE(kept == PBMPM_OK && back == PBMPM_OK && twin == PBMPM_OK && last == PBMPM_OK);
        TEST_ASSERT_TRUE_MESSAGE(part > 0 || first.woken > 0, chosen->name); /* what it lands on wakes */
        TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&first, &again, sizeof first, chosen->name);
        TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&first, &elsewhere, sizeof first, chosen->name);
    }
    OK(pbmpm_world_destroy(made.world));
    OK(pbmpm_world_destroy(other.world));
}

static void test_every_solver_goes_on_half_asleep(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++)
        for (int w = 0; w < way_count; w++) check_half_asleep(dimension, &ways[w]);
}

/* What sleeps holds the nodes that it shares with what is awake; these are no contacts with obstacles. Water, for a body wakes as one. */
static void test_what_sleeps_is_no_obstacle(void)
{
    const pbmpm_world_def def = default_world(2, DX, MOST);
    const pbmpm_world_id world = create_world(&def);
    const pbmpm_shape corner = sphere_shape(-0.6f, 0, 0, 0.02f);
    pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    change_settings(world, to_sleep);
    set_gravity(world, 0, 0, 0);
    fill_shape(world, water, box_shape(0, 0, 0, 0.6f, 0.2f, 1), STILL);
    fall_asleep(world, "a drop");
    OK(pbmpm_world_wake(world, &corner));
    OK(pbmpm_world_step(world, DT));
    const pbmpm_stats stats = world_stats(world);
    TEST_ASSERT_TRUE(stats.blocks_drowsy > 0 && stats.particles_asleep > 0 && stats.particles_asleep < stats.particle_count);
    TEST_ASSERT_EQUAL_UINT32(0, stats.contacts);
}

/* Once a pool has slept, woken and slept again, the same once more allocates nothing. */
static void test_warm_steps_allocate_nothing(void)
{
    static ledger book;
    book = (ledger){0};
    const pool made = make_pool(1, &book);
    fill_pool(&made);
    rest(&made);
    for (int round = 0; round < 3; round++) {
        const uint64_t calls = book.calls;
        a_call_wakes_a_shape(&made);
        a_fast_particle_comes_in(&made);
        rest(&made);
        a_call_wakes_all(&made);
        rest(&made);
        if (round == 2) TEST_ASSERT_EQUAL_UINT64(calls, book.calls);
    }
    OK(pbmpm_world_destroy(made.world));
    ledger_expect_clean(&book, "a pool that slept");
}

/* Without memory a step is refused and nothing is lost; afterwards it goes on. */
static void test_steps_without_memory_leave_the_pool_whole(void)
{
    static ledger book;
    for (uint64_t nth = 1; nth < 40; nth++) {
        book = (ledger){0};
        const pool made = sleeping_pool(&book);
        const uint32_t count = world_count(made.world);
        an_emitter_begins(&made);
        book.fail_at = book.calls + nth;
        for (int i = 0; i < 20; i++) {
            const pbmpm_result result = pbmpm_world_step(made.world, DT);
            TEST_ASSERT_TRUE(result == PBMPM_OK || result == PBMPM_ERROR_OUT_OF_MEMORY);
        }
        steps(&made, 5);
        TEST_ASSERT_TRUE(world_count(made.world) >= count);
        world_expect_finite(made.world, "after a refusal");
        OK(pbmpm_world_destroy(made.world));
        ledger_expect_clean(&book, "a pool without memory");
    }
}

/* ---- Every solver, and elastic bodies ---- */

static void test_bodies_sleep_with_every_solver(void)
{
    static const pbmpm_solver solvers[] = {PBMPM_SOLVER_PAPER, PBMPM_SOLVER_DUAL, PBMPM_SOLVER_PRIMAL, PBMPM_SOLVER_EXPLICIT};
    for (size_t i = 0; i < sizeof solvers / sizeof *solvers; i++) {
        pbmpm_world_def def = default_world(2, DX, MOST);
        def.domain_enabled = 1;
        def.domain_friction = 0.5f;
        const pbmpm_world_id world = create_world(&def);
        pbmpm_settings settings = {.size = sizeof settings};
        OK(pbmpm_world_get_settings(world, &settings));
        to_sleep(&settings);
        settings.solver = solvers[i];
        settings.substeps = solvers[i] == PBMPM_SOLVER_EXPLICIT ? 20 : 1;
        OK(pbmpm_world_set_settings(world, &settings));
        pbmpm_material_def stuff = default_material(PBMPM_ELASTIC);
        stuff.young_modulus = 1e5f;
        pbmpm_material_id rubber;
        OK(pbmpm_material_create(world, &stuff, &rubber));
        fill_shape(world, rubber, box_shape(0.5f, 0.2f, 0, 0.3f, 0.2f, 1), STILL);
        char label[40];
        snprintf(label, sizeof label, "solver %d", (int)solvers[i]);
        fall_asleep(world, label);
        /* A second body falls onto it. */
        const float down[] = {0, -2, 0};
        fill_shape(world, rubber, box_shape(0.5f, 0.6f, 0, 0.1f, 0.1f, 1), down);
        for (int k = 0; k < 30; k++) OK(pbmpm_world_step(world, DT));
        const pbmpm_stats stats = world_stats(world);
        TEST_ASSERT_TRUE_MESSAGE(stats.particles_asleep < 1536 / 2, label);
        world_expect_finite(world, label);
        OK(pbmpm_world_destroy(world));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_results_do_not_depend_on_the_number_of_threads);
    RUN_TEST(test_a_snapshot_holds_who_sleeps);
    RUN_TEST(test_a_snapshot_without_sleeping_wakes_all);
    RUN_TEST(test_every_solver_goes_on_half_asleep);
    RUN_TEST(test_what_sleeps_is_no_obstacle);
    RUN_TEST(test_warm_steps_allocate_nothing);
    RUN_TEST(test_steps_without_memory_leave_the_pool_whole);
    RUN_TEST(test_bodies_sleep_with_every_solver);
    forget_pool();
    return UNITY_END();
}

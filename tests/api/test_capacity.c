/* Hard limits: capacities and the memory budget. */
#include <stdio.h>
#include <string.h>

#include "calls.h"

void setUp(void)
{
}

void tearDown(void)
{
    pbmpm_shutdown();
}

/* ---- capacities ---- */

static void test_particles_stop_at_the_capacity(void)
{
    enum { CAPACITY = 10 };
    static const float positions[2 * (CAPACITY + 1)];
    const pbmpm_world_def def = default_world(2, 0.1f, CAPACITY);
    const pbmpm_world_id world = create_world(&def);
    pbmpm_particles_def particles;
    pbmpm_particle_id ids[CAPACITY];
    pbmpm_event event = {0};
    OK(pbmpm_particles_def_init(&particles, sizeof particles));
    particles.material = create_material(world, PBMPM_LIQUID);
    particles.positions = positions;
    particles.count = CAPACITY + 1;
    EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_particles_add(world, &particles, NULL));
    TEST_ASSERT_EQUAL_UINT32(0, world_count(world));
    TEST_ASSERT_EQUAL_UINT32(1, world_events_of(world, PBMPM_EVENT_CAPACITY, &event));
    TEST_ASSERT_EQUAL_UINT32(CAPACITY + 1, event.count);
    particles.count = CAPACITY;
    OK(pbmpm_particles_add(world, &particles, ids));
    particles.count = 1;
    EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_particles_add(world, &particles, NULL));
    OK(pbmpm_world_step(world, 0.01f));
    OK(pbmpm_particles_remove(world, &ids[3], 1));
    OK(pbmpm_particles_add(world, &particles, &ids[3]));
    TEST_ASSERT_EQUAL_UINT32(CAPACITY, world_count(world));
}

static void test_fill_says_how_many_it_needs(void)
{
    const pbmpm_world_def small = default_world(2, 0.1f, 50), large = default_world(2, 0.1f, 5000);
    const pbmpm_world_id tight = create_world(&small), roomy = create_world(&large);
    const pbmpm_shape shape = default_shape();
    pbmpm_fill_def fill = default_fill(create_material(tight, PBMPM_LIQUID));
    uint32_t needed = 0, added = 0;
    const snapshot before = snapshot_take(tight);
    EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_particles_fill(tight, &fill, &shape, &needed));
    snapshot_expect_same(&before, tight, "fill beyond the capacity");
    fill.material = create_material(roomy, PBMPM_LIQUID);
    OK(pbmpm_particles_fill(roomy, &fill, &shape, &added));
    TEST_ASSERT_EQUAL_UINT32(added, needed);
}

static void test_materials_stop_at_their_limit(void)
{
    const pbmpm_world_def def = default_world(2, 0.1f, 10);
    const pbmpm_world_id world = create_world(&def);
    const pbmpm_material_def material = default_material(PBMPM_LIQUID);
    pbmpm_material_id ids[PBMPM_MAX_MATERIALS], more = {1, 1};
    for (int i = 0; i < PBMPM_MAX_MATERIALS; i++)
        OK(pbmpm_material_create(world, &material, &ids[i]));
    EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_material_create(world, &material, &more));
    OK(pbmpm_material_destroy(world, ids[100]));
    OK(pbmpm_material_create(world, &material, &more));
}

static void test_colliders_stop_at_their_limit(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const pbmpm_collider_def def = default_collider();
    const pbmpm_shape shape = sphere_shape(0.5f, 0.1f, 0, 0.05f);
    pbmpm_collider_id ids[PBMPM_MAX_COLLIDERS], more;
    for (int i = 0; i < PBMPM_MAX_COLLIDERS; i++)
        OK(pbmpm_collider_create(world, &def, &shape, &ids[i]));
    EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_collider_create(world, &def, &shape, &more));
    OK(pbmpm_world_step(world, 0.01f));
    OK(pbmpm_collider_destroy(world, ids[1000]));
    OK(pbmpm_collider_create(world, &def, &shape, &more));
}

static void test_worlds_stop_at_their_limit(void)
{
    static pbmpm_world_id ids[PBMPM_MAX_WORLDS];
    const pbmpm_world_def def = default_world(2, 0.1f, 1);
    pbmpm_world_id more = {7, 7};
    for (int i = 0; i < PBMPM_MAX_WORLDS; i++)
        ids[i] = create_world(&def);
    EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_world_create(&def, &more));
    TEST_ASSERT_TRUE(more.index == 0 && more.generation == 0);
    OK(pbmpm_world_destroy(ids[512]));
    OK(pbmpm_world_create(&def, &more));
}

/* ---- what a small world holds ---- */

/* Materials as they are defined, and as kernels take them: two numbers more each. The events that it keeps; itself and the only block, of 36 KiB. Its two locks
 * take 8 bytes more each on ARM (pthread_mutex_t: 48 and 40). What else there is follows its particles, colliders and blocks. */
static void test_a_small_world_is_small(void)
{
    enum { TABLES = PBMPM_MAX_MATERIALS * (2 * sizeof(pbmpm_material_def) + 2 * sizeof(float)) + PBMPM_MAX_EVENTS * sizeof(pbmpm_event) + 36 * 1024 + 2 * 8, COLLIDER = 1000 };
    static const float positions[3];
    for (int32_t dimension = 2; dimension <= 3; dimension++) {
        const pbmpm_world_def def = default_world(dimension, 0.1f, 1);
        const pbmpm_world_id world = create_world(&def);
        pbmpm_particles_def particles;
        OK(pbmpm_particles_def_init(&particles, sizeof particles));
        particles.material = create_material(world, PBMPM_LIQUID);
        particles.positions = positions;
        particles.count = 1;
        OK(pbmpm_particles_add(world, &particles, NULL));
        for (int i = 0; i < 3; i++) OK(pbmpm_world_step(world, 0.01f));
        const uint64_t bare = world_stats(world).memory_bytes;
        TEST_ASSERT_LESS_THAN_UINT64(TABLES, bare);
        for (int i = 0; i < 8; i++) create_collider(world, sphere_shape(100, 0, 0, 1), false);
        TEST_ASSERT_LESS_THAN_UINT64(8 * COLLIDER, world_stats(world).memory_bytes - bare);
        OK(pbmpm_world_destroy(world));
    }
}

/* ---- memory budget ---- */

typedef struct limits {
    ledger book;
    uint64_t budget;
    int32_t thread_count;
} limits;

static void use_limits(pbmpm_world_def *def, void *user)
{
    limits *given = user;
    def->allocator = ledger_allocator(&given->book);
    def->memory_budget = given->budget;
    if (given->thread_count)
        def->thread_count = given->thread_count;
}

/* A pool that spreads over a wide floor: its grid grows for many steps. */
static pbmpm_world_id spreading_pool(limits *given)
{
    pbmpm_world_def def = default_world(2, 0.05f, 4096);
    use_limits(&def, given);
    const pbmpm_world_id world = create_world(&def);
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    create_collider(world, plane_shape(0, 0, 0, 0, 1, 0), false);
    fill_shape(world, water, box_shape(0, 0.5f, 0, 0.5f, 0.5f, 0.5f), (const float[3]){0, 0, 0});
    set_gravity(world, 0, -9.81f, 0);
    return world;
}

static void test_the_budget_is_never_exceeded(void)
{
    static limits open;
    open = (limits){.budget = 0};
    const pbmpm_world_id unlimited = spreading_pool(&open);
    const uint64_t at_first = open.book.live_bytes;
    for (int i = 0; i < 100; i++)
        OK(pbmpm_world_step(unlimited, 0.01f));
    const uint64_t needed = open.book.peak_bytes;
    TEST_ASSERT_TRUE(needed > at_first);
    OK(pbmpm_world_destroy(unlimited));

    for (int part = 0; part <= 8; part++) {
        static limits given;
        given = (limits){.budget = at_first + (needed - at_first) * (uint64_t)part / 8};
        const pbmpm_world_id world = spreading_pool(&given);
        int refused = 0;
        for (int i = 0; i < 100; i++) {
            const uint64_t before = world_hash_unordered(world);
            const pbmpm_result result = pbmpm_world_step(world, 0.01f);
            if (result == PBMPM_OK)
                continue;
            TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_OUT_OF_MEMORY, result);
            TEST_ASSERT_EQUAL_HEX64(before, world_hash_unordered(world)); /* one substep: it was not begun */
            refused++;
        }
        TEST_ASSERT_TRUE(given.book.peak_bytes <= given.budget);
        TEST_ASSERT_TRUE(part == 8 ? refused == 0 : part > 0 || refused > 0);
        OK(pbmpm_world_destroy(world));
        ledger_expect_clean(&given.book, "budget");
    }
}

static void test_a_budget_too_small_for_the_world(void)
{
    static ledger book;
    book = (ledger){0};
    pbmpm_world_def def = default_world(3, 0.1f, 1000);
    pbmpm_world_id world;
    def.allocator = ledger_allocator(&book);
    world = create_world(&def);
    const uint64_t needed = book.live_bytes;
    OK(pbmpm_world_destroy(world));
    for (uint64_t part = 0; part < 16; part++) {
        def.memory_budget = 1 + (needed - 2) * part / 15; /* from 1 to one byte too few */
        EXPECT(PBMPM_ERROR_OUT_OF_MEMORY, pbmpm_world_create(&def, &world));
        TEST_ASSERT_TRUE(world.index == 0 && world.generation == 0);
        ledger_expect_clean(&book, "small budget");
    }
    def.memory_budget = needed;
    OK(pbmpm_world_create(&def, &world));
}

/* The substep that lacks memory is not begun, but those before it stay done: the state is that of a world that was asked for
 * just as many. */
static void test_earlier_substeps_stay_done(void)
{
    enum { PARTS = 128 };
    static limits open, given;
    int broken_late = 0;
    open = (limits){.budget = 0};
    const pbmpm_world_id unlimited = spreading_pool(&open);
    set_rate(unlimited, PARTS, 2);
    OK(pbmpm_world_step(unlimited, 1.0f));
    const uint64_t needed = open.book.peak_bytes;
    for (int i = 1; i <= 8; i++) {
        given = (limits){.budget = needed - needed / 256 * (uint64_t)i};
        const pbmpm_world_id world = spreading_pool(&given);
        set_rate(world, PARTS, 2);
        EXPECT(PBMPM_ERROR_OUT_OF_MEMORY, pbmpm_world_step(world, 1.0f));
        const double done = world_stats(world).simulated_seconds;
        const pbmpm_world_id same = spreading_pool(&open);
        if (done > 0) {
            set_rate(same, (int32_t)(done * PARTS + 0.5), 2);
            OK(pbmpm_world_step(same, (float)done));
        }
        TEST_ASSERT_EQUAL_HEX64(world_hash_unordered(same), world_hash_unordered(world));
        broken_late += done > 0;
        OK(pbmpm_world_destroy(same));
        OK(pbmpm_world_destroy(world));
        ledger_expect_clean(&given.book, "broken step");
    }
    TEST_ASSERT_TRUE_MESSAGE(broken_late > 0, "every step broke at its first substep");
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_particles_stop_at_the_capacity);
    RUN_TEST(test_fill_says_how_many_it_needs);
    RUN_TEST(test_materials_stop_at_their_limit);
    RUN_TEST(test_colliders_stop_at_their_limit);
    RUN_TEST(test_worlds_stop_at_their_limit);
    RUN_TEST(test_a_small_world_is_small);
    RUN_TEST(test_the_budget_is_never_exceeded);
    RUN_TEST(test_a_budget_too_small_for_the_world);
    RUN_TEST(test_earlier_substeps_stay_done);
    return UNITY_END();
}

/* Groups of materials: obstacles that act on some matter and let other matter pass. */
#include <math.h>
#include <string.h>

#include "solvers.h"

#ifdef PBMPM_SANITIZED
enum { EACH = 3 }; /* ways to solve */
#else
enum { EACH = 1 };
#endif

void setUp(void)
{
}

void tearDown(void)
{
    pbmpm_shutdown();
}

enum { WATER = 1, GHOST = 2 };

static pbmpm_material_id material_of(pbmpm_world_id world, pbmpm_material_kind kind, uint32_t groups)
{
    pbmpm_material_def def = soft_material(kind);
    pbmpm_material_id material;
    def.groups = groups;
    OK(pbmpm_material_create(world, &def, &material));
    return material;
}

static pbmpm_collider_id obstacle_of(pbmpm_world_id world, pbmpm_shape shape, uint32_t meets)
{
    pbmpm_collider_def def = default_collider();
    pbmpm_collider_id collider;
    def.meets = meets;
    def.kinematic = def.measures_impulse = def.reports_touches = 1;
    OK(pbmpm_collider_create(world, &def, &shape, &collider));
    return collider;
}

static pbmpm_world_id new_world(int32_t dimension, const way *chosen, int32_t threads)
{
    pbmpm_world_def def = default_world(dimension, 0.1f, 30000);
    def.thread_count = threads;
    const pbmpm_world_id world = create_world(&def);
    if (chosen)
        use_way(world, chosen);
    set_gravity(world, 0, -9.81f, 0);
    return world;
}

static void run(pbmpm_world_id world, int steps)
{
    for (int i = 0; i < steps; i++)
        OK(pbmpm_world_step(world, 1.0f / 240));
}

/* A block of matter above an obstacle, onto which it falls at 3 m/s. */
static pbmpm_world_id falling(int32_t dimension, const way *chosen, pbmpm_material_kind kind, uint32_t groups)
{
    const pbmpm_world_id world = new_world(dimension, chosen, 1);
    fill_shape(world, material_of(world, kind, groups), box_shape(0.3f, 0.6f, 0.3f, 0.3f, 0.3f, 0.3f), (const float[3]){0, -3, 0});
    return world;
}

static const pbmpm_material_kind kinds[] = {PBMPM_LIQUID, PBMPM_ELASTIC, PBMPM_SAND, PBMPM_VISCO};

/* To matter that it does not meet an obstacle is not there, bit for bit; to what it meets it is one that meets all. */
static void test_an_obstacle_is_there_for_some_or_not_at_all(void)
{
    const pbmpm_shape shapes[] = {box_shape(0.3f, 0.1f, 0.3f, 0.8f, 0.15f, 0.8f), sphere_shape(0.33f, 0, 0.3f, 0.25f), plane_shape(0, 0.21f, 0, 0.2f, 1, 0)};
    for (int w = 0; w < way_count; w += EACH)
        for (int k = 0; k < 4; k++) {
            const int32_t dimension = 2 + (w + k) % 2;
            const pbmpm_shape shape = shapes[(w + k) % 3];
            const pbmpm_world_id alone = falling(dimension, &ways[w], kinds[k], GHOST), passed = falling(dimension, &ways[w], kinds[k], GHOST);
            const pbmpm_world_id met = falling(dimension, &ways[w], kinds[k], GHOST), plain = falling(dimension, &ways[w], kinds[k], GHOST);
            const pbmpm_collider_id ghost = obstacle_of(passed, shape, WATER);
            pbmpm_impulse impulse = {.size = sizeof impulse};
            obstacle_of(met, shape, WATER | GHOST);
            obstacle_of(plain, shape, 0);
            run(alone, 40);
            run(passed, 40);
            run(met, 40);
            run(plain, 40);
            TEST_ASSERT_EQUAL_HEX64_MESSAGE(world_hash(alone), world_hash(passed), ways[w].name);
            TEST_ASSERT_EQUAL_HEX64_MESSAGE(world_hash(plain), world_hash(met), ways[w].name);
            TEST_ASSERT_TRUE_MESSAGE(world_hash(plain) != world_hash(alone), ways[w].name);
            OK(pbmpm_collider_impulse(passed, ghost, &impulse));
            for (int a = 0; a < 3; a++)
                TEST_ASSERT_EQUAL_DOUBLE(0.0, impulse.linear[a]);
            OK(pbmpm_shutdown());
        }
}

/* A dam breaks at the pace of a game around a box that lets the water pass: nothing of the box is felt, not its edges either. */
static pbmpm_world_id dam(int32_t dimension, const way *chosen, pbmpm_shape shape, uint32_t meets)
{
    pbmpm_world_def def = default_world(dimension, 0.08f, 12000);
    def.domain_enabled = 1;
    def.domain_max[0] = def.domain_max[1] = 2.0f;
    def.domain_max[2] = 0.5f;
    const pbmpm_world_id world = create_world(&def);
    const pbmpm_material_def water = default_material(PBMPM_LIQUID);
    pbmpm_material_id material;
    use_way(world, chosen);
    set_gravity(world, 0, -9.81f, 0);
    OK(pbmpm_material_create(world, &water, &material));
    if (meets)
        obstacle_of(world, shape, meets);
    fill_shape(world, material, box_shape(0.5f, 0.6f, 0.25f, 0.4f, 0.5f, 0.2f), (const float[3]){0, 0, 0});
    return world;
}

static void test_water_feels_nothing_of_what_it_passes(void)
{
    const pbmpm_shape shapes[] = {box_shape(1, 0.5f, 0.25f, 1.2f, 0.5f, 0.2f), sphere_shape(0.9f, 0.5f, 0.25f, 0.3f)};
    for (int w = 0; w < way_count; w += EACH) {
        if (ways[w].solver == PBMPM_SOLVER_EXPLICIT)
            continue; /* not at this pace */
        const int32_t dimension = 2 + w % 2;
        const pbmpm_world_id without = dam(dimension, &ways[w], shapes[w % 2], 0), with = dam(dimension, &ways[w], shapes[w / 2 % 2], GHOST);
        for (int i = 0; i < 60; i++) {
            OK(pbmpm_world_step(without, 1.0f / 60));
            OK(pbmpm_world_step(with, 1.0f / 60));
        }
        TEST_ASSERT_EQUAL_HEX64_MESSAGE(world_hash(without), world_hash(with), ways[w].name);
        OK(pbmpm_shutdown());
    }
}

/* One that moves through matter that it does not meet changes nothing of how others hold it. */
static void test_what_passes_matter_changes_no_contact(void)
{
    for (int w = 0; w < way_count; w += EACH)
        for (int fast = 0; fast < 2; fast++) {
            uint64_t hash[2];
            for (int passes = 0; passes < 2; passes++) {
                const pbmpm_world_id world = new_world(2, &ways[w], 1);
                pbmpm_collider_id ghost = {0, 0};
                pbmpm_shape slope = box_shape(0, -0.6f, 0, 1.5f, 0.4f, 0);
                slope.rotation[2] = sinf(0.15f);
                slope.rotation[3] = cosf(0.15f);
                obstacle_of(world, slope, 0);
                fill_shape(world, material_of(world, kinds[w % 4], WATER), box_shape(0.2f, 0.4f, 0, 0.4f, 0.4f, 0), (const float[3]){0, -1, 0});
                if (passes)
                    ghost = obstacle_of(world, box_shape(-3, 0.2f, 0, 0.3f, 0.5f, 0), GHOST);
                for (int i = 0; i < 80; i++) {
                    const float position[3] = {-3 + (fast ? 0.25f : 0.08f) * (float)(i + 1), 0.2f, 0};
                    if (passes)
                        OK(pbmpm_collider_move(world, ghost, position, NULL));
                    run(world, 1);
                }
                hash[passes] = world_hash(world);
            }
            TEST_ASSERT_EQUAL_HEX64_MESSAGE(hash[0], hash[1], ways[w].name);
            OK(pbmpm_shutdown());
        }
}

/* Matter falls asleep beside obstacles that it passes, though they measure and move. */
static void test_what_matter_passes_keeps_nobody_awake(void)
{
    for (uint32_t meets = 1; meets < 3; meets++) {
        pbmpm_world_def def = default_world(2, 0.05f, 4000);
        pbmpm_settings settings = default_settings();
        pbmpm_stats stats = {.size = sizeof stats};
        def.domain_enabled = 1;
        def.domain_max[0] = def.domain_max[1] = 2.0f;
        const pbmpm_world_id world = create_world(&def);
        settings.sleeping = 1;
        settings.sleep_time = 0.1f;
        settings.solver = PBMPM_SOLVER_DUAL;
        settings.gravity[1] = -9.81f;
        OK(pbmpm_world_set_settings(world, &settings));
        fill_shape(world, material_of(world, PBMPM_LIQUID, WATER), box_shape(1, 0.15f, 0, 1, 0.15f, 0), (const float[3]){0, 0, 0});
        const pbmpm_collider_id paddle = obstacle_of(world, box_shape(1, 0.5f, 0, 0.1f, 0.1f, 0), meets);
        for (int i = 0; i < 200; i++) {
            const float position[3] = {1 + 0.001f * (float)(i % 20), 0.5f, 0};
            OK(pbmpm_collider_move(world, paddle, position, NULL));
            OK(pbmpm_world_step(world, 1.0f / 60));
        }
        OK(pbmpm_world_get_stats(world, &stats));
        TEST_ASSERT_TRUE((stats.particles_asleep == stats.particle_count) == (meets == GHOST));
        OK(pbmpm_shutdown());
    }
}

/* What else is in the world changes nothing for matter far from it, whoever the obstacle lets pass. */
static void test_matter_elsewhere_changes_nothing(void)
{
    for (int w = 0; w < way_count; w += EACH) {
        uint64_t hash[2];
        for (int filters = 0; filters < 2; filters++) {
            const pbmpm_world_id world = falling(2, &ways[w], PBMPM_LIQUID, WATER);
            fill_shape(world, material_of(world, PBMPM_LIQUID, GHOST), box_shape(5.3f, 0.6f, 0, 0.3f, 0.3f, 0), (const float[3]){0, -3, 0});
            obstacle_of(world, box_shape(0.3f, 0.1f, 0, 0.8f, 0.15f, 0), filters ? WATER : 0);
            run(world, 40);
            hash[filters] = world_hash(world);
        }
        TEST_ASSERT_EQUAL_HEX64_MESSAGE(hash[0], hash[1], ways[w].name);
        OK(pbmpm_shutdown());
    }
}

typedef struct spread {
    double lowest, highest, middle; /* along the second axis */
    uint32_t count;
} spread;

static spread spread_of(pbmpm_world_id world, pbmpm_material_id material)
{
    const pbmpm_view places = view_of(world, PBMPM_POSITION), slots = view_of(world, PBMPM_MATERIAL);
    spread found = {INFINITY, -INFINITY, 0.0, 0};
    for (uint32_t row = 0; row < places.count; row++) {
        if (view_uint(&slots, row, 0) != material.index)
            continue;
        const double y = (double)view_float(&places, row, 1);
        found.lowest = fmin(found.lowest, y);
        found.highest = fmax(found.highest, y);
        found.middle += y;
        found.count++;
    }
    found.middle /= found.count;
    return found;
}

/* Water and a jelly fall onto a grate that holds the jelly alone; the floor of the domain holds both. */
static pbmpm_world_id sieve(int32_t dimension, const way *chosen, int32_t threads, pbmpm_material_id *water, pbmpm_material_id *jelly)
{
    pbmpm_world_def def = default_world(dimension, 0.05f, 60000);
    def.thread_count = threads;
    def.domain_enabled = 1;
    for (int a = 0; a < 3; a++)
        def.domain_max[a] = 1.2f;
    const pbmpm_world_id world = create_world(&def);
    use_way(world, chosen);
    set_gravity(world, 0, -9.81f, 0);
    *water = material_of(world, PBMPM_LIQUID, WATER);
    *jelly = material_of(world, PBMPM_ELASTIC, GHOST);
    obstacle_of(world, box_shape(0.6f, 0.5f, 0.6f, 0.7f, 0.06f, 0.7f), GHOST);
    fill_shape(world, *jelly, box_shape(0.3f, 0.8f, 0.3f, 0.15f, 0.15f, 0.15f), (const float[3]){0, 0, 0});
    fill_shape(world, *water, box_shape(0.9f, 0.8f, 0.3f, 0.15f, 0.2f, 0.15f), (const float[3]){0, 0, 0});
    return world;
}

static void test_a_sieve_parts_matter(void)
{
    for (int w = 0; w < way_count; w += EACH) {
        pbmpm_material_id water, jelly;
        const pbmpm_world_id world = sieve(2 + w % 2, &ways[w], 2, &water, &jelly);
        run(world, 240);
        const spread fallen = spread_of(world, water), held = spread_of(world, jelly);
        TEST_ASSERT_TRUE_MESSAGE(fallen.middle < 0.3, ways[w].name);
        TEST_ASSERT_TRUE_MESSAGE(fallen.lowest >= 0.0, ways[w].name);
        TEST_ASSERT_TRUE_MESSAGE(held.lowest > 0.56 - 0.025, ways[w].name); /* half a cell below the surface at most */
        TEST_ASSERT_TRUE_MESSAGE(held.middle < 0.77, ways[w].name);         /* it lies on it: its half height is 0.15 */
        OK(pbmpm_shutdown());
    }
}

static void test_any_number_of_threads_gives_the_same_hash(void)
{
    static const int32_t threads[] = {1, 2, 5};
    uint64_t hash[3];
    for (int w = 0; w < way_count; w += 3) {
        for (int i = 0; i < 3; i++) {
            pbmpm_material_id water, jelly;
            const pbmpm_world_id world = sieve(3, &ways[w], threads[i], &water, &jelly);
            run(world, 60);
            hash[i] = world_hash(world);
        }
        TEST_ASSERT_EQUAL_HEX64_MESSAGE(hash[0], hash[1], ways[w].name);
        TEST_ASSERT_EQUAL_HEX64_MESSAGE(hash[0], hash[2], ways[w].name);
    }
}

/* What a collider meets can change, and so can the groups of a material: the next step knows. */
static void test_changes_count_from_the_next_step(void)
{
    for (int by_material = 0; by_material < 2; by_material++) {
        const pbmpm_world_id world = new_world(2, NULL, 1), same = new_world(2, NULL, 1);
        pbmpm_collider_id wall[2];
        pbmpm_material_id jelly[2];
        const pbmpm_world_id both[] = {world, same};
        for (int i = 0; i < 2; i++) {
            wall[i] = obstacle_of(both[i], box_shape(0, -0.5f, 0, 2, 0.2f, 0), WATER);
            jelly[i] = material_of(both[i], PBMPM_ELASTIC, GHOST);
            fill_shape(both[i], jelly[i], box_shape(0, 0.3f, 0, 0.3f, 0.3f, 0), (const float[3]){0, 0, 0});
        }
        run(world, 10);
        run(same, 10);
        if (by_material) {
            pbmpm_material_def def = {.size = sizeof def};
            OK(pbmpm_material_get(world, jelly[0], &def));
            TEST_ASSERT_EQUAL_UINT32(GHOST, def.groups);
            def.groups = WATER | GHOST;
            OK(pbmpm_material_set(world, jelly[0], &def));
        } else {
            pbmpm_collider_def def = {.size = sizeof def};
            OK(pbmpm_collider_get(world, wall[0], &def, NULL));
            TEST_ASSERT_EQUAL_UINT32(WATER, def.meets);
            def.meets = 0;
            OK(pbmpm_collider_set(world, wall[0], &def, NULL));
        }
        run(world, 150);
        run(same, 150);
        TEST_ASSERT_TRUE(spread_of(world, jelly[0]).lowest > -0.35); /* half a cell into the wall at most */
        TEST_ASSERT_TRUE(spread_of(same, jelly[1]).lowest < -0.8);
        OK(pbmpm_shutdown());
    }
}

static uint32_t fill_wall(uint32_t meets)
{
    const pbmpm_world_id world = new_world(2, NULL, 1);
    const pbmpm_material_id ghost = material_of(world, PBMPM_LIQUID, GHOST);
    obstacle_of(world, box_shape(0, 0, 0, 1, 0.2f, 0), meets);
    return fill_shape(world, ghost, box_shape(0, 0, 0, 0.5f, 0.5f, 0), (const float[3]){0, 0, 0});
}

static void test_fills_leave_out_what_holds_them(void)
{
    const uint32_t all = fill_wall(WATER), outside = fill_wall(0);
    TEST_ASSERT_EQUAL_UINT32(outside, fill_wall(GHOST));
    TEST_ASSERT_UINT32_WITHIN(20, (uint32_t)(0.6 * all), outside);
}

/* Out of a nozzle inside of an obstacle. */
static uint32_t emitted(uint32_t meets)
{
    const pbmpm_world_id world = new_world(2, NULL, 1);
    const pbmpm_shape nozzle = box_shape(0, 0, 0, 0.1f, 0.1f, 0);
    pbmpm_emitter_def def;
    pbmpm_emitter_id emitter;
    OK(pbmpm_emitter_def_init(&def, sizeof def));
    def.material = material_of(world, PBMPM_LIQUID, GHOST);
    def.rate = 500.0f;
    def.speed = 2.0f;
    obstacle_of(world, box_shape(0, 0, 0, 0.6f, 0.6f, 0), meets);
    OK(pbmpm_emitter_create(world, &def, &nozzle, &emitter));
    run(world, 60);
    return world_count(world);
}

static void test_emitters_mind_what_holds_their_matter(void)
{
    TEST_ASSERT_TRUE(emitted(WATER) > 60);
    TEST_ASSERT_EQUAL_UINT32(0, emitted(GHOST));
    TEST_ASSERT_EQUAL_UINT32(0, emitted(0));
}

/* A sensor of some groups is a trigger for these. */
static void test_touches_tell_of_what_is_met(void)
{
    const pbmpm_world_id world = new_world(2, NULL, 1);
    const pbmpm_material_id water = material_of(world, PBMPM_LIQUID, WATER), ghost = material_of(world, PBMPM_LIQUID, GHOST);
    pbmpm_collider_def def = default_collider();
    pbmpm_touch touches[4] = {{.size = sizeof touches[0]}};
    uint32_t count;
    def.sensor = def.reports_touches = 1;
    for (uint32_t meets = 0; meets < 3; meets++) {
        const pbmpm_shape shape = box_shape(0, 0, 0, 1, 1, 0);
        pbmpm_collider_id collider;
        def.meets = meets;
        OK(pbmpm_collider_create(world, &def, &shape, &collider));
    }
    fill_shape(world, water, box_shape(-0.5f, 0, 0, 0.2f, 0.2f, 0), (const float[3]){0, 0, 0});
    fill_shape(world, ghost, box_shape(0.5f, 0, 0, 0.2f, 0.2f, 0), (const float[3]){0, 0, 0});
    OK(pbmpm_world_touches(world, touches, 4, &count));
    TEST_ASSERT_EQUAL_UINT32(4, count);
    TEST_ASSERT_EQUAL_UINT32(water.index, touches[2].material.index);
    TEST_ASSERT_EQUAL_UINT32(1, touches[2].collider.index);
    TEST_ASSERT_EQUAL_UINT32(ghost.index, touches[3].material.index);
    TEST_ASSERT_EQUAL_UINT32(2, touches[3].collider.index);
}

/* What passes through a body does not carry it. */
static void test_only_what_is_met_counts_as_under_matter(void)
{
    for (uint32_t meets = 0; meets < 3; meets++) {
        pbmpm_world_def def = default_world(2, 0.1f, 30000);
        def.domain_enabled = 1;
        def.domain_max[0] = def.domain_max[1] = 3.0f;
        const pbmpm_world_id world = create_world(&def);
        const pbmpm_material_id ghost = material_of(world, PBMPM_LIQUID, GHOST);
        pbmpm_submersion found = {.size = sizeof found};
        fill_shape(world, ghost, box_shape(1.5f, 1.5f, 0, 1.5f, 1.5f, 0), (const float[3]){0, 0, 0});
        const pbmpm_collider_id body = obstacle_of(world, box_shape(1.5f, 1.5f, 0, 0.3f, 0.3f, 0), meets);
        OK(pbmpm_collider_submerged(world, body, NULL, &found));
        TEST_ASSERT_DOUBLE_WITHIN(0.04, meets == WATER ? 0.0 : 0.36, found.volume);
        obstacle_of(world, box_shape(1.5f, 2.0f, 0, 1.4f, 0.15f, 0), WATER); /* takes no room from what passes it */
        OK(pbmpm_collider_submerged(world, body, NULL, &found));
        TEST_ASSERT_DOUBLE_WITHIN(0.04, meets == WATER ? 0.0 : 0.36, found.volume);
    }
}

/* Lone drops fly without a grid; obstacles that they do not meet are far from them. */
static void test_drops_fly_through(void)
{
    for (uint32_t meets = 1; meets < 3; meets++) {
        const pbmpm_world_id world = new_world(3, NULL, 1);
        const float drop[3] = {0.05f, 1.0f, 0.05f}, speed[3] = {0, -5, 0};
        pbmpm_particles_def def;
        pbmpm_stats stats = {.size = sizeof stats};
        OK(pbmpm_particles_def_init(&def, sizeof def));
        def.material = material_of(world, PBMPM_LIQUID, GHOST);
        def.positions = drop;
        def.velocities = speed;
        def.count = 1;
        OK(pbmpm_particles_add(world, &def, NULL));
        obstacle_of(world, box_shape(0, 0, 0, 1, 0.2f, 1), meets);
        for (int i = 0; i < 80; i++) {
            run(world, 1);
            OK(pbmpm_world_get_step_stats(world, &stats));
            TEST_ASSERT_TRUE(meets == GHOST || stats.particle_blocks == 0);
        }
        TEST_ASSERT_TRUE((spread_of(world, def.material).lowest < -0.5) == (meets == WATER));
    }
}

static void test_refusals(void)
{
    const pbmpm_world_id world = new_world(2, NULL, 1);
    pbmpm_material_def def = default_material(PBMPM_LIQUID);
    pbmpm_material_id material;
    TEST_ASSERT_EQUAL_UINT32(1, def.groups);
    TEST_ASSERT_EQUAL_UINT32(0, default_collider().meets);
    def.groups = 0;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_material_create(world, &def, &material));
    TEST_ASSERT_NOT_NULL(strstr(pbmpm_last_error(), "groups"));
    def.groups = UINT32_MAX;
    def.reserved = 1;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_material_create(world, &def, &material));
    def.reserved = 0;
    OK(pbmpm_material_create(world, &def, &material));
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_an_obstacle_is_there_for_some_or_not_at_all);
    RUN_TEST(test_water_feels_nothing_of_what_it_passes);
    RUN_TEST(test_what_passes_matter_changes_no_contact);
    RUN_TEST(test_what_matter_passes_keeps_nobody_awake);
    RUN_TEST(test_matter_elsewhere_changes_nothing);
    RUN_TEST(test_a_sieve_parts_matter);
    RUN_TEST(test_any_number_of_threads_gives_the_same_hash);
    RUN_TEST(test_changes_count_from_the_next_step);
    RUN_TEST(test_fills_leave_out_what_holds_them);
    RUN_TEST(test_emitters_mind_what_holds_their_matter);
    RUN_TEST(test_touches_tell_of_what_is_met);
    RUN_TEST(test_only_what_is_met_counts_as_under_matter);
    RUN_TEST(test_drops_fly_through);
    RUN_TEST(test_refusals);
    return UNITY_END();
}

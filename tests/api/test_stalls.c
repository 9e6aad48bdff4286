/* Calls about what is far away, long or immense come back soon: their work is bounded by what they can touch. */
#include <math.h>
#include <time.h>

#include "scenes.h"

void setUp(void)
{
    host_end_after(120); /* a call that never returns ends the program */
}

void tearDown(void)
{
    pbmpm_shutdown();
    host_end_after(0);
}

/* ---- how long ---- */

#if defined PBMPM_SANITIZED || !defined __OPTIMIZE__ /* which makes all of it slower: only what never returns is found */
#define WITHIN(limit, call) call
#else
/* [s] of this processor's time. Each limit is some ten times what is needed, and a small part of what it was before. */
static double used(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

#define WITHIN(limit, call)                                                                                             \
    do {                                                                                                                \
        const double begin = used();                                                                                    \
        call;                                                                                                           \
        TEST_ASSERT_TRUE_MESSAGE(used() - begin < (limit), #call " took too long");                                       \
    } while (0)
#endif

/* ---- queries ---- */

static pbmpm_world_id particles_at(int32_t dimension, const float *positions, uint32_t count)
{
    const pbmpm_world_def def = default_world(dimension, 0.1f, count);
    const pbmpm_world_id world = create_world(&def);
    pbmpm_particles_def many;
    OK(pbmpm_particles_def_init(&many, sizeof many));
    many.material = create_material(world, PBMPM_LIQUID);
    many.count = count;
    many.positions = positions;
    OK(pbmpm_particles_add(world, &many, NULL));
    return world;
}

/* A line has the same matter on it wherever on it its point is. */
static void test_heights_over_points_far_away(void)
{
    static const float particle[2] = {0.1f, 0.4f}, up[2] = {0, 1}, left[2] = {-1, 0};
    static const float far[] = {0.0f, 100.0f, 1e6f, -1e9f, 9e14f, 5e14f, -5e14f, 1e20f, 3e38f, -3e38f};
    enum { FAR = sizeof far / sizeof *far };
    const double halved = 0.1 * 0.25 / 4096 + 1e-7; /* [m] the last halving, and rounding to float */
    const pbmpm_world_id world = particles_at(2, particle, 1);
    float over[2 * FAR], beside[2 * FAR], heights[FAR];
    for (int i = 0; i < FAR; i++) {
        over[2 * i] = particle[0];
        over[2 * i + 1] = far[i];
        beside[2 * i] = far[i];
        beside[2 * i + 1] = particle[1];
    }
    OK(pbmpm_query_heights(world, over, FAR, up, 0.09375f, heights));
    for (int i = 0; i < FAR; i++)
        TEST_ASSERT_DOUBLE_WITHIN(halved, 0.45, heights[i]);
    OK(pbmpm_query_heights(world, beside, FAR, left, 0.09375f, heights));
    for (int i = 0; i < FAR; i++)
        TEST_ASSERT_DOUBLE_WITHIN(halved, -0.05, heights[i]);
}

/* Along other directions nobody knows where such a line passes; the answer comes all the same. */
static void test_crooked_lines_far_away(void)
{
    static const float far[] = {1e6f, -1e9f, 5e14f, -3e15f, 7e17f, 1e22f, 3e38f, -3e38f};
    enum { FAR = sizeof far / sizeof *far };
    uint32_t stream = 3;
    float positions[3 * 64], points[3 * FAR], heights[FAR];
    for (int i = 0; i < 3 * 64; i++)
        positions[i] = random_float(&stream, -1e4f, 1e4f);
    const pbmpm_world_id world = particles_at(3, positions, 64);
    for (int round = 0; round < 200; round++) {
        float direction[3];
        for (int a = 0; a < 3; a++)
            direction[a] = round % 8 == a ? 0.0f : random_float(&stream, -1, 1);
        for (int i = 0; i < 3 * FAR; i++)
            points[i] = i % 3 == round % 3 ? far[i / 3] : far[random_next(&stream) % FAR];
        OK(pbmpm_query_heights(world, points, FAR, direction, 0.01f, heights));
        pbmpm_ray ray;
        pbmpm_ray_hit hit = {.size = sizeof hit};
        OK(pbmpm_ray_init(&ray, sizeof ray));
        for (int a = 0; a < 3; a++) {
            ray.origin[a] = points[a];
            ray.direction[a] = direction[a];
        }
        OK(pbmpm_query_ray(world, &ray, &hit));
    }
}

/* The box around two particles far from each other is empty. */
static void test_lines_through_emptiness(void)
{
    static const float pair[4] = {0, 0, 0, 20000};
    const pbmpm_world_id world = particles_at(2, pair, 2);
    pbmpm_ray ray;
    pbmpm_ray_hit hit = {.size = sizeof hit};
    float points[2 * 64], heights[64];
    OK(pbmpm_ray_init(&ray, sizeof ray));
    ray.level = 0.09375f;
    ray.origin[1] = 19990;
    WITHIN(0.2, for (int i = 0; i < 200; i++) OK(pbmpm_query_ray(world, &ray, &hit)));
    TEST_ASSERT_EQUAL_INT32(1, hit.hit);
    TEST_ASSERT_FLOAT_WITHIN(0.001f, 0.05f, hit.position[1]);
    for (int i = 0; i < 64; i++) {
        points[2 * i] = 0.05f + 0.001f * (float)(i % 2); /* the filling there is less than the level */
        points[2 * i + 1] = 7;
    }
    WITHIN(0.2, OK(pbmpm_query_heights(world, points, 64, (const float[2]){0, 1}, 0.25f, heights)));
    for (int i = 0; i < 64; i++)
        TEST_ASSERT_TRUE(isinf(heights[i]));
}

/* ---- fills ---- */

/* Of a shape that is much larger than the domain only what is inside of the domain is looked at. */
static void test_fills_beyond_the_domain(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++) {
        pbmpm_world_def def = default_world(dimension, 0.05f, 130000);
        def.domain_enabled = 1;
        for (int a = 0; a < 3; a++)
            def.domain_min[a] = -0.3f, def.domain_max[a] = 0.7f;
        const pbmpm_world_id world = create_world(&def);
        const float half = dimension == 2 ? 400 : 12;
        uint32_t huge = 0, fitting = 0;
        const pbmpm_fill_def fill = default_fill(create_material(world, PBMPM_LIQUID));
        pbmpm_shape shape = box_shape(0, 0, 0, half, half, half);
        WITHIN(0.5, OK(pbmpm_particles_fill(world, &fill, &shape, &huge)));
        for (int a = 0; a < 3; a++) /* a multiple of the spacing around the same centre: the same lattice */
            shape.half_extents[a] = 0.8f;
        OK(pbmpm_particles_fill(world, &fill, &shape, &fitting));
        TEST_ASSERT_EQUAL_UINT32(fitting, huge);
        TEST_ASSERT_EQUAL_UINT32(dimension == 2 ? 1600 : 64000, huge);
        OK(pbmpm_world_destroy(world));
    }
}

/* Without a domain there is no room for them, and that is found without counting one by one. */
static void test_fills_beyond_all_room(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++) {
        const pbmpm_world_def def = default_world(dimension, 0.1f, 1000);
        const pbmpm_world_id world = create_world(&def);
        pbmpm_shape shapes[] = {box_shape(0, 0, 0, 400, 400, 400), sphere_shape(0, 0, 0, 400), sphere_shape(0, 0, 0, 400)};
        const double share[][2] = {{1, 1}, {0.785398163, 0.523598776}}; /* of the box around them: pi / 4 and pi / 6 */
        shapes[2].kind = PBMPM_CAPSULE;
        shapes[2].radius = 200;
        shapes[2].half_extents[0] = 100;
        for (int k = 0; k < 3; k++) {
            const pbmpm_fill_def fill = default_fill(create_material(world, PBMPM_LIQUID));
            pbmpm_shape shape = shapes[k];
            uint32_t needed = 0;
            if (dimension == 3)
                for (int a = 0; a < 3; a++)
                    shape.half_extents[a] /= 16, shape.radius /= a == 0 ? 16 : 1;
            const double points = dimension == 2 ? 16000.0 * 16000 : 1e9;
            WITHIN(dimension == 2 ? 0.3 : 5.0, EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_particles_fill(world, &fill, &shape, &needed)));
            if (k < 2)
                TEST_ASSERT_DOUBLE_WITHIN(1e-3 * points, share[k][dimension - 2] * points, needed);
        }
        TEST_ASSERT_EQUAL_UINT32(0, world_count(world));
        OK(pbmpm_world_destroy(world));
    }
}

/* A lattice of which no point counts is a mistake of the caller's. */
static void test_fills_of_nothing(void)
{
    pbmpm_world_def def = default_world(2, 0.05f, 1000);
    def.domain_enabled = 1;
    const pbmpm_world_id world = create_world(&def);
    uint32_t added = 9;
    const pbmpm_fill_def fill = default_fill(create_material(world, PBMPM_LIQUID));
    pbmpm_shape shape = box_shape(3, 0.5f, 0, 0.5f, 0.5f, 0.5f);
    const uint64_t before = world_hash(world);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_fill(world, &fill, &shape, &added));
    TEST_ASSERT_EQUAL_UINT32(0, added);
    TEST_ASSERT_EQUAL_HEX64(before, world_hash(world));
    shape.position[0] = 1.4f; /* reaches in */
    OK(pbmpm_particles_fill(world, &fill, &shape, &added));
    TEST_ASSERT_TRUE(added > 0);
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_particles_fill(world, &(pbmpm_fill_def){.size = sizeof fill}, &shape, &added));
}

/* ---- emitters ---- */

/* Half as many particles as there is room for are due in a step of 0.01 s. */
static pbmpm_emitter_id spring(pbmpm_world_id world, int32_t dimension)
{
    const pbmpm_shape shape = sphere_shape(1, 1, 1, 0.2f);
    pbmpm_emitter_def def;
    pbmpm_emitter_id emitter;
    OK(pbmpm_emitter_def_init(&def, sizeof def));
    def.material = create_material(world, PBMPM_LIQUID);
    def.rate = dimension == 2 ? 100 * 500 * 0.0025f : 100 * 500 * 0.000125f;
    OK(pbmpm_emitter_create(world, &def, &shape, &emitter));
    return emitter;
}

static void test_an_emitter_that_is_moved_far_away(void)
{
    static const float places[][2] = {{700, 450}, {450, 700}, {-700, 1}, {700, 700}};
    for (int k = 0; k < 4; k++) {
        const pbmpm_world_def def = default_world(2, 0.1f, 1000);
        const pbmpm_world_id world = papers_world(&def);
        const pbmpm_emitter_id emitter = spring(world, 2);
        OK(pbmpm_emitter_move(world, emitter, (const float[3]){places[k][0], places[k][1], 0}, NULL));
        WITHIN(0.15, OK(pbmpm_world_step(world, 0.01f)));
        TEST_ASSERT_TRUE(world_count(world) > 0);
        TEST_ASSERT_TRUE(world_stats(world).memory_bytes < 30000000);
        pbmpm_shape now = {.size = sizeof now};
        OK(pbmpm_emitter_get(world, emitter, NULL, &now));
        TEST_ASSERT_TRUE(now.position[0] == places[k][0] && now.position[1] == places[k][1]);
        OK(pbmpm_world_destroy(world));
    }
}

/* However far the matter may fly, nothing of it comes out of the domain. */
static void test_an_emitter_in_immense_gravity(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++) {
        pbmpm_world_def def = default_world(dimension, 0.1f, 1000);
        def.domain_enabled = 1;
        for (int a = 0; a < 3; a++)
            def.domain_max[a] = 2;
        const pbmpm_world_id world = papers_world(&def);
        pbmpm_settings settings = default_settings();
        settings.solver = PBMPM_SOLVER_PAPER;
        settings.gravity[1] = -4e6f;
        settings.max_displacement = 64;
        settings.substeps = 16;
        OK(pbmpm_world_set_settings(world, &settings));
        spring(world, dimension);
        WITHIN(16 * 4194304 * 1e-8, OK(pbmpm_world_step(world, 0.16f))); /* 16 substeps of at most 2^22 nodes, 10 ns for each */
        TEST_ASSERT_TRUE(world_count(world) > 0);
        OK(pbmpm_world_destroy(world));
    }
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_heights_over_points_far_away);
    RUN_TEST(test_crooked_lines_far_away);
    RUN_TEST(test_lines_through_emptiness);
    RUN_TEST(test_fills_beyond_the_domain);
    RUN_TEST(test_fills_beyond_all_room);
    RUN_TEST(test_fills_of_nothing);
    RUN_TEST(test_an_emitter_that_is_moved_far_away);
    RUN_TEST(test_an_emitter_in_immense_gravity);
    return UNITY_END();
}

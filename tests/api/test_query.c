/* Queries through the C interface: exact cases, bad arguments, memory. Sums over all particles stand against them in
 * ../python/test_queries.py. */
#include <math.h>
#include <string.h>

#include "rules.h"
#include "scenes.h"

void setUp(void)
{
}

void tearDown(void)
{
    pbmpm_shutdown();
}

/* One particle of 1/4 cell on a node of a 2D grid with cells of 1 m: all numbers are short. */
static pbmpm_world_id single(ledger *book)
{
    const float position[2] = {3, 4}, velocity[2] = {1, -2}, gradient[4] = {0, 1, -1, 0};
    pbmpm_world_def def = default_world(2, 1.0f, 4);
    pbmpm_particles_def one;
    pbmpm_particle_id id;
    if (book)
        def.allocator = ledger_allocator(book);
    const pbmpm_world_id world = create_world(&def);
    OK(pbmpm_particles_def_init(&one, sizeof one));
    one.material = create_material(world, PBMPM_LIQUID);
    one.count = 1;
    one.positions = position;
    one.velocities = velocity;
    OK(pbmpm_particles_add(world, &one, &id));
    OK(pbmpm_particles_set(world, PBMPM_AFFINE_VELOCITY, &id, 1, gradient));
    return world;
}

static void test_fields_of_a_single_particle(void)
{
    const pbmpm_world_id world = single(NULL);
    const float points[] = {3, 4, 3.5f, 4, 4, 5, 4.5f, 4, 3, 2.5f};
    /* w(0) = 3/4, w(1/2) = 1/2, w(1) = 1/8, w(3/2) = 0 */
    const float fillings[] = {0.25f * 0.5625f, 0.25f * 0.375f, 0.25f / 64, 0, 0};
    const float velocities[] = {1, -2, 1, -2.5f, 2, -3, 0, 0, 0, 0}; /* v + C (x - x_p) */
    float filling[5], density[5], velocity[10];
    OK(pbmpm_query_points(world, points, 5, filling, density, velocity));
    for (int i = 0; i < 5; i++) {
        TEST_ASSERT_EQUAL_FLOAT(fillings[i], filling[i]);
        TEST_ASSERT_EQUAL_FLOAT(1000.0f * fillings[i], density[i]);
        TEST_ASSERT_EQUAL_FLOAT(velocities[2 * i], velocity[2 * i]);
        TEST_ASSERT_EQUAL_FLOAT(velocities[2 * i + 1], velocity[2 * i + 1]);
    }
    OK(pbmpm_query_points(world, points, 5, NULL, NULL, NULL));
    OK(pbmpm_query_points(world, NULL, 0, NULL, NULL, NULL));
}

/* Over the particle the filling is w(y)/4 * 3/4: it is 3/32 where w = 1/2, at y = 1/2. */
static void test_height_and_ray_of_a_single_particle(void)
{
    const pbmpm_world_id world = single(NULL);
    const float points[] = {3, 100, 3, -7, 5, 4}, up[2] = {0, 2};
    const double halved = 0.25 / 4096; /* of a cell: the last halving */
    float heights[3];
    pbmpm_ray ray;
    pbmpm_ray_hit hit = {.size = sizeof hit};
    OK(pbmpm_query_heights(world, points, 3, up, 0.09375f, heights));
    TEST_ASSERT_DOUBLE_WITHIN(halved, 4.5, heights[0]);
    TEST_ASSERT_DOUBLE_WITHIN(halved, 4.5, heights[1]);
    TEST_ASSERT_TRUE(isinf(heights[2]) && heights[2] < 0);

    OK(pbmpm_ray_init(&ray, sizeof ray));
    TEST_ASSERT_TRUE(ray.level == 0.5f && ray.direction[1] == -1.0f && ray.max_distance == 1e9f);
    ray.level = 0.09375f;
    ray.origin[0] = 3;
    ray.origin[1] = 10;
    OK(pbmpm_query_ray(world, &ray, &hit));
    TEST_ASSERT_EQUAL_INT32(1, hit.hit);
    TEST_ASSERT_DOUBLE_WITHIN(halved, 5.5, hit.distance);
    TEST_ASSERT_DOUBLE_WITHIN(halved, 4.5, hit.position[1]);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, hit.normal[0]);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, hit.normal[1]);
    const pbmpm_view ids = view_of(world, PBMPM_PARTICLE);
    TEST_ASSERT_TRUE(hit.particle.index == view_uint(&ids, 0, 0) && hit.particle.generation == view_uint(&ids, 0, 1));
    pbmpm_material_def material = {.size = sizeof material};
    OK(pbmpm_material_get(world, hit.material, &material));

    ray.max_distance = 5.25f; /* ends before */
    OK(pbmpm_query_ray(world, &ray, &hit));
    TEST_ASSERT_EQUAL_INT32(0, hit.hit);
    TEST_ASSERT_TRUE(hit.distance == 0.0f && hit.particle.generation == 0 && hit.size == sizeof hit);
    ray.origin[1] = 4; /* begins in it */
    OK(pbmpm_query_ray(world, &ray, &hit));
    TEST_ASSERT_TRUE(hit.hit == 1 && hit.distance == 0.0f && hit.normal[1] == 0.0f);
}

static void test_region_of_a_single_particle(void)
{
    const pbmpm_world_id world = single(NULL);
    const pbmpm_shape around = sphere_shape(3, 4, 0, 0.5f), beside = sphere_shape(5, 4, 0, 1.5f);
    pbmpm_region_share share = {.size = sizeof share, .count = 99};
    uint32_t count = 99;
    OK(pbmpm_query_region(world, &around, &share, 1, &count));
    TEST_ASSERT_EQUAL_UINT32(1, count);
    TEST_ASSERT_EQUAL_UINT64(1, share.count);
    TEST_ASSERT_TRUE(share.mass == 250.0 && share.volume == 0.25 && share.rest_volume == 0.25);
    OK(pbmpm_query_region(world, &around, NULL, 0, &count));
    TEST_ASSERT_EQUAL_UINT32(1, count);
    OK(pbmpm_query_region(world, &beside, &share, 1, &count));
    TEST_ASSERT_EQUAL_UINT32(0, count);
}

/* More particles near a point than the short list of a line has room for: the answer is that of the points. */
static void test_crowds(void)
{
    enum { CROWD = 5000 };
    static float positions[2 * CROWD];
    const pbmpm_world_def def = default_world(2, 1.0f, CROWD);
    const pbmpm_world_id world = create_world(&def);
    pbmpm_particles_def many;
    uint32_t stream = 9;
    OK(pbmpm_particles_def_init(&many, sizeof many));
    many.material = create_material(world, PBMPM_LIQUID);
    many.count = CROWD;
    many.positions = positions;
    many.volume = 0.001f;
    for (int i = 0; i < 2 * CROWD; i++)
        positions[i] = random_float(&stream, 0, 1);
    OK(pbmpm_particles_add(world, &many, NULL));
    pbmpm_ray ray;
    pbmpm_ray_hit hit = {.size = sizeof hit};
    float filling[2];
    OK(pbmpm_ray_init(&ray, sizeof ray));
    ray.origin[0] = 0.5f;
    ray.origin[1] = 9;
    OK(pbmpm_query_ray(world, &ray, &hit));
    TEST_ASSERT_EQUAL_INT32(1, hit.hit);
    const float around[4] = {0.5f, hit.position[1], 0.5f, hit.position[1] + 2 * 0.25f / 4096};
    OK(pbmpm_query_points(world, around, 2, filling, NULL, NULL));
    TEST_ASSERT_TRUE(filling[0] >= 0.49999f && filling[1] < 0.5f);
}

/* ---- bad arguments ---- */

static pbmpm_result use_ray(const void *structure)
{
    pbmpm_ray_hit hit = {.size = sizeof hit};
    return pbmpm_query_ray(good.world, structure, &hit);
}

static void test_bounds_of_rays(void)
{
    static const rule rules[] = {
        {.name = "level", .type = FLOAT32, .offset = offsetof(pbmpm_ray, level), .low = 0, .low_open = true, .high = 100},
        {.name = "origin[0]", .type = FLOAT32, .offset = offsetof(pbmpm_ray, origin), .low = -INFINITY, .high = INFINITY},
        {.name = "direction[1]", .type = FLOAT32, .offset = offsetof(pbmpm_ray, direction) + 4, .low = -INFINITY, .high = INFINITY},
        {.name = "max_distance", .type = FLOAT32, .offset = offsetof(pbmpm_ray, max_distance), .low = 0, .high = 1e9},
    };
    pbmpm_ray ray;
    rules_set_up();
    OK(pbmpm_ray_init(&ray, sizeof ray));
    check_rules(rules, sizeof rules / sizeof *rules, &ray, sizeof ray, use_ray);
}

static void test_nulls_and_sizes(void)
{
    const pbmpm_world_id world = single(NULL);
    const float point[2] = {0, 0};
    float height;
    uint32_t count;
    pbmpm_ray ray;
    pbmpm_ray_hit hit = {.size = sizeof hit};
    pbmpm_shape shape;
    OK(pbmpm_ray_init(&ray, sizeof ray));
    OK(pbmpm_shape_init(&shape, sizeof shape));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_ray_init(NULL, sizeof ray));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_ray_init(&ray, sizeof ray - 1));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_query_ray(world, NULL, &hit));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_query_ray(world, &ray, NULL));
    hit.size = 1;
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_query_ray(world, &ray, &hit));
    hit.size = sizeof hit;
    ray.size--;
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_query_ray(world, &ray, &hit));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_query_points(world, NULL, 1, &height, NULL, NULL));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_query_heights(world, NULL, 1, point, 0.5f, &height));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_query_heights(world, point, 1, NULL, 0.5f, &height)); /* no gravity */
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_query_heights(world, point, 1, point, 0.5f, &height)); /* no direction */
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_query_heights(world, point, 1, (const float[2]){0, 1}, 0.5f, NULL));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_query_region(world, NULL, NULL, 0, &count));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_query_region(world, &shape, NULL, 1, &count));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_query_region(world, &shape, NULL, 0, NULL));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_snapshot_size(world, NULL, NULL));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_snapshot_save(world, NULL, 100, NULL));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_snapshot_restore(world, NULL, 100, 0));
}

/* ---- memory ---- */

static void test_without_memory_a_query_says_so(void)
{
    static ledger book;
    const pbmpm_shape shape = sphere_shape(3, 4, 0, 0.5f);
    const float point[2] = {3, 4};
    float filling = -1;
    uint32_t count = 0;
    book = (ledger){0};
    const pbmpm_world_id world = single(&book);
    book.fail_at = book.calls + 1;
    EXPECT(PBMPM_ERROR_OUT_OF_MEMORY, pbmpm_query_points(world, point, 1, &filling, NULL, NULL));
    book.fail_at = book.calls + 1;
    EXPECT(PBMPM_ERROR_OUT_OF_MEMORY, pbmpm_query_shape(world, &shape, NULL, 0, &count));
    OK(pbmpm_query_shape(world, &shape, NULL, 0, &count));
    TEST_ASSERT_EQUAL_UINT32(1, count);
    OK(pbmpm_world_destroy(world));
    ledger_expect_clean(&book, "after queries");
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_fields_of_a_single_particle);
    RUN_TEST(test_height_and_ray_of_a_single_particle);
    RUN_TEST(test_region_of_a_single_particle);
    RUN_TEST(test_crowds);
    RUN_TEST(test_bounds_of_rays);
    RUN_TEST(test_nulls_and_sizes);
    RUN_TEST(test_without_memory_a_query_says_so);
    return UNITY_END();
}

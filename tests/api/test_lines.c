/* Lines that hosts draw: each is where the thing is that it shows. */
#include <math.h>
#include <string.h>

#include "scenes.h"
#include "solids.h"

enum { ROOM = 1 << 16 };

static pbmpm_line lines[ROOM];

void setUp(void) {}
void tearDown(void)
{
    bake_forget();
    pbmpm_shutdown();
}

static uint32_t draw(pbmpm_world_id world, uint32_t parts)
{
    uint32_t count;
    memset(lines, 0xA5, sizeof lines);
    OK(pbmpm_world_debug_lines(world, parts, lines, ROOM, &count));
    TEST_ASSERT_TRUE(count <= ROOM);
    return count;
}

static pbmpm_world_id empty(int32_t dimension)
{
    const pbmpm_world_def def = default_world(dimension, 0.1f, 1000);
    return create_world(&def);
}

/* Ends and middles of all lines are this near to the surface; what the lines are long in all. */
static double check_on_surface(uint32_t count, double (*distance)(const double point[3]), double near)
{
    double length = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        double square = 0.0;
        for (int k = 0; k <= 2; k++) {
            double point[3];
            for (int a = 0; a < 3; a++) point[a] = (double)lines[i].from[a] + 0.5 * k * (double)(lines[i].to[a] - lines[i].from[a]);
            TEST_ASSERT_DOUBLE_WITHIN(near, 0.0, distance(point));
        }
        for (int a = 0; a < 3; a++) square += (double)(lines[i].to[a] - lines[i].from[a]) * (double)(lines[i].to[a] - lines[i].from[a]);
        TEST_ASSERT_EQUAL_INT(PBMPM_DEBUG_COLLIDERS, lines[i].part);
        length += sqrt(square);
    }
    return length;
}

static double from_ball(const double p[3]) { return sqrt((p[0] - 1) * (p[0] - 1) + (p[1] - 2) * (p[1] - 2) + p[2] * p[2]) - 0.5; }

static void test_a_ball_is_three_circles(void)
{
    const double sag = 0.5 * (1.0 - cos(3.141592653589793 / 24));
    for (int32_t dimension = 2; dimension <= 3; dimension++) {
        const pbmpm_world_id world = empty(dimension);
        create_collider(world, sphere_shape(1, 2, 0, 0.5f), false);
        const double length = check_on_surface(draw(world, PBMPM_DEBUG_ALL), from_ball, 1.01 * sag);
        TEST_ASSERT_DOUBLE_WITHIN(0.01, (dimension == 2 ? 1 : 3) * 3.141592653589793 / length, 1.0);
    }
}

static double from_box(const double p[3])
{
    /* turned by a right angle about z: 0.3 wide, 0.4 high */
    const double x = fabs(p[0]) - 0.15, y = fabs(p[1] - 1) - 0.2, z = fabs(p[2]) - 0.25;
    return fmax(x, fmax(y, z));
}

static void test_a_box_has_its_edges(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++) {
        const pbmpm_world_id world = empty(dimension);
        pbmpm_shape box = box_shape(0, 1, 0, 0.2f, 0.15f, 0.25f);
        box.rotation[2] = box.rotation[3] = 0.70710678f;
        create_collider(world, box, false);
        const uint32_t count = draw(world, PBMPM_DEBUG_COLLIDERS);
        TEST_ASSERT_EQUAL_UINT32(dimension == 2 ? 4 : 12, count);
        const double length = check_on_surface(count, from_box, 1e-6);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, dimension == 2 ? 1.4 : 4 * (0.3 + 0.4 + 0.5), length);
    }
}

static double from_capsule(const double p[3])
{
    const double beyond = fmax(fabs(p[0]) - 0.5, 0.0);
    return sqrt(beyond * beyond + p[1] * p[1] + p[2] * p[2]) - 0.25;
}

static void test_a_capsule_is_round_at_its_ends(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++) {
        const pbmpm_world_id world = empty(dimension);
        pbmpm_shape capsule = default_shape();
        capsule.kind = PBMPM_CAPSULE;
        capsule.radius = 0.25f;
        create_collider(world, capsule, false);
        const double circle = 3.141592653589793 * 0.5;
        const double length = check_on_surface(draw(world, PBMPM_DEBUG_COLLIDERS), from_capsule, 0.01 * 0.25);
        TEST_ASSERT_DOUBLE_WITHIN(0.03, dimension == 2 ? 2 + circle : 2 * (2 + circle) + 2 * circle, length);
    }
}

static double from_plane(const double p[3]) { return (0.6 * (p[0] - 1) + 0.8 * (p[1] + 1)); }

static void test_a_plane_is_a_square_in_it(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++) {
        const pbmpm_world_id world = empty(dimension);
        create_collider(world, plane_shape(1, -1, 0, 3, 4, 0), false);
        const double length = check_on_surface(draw(world, PBMPM_DEBUG_COLLIDERS), from_plane, 1e-6);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, dimension == 2 ? 2.0 : 8.0, length);
    }
}

static double from_baked(const double p[3])
{
    return sqrt((p[0] - 0.5) * (p[0] - 0.5) + p[1] * p[1] + p[2] * p[2]) - 0.35;
}

static void test_contours_of_a_baked_solid_lie_on_it(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++) {
        const pbmpm_world_id world = empty(dimension);
        bake_ball(dimension, 0.35);
        create_collider(world, baked_shape(load_baked(world), 0.5f, 0, 0), false);
        const uint32_t count = draw(world, PBMPM_DEBUG_COLLIDERS);
        TEST_ASSERT_TRUE(count > 20);
        const double length = check_on_surface(count, from_baked, 0.02);
        TEST_ASSERT_TRUE(length > 0.95 * 2 * 3.141592653589793 * 0.35);
        if (dimension == 2) TEST_ASSERT_TRUE(length < 1.01 * 2 * 3.141592653589793 * 0.35);
        bake_forget();
    }
}

static void test_open_walls_are_not_drawn(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    TEST_ASSERT_EQUAL_UINT32(4, draw(world, PBMPM_DEBUG_DOMAIN));
    pbmpm_domain_wall wall = {.size = sizeof wall};
    OK(pbmpm_domain_wall_get(world, 1, 1, &wall));
    wall.open = 1;
    OK(pbmpm_domain_wall_set(world, 1, 1, &wall));
    const uint32_t count = draw(world, PBMPM_DEBUG_DOMAIN);
    TEST_ASSERT_EQUAL_UINT32(3, count);
    for (uint32_t i = 0; i < count; i++) TEST_ASSERT_FALSE(lines[i].from[1] == 1.0f && lines[i].to[1] == 1.0f);
    pbmpm_world_def def = default_world(3, 0.1f, 10);
    def.domain_enabled = 1;
    TEST_ASSERT_EQUAL_UINT32(24, draw(create_world(&def), PBMPM_DEBUG_DOMAIN)); /* each face has four sides */
}

static bool is_within(const float *position, float low_x, float high_x, float low_y, float high_y)
{
    const float slack = 1e-5f;
    return position[0] > low_x - slack && position[0] < high_x + slack && position[1] > low_y - slack && position[1] < high_y + slack;
}

/* Every particle is in a block that is drawn, awake or asleep, and every block is four cells wide. */
static void check_blocks(pbmpm_world_id world, uint32_t parts, float width)
{
    const uint32_t count = draw(world, parts);
    const pbmpm_view position = view_of(world, PBMPM_POSITION);
    TEST_ASSERT_TRUE(count > 0 && count % 4 == 0);
    for (uint32_t row = 0; row < position.count; row++) {
        const float at[2] = {view_float(&position, row, 0), view_float(&position, row, 1)};
        bool found = false;
        for (uint32_t block = 0; block < count / 4 && !found; block++) {
            const pbmpm_line *bottom = &lines[4 * (size_t)block];
            TEST_ASSERT_FLOAT_WITHIN(1e-5f, width, bottom->to[0] - bottom->from[0]);
            found = is_within(at, bottom->from[0], bottom->to[0], bottom->from[1], bottom->from[1] + width);
        }
        TEST_ASSERT_TRUE(found);
    }
}

static void test_blocks_hold_the_particles(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    pbmpm_settings settings = {.size = sizeof settings};
    OK(pbmpm_world_get_settings(world, &settings));
    TEST_ASSERT_EQUAL_UINT32(0, draw(world, PBMPM_DEBUG_BLOCKS)); /* there was no step */
    settings.max_displacement = 0.1f; /* none leaves its block by more than rounding shows */
    settings.sleeping = 1;
    settings.sleep_speed = 1.0f;
    settings.sleep_time = 0.1f;
    OK(pbmpm_world_set_settings(world, &settings));
    for (int i = 0; i < 240; i++) OK(pbmpm_world_step(world, 1.0f / 60));
    TEST_ASSERT_EQUAL_UINT32(world_count(world), world_stats(world).particles_asleep);
    check_blocks(world, PBMPM_DEBUG_ASLEEP, 0.2f);
    OK(pbmpm_world_wake(world, NULL));
    OK(pbmpm_world_step(world, 1e-6f));
    TEST_ASSERT_EQUAL_UINT32(0, draw(world, PBMPM_DEBUG_ASLEEP));
    check_blocks(world, PBMPM_DEBUG_BLOCKS, 0.2f);
}

static void test_parts_are_chosen_and_all_are_all(void)
{
    uint32_t sum = 0, count;
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    create_collider(world, sphere_shape(1, 1, 0, 0.25f), false);
    create_emitter(world, water);
    create_drain(world, sphere_shape(1, 1, 0, 0.25f));
    create_force(world); /* switched off: not drawn */
    pbmpm_force_def wind;
    pbmpm_force_id force;
    const pbmpm_shape box = default_shape();
    OK(pbmpm_force_def_init(&wind, sizeof wind));
    OK(pbmpm_force_create(world, &wind, &box, &force));
    pbmpm_kill_bounds bounds;
    OK(pbmpm_kill_bounds_init(&bounds, sizeof bounds));
    bounds.enabled = 1;
    OK(pbmpm_world_set_kill_bounds(world, &bounds));
    OK(pbmpm_world_step(world, 0.01f));
    for (uint32_t part = 1; part < PBMPM_DEBUG_ALL; part *= 2) {
        const uint32_t found = draw(world, part);
        for (uint32_t i = 0; i < found; i++) TEST_ASSERT_EQUAL_UINT32(part, lines[i].part);
        if (part == PBMPM_DEBUG_FORCES || part == PBMPM_DEBUG_KILL_BOUNDS) TEST_ASSERT_EQUAL_UINT32(4, found);
        if (part != PBMPM_DEBUG_ASLEEP) TEST_ASSERT_TRUE(found >= 4);
        sum += found;
    }
    TEST_ASSERT_EQUAL_UINT32(sum, draw(world, PBMPM_DEBUG_ALL));
    OK(pbmpm_world_debug_lines(world, PBMPM_DEBUG_ALL, NULL, 0, &count));
    TEST_ASSERT_EQUAL_UINT32(sum, count);
    memset(lines, 0xA5, sizeof lines);
    pbmpm_line untouched = lines[3];
    OK(pbmpm_world_debug_lines(world, PBMPM_DEBUG_ALL, lines, 3, &count));
    TEST_ASSERT_EQUAL_UINT32(sum, count);
    TEST_ASSERT_EQUAL_MEMORY(&untouched, &lines[3], sizeof untouched);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_debug_lines(world, 256, lines, 3, &count));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_debug_lines(world, 1, NULL, 3, &count));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_debug_lines(world, 1, lines, 3, NULL));
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_a_ball_is_three_circles);
    RUN_TEST(test_a_box_has_its_edges);
    RUN_TEST(test_a_capsule_is_round_at_its_ends);
    RUN_TEST(test_a_plane_is_a_square_in_it);
    RUN_TEST(test_contours_of_a_baked_solid_lie_on_it);
    RUN_TEST(test_open_walls_are_not_drawn);
    RUN_TEST(test_blocks_hold_the_particles);
    RUN_TEST(test_parts_are_chosen_and_all_are_all);
    return UNITY_END();
}

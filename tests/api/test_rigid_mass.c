/* What a rigid body is told of its shape: its mass, and how much of it is under matter. */
#include <math.h>
#include <stdio.h>

#include "rigid.h"
#include "solids.h"

void setUp(void) {}

void tearDown(void)
{
    bake_forget();
    pbmpm_shutdown();
}

/* ---- Mass ---- */

static pbmpm_shape capsule_shape(float half_length, float radius)
{
    pbmpm_shape shape = default_shape();
    shape.kind = PBMPM_CAPSULE;
    shape.half_extents[0] = half_length;
    shape.radius = radius;
    return shape;
}

static void test_masses_have_formulas(void)
{
    const pbmpm_world_id deep = empty_world(3, 0.1f), flat = empty_world(2, 0.1f);
    const pbmpm_mass_properties box = mass_of(deep, box_shape(1, 2, 3, 0.5f, 1.0f, 2.0f), 100.0f);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 800.0, box.mass);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 800.0 / 3 * (1 + 4), box.inertia[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 800.0 / 3 * (0.25 + 4), box.inertia[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 800.0 / 3 * (0.25 + 1), box.inertia[2]);
    const pbmpm_mass_properties ball = mass_of(deep, sphere_shape(0, 0, 0, 0.5f), 8.0f);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 8.0 * 4 / 3 * PI / 8, ball.mass);
    for (int a = 0; a < 3; a++) TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.4 * ball.mass / 4, ball.inertia[a]);
    const pbmpm_mass_properties disc = mass_of(flat, sphere_shape(0, 0, 0, 0.5f), 8.0f);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2 * PI, disc.mass);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5 * disc.mass / 4, disc.inertia[2]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, disc.inertia[0]);
}

/* Sums over a lattice, which know nothing of the formulas. */
static void test_the_mass_of_a_capsule_is_that_of_its_points(void)
{
    const double a = 0.6, r = 0.4;
    for (int32_t dimension = 2; dimension <= 3; dimension++) {
        const int N = dimension == 2 ? 1000 : 120;
        const double h = 2 * (a + r) / N;
        const pbmpm_mass_properties mass = mass_of(empty_world(dimension, 0.1f), capsule_shape(0.6f, 0.4f), 10.0f);
        double volume = 0, moment[3] = {0};
        for (int i = 0; i < N; i++)
            for (int j = 0; j < N; j++)
                for (int k = 0; k < (dimension == 3 ? N : 1); k++) {
                    const double x = (i + 0.5) * h - a - r, y = (j + 0.5) * h - a - r, z = dimension == 3 ? (k + 0.5) * h - a - r : 0.0;
                    const double over = fmax(0.0, fabs(x) - a);
                    if (over * over + y * y + z * z > r * r) continue;
                    const double cell = dimension == 3 ? h * h * h : h * h;
                    volume += cell;
                    moment[0] += cell * (y * y + z * z);
                    moment[1] += cell * (x * x + z * z);
                    moment[2] += cell * (x * x + y * y);
                }
        TEST_ASSERT_DOUBLE_WITHIN(4e-3 * volume, volume, mass.volume);
        for (int i = dimension == 2 ? 2 : 0; i < 3; i++) TEST_ASSERT_DOUBLE_WITHIN(5e-3 * 10 * moment[i], 10 * moment[i], mass.inertia[i]);
    }
}

static void bake_fine_ball(int32_t dimension, double radius)
{
    mesh_clear(&mesh, dimension);
    mesh_add_ball(&mesh, 0, 0, 0, radius, 64);
    bake_now(64);
}

static void test_a_baked_ball_weighs_what_a_ball_does(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++) {
        const pbmpm_world_id world = empty_world(dimension, 0.1f);
        bake_fine_ball(dimension, 0.5);
        const pbmpm_mass_properties found = mass_of(world, baked_shape(load_baked(world), 3, 4, 5), 10.0f);
        const pbmpm_mass_properties exact = mass_of(world, sphere_shape(0, 0, 0, 0.5f), 10.0f);
        TEST_ASSERT_DOUBLE_WITHIN(0.01 * exact.mass, exact.mass, found.mass);
        for (int a = 0; a < 3; a++) {
            TEST_ASSERT_DOUBLE_WITHIN(0.02 * exact.inertia[2], exact.inertia[a], found.inertia[a]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-3 * exact.inertia[2], 0.0, found.products[a]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.0, found.centre[a]);
        }
        bake_forget();
    }
}

/* ---- What is under matter ---- */

enum { WIDE = 20 }; /* cells of a tank */
static const float DX = 0.1f;

/* A tank with liquid up to a level around an obstacle; `low` floor at 0. */
static pbmpm_world_id tank_around(int32_t dimension, float level, pbmpm_shape shape, pbmpm_collider_id *collider)
{
    pbmpm_world_def def = default_world(dimension, DX, 60000);
    def.domain_enabled = 1;
    for (int a = 0; a < dimension; a++) def.domain_max[a] = WIDE * DX;
    const pbmpm_world_id world = create_world(&def);
    if (shape.kind == PBMPM_BAKED) {
        bake_fine_ball(dimension, (double)shape.radius);
        shape.baked = load_baked(world);
        bake_forget();
    }
    *collider = create_collider(world, shape, true);
    const float half = WIDE * DX / 2;
    if (level > 0) fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(half, level / 2, half, half, level / 2, half), STILL);
    return world;
}

static bool is_inside(const pbmpm_shape *shape, const double x[3])
{
    const double c = cos(2 * asin((double)shape->rotation[2])), s = sin(2 * asin((double)shape->rotation[2]));
    const double dx = x[0] - (double)shape->position[0], dy = x[1] - (double)shape->position[1], dz = x[2] - (double)shape->position[2];
    const double along = c * dx + s * dy, up = c * dy - s * dx;
    if (shape->kind != PBMPM_BOX) return dx * dx + dy * dy + dz * dz < (double)shape->radius * (double)shape->radius;
    return fabs(along) < (double)shape->half_extents[0] && fabs(up) < (double)shape->half_extents[1] && fabs(dz) < (double)shape->half_extents[2];
}

/* By counting points; `across`: the largest area of a level. */
static double volume_below(const pbmpm_shape *shape, int32_t dimension, double level, double *across, double *height)
{
    enum { N = 100 };
    const double h = WIDE * (double)DX / N;
    double volume = 0, moment = 0;
    *across = 0;
    for (int j = 0; j < N; j++) {
        double row = 0;
        const double y = (j + 0.5) * h;
        for (int i = 0; i < N; i++)
            for (int k = 0; k < (dimension == 3 ? N : 1); k++) {
                const double x[3] = {(i + 0.5) * h, y, dimension == 3 ? (k + 0.5) * h : 0.0};
                row += is_inside(shape, x) ? pow(h, dimension) : 0.0;
            }
        volume += y < level ? row : 0.0;
        moment += y < level ? row * y : 0.0;
        *across = fmax(*across, row / h);
    }
    *height = volume > 0 ? moment / volume : 0.0;
    return volume;
}

static pbmpm_submersion under(pbmpm_world_id world, pbmpm_collider_id collider)
{
    pbmpm_submersion found = {.size = sizeof found};
    OK(pbmpm_collider_submerged(world, collider, NULL, &found));
    return found;
}

static void expect_submerged(int32_t dimension, pbmpm_shape shape, float level, double cells)
{
    pbmpm_collider_id collider;
    if (dimension == 2) shape.position[2] = 0;
    pbmpm_shape same = shape;
    if (shape.kind == PBMPM_BAKED) same.kind = PBMPM_SPHERE;
    double across, height;
    const pbmpm_world_id world = tank_around(dimension, level, shape, &collider);
    const double exact = volume_below(&same, dimension, (double)level, &across, &height), all = volume_below(&same, dimension, 1e9, &(double){0}, &(double){0});
    const pbmpm_submersion found = under(world, collider);
    char label[160];
    snprintf(label, sizeof label, "%dD, kind %d, level %g: %g, not %g; centre at %g, not %g", (int)dimension, (int)shape.kind, (double)level, found.volume, exact,
             found.centre[1], height);
    TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(cells * (double)DX * across, exact, found.volume, label);
    if (exact > 0.3 * all) {
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(cells * (double)DX, height, found.centre[1], label);
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(0.4 * (double)DX, (double)shape.position[0], found.centre[0], label);
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-3, 1000.0, found.density, label);
    }
    OK(pbmpm_world_destroy(world));
}

static void test_what_is_under_matter(void)
{
    static const float levels[] = {0.2f, 0.7f, 0.85f, 1.0f, 1.15f, 1.3f, 1.9f}; /* the shapes reach from 0.6 to 1.4 or so */
    for (int32_t dimension = 2; dimension <= 3; dimension++)
        for (size_t i = 0; i < sizeof levels / sizeof *levels; i++) {
            const pbmpm_shape box = box_shape(1.03f, 1, 1, 0.4f, 0.4f, 0.4f);
            pbmpm_shape turned = box, baked_one = sphere_shape(1, 1.02f, 1, 0.4f);
            turned.rotation[2] = sinf(0.3f);
            turned.rotation[3] = cosf(0.3f);
            baked_one.kind = PBMPM_BAKED;
            expect_submerged(dimension, box, levels[i], 0.4);
            expect_submerged(dimension, turned, levels[i], 0.4);
            expect_submerged(dimension, sphere_shape(1.03f, 1, 1, 0.4f), levels[i], 0.4);
            expect_submerged(dimension, baked_one, levels[i], 0.4);
            expect_submerged(dimension, box_shape(1.03f, 0.4f, 1, 0.4f, 0.4f, 0.4f), levels[i], 0.8); /* on the floor */
        }
}

static void test_a_material_alone_counts(void)
{
    pbmpm_collider_id collider;
    const pbmpm_world_id world = tank_around(2, 1.0f, box_shape(1, 1, 0, 0.4f, 0.4f, 0.4f), &collider);
    const pbmpm_material_id other = create_material(world, PBMPM_ELASTIC);
    pbmpm_submersion found = {.size = sizeof found};
    OK(pbmpm_collider_submerged(world, collider, &other, &found));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, found.share);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, found.density);
    TEST_ASSERT_TRUE(under(world, collider).share > 0.4);
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_collider_submerged(world, collider, &(pbmpm_material_id){7, 7}, &found));
}

static void test_planes_have_no_inside(void)
{
    const pbmpm_world_id world = empty_world(2, 0.1f);
    const pbmpm_collider_id plane = create_collider(world, plane_shape(0, 0, 0, 0, 1, 0), false);
    const pbmpm_shape shape = plane_shape(0, 0, 0, 0, 1, 0);
    pbmpm_submersion found = {.size = sizeof found};
    pbmpm_mass_properties mass = {.size = sizeof mass};
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_submerged(world, plane, NULL, &found));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_shape_mass(world, &shape, 1.0f, &mass));
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_masses_have_formulas);
    RUN_TEST(test_the_mass_of_a_capsule_is_that_of_its_points);
    RUN_TEST(test_a_baked_ball_weighs_what_a_ball_does);
    RUN_TEST(test_what_is_under_matter);
    RUN_TEST(test_a_material_alone_counts);
    RUN_TEST(test_planes_have_no_inside);
    return UNITY_END();
}

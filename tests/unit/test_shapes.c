/* Shapes: signed distances against the nearest of many points on the surface, normals against the gradient. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unity.h>

#include "random.h"
#include "shape/shapes.h"

void setUp(void) {}
void tearDown(void) {}

static pbmpm_shape shape_of(pbmpm_shape_kind kind, int dimension, Random *random)
{
    pbmpm_shape shape = shape_defaults();
    double length;
    shape.kind = kind;
    do {
        length = 0.0;
        for (int a = 0; a < 4; a++) {
            shape.rotation[a] = dimension == 3 || a >= 2 ? (float)random_in(random, -1.0, 1.0) : 0.0f;
            length += (double)shape.rotation[a] * (double)shape.rotation[a];
        }
    } while (length < 0.3 || length > 3.0);
    for (int a = 0; a < 3; a++) {
        shape.position[a] = (float)random_in(random, -2.0, 2.0);
        shape.half_extents[a] = (float)random_in(random, 0.2, 1.5);
        shape.normal[a] = (float)random_in(random, -3.0, 3.0) + 4.0f;
    }
    shape.radius = (float)random_in(random, 0.2, 1.0);
    TEST_ASSERT_NULL(shape_problem(&shape, dimension));
    return shape;
}

/* v turned by a quaternion: q v q*, written out with cross products, v + 2 w (u x v) + 2 u x (u x v). */
static void turn(const float q[4], const double v[3], double o[3])
{
    const double n = sqrt((double)q[0] * q[0] + (double)q[1] * q[1] + (double)q[2] * q[2] + (double)q[3] * q[3]);
    const double u[3] = {q[0] / n, q[1] / n, q[2] / n}, w = q[3] / n;
    const double c[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double cc[3] = {u[1] * c[2] - u[2] * c[1], u[2] * c[0] - u[0] * c[2], u[0] * c[1] - u[1] * c[0]};
    for (int a = 0; a < 3; a++) o[a] = v[a] + 2.0 * w * c[a] + 2.0 * cc[a];
}

/* A random point on the surface, in local axes. */
static void local_surface_point(const pbmpm_shape *shape, int d, Random *random, double o[3])
{
    double direction[3] = {0}, length = 0.0;
    do {
        random_array(random, direction, d, -1.0, 1.0);
        length = sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]);
    } while (length > 1.0 || length < 1e-3);
    memset(o, 0, 3 * sizeof *o);
    if (shape->kind == PBMPM_BOX) {
        const uint32_t face = random_below(random, (uint32_t)d);
        for (int a = 0; a < d; a++) o[a] = random_in(random, -1.0, 1.0) * shape->half_extents[a];
        o[face] = copysign((double)shape->half_extents[face], o[face]);
        return;
    }
    for (int a = 0; a < d; a++) o[a] = direction[a] / length * (double)shape->radius;
    if (shape->kind != PBMPM_CAPSULE) return;
    if (random_below(random, 2)) { /* the ends, and what is between them */
        o[0] += copysign((double)shape->half_extents[0], o[0]);
        return;
    }
    const double across = sqrt(o[1] * o[1] + o[2] * o[2]);
    for (int a = 1; a < d; a++) o[a] *= (double)shape->radius / fmax(across, 1e-9);
    o[0] = random_in(random, -1.0, 1.0) * (double)shape->half_extents[0];
}

/* Whether a point is inside, by the plain definition of each shape. */
static bool is_inside(const pbmpm_shape *shape, int d, const double local[3])
{
    double length2 = 0.0;
    bool in_box = true;
    for (int a = 0; a < d; a++) {
        const double along = shape->kind == PBMPM_CAPSULE && a == 0 ? fmax(fabs(local[0]) - (double)shape->half_extents[0], 0.0) : local[a];
        length2 += along * along;
        in_box &= fabs(local[a]) < (double)shape->half_extents[a];
    }
    return shape->kind == PBMPM_BOX ? in_box : length2 < (double)shape->radius * (double)shape->radius;
}

static void world_point(const pbmpm_shape *shape, const double local[3], double o[3])
{
    turn(shape->rotation, local, o);
    for (int a = 0; a < 3; a++) o[a] += (double)shape->position[a];
}

/* No point of the surface is nearer than the distance says, one is about as near, and the sign is right. */
static void check_distances(const pbmpm_shape *shape, int d, Random *random)
{
    enum { SURFACE = 4000, QUERIES = 20 };
    static double surface[SURFACE][3];
    const Solid solid = solid_of(shape, d);
    for (int i = 0; i < SURFACE; i++) {
        double local[3], normal[3];
        local_surface_point(shape, d, random, local);
        world_point(shape, local, surface[i]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.0, solid_distance(&solid, surface[i], normal));
    }
    for (int q = 0; q < QUERIES; q++) {
        double local[3] = {0}, point[3], normal[3], nearest = INFINITY;
        random_array(random, local, d, -2.5, 2.5);
        world_point(shape, local, point);
        for (int i = 0; i < SURFACE; i++) {
            double length2 = 0.0;
            for (int a = 0; a < d; a++) length2 += (point[a] - surface[i][a]) * (point[a] - surface[i][a]);
            nearest = fmin(nearest, sqrt(length2));
        }
        const double distance = solid_distance(&solid, point, normal);
        TEST_ASSERT_EQUAL_INT(is_inside(shape, d, local), distance < 0.0);
        TEST_ASSERT_TRUE(nearest >= fabs(distance) - 1e-6);
        TEST_ASSERT_TRUE(nearest <= fabs(distance) + 0.15); /* points are at most about this far apart */
    }
}

static void test_distances(void)
{
    Random random = {1};
    for (int d = 2; d <= 3; d++)
        for (int kind = PBMPM_BOX; kind <= PBMPM_CAPSULE; kind++)
            for (int i = 0; i < 10; i++) {
                const pbmpm_shape shape = shape_of((pbmpm_shape_kind)kind, d, &random);
                check_distances(&shape, d, &random);
            }
}

/* Off the ridges the normal is the gradient of the distance, of length 1, and leads to the surface. */
static void check_normals(const pbmpm_shape *shape, int d, Random *random)
{
    const double h = 1e-5;
    const Solid solid = solid_of(shape, d);
    int on_ridges = 0;
    for (int q = 0; q < 100; q++) {
        double point[3] = {0}, normal[3] = {7, 7, 7}, ignored[3], slope[3] = {0}, length = 0.0, foot[3] = {0};
        random_array(random, point, d, -3.0, 3.0);
        const double distance = solid_distance(&solid, point, normal);
        for (int a = 0; a < d; a++) {
            double ahead[3], behind[3];
            memcpy(ahead, point, sizeof ahead);
            memcpy(behind, point, sizeof behind);
            ahead[a] += h;
            behind[a] -= h;
            slope[a] = (solid_distance(&solid, ahead, ignored) - solid_distance(&solid, behind, ignored)) / (2.0 * h);
            length += slope[a] * slope[a];
            foot[a] = point[a] - distance * normal[a];
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        if (d == 2) TEST_ASSERT_TRUE(normal[2] == 0.0);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, solid_distance(&solid, foot, ignored));
        if (fabs(length - 1.0) > 1e-3) { /* two surface points are equally near */
            on_ridges++;
            continue;
        }
        for (int a = 0; a < d; a++) TEST_ASSERT_DOUBLE_WITHIN(1e-3, slope[a], normal[a]);
    }
    TEST_ASSERT_TRUE(on_ridges <= 2);
}

static void test_normals(void)
{
    Random random = {2};
    for (int d = 2; d <= 3; d++)
        for (int kind = PBMPM_PLANE; kind <= PBMPM_CAPSULE; kind++)
            for (int i = 0; i < 10; i++) {
                const pbmpm_shape shape = shape_of((pbmpm_shape_kind)kind, d, &random);
                check_normals(&shape, d, &random);
            }
}

static void test_planes(void)
{
    Random random = {3};
    for (int d = 2; d <= 3; d++)
        for (int i = 0; i < 50; i++) {
            const pbmpm_shape shape = shape_of(PBMPM_PLANE, d, &random);
            const Solid solid = solid_of(&shape, d);
            double local[3] = {0}, normal[3], expected[3], point[3] = {0}, distance = 0.0;
            double length = 0.0;
            for (int a = 0; a < d; a++) {
                local[a] = (double)shape.normal[a];
                length += local[a] * local[a];
            }
            for (int a = 0; a < d; a++) local[a] /= sqrt(length);
            turn(shape.rotation, local, expected);
            random_array(&random, point, d, -5.0, 5.0);
            for (int a = 0; a < d; a++) distance += (point[a] - (double)shape.position[a]) * expected[a];
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, distance, solid_distance(&solid, point, normal));
            for (int a = 0; a < d; a++) TEST_ASSERT_DOUBLE_WITHIN(1e-9, expected[a], normal[a]);
        }
}

/* Centres and axes, where every direction is as good: still a unit normal that leads to the surface. */
static void test_centres(void)
{
    for (int d = 2; d <= 3; d++)
        for (int kind = PBMPM_BOX; kind <= PBMPM_CAPSULE; kind++) {
            pbmpm_shape shape = shape_defaults();
            shape.kind = (pbmpm_shape_kind)kind;
            const Solid solid = solid_of(&shape, d);
            const double centre[3] = {0};
            double normal[3], foot[3] = {0}, ignored[3];
            const double distance = solid_distance(&solid, centre, normal);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.5, distance);
            for (int a = 0; a < d; a++) foot[a] = -distance * normal[a];
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, solid_distance(&solid, foot, ignored));
        }
}

/* Of the faces within reach of a point in a box, one per axis, all but the nearest; none of a point outside, and none of other shapes. */
static void check_other_faces(const pbmpm_shape *shape, int d, Random *random)
{
    const Solid solid = solid_of(shape, d);
    const double reach = random_in(random, 0.1, 1.0);
    double local[3] = {0}, point[3], depth[3], found[2][3];
    int nearest = 0, expected = 0;
    for (int a = 0; a < d; a++) {
        local[a] = random_in(random, -1.05, 1.05) * (double)shape->half_extents[a];
        depth[a] = (double)shape->half_extents[a] - fabs(local[a]);
        if (depth[a] < depth[nearest]) nearest = a;
    }
    world_point(shape, local, point);
    const int count = solid_other_faces(&solid, point, reach, found);
    for (int a = 0; a < d && depth[nearest] >= 0.0 && shape->kind == PBMPM_BOX; a++) {
        double axis[3] = {0}, normal[3];
        if (a == nearest || depth[a] > reach) continue;
        axis[a] = copysign(1.0, local[a]);
        turn(shape->rotation, axis, normal);
        TEST_ASSERT_TRUE(expected < count);
        for (int b = 0; b < 3; b++) TEST_ASSERT_DOUBLE_WITHIN(1e-6, normal[b], found[expected][b]);
        expected++;
    }
    TEST_ASSERT_EQUAL_INT(expected, count);
}

static void test_other_faces(void)
{
    Random random = {17};
    for (int d = 2; d <= 3; d++)
        for (int kind = PBMPM_BOX; kind <= PBMPM_CAPSULE; kind++)
            for (int i = 0; i < 500; i++) {
                const pbmpm_shape shape = shape_of((pbmpm_shape_kind)kind, d, &random);
                check_other_faces(&shape, d, &random);
            }
}

/* The box around a shape holds it and is touched on every side. */
static void check_bounds(const pbmpm_shape *shape, int d, Random *random)
{
    const Solid solid = solid_of(shape, d);
    double low[3], high[3], lowest[3], highest[3];
    solid_bounds(&solid, low, high);
    for (int a = 0; a < 3; a++) {
        lowest[a] = INFINITY;
        highest[a] = -INFINITY;
    }
    for (int i = 0; i < 4000; i++) {
        double local[3], point[3];
        local_surface_point(shape, d, random, local);
        if (shape->kind == PBMPM_BOX && i < 1 << d) /* its corners */
            for (int a = 0; a < d; a++) local[a] = (i >> a & 1 ? 1.0 : -1.0) * (double)shape->half_extents[a];
        world_point(shape, local, point);
        for (int a = 0; a < d; a++) {
            lowest[a] = fmin(lowest[a], point[a]);
            highest[a] = fmax(highest[a], point[a]);
        }
    }
    for (int a = 0; a < d; a++) {
        TEST_ASSERT_TRUE(low[a] <= lowest[a] + 1e-6 && high[a] >= highest[a] - 1e-6);
        TEST_ASSERT_DOUBLE_WITHIN(0.05, lowest[a], low[a]);
        TEST_ASSERT_DOUBLE_WITHIN(0.05, highest[a], high[a]);
    }
}

static void test_bounds(void)
{
    Random random = {4};
    for (int d = 2; d <= 3; d++)
        for (int kind = PBMPM_BOX; kind <= PBMPM_CAPSULE; kind++)
            for (int i = 0; i < 10; i++) {
                const pbmpm_shape shape = shape_of((pbmpm_shape_kind)kind, d, &random);
                check_bounds(&shape, d, &random);
            }
}

static void test_rotations(void)
{
    Random random = {5};
    for (int i = 0; i < 100; i++) {
        const pbmpm_shape shape = shape_of(PBMPM_BOX, 3, &random);
        double r[9];
        const double q[4] = {shape.rotation[0], shape.rotation[1], shape.rotation[2], shape.rotation[3]};
        rotation_from_quaternion(q, r);
        for (int c = 0; c < 3; c++) {
            const double axis[3] = {c == 0, c == 1, c == 2};
            double turned[3];
            turn(shape.rotation, axis, turned);
            for (int a = 0; a < 3; a++) TEST_ASSERT_DOUBLE_WITHIN(1e-12, turned[a], r[a * 3 + c]);
        }
    }
}

/* In 2D the documented quaternion of a turn by a is (0, 0, sin a/2, cos a/2). */
static void test_turn_in_the_plane(void)
{
    pbmpm_shape shape = shape_defaults();
    const double angle = 0.3;
    const double tip[3] = {0.5 * cos(angle), 0.5 * sin(angle), 0.0};
    double normal[3];
    shape.half_extents[1] = 0.1f;
    shape.rotation[2] = (float)sin(angle / 2.0);
    shape.rotation[3] = (float)cos(angle / 2.0);
    const Solid solid = solid_of(&shape, 2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.0, solid_distance(&solid, tip, normal));
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, cos(angle), normal[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, sin(angle), normal[1]);
}

/* A kind is any number that the caller wrote there. */
static void test_unknown_kinds_are_refused(void)
{
    static const int32_t kinds[] = {-1, 5, 6, 1000, INT32_MAX, INT32_MIN};
    pbmpm_shape shape = shape_defaults();
    TEST_ASSERT_NULL(shape_problem(&shape, 2));
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        shape.kind = (pbmpm_shape_kind)kinds[i];
        TEST_ASSERT_EQUAL_STRING("shape.kind is unknown", shape_problem(&shape, 2));
        TEST_ASSERT_EQUAL_STRING("shape.kind is unknown", shape_problem(&shape, 3));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_unknown_kinds_are_refused);
    RUN_TEST(test_distances);
    RUN_TEST(test_other_faces);
    RUN_TEST(test_normals);
    RUN_TEST(test_planes);
    RUN_TEST(test_centres);
    RUN_TEST(test_bounds);
    RUN_TEST(test_rotations);
    RUN_TEST(test_turn_in_the_plane);
    return UNITY_END();
}

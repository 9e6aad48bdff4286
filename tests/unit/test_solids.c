/* Baked solids: distances against formulas, hulls, windings, meshes that are refused, ways that lead through, and stored
 * bytes that were changed. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "shape/bake.h"
#include "shape/tangent_planes.h"
#include "meshes.h"
#include "random.h"
#include "base/result.h"
#include "shape/shapes.h"

static Mesh mesh;

/* What the last bake made. */
static struct {
    void *data;
    uint64_t bytes;
    DistanceGrid grid;
    float *value;
} baked;

void setUp(void) {}

static void forget(void)
{
    free(baked.data);
    free(baked.value);
    memset(&baked, 0, sizeof baked);
}

void tearDown(void) { forget(); }

static void read_back(void)
{
    const void *values;
    TEST_ASSERT_EQUAL_INT_MESSAGE(PBMPM_OK, distance_grid_read(baked.data, baked.bytes, &baked.grid, &values), result_message());
    const size_t bytes = distance_grid_nodes(&baked.grid) * sizeof(float);
    baked.value = malloc(bytes);
    memcpy(baked.value, values, bytes);
    baked.grid.value = baked.value;
}

static void bake_def(const pbmpm_mesh_def *def, bool hull)
{
    forget();
    TEST_ASSERT_EQUAL_INT_MESSAGE(PBMPM_OK, bake_mesh(def, hull, NULL, 0, &baked.bytes), result_message());
    baked.data = malloc(baked.bytes);
    TEST_ASSERT_EQUAL_INT_MESSAGE(PBMPM_OK, bake_mesh(def, hull, baked.data, baked.bytes, &baked.bytes), result_message());
    read_back();
}

static void bake_now(int32_t resolution)
{
    const pbmpm_mesh_def def = mesh_def_of(&mesh, resolution);
    bake_def(&def, false);
}

static double at(double x, double y, double z)
{
    double normal[3];
    return distance_grid_at(&baked.grid, (const double[3]){x, y, z}, normal);
}

/* ---- Distances ---- */

/* The true distance, its gradient, and how far the point is from those that are equally near to several parts of the surface. */
typedef struct Truth {
    double distance, normal[3], apart;
} Truth;

typedef Truth TrueDistance(const double p[3]);

static double length(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

static Truth true_ball(const double p[3])
{
    const double r = length(p);
    return (Truth){r - 1.0, {p[0] / r, p[1] / r, p[2] / r}, r};
}

static const double RING = 1.0, TUBE = 0.4;

static Truth true_torus(const double p[3])
{
    const double around = hypot(p[0], p[2]), out = around - RING, tube = hypot(out, p[1]);
    return (Truth){tube - TUBE, {out / tube * p[0] / around, p[1] / tube, out / tube * p[2] / around}, fmin(tube, around)};
}

static const double HALF[3] = {1.0, 0.6, 0.45};

/* Outside the normal is unique; inside the two nearest faces must differ. */
static Truth true_box_of(const double p[3], int d)
{
    double outside[3] = {0}, first = -INFINITY, second = -INFINITY;
    int face = 0;
    for (int a = 0; a < d; a++) {
        const double over = fabs(p[a]) - HALF[a];
        outside[a] = fmax(over, 0.0);
        second = over > first ? first : fmax(second, over);
        face = over > first ? a : face;
        first = fmax(first, over);
    }
    Truth truth = {.distance = first, .apart = first - second};
    truth.normal[face] = p[face] < 0.0 ? -1.0 : 1.0;
    if (first <= 0.0) return truth;
    truth.distance = length(outside);
    truth.apart = INFINITY;
    for (int a = 0; a < d; a++) truth.normal[a] = copysign(outside[a], p[a]) / truth.distance;
    return truth;
}

static Truth true_box(const double p[3]) { return true_box_of(p, 3); }
static Truth true_rectangle(const double p[3]) { return true_box_of(p, 2); }

/* Under half a cell everywhere but within a cell of points that are equally near to several parts of the surface; there under half the
 * diagonal. Near a smooth surface normals are within 10 degrees. `outside`: also far from the grid, where less is known. */
static void check_distances(TrueDistance *truth_at, bool smooth)
{
    Random random = {5};
    const DistanceGrid *grid = &baked.grid;
    for (int i = 0; i < 40000; i++) {
        double p[3] = {0}, normal[3];
        for (int a = 0; a < grid->dimension; a++) p[a] = random_in(&random, grid->low[a], distance_grid_high(grid, a));
        const Truth truth = truth_at(p);
        const double error = fabs(distance_grid_at(grid, p, normal) - truth.distance) / grid->spacing;
        TEST_ASSERT_TRUE(error < (truth.apart > grid->spacing ? 0.5 : 0.51 * sqrt(grid->dimension))); /* 0.01: the search's slack */
        TEST_ASSERT_TRUE(distance_grid_least(grid, p) <= truth.distance + 0.01 * grid->spacing);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0, length(normal));
        const double along = normal[0] * truth.normal[0] + normal[1] * truth.normal[1] + normal[2] * truth.normal[2];
        if (smooth && fabs(truth.distance) < 2.0 * grid->spacing) TEST_ASSERT_TRUE(along > 0.985);
    }
}

/* Beyond the grid the distance is never too short, and the least never too long. */
static void check_far(TrueDistance *truth_at)
{
    Random random = {6};
    const DistanceGrid *grid = &baked.grid;
    for (int i = 0; i < 5000; i++) {
        double p[3] = {0}, normal[3];
        for (int a = 0; a < grid->dimension; a++) p[a] = random_in(&random, 5.0 * grid->low[a], 5.0 * distance_grid_high(grid, a));
        const double truth = truth_at(p).distance, found = distance_grid_at(grid, p, normal);
        TEST_ASSERT_TRUE(distance_grid_least(grid, p) <= truth + 0.01 * grid->spacing);
        if (truth > 0.0) TEST_ASSERT_TRUE(found > truth - 0.5 * grid->spacing && found < 1.2 * truth + grid->spacing);
    }
}

static void test_ball(void)
{
    for (int d = 2; d <= 3; d++) {
        mesh_clear(&mesh, d);
        mesh_add_ball(&mesh, 0, 0, 0, 1.0, 48);
        bake_now(31); /* odd: no node in the middle */
        check_distances(true_ball, true);
        check_far(true_ball);
    }
}

static void test_box(void)
{
    static const double centre[3] = {0};
    mesh_clear(&mesh, 3);
    mesh_add_box(&mesh, centre, HALF);
    bake_now(32);
    check_distances(true_box, false);
    check_far(true_box);
    mesh_clear(&mesh, 2);
    mesh_add_box(&mesh, centre, HALF);
    bake_now(33);
    check_distances(true_rectangle, false);
    check_far(true_rectangle);
}

static void test_torus(void)
{
    mesh_clear(&mesh, 3);
    mesh_add_torus(&mesh, RING, TUBE, 48);
    bake_now(40);
    check_distances(true_torus, true);
    check_far(true_torus);
    TEST_ASSERT_TRUE(at(0, 0, 0) > 0.5); /* the hole is open */
}

/* ---- Windings ---- */

/* The box around a solid that was turned and moved is the box around the corners of its grid. */
static void test_bounds_of_turned_solids(void)
{
    static const float turns[2][4] = {{0, 0, 0.6f, 0.8f}, {0.1f, -0.5f, 0.5f, 0.7f}};
    for (int d = 2; d <= 3; d++) {
        mesh_clear(&mesh, d);
        mesh_add_box(&mesh, (const double[3]){0.5, 0.25, -1}, (const double[3]){1, 0.5, 0.25});
        bake_now(16);
        Solid solid = {.kind = PBMPM_BAKED, .dimension = d, .position = {3, -2, d == 3 ? 5 : 0}, .grid = &baked.grid};
        float unit[4];
        double turn[4];
        memcpy(unit, turns[d - 2], sizeof unit);
        normalise_quaternion(unit);
        for (int i = 0; i < 4; i++) turn[i] = (double)unit[i];
        rotation_from_quaternion(turn, solid.rotation);
        double low[3], high[3], least[3], most[3];
        for (int corner = 0; corner < 1 << d; corner++)
            for (int a = 0; a < d; a++) {
                double at = solid.position[a];
                for (int b = 0; b < d; b++)
                    at += solid.rotation[a * 3 + b] * (corner >> b & 1 ? distance_grid_high(&baked.grid, b) : baked.grid.low[b]);
                least[a] = corner ? fmin(least[a], at) : at;
                most[a] = corner ? fmax(most[a], at) : at;
            }
        solid_bounds(&solid, low, high);
        for (int a = 0; a < d; a++) {
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, least[a], low[a]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, most[a], high[a]);
        }
    }
}

static void test_winding_inward_is_the_same_solid(void)
{
    for (int d = 2; d <= 3; d++) {
        static float first[100000];
        mesh_clear(&mesh, d);
        mesh_add_ball(&mesh, 0.3, -0.2, 0.1, 0.7, 8);
        bake_now(12);
        const size_t bytes = distance_grid_nodes(&baked.grid) * sizeof(float);
        TEST_ASSERT_TRUE(bytes <= sizeof first);
        memcpy(first, baked.value, bytes);
        mesh_turn_over(&mesh, 0);
        bake_now(12);
        for (size_t i = 0; i < bytes / sizeof(float); i++) { /* another order of elements: the search's slack */
            TEST_ASSERT_TRUE((first[i] < 0.0f) == (baked.value[i] < 0.0f));
            TEST_ASSERT_FLOAT_WITHIN(0.011f * (float)baked.grid.spacing, first[i], baked.value[i]);
        }
    }
}

static void test_parts_may_overlap(void)
{
    for (int d = 2; d <= 3; d++) {
        mesh_clear(&mesh, d);
        mesh_add_ball(&mesh, -0.4, 0, 0, 1.0, 16);
        mesh_add_ball(&mesh, 0.4, 0, 0, 1.0, 16);
        bake_now(32);
        TEST_ASSERT_TRUE(at(0, 0, 0) < -0.3 && at(-1.2, 0, 0) < 0.0 && at(1.2, 0, 0) < 0.0);
        TEST_ASSERT_TRUE(at(0, 1.05, 0) > 0.0 && at(1.5, 0, 0) > 0.0);
    }
}

static void test_hollows(void)
{
    for (int d = 2; d <= 3; d++) {
        mesh_clear(&mesh, d);
        mesh_add_ball(&mesh, 0, 0, 0, 1.0, 24);
        const uint32_t outer = mesh.elements;
        mesh_add_ball(&mesh, 0, 0, 0, 0.6, 24);
        mesh_turn_over(&mesh, outer);
        bake_now(32);
        TEST_ASSERT_TRUE(at(0, 0, 0) > 0.4 && at(0.8, 0, 0) < -0.1 && at(1.1, 0, 0) > 0.0);
    }
}

/* As exporters write it: vertices repeated, some that nobody uses, some triangles without area. */
static void test_sloppy_meshes(void)
{
    mesh_clear(&mesh, 3);
    mesh_add_ball(&mesh, 0, 0, 0, 1.0, 12);
    mesh_unshare(&mesh);
    const uint32_t e = mesh.elements++;
    mesh.element[3 * e] = mesh.element[3 * e + 1] = 5;
    mesh.element[3 * e + 2] = 9;
    bake_now(20);
    TEST_ASSERT_DOUBLE_WITHIN(0.05, -0.5, at(0.5, 0, 0));
}

/* Grid rows that run exactly through vertices, along edges and in faces: a box cut into cubes of the lattice. */
static void test_rows_in_faces_and_edges(void)
{
    static const double halves[3][3] = {{1, 0.5, 0.25}, {0.25, 1, 0.5}, {0.5, 0.25, 1}}, centre[3] = {0};
    for (int turn = 0; turn < 3; turn++) {
        mesh_clear(&mesh, 3);
        mesh_add_box(&mesh, centre, halves[turn]);
        bake_now(16);
        for (size_t i = 0; i < distance_grid_nodes(&baked.grid); i++) {
            double p[3], most = -INFINITY;
            size_t rest = i;
            for (int a = 0; a < 3; a++) {
                p[a] = baked.grid.low[a] + baked.grid.spacing * (double)(rest % (size_t)baked.grid.count[a]);
                rest /= (size_t)baked.grid.count[a];
                most = fmax(most, fabs(p[a]) - halves[turn][a]);
            }
            if (fabs(most) > 1e-6) TEST_ASSERT_TRUE((baked.value[i] < 0.0f) == (most < 0.0));
        }
    }
}

/* ---- Hulls ---- */

static void bake_hull_of(const float *points, uint32_t count, int d, int32_t resolution)
{
    pbmpm_mesh_def def = mesh_defaults();
    def.dimension = d;
    def.vertices = points;
    def.vertex_count = count;
    def.resolution = resolution;
    bake_def(&def, true);
}

/* A lattice: most points lie in faces, on edges, or inside. */
static void test_hull_of_a_lattice_is_a_box(void)
{
    static float points[9 * 9 * 9 * 3];
    for (int d = 2; d <= 3; d++) {
        uint32_t count = 0;
        for (int k = 0; k < (d == 3 ? 9 : 1); k++)
            for (int j = 0; j < 9; j++)
                for (int i = 0; i < 9; i++, count++) {
                    const float p[3] = {(float)(0.25 * (i - 4)), (float)(0.15 * (j - 4)), (float)(0.1125 * (k - 4))};
                    memcpy(points + (size_t)count * (size_t)d, p, (size_t)d * sizeof *p);
                }
        bake_hull_of(points, count, d, 32);
        check_distances(d == 3 ? true_box : true_rectangle, false);
    }
}

static void test_hull_holds_its_points_and_is_convex(void)
{
    static float points[3 * 500];
    Random random = {9};
    for (int d = 2; d <= 3; d++) {
        for (int i = 0; i < 500 * d; i++) points[i] = (float)random_in(&random, -1.0, 1.0);
        bake_hull_of(points, 500, d, 48);
        for (int i = 0; i < 500; i++) {
            const float *p = points + i * d, *q = points + random_below(&random, 500) * (uint32_t)d;
            const double z = d == 3 ? 0.5 * (double)(p[2] + q[2]) : 0.0;
            TEST_ASSERT_TRUE(at(p[0], p[1], d == 3 ? p[2] : 0) < 0.5 * baked.grid.spacing);
            TEST_ASSERT_TRUE(at(0.5 * (double)(p[0] + q[0]), 0.5 * (double)(p[1] + q[1]), z) < 0.5 * baked.grid.spacing);
        }
    }
}

static void test_hull_of_a_hollow_mesh_is_full(void)
{
    mesh_clear(&mesh, 3);
    mesh_add_torus(&mesh, RING, TUBE, 32);
    bake_hull_of(mesh.vertex, mesh.vertices, 3, 32);
    TEST_ASSERT_DOUBLE_WITHIN(0.5 * baked.grid.spacing, -TUBE, at(0, 0, 0));
}

/* ---- Heights ---- */

static void bake_heights_of(const pbmpm_heights_def *def)
{
    forget();
    TEST_ASSERT_EQUAL_INT_MESSAGE(PBMPM_OK, bake_heights(def, NULL, 0, &baked.bytes), result_message());
    baked.data = malloc(baked.bytes);
    TEST_ASSERT_EQUAL_INT_MESSAGE(PBMPM_OK, bake_heights(def, baked.data, baked.bytes, &baked.bytes), result_message());
    read_back();
}

/* A slope of 0.5 along the first direction: over its middle the distance is the height times cos(atan(0.5)). */
static void test_heights(void)
{
    static float heights[17 * 13];
    for (int d = 2; d <= 3; d++)
        for (int up = 0; up < d; up++) {
            pbmpm_heights_def def = heights_defaults();
            const uint32_t second = d == 3 ? 13 : 1;
            for (uint32_t s = 0; s < 17 * second; s++) heights[s] = 0.5f * 0.25f * (float)(s % 17);
            def.dimension = d;
            def.up = up;
            def.count[0] = 17;
            def.count[1] = d == 3 ? 13 : 0xffffffffu; /* not used in 2D */
            def.spacing[0] = def.spacing[1] = 0.25f;
            def.heights = heights;
            bake_heights_of(&def);
            TEST_ASSERT_EQUAL_INT(d, baked.grid.dimension);
            TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.25, baked.grid.spacing);
            const int first_axis = up == 0 ? 1 : 0;
            for (double over = -0.4; over < 0.4; over += 0.1) {
                double p[3] = {0}, normal[3];
                for (int a = 0; a < d; a++) p[a] = 1.5; /* the middle of both directions */
                p[first_axis] = 2.0;
                p[up] = 1.0 + over;
                TEST_ASSERT_DOUBLE_WITHIN(0.02, over / sqrt(1.25), distance_grid_at(&baked.grid, p, normal));
                TEST_ASSERT_DOUBLE_WITHIN(0.02, 1.0 / sqrt(1.25), normal[up]);
            }
        }
}

/* ---- What is refused ---- */

static void refuse(const pbmpm_mesh_def *def, bool hull, const char *why)
{
    static char buffer[1 << 22];
    uint64_t bytes = 0;
    TEST_ASSERT_EQUAL_INT_MESSAGE(PBMPM_ERROR_INVALID_ARGUMENT, bake_mesh(def, hull, buffer, sizeof buffer, &bytes), why);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(result_message(), why), result_message());
}

static void refuse_mesh(const char *why)
{
    const pbmpm_mesh_def def = mesh_def_of(&mesh, 16);
    refuse(&def, false, why);
}

static void small_ball(int d)
{
    mesh_clear(&mesh, d);
    mesh_add_ball(&mesh, 0, 0, 0, 1.0, 8);
}

static void test_open_meshes(void)
{
    for (int d = 2; d <= 3; d++) {
        small_ball(d);
        mesh.elements--;
        refuse_mesh(d == 2 ? "the polygon is open at (" : "the mesh is open at the edge from (");
    }
    mesh_clear(&mesh, 3);
    const uint32_t triangle[3] = {0, 1, 2};
    const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    memcpy(mesh.vertex, corners, sizeof corners);
    memcpy(mesh.element, triangle, sizeof triangle);
    mesh.vertices = 3;
    mesh.elements = 1;
    refuse_mesh("open");
    for (int i = 0; i < 9; i++) mesh.vertex[i] += 2.0f; /* and says where, in the mesh's own places */
    refuse_mesh("(2, 2, 2)");
}

static void test_meshes_wound_in_two_ways(void)
{
    for (int d = 2; d <= 3; d++) {
        small_ball(d);
        mesh_turn_over(&mesh, mesh.elements - 1);
        refuse_mesh("wound in two ways");
        small_ball(d); /* each part closed, one of them inside out */
        const uint32_t first = mesh.elements;
        mesh_add_ball(&mesh, 3, 0, 0, 0.8, 8);
        mesh_turn_over(&mesh, first);
        refuse_mesh("wound the other way");
    }
}

static void test_meshes_without_volume(void)
{
    for (int d = 2; d <= 3; d++) {
        small_ball(d); /* there and back again */
        const size_t corners = (size_t)mesh.elements * (size_t)d;
        memcpy(mesh.element + corners, mesh.element, corners * sizeof *mesh.element);
        mesh.elements *= 2;
        mesh_turn_over(&mesh, mesh.elements / 2);
        refuse_mesh("no volume");
    }
    small_ball(3); /* each element has a corner twice */
    for (uint32_t i = 0; i < mesh.elements; i++) mesh.element[3 * i + 1] = mesh.element[3 * i];
    refuse_mesh("all elements of the mesh are degenerate");
    mesh_clear(&mesh, 3); /* thinner than a cell */
    mesh_add_box(&mesh, (const double[3]){0, 0, 0}, (const double[3]){1, 1e-3, 1});
    refuse_mesh("thinner than a grid cell");
    mesh.vertex[4] = NAN;
    refuse_mesh("mesh.vertices must be in");
    small_ball(3);
    for (uint32_t i = 0; i < 3 * mesh.vertices; i++) mesh.vertex[i] = 0.25f;
    refuse_mesh("smaller than 1e-6");
    small_ball(3);
    mesh.element[7] = mesh.vertices;
    refuse_mesh("names a vertex that does not exist");
}

static void test_flat_hulls(void)
{
    static const float flat[5 * 3] = {0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1, 0.5f, 0.3f, 1}, line[4 * 2] = {0, 0, 1, 1, 2, 2, 5, 5};
    pbmpm_mesh_def def = mesh_defaults();
    def.vertices = flat;
    def.vertex_count = 5;
    refuse(&def, true, "all points of the hull lie in a plane");
    def.vertex_count = 3;
    refuse(&def, true, "all points of the hull lie in a plane");
    def.dimension = 2;
    def.vertices = line;
    def.vertex_count = 4;
    refuse(&def, true, "all points of the hull lie on a line");
    def.vertex_count = 1;
    refuse(&def, true, "smaller than 1e-6");
}

/* Said at once, before any memory is asked for. */
static void test_grids_of_too_many_nodes(void)
{
    uint64_t bytes = 0;
    small_ball(3);
    const pbmpm_mesh_def def = mesh_def_of(&mesh, 1024);
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_INVALID_ARGUMENT, bake_mesh(&def, false, NULL, 0, &bytes));
    TEST_ASSERT_NOT_NULL(strstr(result_message(), "more than 2^27"));
    TEST_ASSERT_EQUAL_UINT64(0, bytes);
}

/* ---- Stored bytes ---- */

static pbmpm_result read_bytes(const void *data, uint64_t size)
{
    DistanceGrid grid;
    const void *values;
    return distance_grid_read(data, size, &grid, &values);
}

static void test_every_changed_byte_is_noticed(void)
{
    small_ball(2);
    bake_now(8);
    unsigned char *byte = baked.data;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, read_bytes(byte, baked.bytes));
    for (uint64_t i = 0; i < baked.bytes; i++)
        for (int bit = 0; bit < 8; bit += 3) {
            byte[i] ^= (unsigned char)(1 << bit);
            const pbmpm_result result = read_bytes(byte, baked.bytes);
            TEST_ASSERT_TRUE(result == PBMPM_ERROR_DAMAGED || (result == PBMPM_ERROR_UNSUPPORTED && i >= 8 && i < 12));
            byte[i] ^= (unsigned char)(1 << bit);
        }
    for (uint64_t size = 0; size < baked.bytes; size++) TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_DAMAGED, read_bytes(byte, size));
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_DAMAGED, read_bytes(byte, baked.bytes + 1));
}

/* Made on purpose, with the right checksum. */
static void test_distances_that_cannot_be(void)
{
    static const float wrong[] = {NAN, INFINITY, 1e9f};
    small_ball(2);
    bake_now(8);
    for (int i = 0; i < 4; i++) {
        const float kept = baked.value[20];
        const size_t place = i < 3 ? 20 : 0; /* and solid at the border */
        const float border = baked.value[0];
        baked.value[place] = i < 3 ? wrong[i] : -0.1f;
        distance_grid_write(&baked.grid, baked.data);
        TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_DAMAGED, read_bytes(baked.data, baked.bytes));
        baked.value[20] = kept;
        baked.value[0] = border;
    }
}

/* Each field of the header outside of its range, with the right checksum; where they lie: distance_grid.c. */
static void test_headers_that_cannot_be(void)
{
    enum { DIMENSION_AT = 12, COUNT_AT = 16, SPACING_AT = 32, LOW_AT = 40 };
    static const int32_t counts[] = {0, 1, -1, INT32_MIN, (1 << 27) + 1, 1 << 14};
    static const double spacings[] = {0.0, -1.0, 1e-13, 1e10, NAN, INFINITY}, lows[] = {2e9, -2e9, NAN, -INFINITY};
    static char bytes[1 << 16];
    small_ball(2);
    bake_now(8);
    TEST_ASSERT_TRUE(baked.bytes <= sizeof bytes);
#define FORGE(at, value)                                                                                 \
    memcpy(bytes, baked.data, baked.bytes);                                                              \
    memcpy(bytes + (at), &(value), sizeof(value));                                                       \
    distance_grid_seal(bytes, baked.bytes);                                                              \
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_DAMAGED, read_bytes(bytes, baked.bytes))
    for (uint32_t dimension = 0; dimension < 6; dimension++) {
        if (dimension == 2) continue;
        FORGE(DIMENSION_AT, dimension);
    }
    for (size_t a = 0; a < 3; a++) {
        for (size_t i = a < 2 ? 0 : 2; i < sizeof counts / sizeof *counts; i++) {
            FORGE(COUNT_AT + 4 * a, counts[i]);
        }
        for (size_t i = 0; i < sizeof lows / sizeof *lows; i++) {
            FORGE(LOW_AT + 8 * a, lows[i]);
        }
    }
    for (size_t i = 0; i < sizeof spacings / sizeof *spacings; i++) {
        FORGE(SPACING_AT, spacings[i]);
    }
    memcpy(bytes, baked.data, baked.bytes);
    distance_grid_seal(bytes, baked.bytes);
    TEST_ASSERT_EQUAL_MEMORY(baked.data, bytes, baked.bytes); /* sealed as it was written */
}

static void test_a_small_buffer_is_refused(void)
{
    char small[64];
    uint64_t bytes = 0;
    small_ball(2);
    const pbmpm_mesh_def def = mesh_def_of(&mesh, 8);
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_CAPACITY, bake_mesh(&def, false, small, sizeof small, &bytes));
    TEST_ASSERT_TRUE(bytes > sizeof small);
}

/* ---- Ways past solids that are not convex ---- */

/* From a point outside and no farther than `most` cells a way through the solid is forbidden by a plane, and no plane forbids to stay. Ways that only
 * graze the solid, or its edges, do not count. */
static void check_ways(int d, double most)
{
    enum { WAYS = 3000, PLACES = 64 };
    const double cell = 0.25, margin = 1.0;
    const pbmpm_shape shape = {.size = sizeof shape, .kind = PBMPM_BAKED, .rotation = {0, 0, 0, 1}};
    Solid solid = solid_of(&shape, d);
    Random random = {21};
    int through = 0;
    solid.grid = &baked.grid;
    for (int i = 0; i < WAYS; i++) {
        double point[3] = {0}, way[3] = {0}, deepest = 0.0, size2 = 0.0;
        Plane nearest, ahead, plane[PLANES_MAX + 1];
        for (int a = 0; a < d; a++) {
            point[a] = random_in(&random, -2.0, 2.0);
            way[a] = random_in(&random, -most, most);
            size2 += way[a] * way[a];
        }
        const double distance = solid_distance(&solid, point, nearest.normal) / cell;
        if (distance < 0.0 || size2 > most * most) continue;
        nearest.gap = distance;
        for (int k = 1; k <= PLACES; k++) {
            double there[3] = {0}, unused[3];
            for (int a = 0; a < d; a++) there[a] = point[a] + way[a] * cell * k / PLACES;
            deepest = fmin(deepest, solid_distance(&solid, there, unused) / cell);
        }
        int planes = tangent_planes(&solid, cell, point, &nearest, margin, plane);
        if (plane_on_way(&solid, cell, &(Way){point, way, plane, planes}, margin, &ahead)) plane[planes++] = ahead;
        bool forbidden = false;
        for (int k = 0; k < planes; k++) {
            const double along = plane[k].normal[0] * way[0] + plane[k].normal[1] * way[1] + plane[k].normal[2] * way[2];
            TEST_ASSERT_TRUE(plane[k].gap >= 0.0);
            forbidden = forbidden || along < -plane[k].gap;
        }
        if (deepest > -0.5) continue;
        through++;
        TEST_ASSERT_TRUE_MESSAGE(forbidden, "a way through the solid");
    }
    TEST_ASSERT_TRUE(through > 20);
}

static void test_ways_through_solids_are_forbidden(void)
{
    const double middle[3] = {0, 0, 0}, plate[3] = {1.5, 0.15, 1.5};
    for (int d = 2; d <= 3; d++) {
        mesh_clear(&mesh, d);
        mesh_add_box(&mesh, middle, plate);
        bake_now(32);
        check_ways(d, 6.0);
    }
    mesh_clear(&mesh, 3);
    mesh_add_torus(&mesh, RING, TUBE, 12);
    bake_now(24);
    check_ways(3, 6.0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_ball);
    RUN_TEST(test_box);
    RUN_TEST(test_torus);
    RUN_TEST(test_bounds_of_turned_solids);
    RUN_TEST(test_winding_inward_is_the_same_solid);
    RUN_TEST(test_parts_may_overlap);
    RUN_TEST(test_hollows);
    RUN_TEST(test_sloppy_meshes);
    RUN_TEST(test_rows_in_faces_and_edges);
    RUN_TEST(test_hull_of_a_lattice_is_a_box);
    RUN_TEST(test_hull_holds_its_points_and_is_convex);
    RUN_TEST(test_hull_of_a_hollow_mesh_is_full);
    RUN_TEST(test_heights);
    RUN_TEST(test_open_meshes);
    RUN_TEST(test_meshes_wound_in_two_ways);
    RUN_TEST(test_meshes_without_volume);
    RUN_TEST(test_flat_hulls);
    RUN_TEST(test_grids_of_too_many_nodes);
    RUN_TEST(test_every_changed_byte_is_noticed);
    RUN_TEST(test_headers_that_cannot_be);
    RUN_TEST(test_distances_that_cannot_be);
    RUN_TEST(test_a_small_buffer_is_refused);
    RUN_TEST(test_ways_through_solids_are_forbidden);
    return UNITY_END();
}

/* Baked solids through the public interface: the life of a solid, and hollows that hold matter. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rules.h"
#include "solids.h"

void setUp(void) {}

void tearDown(void)
{
    bake_forget();
    pbmpm_shutdown();
}

static pbmpm_world_id open_world(int32_t dimension, uint32_t capacity)
{
    const pbmpm_world_def def = default_world(dimension, 0.1f, capacity);
    return create_world(&def);
}

/* ---- Definitions ---- */

static pbmpm_result use_mesh(const void *structure)
{
    uint64_t bytes;
    return pbmpm_bake_mesh(structure, NULL, 0, &bytes);
}

static pbmpm_result use_heights(const void *structure)
{
    uint64_t bytes;
    return pbmpm_bake_heights(structure, NULL, 0, &bytes);
}

static void test_ranges(void)
{
    static float heights[6] = {0, 1, 2, 1, 0, 1};
    static const rule of_meshes[] = {
        {FIELD(pbmpm_mesh_def, dimension), INT32, 2, 3, false, false},
        {FIELD(pbmpm_mesh_def, resolution), INT32, 4, INFINITY, false, false}, /* the largest depends on the form */
        {FIELD(pbmpm_mesh_def, vertex_count), UINT32, 1, INFINITY, true, false},
        {FIELD(pbmpm_mesh_def, element_count), UINT32, 1, INFINITY, false, false},
    };
    static const rule of_heights[] = {
        {FIELD(pbmpm_heights_def, dimension), INT32, 2, 3, false, false},
        {FIELD(pbmpm_heights_def, up), INT32, 0, 2, false, false},
        {FIELD(pbmpm_heights_def, count[0]), UINT32, 2, INFINITY, false, false},
        {FIELD(pbmpm_heights_def, count[1]), UINT32, 2, INFINITY, false, false},
        {FIELD(pbmpm_heights_def, spacing[1]), FLOAT32, (double)1e-6f, 1e6, false, false},
        {FIELD(pbmpm_heights_def, thickness), FLOAT32, (double)1e-6f, 1e6, false, false},
    };
    rules_set_up();
    mesh_clear(&mesh, 3);
    mesh_add_ball(&mesh, 0, 0, 0, 1, 6);
    const pbmpm_mesh_def made = mesh_def_of(&mesh, 8);
    CHECK_RULES(of_meshes, made, use_mesh);
    pbmpm_heights_def field;
    OK(pbmpm_heights_def_init(&field, sizeof field));
    field.count[0] = 2;
    field.count[1] = 2;
    field.heights = heights;
    field.resolution = 4;
    CHECK_RULES(of_heights, field, use_heights);
    field.resolution = 1025;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, use_heights(&field));
}

/* ---- The life of a solid ---- */

static void test_definitions_have_the_documented_defaults(void)
{
    pbmpm_mesh_def made;
    pbmpm_heights_def heights;
    memset(&made, 0xA5, sizeof made);
    memset(&heights, 0xA5, sizeof heights);
    OK(pbmpm_mesh_def_init(&made, sizeof made));
    OK(pbmpm_heights_def_init(&heights, sizeof heights));
    TEST_ASSERT_TRUE(made.dimension == 3 && made.resolution == 64 && !made.vertices && !made.elements && !made.vertex_count && !made.element_count);
    TEST_ASSERT_TRUE(heights.dimension == 3 && heights.up == 1 && heights.resolution == 0 && !heights.heights && !heights.count[0]);
    TEST_ASSERT_TRUE(heights.spacing[0] == 1.0f && heights.spacing[1] == 1.0f && heights.thickness == 1.0f);
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_mesh_def_init(&made, sizeof made - 1));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_heights_def_init(NULL, sizeof heights));
}

static void test_a_solid_is_inspected_loaded_shared_and_destroyed(void)
{
    pbmpm_baked_info info = {.size = sizeof info}, loaded = {.size = sizeof loaded};
    const pbmpm_world_id world = open_world(3, 100);
    bake_ball(3, 1.5);
    OK(pbmpm_baked_inspect(baked.data, baked.bytes, &info));
    TEST_ASSERT_EQUAL_INT32(3, info.dimension);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.125f, info.spacing);
    TEST_ASSERT_EQUAL_UINT64(baked.bytes, info.bytes);
    for (int a = 0; a < 3; a++) {
        TEST_ASSERT_EQUAL_UINT32(29, info.count[a]);
        TEST_ASSERT_FLOAT_WITHIN(1e-5f, -1.75f, info.minimum[a]);
        TEST_ASSERT_FLOAT_WITHIN(1e-5f, 1.75f, info.maximum[a]);
    }
    const pbmpm_baked_id id = load_baked(world);
    memset(baked.data, 0, baked.bytes); /* the world has a copy */
    OK(pbmpm_baked_get(world, id, &loaded));
    TEST_ASSERT_EQUAL_MEMORY(&info, &loaded, sizeof info);
    const pbmpm_collider_id one = create_collider(world, baked_shape(id, 0, 0, 0), true), two = create_collider(world, baked_shape(id, 5, 0, 0), false);
    EXPECT(PBMPM_ERROR_IN_USE, pbmpm_baked_destroy(world, id));
    OK(pbmpm_collider_destroy(world, one));
    EXPECT(PBMPM_ERROR_IN_USE, pbmpm_baked_destroy(world, id));
    OK(pbmpm_collider_destroy(world, two));
    OK(pbmpm_baked_destroy(world, id));
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_baked_destroy(world, id));
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_baked_get(world, id, &loaded));
}

static void test_solids_that_do_not_fit(void)
{
    const pbmpm_world_id world = open_world(3, 100), other = open_world(3, 100);
    const pbmpm_collider_def def = default_collider();
    pbmpm_baked_id id;
    pbmpm_collider_id collider;
    bake_ball(2, 1.0);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_baked_create(world, baked.data, baked.bytes, &id));
    EXPECT(PBMPM_ERROR_DAMAGED, pbmpm_baked_create(world, baked.data, baked.bytes - 1, &id));
    TEST_ASSERT_TRUE(id.index == 0 && id.generation == 0);
    bake_ball(3, 1.0);
    id = load_baked(other);
    const pbmpm_shape shape = baked_shape(id, 0, 0, 0);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_create(world, &def, &shape, &collider)); /* another world's */
    OK(pbmpm_baked_destroy(other, id));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_create(other, &def, &shape, &collider)); /* stale */
}

static void test_as_many_solids_as_documented(void)
{
    const pbmpm_world_id world = open_world(2, 100);
    pbmpm_baked_id id;
    mesh_clear(&mesh, 2);
    mesh_add_ball(&mesh, 0, 0, 0, 1, 3);
    bake_now(4);
    for (int i = 0; i < PBMPM_MAX_BAKED; i++) load_baked(world);
    EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_baked_create(world, baked.data, baked.bytes, &id));
}

static void test_memory_of_solids(void)
{
    static ledger book;
    book = (ledger){0};
    pbmpm_world_def def = default_world(2, 0.1f, 100);
    pbmpm_baked_id id;
    def.allocator = ledger_allocator(&book);
    const pbmpm_world_id world = create_world(&def);
    bake_ball(2, 1.0);
    for (int refused = 1; refused <= 2; refused++) { /* the table, then the values */
        book.fail_at = book.calls + (uint64_t)refused;
        EXPECT(PBMPM_ERROR_OUT_OF_MEMORY, pbmpm_baked_create(world, baked.data, baked.bytes, &id));
    }
    book.fail_at = 0;
    const pbmpm_baked_id first = load_baked(world);
    load_baked(world);
    OK(pbmpm_baked_destroy(world, first));
    OK(pbmpm_world_destroy(world));
    ledger_expect_clean(&book, "solids");
}

/* Particles fill, and are found in, a baked ball as they would a real one: pi r^2, 4/3 pi r^3. */
static void test_solids_are_filled_queried_and_emptied(void)
{
    static const double content[] = {0, 0, 3.14159, 4.18879};
    for (int32_t d = 2; d <= 3; d++) {
        const pbmpm_world_id world = open_world(d, 60000);
        bake_ball(d, 1.0);
        const pbmpm_shape ball = baked_shape(load_baked(world), 0.3f, 0.2f, 0.1f);
        const uint32_t added = fill_shape(world, create_material(world, PBMPM_LIQUID), ball, (const float[3]){0, 0, 0});
        TEST_ASSERT_DOUBLE_WITHIN(0.03 * content[d], content[d], added * pow(0.05, d));
        uint32_t count = 0;
        OK(pbmpm_query_shape(world, &ball, NULL, 0, &count));
        TEST_ASSERT_TRUE(count > 0.95 * added && count <= added); /* jitter */
        const pbmpm_collider_id collider = create_collider(world, ball, false);
        OK(pbmpm_query_collider(world, collider, NULL, 0, &count));
        TEST_ASSERT_TRUE(count > 0.9 * added && count <= added);
        OK(pbmpm_particles_remove_in(world, &ball, &count));
        TEST_ASSERT_EQUAL_UINT32(added - count, world_count(world));
    }
}

/* ---- Hollows ---- */

/* A box of walls `thick` with a hollow of half width 1. */
static void bake_container(int32_t dimension, double thick)
{
    static const double centre[3] = {0};
    const double outer[3] = {1 + thick, 1 + thick, 1 + thick}, inner[3] = {1, 1, 1};
    mesh_clear(&mesh, dimension);
    mesh_add_box(&mesh, centre, outer);
    const uint32_t first = mesh.elements;
    mesh_add_box(&mesh, centre, inner);
    mesh_turn_over(&mesh, first);
    bake_now(48);
}

/* How far [m] a particle is outside the hollow of a turned container, at most. */
static double outside(pbmpm_world_id world, const float position[3], double angle)
{
    const pbmpm_view view = view_of(world, PBMPM_POSITION);
    double most = 0.0;
    for (uint32_t i = 0; i < view.count; i++) {
        const double x = (double)view_float(&view, i, 0) - (double)position[0], y = (double)view_float(&view, i, 1) - (double)position[1];
        const double local[2] = {x * cos(angle) + y * sin(angle), y * cos(angle) - x * sin(angle)};
        most = fmax(most, fmax(fabs(local[0]), fabs(local[1])) - 1.0);
        if (view.components == 3) most = fmax(most, fabs((double)view_float(&view, i, 2)) - 1.0);
    }
    return most;
}

/* A container that turns and shakes keeps all that is in it; grid error and rounded corners are within a tenth of a cell, and what
 * pushing out allows is a cell. */
static void check_container(int32_t dimension, pbmpm_solver solver, pbmpm_friction friction)
{
    const pbmpm_world_id world = open_world(dimension, 21000);
    bake_container(dimension, 0.3);
    pbmpm_settings settings = default_settings();
    settings.solver = solver;
    settings.gravity[1] = -9.81f;
    settings.iterations = 8;
    settings.substeps = 2;
    OK(pbmpm_world_set_settings(world, &settings));
    pbmpm_collider_def def = default_collider();
    pbmpm_collider_id collider;
    const pbmpm_shape shape = baked_shape(load_baked(world), 0, 0, 0);
    def.kinematic = 1;
    def.friction = friction;
    OK(pbmpm_collider_create(world, &def, &shape, &collider));
    const uint32_t added = fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0, -0.4f, 0, 0.9f, 0.4f, 0.9f), (const float[3]){3, 2, 0});
    const int steps = dimension == 3 ? 60 : 240;
    for (int i = 1; i <= steps; i++) {
        const double angle = 0.02 * i;
        const float position[3] = {0.3f * sinf(0.1f * (float)i), 0, 0}, rotation[4] = {0, 0, (float)sin(0.5 * angle), (float)cos(0.5 * angle)};
        OK(pbmpm_collider_move(world, collider, position, rotation));
        OK(pbmpm_world_step(world, 1.0f / 60));
        TEST_ASSERT_TRUE(outside(world, position, angle) < 0.1);
    }
    TEST_ASSERT_EQUAL_UINT32(added, world_count(world));
    uint32_t inside = 0;
    OK(pbmpm_query_collider(world, collider, NULL, 0, &inside));
    TEST_ASSERT_TRUE(inside < added / 50);
}

static void test_a_turning_container_keeps_its_contents(void)
{
    check_container(2, PBMPM_SOLVER_PAPER, PBMPM_FRICTION_COULOMB);
    check_container(2, PBMPM_SOLVER_DUAL, PBMPM_FRICTION_COULOMB);
    check_container(2, PBMPM_SOLVER_PAPER, PBMPM_FRICTION_SLIP);
    check_container(2, PBMPM_SOLVER_PAPER, PBMPM_FRICTION_STICK);
    check_container(3, PBMPM_SOLVER_PAPER, PBMPM_FRICTION_COULOMB);
}

/* Fast matter meets the far wall of a hollow, and passes the end of a wall, where planes that a convex solid would allow would hold it. */
static double fly(pbmpm_world_id world, float x, float y, float vx, int steps)
{
    const pbmpm_material_id matter = create_material(world, PBMPM_ELASTIC);
    fill_shape(world, matter, box_shape(x, y, 0, 0.1f, 0.1f, 0.1f), (const float[3]){vx, 0, 0});
    for (int i = 0; i < steps; i++)
        OK(pbmpm_world_step(world, 1.0f / 60));
    const pbmpm_view position = view_of(world, PBMPM_POSITION);
    double most = -INFINITY;
    for (uint32_t i = 0; i < position.count; i++) most = fmax(most, (double)view_float(&position, i, 0));
    return most;
}

static void test_fast_matter_stops_at_the_far_wall(void)
{
    const pbmpm_world_id world = open_world(2, 100);
    bake_container(2, 0.3);
    create_collider(world, baked_shape(load_baked(world), 0, 0, 0), false);
    TEST_ASSERT_TRUE(fly(world, -0.8f, 0, 90, 3) < 1.01); /* 15 cells per step */
}

static void test_fast_matter_passes_beside_a_bump(void)
{
    const pbmpm_world_id world = open_world(2, 100);
    mesh_clear(&mesh, 2); /* an L: a floor with a wall at its left end that does not reach the matter */
    mesh_add_box(&mesh, (const double[3]){0, -1, 0}, (const double[3]){2, 0.3, 0});
    mesh_add_box(&mesh, (const double[3]){-1.5, -0.6, 0}, (const double[3]){0.3, 0.8, 0});
    bake_now(64);
    create_collider(world, baked_shape(load_baked(world), 0, 0, 0), false);
    TEST_ASSERT_DOUBLE_WITHIN(0.15, -2.5 + 0.1 + 60.0 * 5 / 60, fly(world, -2.5f, 0.55f, 60, 5));
}

/* ---- Damaged bytes ---- */

static uint64_t mix_words(uint64_t hash, const void *data, size_t bytes)
{
    for (size_t i = 0; i < bytes; i += 4) {
        uint32_t word;
        memcpy(&word, (const char *)data + i, sizeof word);
        hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}

enum { CHECKSUM = 64 }; /* its place in the header; see src/shape/distance_grid.c */

/* Puts the checksum right, so that what comes after it is looked at. */
static void mend(void *data, uint64_t bytes)
{
    uint64_t sum = 0;
    memcpy((char *)data + CHECKSUM, &sum, sizeof sum);
    sum = mix_words(0x243f6a8885a308d3u, data, bytes);
    memcpy((char *)data + CHECKSUM, &sum, sizeof sum);
}

/* Both calls judge the bytes alike, whatever the caller's floating-point mode: here every exception traps. */
static void check_judgement(pbmpm_world_id world)
{
    pbmpm_baked_info inspected = {.size = sizeof inspected}, loaded = inspected;
    pbmpm_baked_id id;
    char message[256];
    const unsigned own = host_float_mode();
    host_set_float_mode(HOST_TRAPS);
    const pbmpm_result judged = pbmpm_baked_inspect(baked.data, baked.bytes, &inspected);
    snprintf(message, sizeof message, "%s", pbmpm_last_error());
    const pbmpm_result created = pbmpm_baked_create(world, baked.data, baked.bytes, &id);
    const unsigned after = host_float_mode();
    host_set_float_mode(own);
    TEST_ASSERT_EQUAL_HEX32(HOST_TRAPS, after);
    TEST_ASSERT_EQUAL_STRING(pbmpm_result_name(created), pbmpm_result_name(judged));
    if (created != PBMPM_OK) {
        TEST_ASSERT_EQUAL_STRING(pbmpm_last_error(), message);
        return;
    }
    OK(pbmpm_baked_get(world, id, &loaded));
    TEST_ASSERT_EQUAL_MEMORY(&loaded, &inspected, sizeof loaded);
    OK(pbmpm_baked_destroy(world, id));
}

static void test_changed_bytes_are_judged_alike(void)
{
    static const uint32_t odd[] = {0x7fc00000, 0x7f800001, 0x7f800000, 0xff800000, 1, 0x80000001, 0x007fffff, 0x80000000, 0, 0x7f7fffff};
    const pbmpm_world_id world = open_world(2, 100);
    uint32_t stream = 5, judged = 0;
    bake_ball(2, 1.5);
    unsigned char *byte = baked.data;
    unsigned char *kept = malloc(baked.bytes);
    TEST_ASSERT_NOT_NULL(kept);
    memcpy(kept, byte, baked.bytes);
    for (uint64_t i = 0; i < baked.bytes; i++)
        for (int bit = 0; bit < 8; bit++, judged++) {
            memcpy(byte, kept, baked.bytes);
            byte[i] ^= (unsigned char)(1 << bit);
            mend(byte, baked.bytes);
            check_judgement(world);
        }
    for (uint64_t i = 0; i < baked.bytes; i += 4)
        for (size_t k = 0; k < sizeof odd / sizeof *odd; k++, judged++) {
            memcpy(byte, kept, baked.bytes);
            memcpy(byte + i, &odd[k], sizeof odd[k]);
            if (random_next(&stream) % 8 != 0)
                mend(byte, baked.bytes);
            check_judgement(world);
        }
    memcpy(byte, kept, baked.bytes);
    check_judgement(world); /* the sound one */
    free(kept);
    TEST_ASSERT_TRUE(judged > 20000);
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_ranges);
    RUN_TEST(test_definitions_have_the_documented_defaults);
    RUN_TEST(test_a_solid_is_inspected_loaded_shared_and_destroyed);
    RUN_TEST(test_solids_that_do_not_fit);
    RUN_TEST(test_as_many_solids_as_documented);
    RUN_TEST(test_memory_of_solids);
    RUN_TEST(test_solids_are_filled_queried_and_emptied);
    RUN_TEST(test_a_turning_container_keeps_its_contents);
    RUN_TEST(test_fast_matter_stops_at_the_far_wall);
    RUN_TEST(test_fast_matter_passes_beside_a_bump);
    RUN_TEST(test_changed_bytes_are_judged_alike);
    return UNITY_END();
}

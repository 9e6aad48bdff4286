/* Particles copied for rendering: the layout, what was before the last step, and the state of before a step in the background. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scenes.h"

enum { ROOM = 1 << 18 };

static float buffer[ROOM];

void setUp(void) {}
void tearDown(void) { pbmpm_shutdown(); }

static pbmpm_copy_def default_copy(void)
{
    pbmpm_copy_def def;
    OK(pbmpm_copy_def_init(&def, sizeof def));
    return def;
}

static uint32_t word(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static void test_position_velocity_and_material_stand_side_by_side(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    uint32_t count;
    for (int i = 0; i < 5; i++) OK(pbmpm_world_step(world, 0.01f));
    OK(pbmpm_particles_copy(world, NULL, buffer, sizeof buffer, &count));
    const pbmpm_view position = view_of(world, PBMPM_POSITION), velocity = view_of(world, PBMPM_VELOCITY), material = view_of(world, PBMPM_MATERIAL);
    TEST_ASSERT_EQUAL_UINT32(world_count(world), count);
    for (uint32_t i = 0; i < count; i++) {
        const float *particle = buffer + 5 * (size_t)i;
        for (uint32_t c = 0; c < 2; c++) {
            TEST_ASSERT_EQUAL_FLOAT(view_float(&position, i, c), particle[c]);
            TEST_ASSERT_EQUAL_FLOAT(view_float(&velocity, i, c), particle[2 + c]);
        }
        TEST_ASSERT_EQUAL_UINT32(view_uint(&material, i, 0), word(particle[4]));
    }
}

static void test_fields_and_stride_of_the_hosts_choice(void)
{
    static const pbmpm_field fields[] = {PBMPM_MASS, PBMPM_POSITION};
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const pbmpm_view position = view_of(world, PBMPM_POSITION), mass = view_of(world, PBMPM_MASS);
    pbmpm_copy_def def = default_copy();
    uint32_t count;
    def.fields = fields;
    def.field_count = 2;
    def.stride = 32;
    for (int i = 0; i < ROOM; i++) buffer[i] = -7.0f;
    OK(pbmpm_particles_copy(world, &def, buffer, sizeof buffer, &count));
    for (uint32_t i = 0; i < count; i++) {
        TEST_ASSERT_EQUAL_FLOAT(view_float(&mass, i, 0), buffer[8 * (size_t)i]);
        TEST_ASSERT_EQUAL_FLOAT(view_float(&position, i, 1), buffer[8 * (size_t)i + 2]);
        TEST_ASSERT_EQUAL_FLOAT(-7.0f, buffer[8 * (size_t)i + 3]); /* the host's own */
    }
    TEST_ASSERT_EQUAL_FLOAT(-7.0f, buffer[8 * (size_t)count]);
}

/* One layout for 2D and 3D: what a shader reads does not know the dimension. */
static void check_padded(pbmpm_world_id world, const pbmpm_copy_def *def, const int at[3])
{
    const size_t stride = def->stride ? def->stride / sizeof(float) : 7;
    const pbmpm_view position = view_of(world, PBMPM_POSITION), velocity = view_of(world, PBMPM_VELOCITY), material = view_of(world, PBMPM_MATERIAL);
    uint32_t count;
    for (int i = 0; i < ROOM; i++) buffer[i] = -7.0f;
    OK(pbmpm_particles_copy(world, def, buffer, sizeof buffer, &count));
    TEST_ASSERT_TRUE(count > 0);
    for (uint32_t i = 0; i < count; i++) {
        const float *particle = buffer + stride * i + def->offset / sizeof(float);
        for (uint32_t c = 0; c < def->offset / sizeof(float); c++) TEST_ASSERT_EQUAL_FLOAT(-7.0f, buffer[stride * i + c]);
        for (uint32_t c = 0; c < 3; c++) {
            TEST_ASSERT_EQUAL_FLOAT(c < position.components ? view_float(&position, i, c) : 0.0f, particle[at[0] + (int)c]);
            TEST_ASSERT_EQUAL_FLOAT(c < velocity.components ? view_float(&velocity, i, c) : 0.0f, particle[at[1] + (int)c]);
        }
        TEST_ASSERT_EQUAL_UINT32(view_uint(&material, i, 0), word(particle[at[2]]));
        if (stride > 7) TEST_ASSERT_EQUAL_FLOAT(-7.0f, particle[7]);
    }
    TEST_ASSERT_EQUAL_FLOAT(-7.0f, buffer[stride * count]);
}

static void test_records_for_a_gpu_are_the_same_in_2d_and_3d(void)
{
    static const pbmpm_field aligned[] = {PBMPM_POSITION, PBMPM_MATERIAL, PBMPM_VELOCITY};
    for (int i = 0; i < scene_count; i++) {
        const stage made = scenes[i].build(NULL, NULL);
        pbmpm_copy_def def = default_copy();
        OK(pbmpm_world_step(made.world, 0.004f));
        def.pads_vectors = 1;
        check_padded(made.world, &def, (const int[]){0, 3, 6});
        def.fields = aligned;
        def.field_count = 3;
        def.stride = 32;
        check_padded(made.world, &def, (const int[]){0, 4, 3});
        def.offset = 12;
        def.stride = 44;
        check_padded(made.world, &def, (const int[]){0, 4, 3});
        OK(pbmpm_world_destroy(made.world));
    }
}

/* The largest way from where particles were before a step to where alpha = 0 says that they were [cells]. A block of water stands free, falls
 * apart and runs to the wall; thrown, it hits the wall. */
static float error_of_before(float speed, float dt)
{
    static float before[ROOM];
    const float dx = 0.05f, thrown[3] = {speed, 0, 0};
    pbmpm_world_def made = default_world(2, dx, 4000);
    pbmpm_copy_def def = default_copy();
    float worst = 0.0f;
    uint32_t count;
    made.domain_enabled = 1;
    const pbmpm_world_id world = create_world(&made);
    set_gravity(world, 0, -10, 0);
    fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0.3f, 0.3f, 0, 0.2f, 0.2f, 0.1f), thrown);
    for (int step = 0; step < 60; step++) {
        const pbmpm_view now = view_of(world, PBMPM_POSITION), who = view_of(world, PBMPM_PARTICLE);
        for (uint32_t i = 0; i < now.count; i++)
            for (uint32_t c = 0; c < 2; c++) before[2 * view_uint(&who, i, 0) + c] = view_float(&now, i, c);
        OK(pbmpm_world_step(world, dt));
        def.alpha = 0.0f;
        OK(pbmpm_particles_copy(world, &def, buffer, sizeof buffer, &count));
        const pbmpm_view moved = view_of(world, PBMPM_PARTICLE);
        for (uint32_t i = 0; i < count; i++)
            for (uint32_t c = 0; c < 2; c++) {
                const float apart = fabsf(buffer[5 * (size_t)i + c] - before[2 * view_uint(&moved, i, 0) + c]) / dx;
                worst = fmaxf(worst, apart);
            }
    }
    return worst;
}

static void test_before_the_last_step(void)
{
    const float falling = error_of_before(0.0f, 1.0f / 60), hitting = error_of_before(2.0f, 1.0f / 60);
    printf("positions before the last step: within %.4f cells, %.4f where water hits a wall\n", (double)falling, (double)hitting);
    TEST_ASSERT_TRUE(falling <= 0.02f + 1.0f / 40); /* .02 is promised, and crowded particles are moved apart by up to 1/40 cell */
    TEST_ASSERT_TRUE(hitting <= 0.02f + 1.0f / 40);
}

static void test_between(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const pbmpm_view position = view_of(world, PBMPM_POSITION);
    pbmpm_copy_def def = default_copy();
    uint32_t count;
    def.alpha = 0.25f;
    OK(pbmpm_particles_copy(world, &def, buffer, sizeof buffer, &count)); /* no step was made yet */
    for (uint32_t i = 0; i < count; i++) TEST_ASSERT_EQUAL_FLOAT(view_float(&position, i, 1), buffer[5 * (size_t)i + 1]);
    OK(pbmpm_world_step(world, 0.01f));
    OK(pbmpm_particles_copy(world, &def, buffer, sizeof buffer, &count));
    const pbmpm_view now = view_of(world, PBMPM_POSITION), velocity = view_of(world, PBMPM_VELOCITY);
    for (uint32_t i = 0; i < count; i++)
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, view_float(&now, i, 1) - 0.0075f * view_float(&velocity, i, 1), buffer[5 * (size_t)i + 1]);
}

static void test_while_a_step_runs(void)
{
    static float before[ROOM];
    static const pbmpm_field pressure[] = {PBMPM_VOLUME_RATIO};
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    pbmpm_copy_def def = default_copy();
    uint32_t count, again;
    for (int i = 0; i < 5; i++) OK(pbmpm_world_step(world, 0.01f));
    def.alpha = 0.5f;
    OK(pbmpm_particles_copy(world, &def, before, sizeof before, &count));
    OK(pbmpm_world_step_begin(world, 0.02f));
    OK(pbmpm_particles_copy(world, &def, buffer, sizeof buffer, &again));
    TEST_ASSERT_EQUAL_UINT32(count, again);
    TEST_ASSERT_EQUAL_MEMORY(before, buffer, count * 5 * sizeof(float));
    def.fields = pressure;
    def.field_count = 1;
    EXPECT(PBMPM_ERROR_BUSY, pbmpm_particles_copy(world, &def, buffer, sizeof buffer, &again));
    OK(pbmpm_world_step_end(world, 1));
    TEST_ASSERT_EQUAL_MEMORY(before, buffer, count * 5 * sizeof(float)); /* it is the caller's */
}

static void test_what_is_refused(void)
{
    static const pbmpm_field unknown[] = {(pbmpm_field)-1};
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const pbmpm_copy_def good = default_copy();
    uint32_t count = 0;
    buffer[0] = -7.0f;
    EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_particles_copy(world, NULL, buffer, 19 * sizeof(float), &count));
    TEST_ASSERT_EQUAL_UINT32(world_count(world), count);
    TEST_ASSERT_EQUAL_FLOAT(-7.0f, buffer[0]);
    EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_particles_copy(world, NULL, NULL, 0, &count));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_copy(world, NULL, NULL, 100, &count));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_copy(world, NULL, buffer, sizeof buffer, NULL));
    static const float wrong[] = {-0.1f, 1.1f, NAN, INFINITY};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        pbmpm_copy_def def = good;
        def.alpha = wrong[i];
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_copy(world, &def, buffer, sizeof buffer, &count));
    }
    pbmpm_copy_def def = good;
    def.stride = 16; /* 20 are needed */
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_copy(world, &def, buffer, sizeof buffer, &count));
    def.stride = 21;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_copy(world, &def, buffer, sizeof buffer, &count));
    def.stride = 24; /* 28 with zeros */
    OK(pbmpm_particles_copy(world, &def, buffer, sizeof buffer, &count));
    def.pads_vectors = 1;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_copy(world, &def, buffer, sizeof buffer, &count));
    def = good;
    def.offset = 2;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_copy(world, &def, buffer, sizeof buffer, &count));
    def.offset = 8;
    def.stride = 24;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_copy(world, &def, buffer, sizeof buffer, &count));
    def = good;
    def.pads_vectors = 2;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_copy(world, &def, buffer, sizeof buffer, &count));
    def = good;
    def.field_count = 1;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_copy(world, &def, buffer, sizeof buffer, &count));
    def.fields = unknown;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_copy(world, &def, buffer, sizeof buffer, &count));
    def.field_count = 4000000000u;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_copy(world, &def, buffer, sizeof buffer, &count));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_position_velocity_and_material_stand_side_by_side);
    RUN_TEST(test_fields_and_stride_of_the_hosts_choice);
    RUN_TEST(test_records_for_a_gpu_are_the_same_in_2d_and_3d);
    RUN_TEST(test_before_the_last_step);
    RUN_TEST(test_between);
    RUN_TEST(test_while_a_step_runs);
    RUN_TEST(test_what_is_refused);
    return UNITY_END();
}

/* Values outside their documented range in what adds, fills and changes particles; and values that are legal, but absurd. */
#include <float.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#include "rules.h"

void setUp(void)
{
    rules_set_up();
}

void tearDown(void)
{
    pbmpm_shutdown();
}

/* ---- particles ---- */

/* Adds 8 particles with one wrong number in one array. */
static void check_arrays(float wrong, uint32_t place, int which, bool refused)
{
    enum { COUNT = 8 };
    float positions[2 * COUNT], velocities[2 * COUNT], volumes[COUNT];
    float *const arrays[] = {positions, velocities, volumes};
    pbmpm_particles_def def;
    for (int i = 0; i < 2 * COUNT; i++) {
        positions[i] = 0.25f;
        velocities[i] = 0;
    }
    for (int i = 0; i < COUNT; i++)
        volumes[i] = 0.0025f;
    arrays[which][place] = wrong;
    OK(pbmpm_particles_def_init(&def, sizeof def));
    def.material = good.material;
    def.count = COUNT;
    def.positions = positions;
    def.velocities = velocities;
    def.volumes = volumes;
    if (refused) {
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_add(good.world, &def, NULL));
        snapshot_expect_same(&before, good.world, "arrays");
    } else {
        OK(pbmpm_particles_add(good.world, &def, NULL));
    }
}

static void test_arrays_of_particles(void)
{
    static const float wrong[] = {NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        for (uint32_t place = 0; place < 16; place++) {
            check_arrays(wrong[i], place, 0, true);
            check_arrays(wrong[i], place, 1, true);
            check_arrays(wrong[i], place % 8, 2, true);
        }
    check_arrays(-0.0625f, 5, 0, true); /* outside the domain */
    check_arrays(2.0625f, 15, 0, true);
    check_arrays(1e30f, 3, 0, true);
    check_arrays(0.0f, 7, 2, true);
    check_arrays(-1.0f, 0, 2, true);
    check_arrays(2.0f, 15, 0, false); /* the wall itself is inside */
}

static pbmpm_result use_particles(const void *structure)
{
    static const float position[2] = {0.25f, 0.25f};
    pbmpm_particles_def def;
    pbmpm_particle_id id;
    memcpy(&def, structure, sizeof def);
    def.positions = position;
    const pbmpm_result result = pbmpm_particles_add(good.world, &def, &id);
    if (result == PBMPM_OK)
        OK(pbmpm_particles_remove(good.world, &id, 1));
    before.generation = snapshot_take(good.world).generation; /* adding and removing counts as a change */
    before.hash = world_hash(good.world);
    return result;
}

static void test_volume_of_particles(void)
{
    static const rule rules[] = {{FIELD(pbmpm_particles_def, volume), FLOAT32, 0, INFINITY, false, false}};
    pbmpm_particles_def def;
    OK(pbmpm_particles_def_init(&def, sizeof def));
    def.material = good.material;
    def.count = 1;
    CHECK_RULES(rules, def, use_particles);
}

/* A count beyond all room must be refused before the arrays are read: these are far too short for it. */
static void test_counts_beyond_all_room(void)
{
    static const uint32_t counts[] = {2049, 1u << 28, (1u << 28) + 1, 1u << 30, 1u << 31, UINT32_MAX};
    const float position[2] = {0.25f, 0.25f};
    pbmpm_particles_def def;
    uint32_t row;
    OK(pbmpm_particles_def_init(&def, sizeof def));
    def.material = good.material;
    def.positions = def.velocities = def.volumes = position;
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        def.count = counts[i];
        EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_particles_add(good.world, &def, NULL));
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_set(good.world, PBMPM_POSITION, NULL, counts[i], position));
        snapshot_expect_same(&before, good.world, "counts");
    }
    OK(pbmpm_particles_remove(good.world, NULL, 0));
    OK(pbmpm_particles_find(good.world, NULL, 0, &row));
    OK(pbmpm_particles_set(good.world, PBMPM_VELOCITY, &good.particle, 0, position));
}

static pbmpm_result use_fill(const void *structure)
{
    const pbmpm_shape shape = box_shape(0.25f, 0.25f, 0, 0.1f, 0.1f, 0.1f);
    const pbmpm_result result = pbmpm_particles_fill(good.world, structure, &shape, NULL);
    if (result == PBMPM_OK) { /* back to the state before */
        const pbmpm_shape corner = box_shape(0.25f, 0.25f, 0, 0.25f, 0.25f, 0.25f);
        OK(pbmpm_particles_remove_in(good.world, &corner, NULL));
    }
    before.generation = snapshot_take(good.world).generation;
    before.hash = world_hash(good.world);
    return result;
}

static void test_fills(void)
{
    static const rule rules[] = {
        {FIELD(pbmpm_fill_def, particles_per_axis), FLOAT32, 0.25, 16, false, false},
        {FIELD(pbmpm_fill_def, jitter), FLOAT32, 0, 1, false, false},
        {FIELD(pbmpm_fill_def, velocity[0]), FLOAT32, -INFINITY, INFINITY, false, false},
        {FIELD(pbmpm_fill_def, velocity[1]), FLOAT32, -INFINITY, INFINITY, false, false},
    };
    const pbmpm_fill_def fill = default_fill(good.material);
    CHECK_RULES(rules, fill, use_fill);
}

/* Shapes that would need more particles than can be counted are refused at once. */
static void test_immense_fills(void)
{
    static const float sizes[] = {1e4f, 1e10f, 1e20f, 1e38f};
    for (int dimension = 2; dimension <= 3; dimension++) {
        const pbmpm_world_def def = default_world(dimension, 0.01f, 100);
        const pbmpm_world_id world = create_world(&def);
        const pbmpm_fill_def fill = default_fill(create_material(world, PBMPM_LIQUID));
        for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
            const pbmpm_shape shape = box_shape(0, 0, 0, sizes[i], sizes[i], sizes[i]);
            const pbmpm_result result = pbmpm_particles_fill(world, &fill, &shape, NULL);
            TEST_ASSERT_TRUE(result == PBMPM_ERROR_CAPACITY || result == PBMPM_ERROR_INVALID_ARGUMENT);
            TEST_ASSERT_EQUAL_UINT32(0, world_count(world));
        }
    }
}

static void test_values_of_setters(void)
{
    static const struct {
        pbmpm_field field;
        uint32_t components;
    } settable[] = {{PBMPM_POSITION, 2}, {PBMPM_VELOCITY, 2}, {PBMPM_AFFINE_VELOCITY, 4}, {PBMPM_DEFORMATION, 4}};
    static const float wrong[] = {NAN, INFINITY, -INFINITY};
    for (size_t f = 0; f < sizeof settable / sizeof *settable; f++)
        for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
            for (uint32_t c = 0; c < settable[f].components; c++) {
                float values[4] = {1, 1, 1, 1};
                values[c] = wrong[i];
                EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_set(good.world, settable[f].field, &good.particle, 1, values));
                snapshot_expect_same(&before, good.world, "setter");
            }
    const float outside[2] = {1, 2.5f}, wild[4] = {1, 2e6f, 0, 1};
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_set(good.world, PBMPM_POSITION, &good.particle, 1, outside));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_set(good.world, PBMPM_DEFORMATION, &good.particle, 1, wild));
    REFUSED(pbmpm_particles_set(good.world, PBMPM_MATERIAL, &good.particle, 1, wild));
    REFUSED(pbmpm_particles_set(good.world, PBMPM_PARTICLE, &good.particle, 1, wild));
    REFUSED(pbmpm_particles_set(good.world, PBMPM_MASS, &good.particle, 1, wild));
    REFUSED(pbmpm_particles_set(good.world, (pbmpm_field)(PBMPM_USER_VALUE + 1), &good.particle, 1, wild));
    REFUSED(pbmpm_particles_set(good.world, (pbmpm_field)-1, &good.particle, 1, wild));
    snapshot_expect_same(&before, good.world, "setters");
}

static void test_volume_ratio_setter(void)
{
    static const float wrong[] = {NAN, INFINITY, 0, -1, 0.0499f, 1.21f};
    const float position[2] = {0.25f, 0.25f}, ends[2] = {0.05f, 1.2f};
    pbmpm_particles_def def;
    pbmpm_particle_id id;
    OK(pbmpm_particles_def_init(&def, sizeof def));
    def.material = good.spare;
    def.count = 1;
    def.positions = position;
    OK(pbmpm_particles_add(good.world, &def, &id));
    before = snapshot_take(good.world);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_set(good.world, PBMPM_VOLUME_RATIO, &id, 1, &wrong[i]));
    snapshot_expect_same(&before, good.world, "volume ratio");
    OK(pbmpm_particles_set(good.world, PBMPM_VOLUME_RATIO, &id, 1, &ends[0]));
    OK(pbmpm_particles_set(good.world, PBMPM_VOLUME_RATIO, &id, 1, &ends[1]));
}

/* The first pressure that is set makes room for all. */
static void test_pressure_setter(void)
{
    static const float wrong[] = {NAN, INFINITY, -1e-6f, -1, 1.1e30f}, ends[] = {1e30f, 0, 1234.5f};
    const float position[2] = {0.25f, 0.25f};
    pbmpm_particles_def def;
    pbmpm_particle_id id;
    uint32_t row;
    OK(pbmpm_particles_def_init(&def, sizeof def));
    def.material = good.spare;
    def.count = 1;
    def.positions = position;
    OK(pbmpm_particles_add(good.world, &def, &id));
    before = snapshot_take(good.world);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_set(good.world, PBMPM_PRESSURE, &id, 1, &wrong[i]));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_particles_set(good.world, PBMPM_PRESSURE, &good.particle, 1, &ends[1])); /* an elastic one */
    snapshot_expect_same(&before, good.world, "pressure");
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
        OK(pbmpm_particles_set(good.world, PBMPM_PRESSURE, &id, 1, &ends[i]));
        OK(pbmpm_particles_find(good.world, &id, 1, &row));
        const pbmpm_view view = view_of(good.world, PBMPM_PRESSURE);
        TEST_ASSERT_EQUAL_FLOAT(ends[i], view_float(&view, row, 0));
    }
}

/* A volume for all is between 1e-6 and 1e6 cells of 0.01 m^2. */
static void test_volume_in_cells(void)
{
    static const float wrong[] = {0.9e-8f, 1.1e4f, 1e27f}, right[] = {1.1e-8f, 0.9e4f, 0};
    const float position[2] = {0.25f, 0.25f};
    pbmpm_particles_def def;
    OK(pbmpm_particles_def_init(&def, sizeof def));
    def.material = good.spare;
    def.count = 1;
    def.positions = position;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        def.volume = wrong[i];
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_add(good.world, &def, NULL));
        snapshot_expect_same(&before, good.world, "volume");
    }
    for (size_t i = 0; i < sizeof right / sizeof *right; i++) {
        def.volume = right[i];
        OK(pbmpm_particles_add(good.world, &def, NULL));
    }
}

static void test_unknown_fields(void)
{
    static const int wrong[] = {PBMPM_USER_VALUE + 1, -1, 1000, INT_MAX, INT_MIN};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        pbmpm_view view = {.size = sizeof view};
        REFUSED(pbmpm_particles_view(good.world, (pbmpm_field)wrong[i], &view));
    }
}

/* ---- values that are legal, but absurd ---- */

/* Whatever the answer, the world stays finite and no particle goes missing without being counted. */
static void survive(pbmpm_world_id world, uint32_t added, const char *label)
{
    for (int i = 0; i < 5; i++)
        OK(pbmpm_world_step(world, 0.01f));
    world_expect_finite(world, label);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(added, world_count(world) + world_stats(world).deleted_total, label);
    TEST_ASSERT_TRUE_MESSAGE(isfinite(world_stats(world).mass), label);
    OK(pbmpm_world_destroy(world));
}

/* Gravity that may be refused. */
static void offer_gravity(pbmpm_world_id world, float gravity)
{
    pbmpm_settings settings = default_settings();
    settings.gravity[0] = gravity;
    const pbmpm_result result = pbmpm_world_set_settings(world, &settings);
    TEST_ASSERT_TRUE(result == PBMPM_OK || result == PBMPM_ERROR_INVALID_ARGUMENT);
}

/* A collider that may be refused. */
static void offer_collider(pbmpm_world_id world, pbmpm_shape shape)
{
    const pbmpm_collider_def def = default_collider();
    pbmpm_collider_id collider;
    const pbmpm_result result = pbmpm_collider_create(world, &def, &shape, &collider);
    TEST_ASSERT_TRUE(result == PBMPM_OK || result == PBMPM_ERROR_INVALID_ARGUMENT);
}

static void test_absurd_but_finite_numbers(void)
{
    static const float numbers[] = {1e6f, 1e12f, 1e20f, 1e30f, FLT_MAX, -FLT_MAX, 1e-30f, 1e-44f};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        for (int which = 0; which < 5; which++) {
            const pbmpm_world_id world = which == 4 ? tank_2d(NULL, NULL) : block_2d(NULL, NULL);
            const uint32_t before_adding = world_count(world);
            float position[2] = {0, 0}, velocity[2] = {0, 0}, volume = 0.0025f;
            const pbmpm_shape shape = sphere_shape(which == 3 ? numbers[i] : 0, 0, 0, fabsf(numbers[i]));
            pbmpm_particles_def def;
            OK(pbmpm_particles_def_init(&def, sizeof def));
            def.material = create_material(world, PBMPM_LIQUID);
            def.count = 1;
            def.positions = position;
            def.velocities = velocity;
            def.volumes = &volume;
            position[0] = which == 0 ? numbers[i] : 0.05f;
            velocity[1] = which == 1 ? numbers[i] : 0;
            volume = which == 2 ? numbers[i] : volume;
            if (which == 3)
                offer_collider(world, shape);
            if (which == 4)
                offer_gravity(world, numbers[i]);
            const pbmpm_result result = pbmpm_particles_add(world, &def, NULL);
            TEST_ASSERT_TRUE(result == PBMPM_OK || result == PBMPM_ERROR_INVALID_ARGUMENT);
            survive(world, before_adding + (result == PBMPM_OK), "absurd numbers");
        }
}

/* Structures full of random bits: any answer will do, but the library lives, and what it takes it can handle. */
static void test_random_bits(void)
{
    uint32_t seed = 88172645u;
    for (int round = 0; round < 3000; round++) {
        pbmpm_settings settings;
        pbmpm_material_def material;
        pbmpm_collider_def collider;
        pbmpm_shape shape;
        pbmpm_material_id material_id;
        pbmpm_collider_id collider_id;
        pbmpm_world_def def;
        pbmpm_world_id world;
        uint32_t *const words[] = {(void *)&settings, (void *)&material, (void *)&collider, (void *)&shape, (void *)&def};
        const size_t sizes[] = {sizeof settings, sizeof material, sizeof collider, sizeof shape, offsetof(pbmpm_world_def, allocator)};
        enum { STRUCTURES = sizeof sizes / sizeof *sizes };
        def = default_world(2, 0.1f, 64);
        for (size_t s = 0; s < STRUCTURES; s++)
            for (size_t w = 0; w < sizes[s] / 4; w++)
                if (s < STRUCTURES - 1 || random_next(&seed) % 8 == 0)
                    words[s][w] = random_next(&seed);
        settings.size = sizeof settings;
        material.size = sizeof material;
        collider.size = sizeof collider;
        shape.size = sizeof shape;
        def.size = sizeof def;
        def.particle_capacity = def.particle_capacity % 1024;
        def.thread_count %= 4;
        if (pbmpm_world_create(&def, &world) == PBMPM_OK) {
            OK(pbmpm_world_step(world, 0.01f));
            OK(pbmpm_world_destroy(world));
        }
        pbmpm_world_set_settings(good.world, &settings);
        if (pbmpm_material_create(good.world, &material, &material_id) == PBMPM_OK)
            OK(pbmpm_material_destroy(good.world, material_id));
        if (pbmpm_collider_create(good.world, &collider, &shape, &collider_id) == PBMPM_OK)
            OK(pbmpm_collider_destroy(good.world, collider_id));
    }
    OK(pbmpm_world_set_settings(good.world, &before.settings));
    OK(pbmpm_world_step(good.world, 0.01f));
    world_expect_finite(good.world, "after random bits");
    TEST_ASSERT_EQUAL_UINT32(before.count, world_count(good.world));
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_arrays_of_particles);
    RUN_TEST(test_volume_of_particles);
    RUN_TEST(test_counts_beyond_all_room);
    RUN_TEST(test_fills);
    RUN_TEST(test_immense_fills);
    RUN_TEST(test_values_of_setters);
    RUN_TEST(test_volume_ratio_setter);
    RUN_TEST(test_pressure_setter);
    RUN_TEST(test_volume_in_cells);
    RUN_TEST(test_unknown_fields);
    RUN_TEST(test_absurd_but_finite_numbers);
    RUN_TEST(test_random_bits);
    return UNITY_END();
}

/* Sand and viscoplastic matter through the public interface: what is refused, and that everything a world can do is as good with them: snapshots,
 * threads, steps in the background, steps without memory, changes on the way, queries by material. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "solvers.h"

enum { BEFORE = 40, AFTER = 200 };
static const float DT = 1.0f / 480, REST[3] = {0, 0, 0};

void setUp(void) {}

void tearDown(void) { pbmpm_shutdown(); }

/* A column of sand that falls apart beside a lump of clay that sags, 24 by 16 cells of 0.05 m (3D: 4 deep). */
typedef struct yard {
    pbmpm_world_id world;
    pbmpm_material_id sand, clay;
    uint32_t sand_count, clay_count;
} yard;

static pbmpm_material_def soft(pbmpm_material_kind kind)
{
    pbmpm_material_def def = default_material(kind);
    def.density = 1500;
    def.young_modulus = 2e5f; /* sound of 13 m/s: half a cell per step */
    def.yield_strain = 0.005f;
    return def;
}

static yard make_yard(int32_t dimension, const way *chosen, int32_t threads, ledger *book, const pbmpm_material_def *sand)
{
    yard made;
    const pbmpm_material_def clay = soft(PBMPM_VISCO), plain = soft(PBMPM_SAND);
    pbmpm_world_def def = default_world(dimension, 0.05f, 4096);
    def.domain_enabled = 1;
    def.domain_max[0] = 1.2f;
    def.domain_max[1] = 0.8f;
    def.domain_max[2] = 0.2f;
    def.thread_count = threads;
    if (book) def.allocator = ledger_allocator(book);
    made.world = create_world(&def);
    OK(pbmpm_material_create(made.world, sand ? sand : &plain, &made.sand));
    OK(pbmpm_material_create(made.world, &clay, &made.clay));
    made.sand_count = fill_shape(made.world, made.sand, box_shape(0.15f, 0.2f, 0.1f, 0.15f, 0.2f, 0.1f), REST);
    made.clay_count = fill_shape(made.world, made.clay, box_shape(0.9f, 0.15f, 0.1f, 0.15f, 0.15f, 0.1f), REST);
    set_gravity(made.world, 0, -9.81f, 0);
    set_rate(made.world, 1, 5);
    use_way(made.world, chosen);
    return made;
}

static void steps(const yard *made, int count)
{
    for (int i = 0; i < count; i++) OK(pbmpm_world_step(made->world, DT));
}

/* ---- What is refused ---- */

/* Every parameter of a kind, with what is just beyond its range and what is no number, on creation and on a change. */
static void check_refusals(pbmpm_material_kind kind)
{
    const pbmpm_material_def good = soft(kind);
    struct {
        size_t offset;
        float low, high;
    } fields[] = {
        {offsetof(pbmpm_material_def, elasticity_ratio), 0.01f, 1.0f}, {offsetof(pbmpm_material_def, friction_angle), 0.0f, 1.4f},
        {offsetof(pbmpm_material_def, cohesion), 0.0f, 0.5f},          {offsetof(pbmpm_material_def, yield_strain), 0.0f, 10.0f},
        {offsetof(pbmpm_material_def, flow_rate), 0.0f, 1e9f},
    };
    const yard made = make_yard(2, &ways[0], 1, NULL, NULL);
    const pbmpm_material_id target = kind == PBMPM_SAND ? made.sand : made.clay;
    const snapshot before = snapshot_take(made.world);
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) {
        const float bad[] = {fields[f].low > 0 ? nextafterf(fields[f].low, 0) : -1e-30f, nextafterf(fields[f].high, INFINITY), -1.0f, NAN, INFINITY, -INFINITY};
        const float fine[] = {fields[f].low, fields[f].high};
        pbmpm_material_def def = good;
        pbmpm_material_id id;
        for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
            memcpy((char *)&def + fields[f].offset, &bad[i], sizeof bad[i]);
            EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_material_create(made.world, &def, &id));
            EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_material_set(made.world, target, &def));
        }
        snapshot_expect_same(&before, made.world, "a refused parameter");
        for (size_t i = 0; i < 2; i++) {
            memcpy((char *)&def + fields[f].offset, &fine[i], sizeof fine[i]);
            OK(pbmpm_material_create(made.world, &def, &id));
            OK(pbmpm_material_destroy(made.world, id));
        }
    }
}

static void test_bad_parameters_are_refused(void)
{
    check_refusals(PBMPM_SAND);
    check_refusals(PBMPM_VISCO);
}

static void test_kinds_do_not_change(void)
{
    const yard made = make_yard(2, &ways[0], 1, NULL, NULL);
    pbmpm_material_def def = soft(PBMPM_VISCO);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_material_set(made.world, made.sand, &def));
    EXPECT(PBMPM_ERROR_IN_USE, pbmpm_material_destroy(made.world, made.sand));
    EXPECT(PBMPM_ERROR_IN_USE, pbmpm_material_destroy(made.world, made.clay));
}

/* ---- Going on ---- */

/* Hashes of a run after each twentieth part, from what the world is now. */
static void run_on(const yard *made, uint64_t hashes[10])
{
    for (int part = 0; part < 10; part++) {
        steps(made, AFTER / 10);
        hashes[part] = world_hash(made->world);
    }
}

static void check_goes_on(int32_t dimension, const way *chosen)
{
    uint64_t first[10], again[10], bytes;
    const yard made = make_yard(dimension, chosen, 1, NULL, NULL), twin = make_yard(dimension, chosen, 3, NULL, NULL);
    steps(&made, BEFORE);
    OK(pbmpm_snapshot_size(made.world, &bytes, NULL));
    void *state = malloc(bytes);
    OK(pbmpm_snapshot_save(made.world, state, bytes, NULL));
    run_on(&made, first);
    world_expect_finite(made.world, chosen->name);
    TEST_ASSERT_TRUE_MESSAGE(first[0] != first[9], "nothing moves");
    OK(pbmpm_snapshot_restore(made.world, state, bytes, 0));
    run_on(&made, again);
    TEST_ASSERT_EQUAL_MEMORY_MESSAGE(first, again, sizeof first, chosen->name);
    OK(pbmpm_snapshot_restore(twin.world, state, bytes, 0)); /* another world, three threads */
    run_on(&twin, again);
    TEST_ASSERT_EQUAL_MEMORY_MESSAGE(first, again, sizeof first, chosen->name);
    free(state);
    OK(pbmpm_world_destroy(made.world));
    OK(pbmpm_world_destroy(twin.world));
}

static void test_a_snapshot_goes_on_bit_for_bit(void)
{
    for (int w = 0; w < way_count; w++) check_goes_on(2, &ways[w]);
    check_goes_on(3, &ways[0]);
    check_goes_on(3, &ways[1]);
}

static void test_a_snapshot_of_other_sand_is_refused(void)
{
    pbmpm_material_def other = soft(PBMPM_SAND);
    other.friction_angle = 0.6f;
    const yard made = make_yard(2, &ways[0], 1, NULL, NULL), foreign = make_yard(2, &ways[0], 1, NULL, &other);
    uint64_t bytes;
    OK(pbmpm_snapshot_size(made.world, &bytes, NULL));
    void *state = malloc(bytes);
    OK(pbmpm_snapshot_save(made.world, state, bytes, NULL));
    const snapshot before = snapshot_take(foreign.world);
    EXPECT(PBMPM_ERROR_FOREIGN, pbmpm_snapshot_restore(foreign.world, state, bytes, 0));
    snapshot_expect_same(&before, foreign.world, "other sand");
    free(state);
}

static void test_background_steps_are_the_same_steps(void)
{
    for (int w = 0; w < way_count; w++) {
        const yard made = make_yard(2, &ways[w], 1, NULL, NULL), other = make_yard(2, &ways[w], 1, NULL, NULL);
        for (int i = 0; i < BEFORE; i++) {
            OK(pbmpm_world_step_begin(other.world, DT));
            OK(pbmpm_world_step_end(other.world, 1));
        }
        steps(&made, BEFORE);
        TEST_ASSERT_EQUAL_HEX64_MESSAGE(world_hash(made.world), world_hash(other.world), ways[w].name);
        OK(pbmpm_world_destroy(made.world));
        OK(pbmpm_world_destroy(other.world));
    }
}

static void test_warm_steps_take_no_memory(void)
{
    for (int w = 0; w < way_count; w++) {
        static ledger book;
        book = (ledger){0};
        const yard made = make_yard(2, &ways[w], 1, &book, NULL);
        steps(&made, AFTER); /* until nothing spreads any more */
        const uint64_t calls = book.calls;
        steps(&made, 20);
        TEST_ASSERT_EQUAL_UINT64_MESSAGE(calls, book.calls, ways[w].name);
        OK(pbmpm_world_destroy(made.world));
        ledger_expect_clean(&book, ways[w].name);
    }
}

/* ---- Changes on the way ---- */

static float front_of(const yard *made, pbmpm_material_id material)
{
    const pbmpm_view position = view_of(made->world, PBMPM_POSITION), kind = view_of(made->world, PBMPM_MATERIAL);
    float front = 0;
    for (uint32_t i = 0; i < position.count; i++)
        if (view_uint(&kind, i, 0) == material.index) front = fmaxf(front, view_float(&position, i, 0));
    return front;
}

/* Sand that loses its friction runs away at once. */
static void test_a_change_of_friction_takes_effect(void)
{
    const yard rough = make_yard(2, &ways[0], 1, NULL, NULL), smooth = make_yard(2, &ways[0], 1, NULL, NULL);
    steps(&rough, BEFORE);
    steps(&smooth, BEFORE);
    TEST_ASSERT_EQUAL_HEX64(world_hash(rough.world), world_hash(smooth.world));
    pbmpm_material_def def = {.size = sizeof def};
    OK(pbmpm_material_get(smooth.world, smooth.sand, &def));
    def.friction_angle = 0;
    OK(pbmpm_material_set(smooth.world, smooth.sand, &def));
    steps(&rough, 60);
    steps(&smooth, 60);
    TEST_ASSERT_TRUE(front_of(&smooth, smooth.sand) > front_of(&rough, rough.sand) + 0.02f);
}

/* ---- Queries ---- */

static void test_regions_and_removal_know_the_materials(void)
{
    yard made = make_yard(2, &ways[0], 1, NULL, NULL);
    pbmpm_region_share shares[3] = {{.size = sizeof *shares}};
    uint32_t materials = 0, removed = 0;
    const pbmpm_shape all = box_shape(0.6f, 0.4f, 0, 0.6f, 0.4f, 1), clay = box_shape(0.9f, 0.15f, 0, 0.2f, 0.2f, 1);
    TEST_ASSERT_EQUAL_UINT32(made.sand_count + made.clay_count, world_count(made.world));
    OK(pbmpm_query_region(made.world, &all, shares, 3, &materials));
    TEST_ASSERT_EQUAL_UINT32(2, materials);
    for (uint32_t i = 0; i < 2; i++) {
        const bool is_sand = shares[i].material.index == made.sand.index;
        TEST_ASSERT_EQUAL_UINT32(is_sand ? made.sand_count : made.clay_count, shares[i].count);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, is_sand ? 0.3 * 0.4 : 0.3 * 0.3, shares[i].rest_volume);
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, 1500 * (is_sand ? 0.3 * 0.4 : 0.3 * 0.3), shares[i].mass);
    }
    OK(pbmpm_particles_remove_in(made.world, &clay, &removed));
    TEST_ASSERT_EQUAL_UINT32(made.clay_count, removed);
    OK(pbmpm_query_region(made.world, &all, shares, 3, &materials));
    TEST_ASSERT_EQUAL_UINT32(1, materials);
    OK(pbmpm_material_destroy(made.world, made.clay));
    steps(&made, 20);
    TEST_ASSERT_EQUAL_UINT32(made.sand_count, world_count(made.world));
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_bad_parameters_are_refused);
    RUN_TEST(test_kinds_do_not_change);
    RUN_TEST(test_a_snapshot_goes_on_bit_for_bit);
    RUN_TEST(test_a_snapshot_of_other_sand_is_refused);
    RUN_TEST(test_background_steps_are_the_same_steps);
    RUN_TEST(test_warm_steps_take_no_memory);
    RUN_TEST(test_a_change_of_friction_takes_effect);
    RUN_TEST(test_regions_and_removal_know_the_materials);
    return UNITY_END();
}

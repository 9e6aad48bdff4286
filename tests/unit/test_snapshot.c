/* Snapshots that are sound by their checksum and false all the same: made up, or of a later version. Nothing in them may lead a step
 * astray. */
#include <float.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "edit.h"
#include "inspect.h"
#include "random.h"
#include "registry.h"
#include "snapshot.h"
#include "step.h"

enum { HEADER_BYTES = 32, VERSION_AT = 8, SECTIONS_AT = 12, BYTES_AT = 16, PARTICLES_TAG = 6 };

static World *world;
static pbmpm_material_id water;
static char *snapshot, *forged;
static uint64_t bytes;

static void open_world(int dimension)
{
    pbmpm_world_def def = world_def_defaults();
    pbmpm_material_def liquid = material_defaults(), elastic = material_defaults();
    pbmpm_collider_def ball = collider_defaults();
    pbmpm_material_id jelly;
    pbmpm_collider_id id;
    def.dimension = dimension;
    def.particle_capacity = 1000;
    def.thread_count = 1;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_create(&def, &world));
    elastic.kind = PBMPM_ELASTIC;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &liquid, registry_next_generation(), &water));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &elastic, registry_next_generation(), &jelly));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_enable_deformation(&world->particles, &world->memory));
    ball.shape.kind = PBMPM_SPHERE;
    ball.kinematic = 1;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, colliders_add(&world->colliders, &world->memory, &ball, NULL, registry_next_generation(), &id));
    for (int i = 0; i < 60; i++) {
        const NewParticle particle = {{i % 5 + 0.25, i % 7 - 0.25, i % 3}, {1, 0, 0}, 125.0f, i % 2 ? water.index : jelly.index};
        particles_append(&world->particles, &particle, registry_next_generation());
    }
    world->particles.status[7] = world->particles.status[30] = K_REMOVED;
    particles_compact(&world->particles, 0);
    bytes = snapshot_size(world);
    snapshot = malloc(bytes);
    forged = malloc(bytes);
    snapshot_save(world, snapshot);
    memcpy(forged, snapshot, bytes);
}

static void close_world(void)
{
    free(snapshot);
    free(forged);
    snapshot = forged = NULL;
    if (world) world_destroy(world);
    world = NULL;
}

void setUp(void) {}
void tearDown(void) { close_world(); }

static pbmpm_result restore_forged(void)
{
    snapshot_seal(forged);
    const pbmpm_result result = snapshot_restore(world, forged, bytes);
    memcpy(forged, snapshot, bytes);
    return result;
}

static void write_u32(uint64_t at, uint32_t value) { memcpy(forged + at, &value, sizeof value); }
static void write_u64(uint64_t at, uint64_t value) { memcpy(forged + at, &value, sizeof value); }

static uint32_t read_u32(uint64_t at)
{
    uint32_t value;
    memcpy(&value, snapshot + at, sizeof value);
    return value;
}

static uint64_t read_u64(uint64_t at)
{
    uint64_t value;
    memcpy(&value, snapshot + at, sizeof value);
    return value;
}

/* Where the header of a section lies. */
static uint64_t find_section(uint32_t tag)
{
    for (uint64_t at = HEADER_BYTES; at < bytes; at += 16 + (read_u64(at + 8) + 7) / 8 * 8)
        if (read_u32(at) == tag) return at;
    TEST_FAIL_MESSAGE("no such section");
    return 0;
}

/* Where the first array of a field of the particles lies. */
static uint64_t find_field(uint32_t tag)
{
    const uint64_t contents = find_section(PARTICLES_TAG) + 16;
    const uint32_t count = read_u32(contents), fields = read_u32(contents + 4);
    uint64_t at = contents + 16 + 8 * (uint64_t)fields;
    for (uint32_t i = 0; i < fields; i++) {
        if (read_u32(contents + 16 + 8 * (uint64_t)i) == tag) return at;
        at += (uint64_t)count * read_u32(contents + 20 + 8 * (uint64_t)i);
    }
    TEST_FAIL_MESSAGE("no such field");
    return 0;
}

static void expect_foreign_and_unchanged(const char *what)
{
    const uint64_t hash = inspect_hash(world), generation = world->generation;
    TEST_ASSERT_EQUAL_INT_MESSAGE(PBMPM_ERROR_FOREIGN, restore_forged(), what);
    TEST_ASSERT_EQUAL_HEX64_MESSAGE(hash, inspect_hash(world), what);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(generation, world->generation, what);
}

static void test_a_sealed_snapshot_is_taken(void)
{
    open_world(3);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, restore_forged());
}

/* What steps remember beside the particles: a step's length and iterations before they changed, and what the primal solver's solutions lost. */
static void test_what_steps_remember_comes_back(void)
{
    open_world(2);
    world->slow_dt = 0.02;
    world->slow_iterations = 3.5;
    world->primal.credit = 42.5;
    world->strain_unchecked = true;
    snapshot_save(world, snapshot);
    world->slow_dt = world->slow_iterations = world->primal.credit = 0.0;
    world->strain_unchecked = false;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, snapshot_restore(world, snapshot, bytes));
    TEST_ASSERT_EQUAL_DOUBLE(0.02, world->slow_dt);
    TEST_ASSERT_EQUAL_DOUBLE(3.5, world->slow_iterations);
    TEST_ASSERT_EQUAL_DOUBLE(42.5, world->primal.credit);
    TEST_ASSERT_TRUE(world->strain_unchecked);
}

static void test_other_versions_and_sections(void)
{
    open_world(2);
    write_u32(VERSION_AT, PBMPM_SNAPSHOT_VERSION + 1);
    expect_foreign_and_unchanged("a later version");
    write_u32(find_section(PARTICLES_TAG), 4711);
    expect_foreign_and_unchanged("an unknown section");
    write_u32(find_section(4), PARTICLES_TAG);
    expect_foreign_and_unchanged("a section twice");
    write_u32(SECTIONS_AT, read_u32(SECTIONS_AT) - 1);
    expect_foreign_and_unchanged("a section less");
    write_u32(SECTIONS_AT, UINT32_MAX);
    expect_foreign_and_unchanged("more sections than there are");
    write_u64(find_section(PARTICLES_TAG) + 8, UINT64_MAX - 3);
    expect_foreign_and_unchanged("a section without end");
    write_u64(find_section(1) + 8, 0);
    expect_foreign_and_unchanged("an empty section");
}

static void test_false_particles(void)
{
    open_world(3);
    const uint64_t contents = find_section(PARTICLES_TAG) + 16;
    write_u32(find_field(FIELD_MATERIAL), 2);
    expect_foreign_and_unchanged("a material that does not exist");
    write_u32(find_field(FIELD_MATERIAL) + 4, UINT32_MAX);
    expect_foreign_and_unchanged("a material far away");
    write_u32(find_field(FIELD_CELL), PBMPM_MAX_CELL);
    expect_foreign_and_unchanged("a cell out of range");
    write_u32(find_field(FIELD_CELL) + 8, 0x80000000u);
    expect_foreign_and_unchanged("the lowest cell");
    write_u32(find_field(FIELD_FRACTION), 0x7fc00000u);
    expect_foreign_and_unchanged("a place that is NaN");
    write_u32(find_field(FIELD_MASS), 0);
    expect_foreign_and_unchanged("no mass");
    write_u32(find_field(FIELD_MASS), 0x7f800000u);
    expect_foreign_and_unchanged("infinite mass");
    write_u32(find_field(FIELD_ID), read_u32(find_field(FIELD_ID) + 8));
    expect_foreign_and_unchanged("an identifier twice");
    write_u32(find_field(FIELD_ID), 999);
    expect_foreign_and_unchanged("an identifier that was never used");
    write_u32(find_field(FIELD_ID) + 4, 0);
    expect_foreign_and_unchanged("an identifier without generation");
    write_u32(contents, 1u << 30);
    expect_foreign_and_unchanged("more particles than there are bytes");
    write_u32(contents + 4, 17);
    expect_foreign_and_unchanged("more fields than there can be");
    write_u32(contents + 16, 99);
    expect_foreign_and_unchanged("an unknown field");
    write_u32(contents + 16, FIELD_FRACTION);
    expect_foreign_and_unchanged("a field twice");
    write_u32(contents + 20, 8);
    expect_foreign_and_unchanged("a field of another size");
    write_u32(contents + 8, 2000);
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_CAPACITY, restore_forged());
}

/* Bytes changed at random, and sealed. What is taken may be nonsense, but the world lives on. */
static void test_random_forgeries_do_no_harm(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        open_world(dimension);
        Random random = {(uint64_t)dimension};
        int taken = 0;
        for (int round = 0; round < 3000; round++) {
            const uint32_t places = 1 + random_below(&random, 4);
            for (uint32_t k = 0; k < places; k++)
                forged[HEADER_BYTES + random_below(&random, (uint32_t)bytes - HEADER_BYTES)] = (char)random_below(&random, 256);
            if (restore_forged() != PBMPM_OK) continue;
            taken++;
            world->settings.substeps = 1; /* many parts take long */
            world->settings.iterations = 1;
            world->settings.solver = PBMPM_SOLVER_PAPER;
            world_step(world, 0.01f);
            TEST_ASSERT_TRUE(world->particles.count <= 58);
        }
        TEST_ASSERT_TRUE(taken > 100);
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, snapshot_restore(world, snapshot, bytes));
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_step(world, 0.01f));
        close_world();
    }
}

/* Later identifiers must not repeat those of a snapshot from another process. */
static void test_generations_of_a_snapshot_are_not_given_again(void)
{
    open_world(2);
    const uint32_t far = registry_next_generation() + 1000;
    write_u32(find_field(FIELD_ID) + 4, far);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, restore_forged());
    TEST_ASSERT_TRUE(registry_next_generation() > far);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_sealed_snapshot_is_taken);
    RUN_TEST(test_what_steps_remember_comes_back);
    RUN_TEST(test_other_versions_and_sections);
    RUN_TEST(test_false_particles);
    RUN_TEST(test_random_forgeries_do_no_harm);
    RUN_TEST(test_generations_of_a_snapshot_are_not_given_again);
    return UNITY_END();
}

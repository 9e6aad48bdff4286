/* Snapshots that are sound by their checksum and false all the same: made up, or of a later version. Nothing in them may lead a step
 * astray. */
#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "base/generations.h"
#include "books.h"
#include "random.h"
#include "services/edit_particles.h"
#include "services/lifecycle.h"
#include "services/registry.h"
#include "services/state_hash.h"
#include "snapshot/snapshot.h"
#include "step/step.h"

enum { HEADER_BYTES = 32, VERSION_AT = 8, SECTIONS_AT = 12, BYTES_AT = 16, PARTICLES_TAG = 6 };

static World *world;
static pbmpm_material_id water;
static char *snapshot, *forged;
static uint64_t bytes;

static Books books;

/* Without particles; a liquid, an elastic material and a collider. */
static void make_world(int dimension)
{
    pbmpm_world_def def = world_def_defaults();
    pbmpm_material_def liquid = material_defaults(), elastic = material_defaults();
    pbmpm_collider_def movable = collider_defaults();
    pbmpm_shape ball = shape_defaults();
    pbmpm_material_id jelly;
    pbmpm_collider_id id;
    def.dimension = dimension;
    def.particle_capacity = 1000;
    def.thread_count = 1;
    const Memory memory = books_memory(&books, 0);
    def.allocator = &memory.allocator;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_create(&def, &world));
    elastic.kind = PBMPM_ELASTIC;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &liquid, generation_next(), &water));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &elastic, generation_next(), &jelly));
    ball.kind = PBMPM_SPHERE;
    movable.kinematic = 1;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, colliders_add(&world->colliders, &world->memory, &movable, &ball, NULL, generation_next(), &id));
}

static void save_world(void)
{
    bytes = snapshot_size(world);
    snapshot = malloc(bytes);
    forged = malloc(bytes);
    snapshot_save(world, snapshot);
    memcpy(forged, snapshot, bytes);
}

static void open_world(int dimension)
{
    make_world(dimension);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_enable_deformation(&world->particles, &world->memory));
    for (int i = 0; i < 60; i++) {
        const NewParticle particle = {{i % 5 + 0.25, i % 7 - 0.25, i % 3}, {1, 0, 0}, 125.0f, i % 2 ? water.index : water.index + 1, 0};
        particles_append(&world->particles, &particle, generation_next());
    }
    world->particles.status[7] = world->particles.status[30] = K_REMOVED;
    particles_compact(&world->particles, 0);
    save_world();
}

/* Matter at rest without gravity, most of which sleeps. */
static void open_sleepers(void)
{
    make_world(2);
    world->settings.sleeping = 1;
    world->settings.sleep_time = 0.0f;
    world->settings.sleep_speed = 1e9f;
    world->settings.solver = PBMPM_SOLVER_DUAL;
    for (int i = 0; i < 900; i++) {
        const NewParticle particle = {{i % 30 * 0.5, i / 30 * 0.5, 0}, {0}, 250.0f, water.index, 0};
        particles_append(&world->particles, &particle, generation_next());
    }
    for (int step = 0; step < 6; step++) TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_step(world, 0.01f));
    TEST_ASSERT_TRUE(world->sleep.rows > 0 && world->sleep.pieces > 0);
    save_world();
}

static void close_world(void)
{
    free(snapshot);
    free(forged);
    snapshot = forged = NULL;
    if (world) world_destroy(world);
    world = NULL;
    TEST_ASSERT_EQUAL_UINT64(0, books.live_blocks);
    books = (Books){0};
}

void setUp(void) {}
void tearDown(void) { close_world(); }

static pbmpm_result restore_forged(void)
{
    snapshot_seal(forged);
    const pbmpm_result result = snapshot_restore(world, forged, bytes, 0);
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
    const uint64_t hash = state_hash(world), generation = world->generation;
    TEST_ASSERT_EQUAL_INT_MESSAGE(PBMPM_ERROR_FOREIGN, restore_forged(), what);
    TEST_ASSERT_EQUAL_HEX64_MESSAGE(hash, state_hash(world), what);
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
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, snapshot_restore(world, snapshot, bytes, 0));
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
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, snapshot_restore(world, snapshot, bytes, 0));
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_step(world, 0.01f));
        close_world();
    }
}

/* ---- Sleep ---- */

enum { SLEEP_TAG = 11, SLEEP_CONTENTS = 56, STILL_ROWS_AT = 24, ASLEEP_AT = 32, DT_AT = 48 };

static uint64_t find_block(uint32_t i) { return find_section(SLEEP_TAG) + 16 + SLEEP_CONTENTS + i * sizeof(SleepBlock); }

static void test_false_sleep(void)
{
    static const uint32_t places[] = {0x7fffffffu, 0x80000000u, 0x20000000u, 0xdfffffffu, PBMPM_MAX_CELL, 0u - PBMPM_MAX_CELL};
    open_sleepers();
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, restore_forged());
    TEST_ASSERT_TRUE(world->sleep.rows > 0);
    const uint64_t contents = find_section(SLEEP_TAG) + 16;
    const uint32_t asleep = read_u32(contents + ASLEEP_AT), active = read_u32(contents + ASLEEP_AT + 4);
    TEST_ASSERT_EQUAL_UINT64(read_u64(contents - 8), SLEEP_CONTENTS + (asleep + active) * sizeof(SleepBlock) + read_u32(contents + ASLEEP_AT + 8) * sizeof(SleepPiece));
    for (uint32_t which = 0; which < 2; which++) {
        const uint64_t block = find_block(which ? asleep : 0);
        if (which && active == 0) break;
        for (int a = 0; a < 3; a++)
            for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
                write_u32(block + 4 * (uint64_t)a, places[i]);
                expect_foreign_and_unchanged("the place of a block");
            }
        write_u32(block + 8, 1);
        expect_foreign_and_unchanged("a place beside the plane");
        write_u32(block + offsetof(SleepBlock, quiet), 0x7fc00000u);
        expect_foreign_and_unchanged("a time that is NaN");
        write_u32(block + offsetof(SleepBlock, gained) + 4, 0x7f800000u);
        expect_foreign_and_unchanged("an infinite velocity");
        write_u32(block + offsetof(SleepBlock, liquid_mass), 0xff800000u);
        expect_foreign_and_unchanged("an infinite mass");
    }
    write_u32(contents + STILL_ROWS_AT, 5000);
    expect_foreign_and_unchanged("more rows than there is room for");
    write_u64(contents + DT_AT, 0x7ff0000000000000u);
    expect_foreign_and_unchanged("an endless substep");
}

/* What is not finite is for the next step to find, and that does not look at who sleeps. */
static void test_sleepers_that_are_not_finite_wake(void)
{
    static const uint32_t tags[] = {FIELD_VELOCITY, FIELD_AFFINE};
    for (int i = 0; i < 2; i++) {
        open_sleepers();
        const uint32_t count = world->particles.count;
        write_u32(find_field(tags[i]), 0x7fc00000u);
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, restore_forged());
        TEST_ASSERT_EQUAL_UINT32(0, world->sleep.rows);
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_step(world, 0.01f));
        TEST_ASSERT_TRUE(world->particles.count >= count - 1);
        for (uint32_t row = 0; row < world->particles.count; row++)
            TEST_ASSERT_TRUE(isfinite(world->particles.velocity[0][row]) && isfinite(world->particles.affine[0][row]));
        close_world();
    }
}

static void test_false_counters(void)
{
    static const uint64_t wrong[] = {0x7ff8000000000000u, 0x7ff0000000000000u, 0xbff0000000000000u};
    open_world(2);
    const uint64_t counters = find_section(4) + 24; /* behind the length of the part */
    for (uint64_t field = 3; field < 6; field++)
        for (int i = 0; i < 3; i++) {
            write_u64(counters + 8 * field, wrong[i]);
            expect_foreign_and_unchanged("a time or a number of iterations that cannot be");
        }
    write_u64(counters + 56, wrong[0]);
    expect_foreign_and_unchanged("an energy that is NaN");
}

/* ---- Memory ---- */

/* Whichever piece of memory is missing, the world stays as it was: no field more, no byte more. */
static void test_without_memory_nothing_changes(void)
{
    open_sleepers();
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_enable(&world->particles, &world->memory, FIELD_DEFORMATION));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_enable(&world->particles, &world->memory, FIELD_PAST_AFFINE));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_enable(&world->particles, &world->memory, FIELD_PAST_DT));
    free(snapshot);
    free(forged);
    save_world();
    world_destroy(world);
    make_world(2);
    const uint64_t used = world->memory.used, hash = state_hash(world), blocks = books.live_blocks;
    const int fields = world->particles.field_count;
    uint64_t failures = 0;
    pbmpm_result result;
    do {
        books.fail_at = books.calls + failures + 1;
        result = snapshot_restore(world, snapshot, bytes, 0);
        if (result == PBMPM_OK) break;
        failures++;
        TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_OUT_OF_MEMORY, result);
        TEST_ASSERT_EQUAL_UINT64(used, world->memory.used);
        TEST_ASSERT_EQUAL_UINT64(blocks, books.live_blocks);
        TEST_ASSERT_EQUAL_INT(fields, world->particles.field_count);
        TEST_ASSERT_TRUE(!world->particles.deformation[0] && !world->particles.pressure && !world->particles.past_affine[0] && !world->particles.past_dt);
        TEST_ASSERT_EQUAL_HEX64(hash, state_hash(world));
    } while (failures < 100);
    books.fail_at = 0;
    TEST_ASSERT_TRUE(failures >= 10 && failures < 100); /* four fields and six lists of who sleeps */
    TEST_ASSERT_TRUE(world->sleep.rows > 0);
    const uint64_t warm = books.calls; /* the same again takes nothing */
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, snapshot_restore(world, snapshot, bytes, 0));
    TEST_ASSERT_EQUAL_UINT64(warm, books.calls);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_step(world, 0.01f));
}

/* ---- Generations ---- */

/* Numbers near the end of their range would soon begin anew, and stale identifiers be taken for live ones. */
static void test_generations_near_the_end_of_their_range(void)
{
    open_world(2);
    const uint32_t own = generation_next();
    write_u32(find_field(FIELD_ID) + 4, UINT32_MAX);
    expect_foreign_and_unchanged("the last generation");
    write_u32(find_field(FIELD_ID) + 4, UINT32_MAX - 1000);
    expect_foreign_and_unchanged("one of the last generations");
    write_u32(find_field(FIELD_ID) + 4, 0x80000000u);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, restore_forged());
    TEST_ASSERT_TRUE(generation_next() < own + 1000); /* those of worlds, materials and all else go on */
}

/* Later identifiers must not repeat those of a snapshot from another process. */
static void test_generations_of_a_snapshot_are_not_given_again(void)
{
    open_world(2);
    const uint32_t far = generation_next_of_particles() + 1000;
    write_u32(find_field(FIELD_ID) + 4, far);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, restore_forged());
    TEST_ASSERT_TRUE(generation_next_of_particles() > far);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_sealed_snapshot_is_taken);
    RUN_TEST(test_what_steps_remember_comes_back);
    RUN_TEST(test_other_versions_and_sections);
    RUN_TEST(test_false_particles);
    RUN_TEST(test_false_sleep);
    RUN_TEST(test_sleepers_that_are_not_finite_wake);
    RUN_TEST(test_false_counters);
    RUN_TEST(test_without_memory_nothing_changes);
    RUN_TEST(test_random_forgeries_do_no_harm);
    RUN_TEST(test_generations_of_a_snapshot_are_not_given_again);
    RUN_TEST(test_generations_near_the_end_of_their_range);
    return UNITY_END();
}

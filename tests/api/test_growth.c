/* Structures of other versions: a later one's are larger, and every call that takes a structure with a size takes them, as far as it knows
 * them. Tables say which calls take which structure; a structure that is in no table fails the first test. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sized_calls.h"

enum {
    MOST = 4096,   /* no version is larger */
    BEYOND = 64,   /* bytes behind a structure, which nobody writes */
    FILLER = 0xA5, /* what is there before a call */
    LISTED = 8,    /* room of an array */
};

static const pbmpm_layout_entry *layout;
static uint32_t layout_count;

void setUp(void)
{
    OK(pbmpm_layout_table(&layout, &layout_count));
    world = target_create(NULL, NULL);
}

void tearDown(void) { pbmpm_shutdown(); }

static void new_world(void)
{
    OK(pbmpm_world_destroy(world.world));
    world = target_create(NULL, NULL);
}

/* Larger than the library's: by the least there can be, by a member, and the largest. */
static uint32_t larger(size_t size, int i) { return i == 0 ? (uint32_t)size + 1 : i == 1 ? (uint32_t)size + 8 : MOST; }
enum { LARGER = 3 };

/* No version has had these, nor will one: what has a size is made of members of 4 bytes and more. */
static uint32_t unknown(size_t size, int i)
{
    const uint32_t sizes[] = {0, 1, 3, 4, (uint32_t)size - 1, (uint32_t)size - 3, MOST + 1, 5000, 0x80000000u, UINT32_MAX};
    return sizes[i];
}
enum { UNKNOWN = 10 };

static void set_size(void *structure, uint32_t size) { memcpy(structure, &size, sizeof size); }

static uint32_t size_of(const void *structure)
{
    uint32_t size;
    memcpy(&size, structure, sizeof size);
    return size;
}

static const char *label_of(const char *call, const char *structure, uint32_t size)
{
    static char label[200];
    snprintf(label, sizeof label, "%s with %s of %u bytes", call, structure, (unsigned)size);
    return label;
}

/* All members but the size: bytes between them are nobody's. */
static void expect_same_members(const char *structure, const void *expected, const void *actual, const char *label)
{
    uint32_t members = 0;
    for (uint32_t i = 0; i < layout_count; i++) {
        const pbmpm_layout_entry *row = &layout[i];
        if (strcmp(row->structure, structure) != 0 || !row->field[0] || strcmp(row->field, "size") == 0) continue;
        const char *const from = (const char *)expected + row->offset, *const to = (const char *)actual + row->offset;
        if (memcmp(from, to, row->size) != 0) {
            char line[300];
            snprintf(line, sizeof line, "%s: %s differs", label, row->field);
            TEST_FAIL_MESSAGE(line);
        }
        members++;
    }
    TEST_ASSERT_TRUE_MESSAGE(members > 0, label);
}

static void expect_result(pbmpm_result expected, pbmpm_result actual, const char *label)
{
    TEST_ASSERT_EQUAL_STRING_MESSAGE(pbmpm_result_name(expected), pbmpm_result_name(actual), label);
}

/* ---- Everything that a world is ---- */

typedef struct state {
    snapshot figures;
    uint64_t bytes;
    char saved[1 << 18];
} state;

static void state_take(state *now)
{
    now->figures = snapshot_take(world.world);
    OK(pbmpm_snapshot_save(world.world, now->saved, sizeof now->saved, &now->bytes));
}

static void state_expect_same(const state *before, const char *label)
{
    static state now;
    snapshot_expect_same(&before->figures, world.world, label);
    state_take(&now);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(before->bytes, now.bytes, label);
    TEST_ASSERT_TRUE_MESSAGE(memcmp(before->saved, now.saved, now.bytes) == 0, label);
}

/* ---- Tests ---- */

/* Structures stand on the heap, in blocks of just their size, so that a sanitizer sees who reads or writes behind them. */
static unsigned char *structure_of(uint32_t size, int filler)
{
    unsigned char *structure = malloc(size);
    TEST_ASSERT_NOT_NULL(structure);
    memset(structure, filler, size);
    return structure;
}

static bool has_size(const char *structure)
{
    for (uint32_t i = 0; i + 1 < layout_count; i++)
        if (strcmp(layout[i].structure, structure) == 0 && !layout[i].field[0])
            return strcmp(layout[i + 1].field, "size") == 0 && layout[i + 1].offset == 0;
    return false;
}

static bool is_in_a_table(const pbmpm_layout_entry *whole)
{
    for (int i = 0; i < sized_input_count; i++)
        if (strcmp(sized_inputs[i].structure, whole->structure) == 0) return sized_inputs[i].size == whole->size;
    for (int i = 0; i < sized_output_count; i++)
        if (strcmp(sized_outputs[i].structure, whole->structure) == 0) return sized_outputs[i].size == whole->size;
    for (int i = 0; i < sized_array_count; i++)
        if (strcmp(sized_arrays[i].structure, whole->structure) == 0) return sized_arrays[i].size == whole->size;
    return false;
}

static void test_every_structure_with_a_size_is_here(void)
{
    int found = 0;
    for (uint32_t i = 0; i < layout_count; i++) {
        if (layout[i].field[0] || !has_size(layout[i].structure)) continue;
        TEST_ASSERT_TRUE_MESSAGE(is_in_a_table(&layout[i]), layout[i].structure);
        found++;
    }
    TEST_ASSERT_TRUE(found >= 29); /* as many as in 0.2 */
    for (int i = 0; i < sized_input_count; i++) TEST_ASSERT_TRUE_MESSAGE(has_size(sized_inputs[i].structure), sized_inputs[i].structure);
    for (int i = 0; i < sized_output_count; i++) TEST_ASSERT_TRUE_MESSAGE(has_size(sized_outputs[i].structure), sized_outputs[i].structure);
}

static void test_defaults_fill_larger_structures(void)
{
    for (int i = 0; i < sized_init_count; i++) {
        const sized_init *row = &sized_inits[i];
        _Alignas(8) unsigned char plain[MOST], room[MOST + BEYOND];
        OK(row->make(plain, row->size));
        for (int k = 0; k < LARGER; k++) {
            const uint32_t size = larger(row->size, k);
            const char *label = label_of(row->call, row->structure, size);
            memset(room, FILLER, sizeof room);
            expect_result(PBMPM_OK, row->make(room, size), label);
            TEST_ASSERT_EQUAL_UINT32_MESSAGE(size, size_of(room), label);
            expect_same_members(row->structure, plain, room, label);
            TEST_ASSERT_EACH_EQUAL_HEX8_MESSAGE(0, room + row->size, size - row->size, label);
            TEST_ASSERT_EACH_EQUAL_HEX8_MESSAGE(FILLER, room + size, BEYOND, label);
        }
        memset(room, FILLER, sizeof room);
        for (int k = 0; k < UNKNOWN; k++) {
            const char *label = label_of(row->call, row->structure, unknown(row->size, k));
            expect_result(PBMPM_ERROR_UNSUPPORTED, row->make(room, unknown(row->size, k)), label);
            TEST_ASSERT_EACH_EQUAL_HEX8_MESSAGE(FILLER, room, sizeof room, label);
        }
        expect_result(PBMPM_ERROR_UNSUPPORTED, row->make(room, (size_t)-1), row->call);
    }
}

/* What a call reads of `size` bytes: sound values, then `last` in the last byte. */
static unsigned char *given_of(const sized_input *row, uint32_t size, unsigned char last)
{
    _Alignas(8) unsigned char plain[MOST];
    unsigned char *given = structure_of(size, 0);
    row->fill(plain);
    memcpy(given, plain, row->size);
    given[size - 1] |= last;
    set_size(given, size);
    return given;
}

/* Makes the call in a new world, which then makes a step. The hash is of the world after it. */
static void call_in_new_world(const sized_input *row, uint32_t size, uint64_t *number, uint64_t *hash)
{
    const char *label = label_of(row->call, row->structure, size);
    union {
        uint64_t number;
        unsigned char bytes[MOST];
    } outcome = {0};
    new_world();
    unsigned char *given = given_of(row, size, 0);
    if (row->reads_back) set_size(&outcome, (uint32_t)row->size);
    expect_result(PBMPM_OK, row->make(given, &outcome), label);
    if (row->reads_back) expect_same_members(row->structure, given, outcome.bytes, label);
    *number = row->reads_back ? 0 : outcome.number;
    free(given);
    OK(pbmpm_world_step(world.world, 0.01f));
    *hash = world_hash(world.world);
}

static void test_larger_structures_are_read(void)
{
    for (int i = 0; i < sized_input_count; i++) {
        uint64_t number, hash, same_number, same_hash;
        call_in_new_world(&sized_inputs[i], (uint32_t)sized_inputs[i].size, &number, &hash);
        for (int k = 0; k < LARGER; k++) {
            call_in_new_world(&sized_inputs[i], larger(sized_inputs[i].size, k), &same_number, &same_hash);
            TEST_ASSERT_EQUAL_UINT64_MESSAGE(number, same_number, sized_inputs[i].call);
            TEST_ASSERT_EQUAL_HEX64_MESSAGE(hash, same_hash, sized_inputs[i].call);
        }
    }
}

static state before; /* too large for the stack */

static void expect_refused(const sized_input *row, const void *given, const char *label)
{
    _Alignas(8) unsigned char outcome[MOST];
    set_size(outcome, (uint32_t)row->size);
    expect_result(PBMPM_ERROR_UNSUPPORTED, row->make(given, outcome), label);
    state_expect_same(&before, label);
}

/* The first byte and the last one that the library does not know. */
static void test_members_of_later_versions_are_refused(void)
{
    state_take(&before);
    for (int i = 0; i < sized_input_count; i++)
        for (int k = 0; k < LARGER; k++) {
            const uint32_t size = larger(sized_inputs[i].size, k);
            const char *label = label_of(sized_inputs[i].call, sized_inputs[i].structure, size);
            unsigned char *given = given_of(&sized_inputs[i], size, 0x80);
            expect_refused(&sized_inputs[i], given, label);
            TEST_ASSERT_NOT_NULL_MESSAGE(strstr(pbmpm_last_error(), sized_inputs[i].call), pbmpm_last_error());
            TEST_ASSERT_NOT_NULL_MESSAGE(strstr(pbmpm_last_error(), sized_inputs[i].structure), pbmpm_last_error());
            given[size - 1] = 0;
            given[sized_inputs[i].size] = 1;
            expect_refused(&sized_inputs[i], given, label);
            free(given);
        }
}

static void test_sizes_that_no_version_had_are_not_read(void)
{
    state_take(&before);
    for (int i = 0; i < sized_input_count; i++)
        for (int k = 0; k < UNKNOWN; k++) {
            const uint32_t size = unknown(sized_inputs[i].size, k);
            unsigned char *given = given_of(&sized_inputs[i], (uint32_t)sized_inputs[i].size, 0);
            set_size(given, size);
            expect_refused(&sized_inputs[i], given, label_of(sized_inputs[i].call, sized_inputs[i].structure, size));
            TEST_ASSERT_NOT_NULL_MESSAGE(strstr(pbmpm_last_error(), size ? "which no version" : "size is 0: "), pbmpm_last_error()); /* 0 is one that was forgotten */
            free(given);
        }
}

static void test_larger_structures_are_written(void)
{
    OK(pbmpm_world_step(world.world, 0.01f));
    for (int i = 0; i < sized_output_count; i++) {
        const sized_output *row = &sized_outputs[i];
        unsigned char *plain = structure_of((uint32_t)row->size, FILLER);
        set_size(plain, (uint32_t)row->size);
        expect_result(PBMPM_OK, row->make(plain), row->call);
        TEST_ASSERT_EQUAL_UINT32_MESSAGE(row->size, size_of(plain), row->call);
        for (int k = 0; k < LARGER; k++) {
            const uint32_t size = larger(row->size, k);
            const char *label = label_of(row->call, row->structure, size);
            unsigned char *taken = structure_of(size, FILLER);
            set_size(taken, size);
            expect_result(PBMPM_OK, row->make(taken), label);
            TEST_ASSERT_EQUAL_UINT32_MESSAGE(size, size_of(taken), label);
            expect_same_members(row->structure, plain, taken, label);
            TEST_ASSERT_EACH_EQUAL_HEX8_MESSAGE(0, taken + row->size, size - row->size, label);
            free(taken);
        }
        free(plain);
    }
}

static void test_sizes_that_no_version_had_are_not_written(void)
{
    for (int i = 0; i < sized_output_count; i++)
        for (int k = 0; k < UNKNOWN; k++) {
            const uint32_t size = unknown(sized_outputs[i].size, k), room = (uint32_t)sized_outputs[i].size;
            const char *label = label_of(sized_outputs[i].call, sized_outputs[i].structure, size);
            unsigned char *taken = structure_of(room, FILLER);
            set_size(taken, size);
            expect_result(PBMPM_ERROR_UNSUPPORTED, sized_outputs[i].make(taken), label);
            TEST_ASSERT_EQUAL_UINT32_MESSAGE(size, size_of(taken), label);
            TEST_ASSERT_EACH_EQUAL_HEX8_MESSAGE(FILLER, taken + sizeof size, room - sizeof size, label);
            free(taken);
        }
}

/* A definition is not written when the shape beside it cannot be. */
#define CHECK_GET(kind)                                                                                                 \
    do {                                                                                                                \
        pbmpm_##kind##_def def;                                                                                         \
        pbmpm_shape shape = {.size = sizeof shape - 1};                                                                 \
        memset(&def, FILLER, sizeof def);                                                                               \
        def.size = sizeof def;                                                                                          \
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_##kind##_get(world.world, world.kind, &def, &shape));                     \
        TEST_ASSERT_EACH_EQUAL_HEX8(FILLER, (char *)&def + sizeof def.size, sizeof def - sizeof def.size);              \
    } while (0)

static void test_a_refused_shape_spoils_the_definition(void)
{
    CHECK_GET(collider);
    CHECK_GET(emitter);
    CHECK_GET(drain);
    CHECK_GET(force);
}

/* Elements follow each other in steps of the size that the first one tells; no more than the capacity is written. */
static void check_array(const sized_array *row, const unsigned char *plain, uint32_t count, uint32_t size)
{
    const char *label = label_of(row->call, row->structure, size);
    unsigned char *array = structure_of(LISTED * size, FILLER);
    uint32_t same = 0;
    for (uint32_t capacity = 1; capacity <= count; capacity++) {
        memset(array, FILLER, (size_t)LISTED * size);
        set_size(array, size);
        expect_result(PBMPM_OK, row->make(array, capacity, &same), label);
        TEST_ASSERT_EQUAL_UINT32_MESSAGE(count, same, label);
        for (uint32_t i = 0; i < capacity; i++) {
            const unsigned char *element = array + (size_t)i * size;
            TEST_ASSERT_EQUAL_UINT32_MESSAGE(size, size_of(element), label);
            expect_same_members(row->structure, plain + i * row->size, element, label);
            if (size > row->size) TEST_ASSERT_EACH_EQUAL_HEX8_MESSAGE(0, element + row->size, size - row->size, label);
        }
        if (capacity < LISTED)
            TEST_ASSERT_EACH_EQUAL_HEX8_MESSAGE(FILLER, array + (size_t)capacity * size, (LISTED - capacity) * size, label);
    }
    free(array);
}

static void test_arrays_step_by_the_size_of_the_first_element(void)
{
    make_arrays_busy();
    for (int i = 0; i < sized_array_count; i++) {
        const sized_array *row = &sized_arrays[i];
        unsigned char *plain = structure_of((uint32_t)(LISTED * row->size), FILLER);
        uint32_t count = 0;
        set_size(plain, (uint32_t)row->size);
        expect_result(PBMPM_OK, row->make(plain, LISTED, &count), row->call);
        TEST_ASSERT_TRUE_MESSAGE(count >= 3 && count <= LISTED, row->call);
        check_array(row, plain, count, (uint32_t)row->size);
        for (int k = 0; k < LARGER; k++) check_array(row, plain, count, larger(row->size, k));
        for (int k = 0; k < UNKNOWN; k++) {
            const uint32_t size = unknown(row->size, k), bytes = (uint32_t)(LISTED * row->size);
            const char *label = label_of(row->call, row->structure, size);
            memset(plain, FILLER, bytes);
            set_size(plain, size);
            expect_result(PBMPM_ERROR_UNSUPPORTED, row->make(plain, LISTED, &count), label);
            TEST_ASSERT_EACH_EQUAL_HEX8_MESSAGE(FILLER, plain + sizeof size, bytes - sizeof size, label);
            expect_result(PBMPM_OK, row->make(plain, 0, &count), label); /* without room the array is not looked at */
        }
        free(plain);
    }
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_every_structure_with_a_size_is_here);
    RUN_TEST(test_defaults_fill_larger_structures);
    RUN_TEST(test_larger_structures_are_read);
    RUN_TEST(test_members_of_later_versions_are_refused);
    RUN_TEST(test_sizes_that_no_version_had_are_not_read);
    RUN_TEST(test_larger_structures_are_written);
    RUN_TEST(test_sizes_that_no_version_had_are_not_written);
    RUN_TEST(test_a_refused_shape_spoils_the_definition);
    RUN_TEST(test_arrays_step_by_the_size_of_the_first_element);
    return UNITY_END();
}

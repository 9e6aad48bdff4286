/* Callers of older versions: their structures lack members. Compiled with a table of its own, older/sized_table.inc. */
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "world/colliders.h"
#include "base/result.h"
#include "base/sized.h"

enum { DEF = SIZED_pbmpm_collider_def, FILLER = 0xA5 };

#define END(field) (offsetof(pbmpm_collider_def, field) + sizeof(((pbmpm_collider_def *)0)->field))

static const uint32_t older[] = {END(measures_impulse), END(key)};
enum { OLDER = 2 };

/* A block of just this size on the heap: a sanitizer sees who goes beyond. */
static unsigned char *given;

static void give(uint32_t room, uint32_t size)
{
    free(given);
    given = malloc(room);
    TEST_ASSERT_NOT_NULL(given);
    memset(given, FILLER, room);
    memcpy(given, &size, sizeof size);
}

void setUp(void) { given = NULL; }
void tearDown(void) { free(given); }

/* No member has its default, nor FILLER. */
static pbmpm_collider_def unusual(void)
{
    pbmpm_collider_def def = collider_defaults();
    def.friction = PBMPM_FRICTION_SLIP;
    def.friction_coefficient = 3;
    def.kinematic = def.measures_impulse = 1;
    def.key = 5;
    def.user_data = 7;
    return def;
}

static void test_missing_members_stay_as_they_were(void)
{
    for (int i = 0; i < OLDER; i++) {
        const pbmpm_collider_def base = unusual();
        pbmpm_collider_def own = base;
        give(older[i], older[i]);
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, sized_read(DEF, "call", "def", given, &own));
        TEST_ASSERT_EQUAL_UINT32(sizeof own, own.size);
        TEST_ASSERT_EQUAL_MEMORY(given + sizeof own.size, (char *)&own + sizeof own.size, older[i] - sizeof own.size);
        TEST_ASSERT_EQUAL_MEMORY((char *)&base + older[i], (char *)&own + older[i], sizeof own - older[i]);
    }
}

static void test_missing_members_are_not_written(void)
{
    const pbmpm_collider_def own = unusual();
    for (int i = 0; i < OLDER; i++) {
        const uint32_t size = older[i];
        give(size + 8, size);
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, sized_check(DEF, "call", "def", given));
        sized_write(DEF, given, size, &own);
        TEST_ASSERT_EQUAL_MEMORY(&size, given, sizeof size);
        TEST_ASSERT_EQUAL_MEMORY((char *)&own + sizeof size, given + sizeof size, size - sizeof size);
        TEST_ASSERT_EACH_EQUAL_HEX8(FILLER, given + size, 8);
    }
}

static void test_arrays_of_older_structures(void)
{
    const pbmpm_collider_def own = unusual();
    for (int i = 0; i < OLDER; i++) {
        const uint32_t size = older[i];
        give(3 * size, size);
        for (uint32_t index = 0; index < 2; index++) sized_put(DEF, given, index, &own);
        for (uint32_t index = 0; index < 2; index++) {
            TEST_ASSERT_EQUAL_MEMORY(&size, given + index * size, sizeof size);
            TEST_ASSERT_EQUAL_MEMORY((char *)&own + sizeof size, given + index * size + sizeof size, size - sizeof size);
        }
        TEST_ASSERT_EACH_EQUAL_HEX8(FILLER, given + 2 * size, size);
    }
}

static void test_defaults_of_older_structures(void)
{
    const pbmpm_collider_def own = unusual();
    for (int i = 0; i < OLDER; i++) {
        const uint32_t size = older[i];
        give(size + 8, 0);
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, sized_init(DEF, "call", given, size, &own));
        TEST_ASSERT_EQUAL_MEMORY(&size, given, sizeof size);
        TEST_ASSERT_EQUAL_MEMORY((char *)&own + sizeof size, given + sizeof size, size - sizeof size);
        TEST_ASSERT_EACH_EQUAL_HEX8(FILLER, given + size, 8);
    }
}

/* Sizes between those that versions had are nobody's. */
static void test_other_sizes_are_refused(void)
{
    for (uint32_t size = 0; size < sizeof(pbmpm_collider_def); size++) {
        const pbmpm_collider_def base = unusual();
        pbmpm_collider_def own = base;
        if (size == older[0] || size == older[1]) continue;
        give(sizeof own, size);
        TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_UNSUPPORTED, sized_read(DEF, "call", "def", given, &own));
        TEST_ASSERT_EQUAL_MEMORY(&base, &own, sizeof own);
        TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_UNSUPPORTED, sized_check(DEF, "call", "def", given));
        TEST_ASSERT_NOT_NULL(strstr(result_message(), "pbmpm_collider_def_init()"));
        TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_UNSUPPORTED, sized_init(DEF, "call", given, size, &own));
        TEST_ASSERT_EACH_EQUAL_HEX8(FILLER, given + sizeof size, sizeof own - sizeof size);
    }
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_INVALID_ARGUMENT, sized_check(DEF, "call", "def", NULL));
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_INVALID_ARGUMENT, sized_init(DEF, "call", NULL, sizeof(pbmpm_collider_def), given));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_missing_members_stay_as_they_were);
    RUN_TEST(test_missing_members_are_not_written);
    RUN_TEST(test_arrays_of_older_structures);
    RUN_TEST(test_defaults_of_older_structures);
    RUN_TEST(test_other_sizes_are_refused);
    return UNITY_END();
}

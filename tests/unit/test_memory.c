/* Memory: the budget, the account, arrays that grow. */
#include <string.h>
#include <unity.h>

#include "books.h"

void setUp(void) {}
void tearDown(void) {}

static bool is_zero(const void *block, size_t size)
{
    const unsigned char *bytes = block;
    for (size_t i = 0; i < size; i++)
        if (bytes[i]) return false;
    return true;
}

static void test_blocks_are_zeroed_aligned_and_accounted(void)
{
    Books books;
    Memory memory = books_memory(&books, 0);
    void *a = memory_take(&memory, 1), *b = memory_take(&memory, 1000);
    TEST_ASSERT_TRUE(is_zero(a, 1) && is_zero(b, 1000));
    TEST_ASSERT_EQUAL_UINT64(1001, memory.used);
    TEST_ASSERT_EQUAL_UINT64(1001, books.live_bytes);
    memory_give(&memory, a, 1);
    TEST_ASSERT_EQUAL_UINT64(1000, memory.used);
    memory_give(&memory, NULL, 77); /* nothing to give */
    memory_give(&memory, b, 1000);
    books_expect_closed(&books, &memory);
}

static void test_the_c_library_serves_without_an_allocator(void)
{
    Memory memory;
    memory_init(&memory, NULL, 0);
    void *block = memory_take(&memory, 12345);
    TEST_ASSERT_NOT_NULL(block);
    TEST_ASSERT_EQUAL_UINT64(0, (uintptr_t)block % 64);
    TEST_ASSERT_TRUE(is_zero(block, 12345));
    memory_give(&memory, block, 12345);
    TEST_ASSERT_EQUAL_UINT64(0, memory.used);
}

/* To the byte, also where the sum would overflow; what is given back can be taken again. */
static void test_budget(void)
{
    Books books;
    Memory memory = books_memory(&books, 100);
    TEST_ASSERT_NULL(memory_take(&memory, 101));
    TEST_ASSERT_NULL(memory_take(&memory, SIZE_MAX));
    TEST_ASSERT_EQUAL_UINT64(0, books.calls); /* not even asked for */
    void *a = memory_take(&memory, 60);
    TEST_ASSERT_NOT_NULL(a);
    TEST_ASSERT_NULL(memory_take(&memory, 41));
    TEST_ASSERT_NULL(memory_take(&memory, SIZE_MAX - 10));
    void *b = memory_take(&memory, 40);
    TEST_ASSERT_NOT_NULL(b);
    TEST_ASSERT_NULL(memory_take(&memory, 1));
    memory_give(&memory, a, 60);
    a = memory_take(&memory, 60);
    TEST_ASSERT_NOT_NULL(a);
    memory_give(&memory, a, 60);
    memory_give(&memory, b, 40);
    books_expect_closed(&books, &memory);
}

static void test_a_refusal_is_not_accounted(void)
{
    Books books;
    Memory memory = books_memory(&books, 0);
    books.fail_at = 1;
    TEST_ASSERT_NULL(memory_take(&memory, 10));
    books_expect_closed(&books, &memory);
}

static void test_array_grows_with_room_to_spare(void)
{
    Books books;
    Memory memory = books_memory(&books, 0);
    Array array = {0};
    TEST_ASSERT_TRUE(array_reserve(&memory, &array, 100, 8));
    TEST_ASSERT_TRUE(array.bytes > 800 && memory.used == array.bytes);
    const void *first = array.data;
    TEST_ASSERT_TRUE(array_reserve(&memory, &array, array.bytes / 8, 8)); /* up to the spare room nothing moves */
    TEST_ASSERT_TRUE(array_reserve(&memory, &array, 1, 8));
    TEST_ASSERT_EQUAL_PTR(first, array.data);
    TEST_ASSERT_EQUAL_UINT64(1, books.calls);
    TEST_ASSERT_TRUE(array_reserve(&memory, &array, array.bytes / 8 + 1, 8));
    TEST_ASSERT_EQUAL_UINT64(2, books.calls);
    TEST_ASSERT_EQUAL_UINT64(1, books.live_blocks);
    array_free(&memory, &array);
    TEST_ASSERT_NULL(array.data);
    array_free(&memory, &array); /* twice does no harm */
    books_expect_closed(&books, &memory);
}

/* A world whose matter spreads slowly must not allocate in every step. */
static void test_growth_is_geometric(void)
{
    Books books;
    Memory memory = books_memory(&books, 0);
    Array array = {0};
    for (size_t count = 1; count <= 100000; count++) TEST_ASSERT_TRUE(array_reserve(&memory, &array, count, 4));
    TEST_ASSERT_TRUE(books.calls < 60);
    array_free(&memory, &array);
    books_expect_closed(&books, &memory);
}

static void test_an_array_that_cannot_grow_stays(void)
{
    Books books;
    Memory memory = books_memory(&books, 0);
    Array array = {0};
    TEST_ASSERT_TRUE(array_reserve(&memory, &array, 10, 4));
    const Array before = array;
    memset(array.data, 7, array.bytes);
    books.fail_at = books.calls + 1;
    TEST_ASSERT_FALSE(array_reserve(&memory, &array, 1000, 4));
    TEST_ASSERT_TRUE(array.data == before.data && array.bytes == before.bytes);
    TEST_ASSERT_EACH_EQUAL_UINT8(7, array.data, array.bytes);
    array_free(&memory, &array);
    books_expect_closed(&books, &memory);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_blocks_are_zeroed_aligned_and_accounted);
    RUN_TEST(test_the_c_library_serves_without_an_allocator);
    RUN_TEST(test_budget);
    RUN_TEST(test_a_refusal_is_not_accounted);
    RUN_TEST(test_array_grows_with_room_to_spare);
    RUN_TEST(test_growth_is_geometric);
    RUN_TEST(test_an_array_that_cannot_grow_stays);
    return UNITY_END();
}

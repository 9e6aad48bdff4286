#include "books.h"

#include <stdint.h>
#include <string.h>
#include <unity.h>

#include "host.h"

/* Fresh memory is full of what no code wants to see. */
static void *allocate(size_t size, size_t alignment, void *user)
{
    Books *books = user;
    if (++books->calls == books->fail_at) return NULL;
    void *block = host_allocate(size, alignment);
    if (!block) return NULL;
    memset(block, 0xa5, size);
    books->live_blocks++;
    books->live_bytes += size;
    books->misaligned |= (uintptr_t)block % 64 != 0;
    return block;
}

static void release(void *block, size_t size, void *user)
{
    Books *books = user;
    books->live_blocks--;
    books->live_bytes -= size;
    memset(block, 0xdd, size);
    host_release(block);
}

Memory books_memory(Books *books, uint64_t budget)
{
    Memory memory;
    *books = (Books){0};
    memory_init(&memory, &(pbmpm_allocator){sizeof(pbmpm_allocator), allocate, release, books}, budget);
    return memory;
}

void books_expect_closed(const Books *books, const Memory *memory)
{
    TEST_ASSERT_EQUAL_UINT64(0, books->live_blocks);
    TEST_ASSERT_EQUAL_UINT64(0, books->live_bytes);
    TEST_ASSERT_EQUAL_UINT64(0, memory->used);
    TEST_ASSERT_FALSE(books->misaligned);
}

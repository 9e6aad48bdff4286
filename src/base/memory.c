#include "base/memory.h"

#include <string.h>

#include "base/assertion.h"
#include "base/cpu.h"
#include "base/platform.h"

enum { ALIGNMENT = 64 };

static void *default_allocate(size_t size, size_t alignment, void *user)
{
    (void)user;
    return platform_allocate(size, alignment);
}

static void default_release(void *block, size_t size, void *user)
{
    (void)size;
    (void)user;
    platform_release(block);
}

void memory_init(Memory *memory, const pbmpm_allocator *allocator, uint64_t budget)
{
    const pbmpm_allocator own = {.size = sizeof own, .allocate = default_allocate, .release = default_release};
    *memory = (Memory){allocator ? *allocator : own, budget, 0};
}

void *memory_take(Memory *memory, size_t size)
{
    if (memory->budget && (size > memory->budget || memory->used > memory->budget - size)) return NULL;
    const uint32_t mode = float_mode_lend();
    void *block = memory->allocator.allocate(size, ALIGNMENT, memory->allocator.user);
    float_mode_take_back(mode);
    if (!block) return NULL;
    memory->used += size;
    memset(block, 0, size);
    return block;
}

void memory_give(Memory *memory, void *block, size_t size)
{
    if (!block) return;
    ASSERT(memory->used >= size);
    memory->used -= size;
    const uint32_t mode = float_mode_lend();
    memory->allocator.release(block, size, memory->allocator.user);
    float_mode_take_back(mode);
}

bool array_reserve(Memory *memory, Array *array, size_t count, size_t size)
{
    if (count * size <= array->bytes) return true;
    const size_t bytes = (count + count / 4 + 16) * size;
    void *grown = memory_take(memory, bytes);
    if (!grown) return false;
    memory_give(memory, array->data, array->bytes);
    *array = (Array){grown, bytes};
    return true;
}

bool array_grow(Memory *memory, Array *array, size_t count, size_t size, size_t kept)
{
    Array grown = {0};
    if (count * size <= array->bytes) return true;
    if (!array_reserve(memory, &grown, count, size)) return false;
    if (kept) memcpy(grown.data, array->data, kept);
    array_free(memory, array);
    *array = grown;
    return true;
}

void array_free(Memory *memory, Array *array)
{
    memory_give(memory, array->data, array->bytes);
    *array = (Array){0};
}

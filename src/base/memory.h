/* The memory of one world: an allocator, a budget, and what is in use. */
#ifndef PBMPM_SRC_BASE_MEMORY_H
#define PBMPM_SRC_BASE_MEMORY_H

#include <stdbool.h>

#include "pbmpm/base.h"

typedef struct Memory {
    pbmpm_allocator allocator;
    uint64_t budget; /* 0: none */
    uint64_t used;
} Memory;

/* A null allocator is the C library's. */
void memory_init(Memory *memory, const pbmpm_allocator *allocator, uint64_t budget);

/* 64-byte aligned, zeroed; null when the allocator or the budget says no. */
void *memory_take(Memory *memory, size_t size);
void memory_give(Memory *memory, void *block, size_t size);

/* An array that only grows. */
typedef struct Array {
    void *data;
    size_t bytes;
} Array;

/* Makes room for `count` elements of `size` bytes, with some to spare; the contents are lost when it grows. */
bool array_reserve(Memory *memory, Array *array, size_t count, size_t size);
/* The same, but the first `kept` bytes stay. */
bool array_grow(Memory *memory, Array *array, size_t count, size_t size, size_t kept);
void array_free(Memory *memory, Array *array);

#endif

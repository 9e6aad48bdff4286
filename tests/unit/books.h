/* An allocator that counts and fails on request. */
#ifndef PBMPM_TESTS_BOOKS_H
#define PBMPM_TESTS_BOOKS_H

#include "base/memory.h"

typedef struct Books {
    uint64_t calls;       /* allocations asked for */
    uint64_t fail_at;     /* the call, from 1, that is refused; 0: none */
    uint64_t live_blocks;
    uint64_t live_bytes;  /* by the sizes asked for and given back */
    bool misaligned;
} Books;

/* Memory that keeps `books`; `budget` as for memory_init(). */
Memory books_memory(Books *books, uint64_t budget);

/* Fails the test unless everything was given back, to the allocator and by the memory's own account. */
void books_expect_closed(const Books *books, const Memory *memory);

#endif

/* Parallel loops over blocks, on the world's own threads or on the host's job system. */
#ifndef PBMPM_SRC_BASE_POOL_H
#define PBMPM_SRC_BASE_POOL_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/memory.h"

typedef struct Pool Pool;

/* Works on the items [begin, end). */
typedef void RangeTask(void *context, int32_t begin, int32_t end);

/* `threads` counts the caller. With hooks no thread is started. */
pbmpm_result pool_create(Memory *memory, int threads, const pbmpm_task_hooks *hooks, Pool **pool);
/* After a fork the threads exist only in the parent: `joinable` false frees without joining. */
void pool_destroy(Memory *memory, Pool *pool, bool joinable);
/* Ends the threads; loops run on the caller from then on. */
void pool_stop(Pool *pool);
int pool_thread_count(const Pool *pool);

/* Serial mode runs every loop on the caller: cheaper when there is little to do. */
void pool_set_serial(Pool *pool, bool serial);

/* Calls task on disjoint ranges of at most `grain` items that cover [0, count), and returns when all are done. Without a pool, or with one that
 * works for another thread, on the caller. */
void pool_for(Pool *pool, int32_t count, int32_t grain, RangeTask *task, void *context);

/* ---- Loops that follow one another ----
 *
 * Loops of which each needs all of the one before share a fork-join: whoever finds nothing more to take in a loop waits for those who still work on theirs,
 * and goes on to the next. Nobody waits for a thread that has not begun, or for long, so any number of threads in any order comes to the end. */

/* What a loop goes over: items, how many of them are taken at once, and about how long all of them take one thread [ns]. */
typedef struct Span {
    int32_t count, grain;
    int64_t ns;
} Span;

/* About what a loop takes for a node of the grid and for a particle. Measured in 3D with AVX2, of all loops of the dual solver the median: nodes 0.4 to 12,
 * particles 6 to 38. */
enum { NODE_NS = 4, PARTICLE_NS = 16 };

/* For what one thread does in between. */
static inline Span span_once(void) { return (Span){1, 1, 0}; }

enum { LOOPS_MAX = 48, LOOP_CONTEXT = 64 };

typedef struct Loop {
    _Alignas(64) RangeTask *task; /* a cache line for what threads write, and one for what they read */
    int32_t count, grain;
    atomic_int next, left; /* the item to take next; items that are not done */
    _Alignas(64) char context[LOOP_CONTEXT];
} Loop;

typedef struct Loops {
    Pool *pool;
    int count;
    int ranges; /* of the loop that has most */
    int64_t ns;
    Loop loop[LOOPS_MAX];
} Loops;

void loops_open(Loops *loops, Pool *pool);

/* Adds a loop. *job, the task's context, is copied; what it points to has to live until loops_run(). If there is no room for another loop those that
 * are there run. */
#define LOOPS_ADD(loops, span, task, job)                                                     \
    do {                                                                                      \
        _Static_assert(sizeof *(job) <= LOOP_CONTEXT, "the context of a loop has to fit");    \
        loops_put(loops, span, task, job, sizeof *(job));                                     \
    } while (0)
void loops_put(Loops *loops, Span span, RangeTask *task, const void *context, size_t bytes);

/* Runs them in order: on the caller if that takes less than sharing. Then there are none. */
void loops_run(Loops *loops);

#endif

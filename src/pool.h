/* Parallel loops over blocks, on the world's own threads or on the host's job system. */
#ifndef PBMPM_SRC_POOL_H
#define PBMPM_SRC_POOL_H

#include <stdbool.h>

#include "memory.h"

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

/* Calls task on disjoint ranges of at most `grain` items that cover [0, count), and returns when all are done. */
void pool_for(Pool *pool, int32_t count, int32_t grain, RangeTask *task, void *context);

#endif

#include "base/platform.h"
#include "base/thread.h"

#include <stdlib.h>

long platform_core_count(void) { return 1; }

void *platform_allocate(size_t size, size_t alignment) { return aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment); }

void platform_release(void *block) { free(block); }

bool platform_has_lost_its_threads(void) { return false; }

/* There are none: worlds of several threads, and steps in the background without tasks of the host, are refused. */
bool thread_start(pthread_t *thread, void *(*run)(void *), void *context)
{
    (void)thread;
    (void)run;
    (void)context;
    return false;
}

void thread_join(pthread_t thread) { (void)thread; }

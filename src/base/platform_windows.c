#include "base/platform.h"
#include "base/thread.h"

#include <malloc.h>
#include <windows.h>

long platform_core_count(void) { return (long)GetActiveProcessorCount(ALL_PROCESSOR_GROUPS); }

void *platform_allocate(size_t size, size_t alignment) { return _aligned_malloc(size, alignment); }

void platform_release(void *block) { _aligned_free(block); }

/* Windows sends no signals to threads. */
bool thread_start(pthread_t *thread, void *(*run)(void *), void *context) { return pthread_create(thread, NULL, run, context) == 0; }

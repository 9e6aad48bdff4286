/* What systems do each in its own way, with thread_start() and thread_join() of thread.h: platform_posix.c, platform_windows.c. Threads, locks and clocks have the names of
 * POSIX everywhere; on Windows the tool chain brings them (winpthreads). */
#ifndef PBMPM_SRC_BASE_PLATFORM_H
#define PBMPM_SRC_BASE_PLATFORM_H

#include <stdbool.h>
#include <stddef.h>

long platform_core_count(void); /* below 1: not known */

/* Null: no memory. `alignment`: a power of two, and a multiple of sizeof(void *). */
void *platform_allocate(size_t size, size_t alignment);
void platform_release(void *block);

/* True while the library is told of its end because the process ends, where that ends all other threads before: in the midst of whatever they did. */
bool platform_has_lost_its_threads(void);

#endif

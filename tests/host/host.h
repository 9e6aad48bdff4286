/* What tests need of the system and the CPU that they run on, each of which has its own way: host_posix.c, host_windows.c. */
#ifndef PBMPM_TESTS_HOST_H
#define PBMPM_TESTS_HOST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* ---- The floating-point mode of this thread ---- */

/* HOST_USUAL: what a thread begins with. HOST_FLAGS: traces of what has happened, no part of the mode. HOST_TRAPS: what every exception traps in, where the
 * CPU has traps. */
#if defined(__aarch64__)
enum { HOST_USUAL = 0, HOST_FLUSH = 1 << 24, HOST_UP = 1 << 22, HOST_DOWN = 2 << 22, HOST_TO_ZERO = 3 << 22, HOST_FLAGS = 0, HOST_TRAPS = 0 };

static inline uint32_t host_float_mode(void)
{
    uint64_t mode;
    __asm__ volatile("mrs %0, fpcr" : "=r"(mode));
    return (uint32_t)mode;
}

static inline void host_set_float_mode(uint32_t mode) { __asm__ volatile("msr fpcr, %0" : : "r"((uint64_t)mode)); }
#else
#include <xmmintrin.h>

enum { HOST_USUAL = 0x1f80, HOST_FLUSH = 0x8040, HOST_UP = 0x4000, HOST_DOWN = 0x2000, HOST_TO_ZERO = 0x6000, HOST_FLAGS = 0x3f, HOST_TRAPS = 0 };

static inline uint32_t host_float_mode(void) { return _mm_getcsr(); }

static inline void host_set_float_mode(uint32_t mode) { _mm_setcsr(mode); }
#endif

/* ---- Memory ---- */

/* Null: none is left. `alignment`: a power of two. */
void *host_allocate(size_t size, size_t alignment);
void host_release(void *block);

/* ---- This process ---- */

int host_thread_count(void);

/* Ends it in so many seconds; 0: not any more. */
void host_end_after(unsigned seconds);

/* Libraries that are loaded while a program runs. */
void *host_load(const char *path);
void *host_find(void *library, const char *name);
bool host_unload(void *library);
bool host_has_loaded(const char *file_name);

#endif

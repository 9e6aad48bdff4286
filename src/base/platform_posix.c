#define _POSIX_C_SOURCE 200809L
#define _DARWIN_C_SOURCE /* the number of cores */
#include "base/platform.h"
#include "base/thread.h"

#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

long platform_core_count(void) { return sysconf(_SC_NPROCESSORS_ONLN); }

void *platform_allocate(size_t size, size_t alignment)
{
    void *block = NULL;
    return posix_memalign(&block, alignment, size) == 0 ? block : NULL;
}

void platform_release(void *block) { free(block); }

bool platform_has_lost_its_threads(void) { return false; }

/* A thread begins with the mask of the one that makes it. */
bool thread_start(pthread_t *thread, void *(*run)(void *), void *context)
{
    static const int faults[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGABRT, SIGSYS};
    sigset_t blocked, before;
    sigfillset(&blocked);
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) sigdelset(&blocked, faults[i]);
    pthread_sigmask(SIG_SETMASK, &blocked, &before);
    const bool started = pthread_create(thread, NULL, run, context) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started;
}

void thread_join(pthread_t thread) { pthread_join(thread, NULL); }

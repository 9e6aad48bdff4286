/* Threads of the library's own. */
#ifndef PBMPM_SRC_BASE_THREAD_H
#define PBMPM_SRC_BASE_THREAD_H

#include <pthread.h>
#include <stdbool.h>

/* Starts a thread that takes no signals: handlers of the host run on the host's threads. Faults are the thread's own, so that a host hears of them. */
bool thread_start(pthread_t *thread, void *(*run)(void *), void *context);

/* Waits for its end. */
void thread_join(pthread_t thread);

#endif

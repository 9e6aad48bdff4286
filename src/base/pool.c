#include "base/pool.h"

#include <pthread.h>
#include <sched.h>
#include <string.h>

#include "base/assertion.h"
#include "base/cpu.h"
#include "base/machine.h"
#include "base/result.h"
#include "base/thread.h"

/* How long a thread looks for work or for the end of it before it sleeps: some 20 microseconds. */
enum { SPIN_ROUNDS = 400 };

/* How often one that waits for others in the middle of loops lets other threads run before it leaves. A call takes some 0.5 microseconds, so they are about as
 * long as a scheduler keeps one who works from its core. */
enum { YIELD_ROUNDS = 8000 };

/* What a fork-join of two threads takes if there is nothing to do: 27 microseconds on own ones that sleep, 15 in a job system with condition variables
 * (medians on a virtual machine). Two threads save half of the work; what saves less than that runs on the caller. */
enum { FORK_JOIN_NS = 20000, WORTH_A_FORK_NS = 2 * FORK_JOIN_NS };

struct Pool {
    pbmpm_task_hooks hooks;
    int threads;
    int spin_rounds;
    bool serial;
    atomic_bool taken; /* by loops under way: of several readers of a world one has the threads */
    Loops *loops;      /* under way */

    /* Own threads only. */
    pthread_mutex_t lock;
    pthread_cond_t work, done;
    atomic_uint_fast64_t gate; /* see INSIDE */
    atomic_bool stop;
    int started;
    int most;            /* workers that are worth a core; the others sleep */
    int sleeping, calls; /* workers that sleep, and how many of them are called; behind the lock */
    pthread_t worker[];
};

static size_t pool_bytes(int threads) { return sizeof(Pool) + (size_t)threads * sizeof(pthread_t); }

/* Takes ranges until there are none. */
static void take_ranges(Loop *loop)
{
    int32_t done = 0;
    for (;;) {
        const int32_t begin = atomic_fetch_add_explicit(&loop->next, loop->grain, memory_order_relaxed);
        if (begin >= loop->count) break;
        const int32_t end = loop->count - begin < loop->grain ? loop->count : begin + loop->grain;
        loop->task(loop->context, begin, end);
        done += end - begin;
    }
    if (done > 0) atomic_fetch_sub_explicit(&loop->left, done, memory_order_acq_rel);
}

static bool is_done(Loop *loop) { return atomic_load_explicit(&loop->left, memory_order_acquire) == 0; }

/* Waits for those who still work on the loop. False: one of them has lost its core, and waiting would keep that from it. */
static bool wait_for_rest(Loop *loop, int spin_rounds)
{
    for (int i = 0; i < spin_rounds; i++) {
        if (is_done(loop)) return true;
        machine_pause();
    }
    for (int i = 0; i < YIELD_ROUNDS; i++) {
        if (is_done(loop)) return true;
        sched_yield();
    }
    return is_done(loop);
}

/* Who does the last item of a loop need not wait, and so comes to the end: the others may leave. */
static void run_share(Loops *loops, int spin_rounds)
{
    const uint32_t mode = float_mode_enter();
    for (int i = 0; i < loops->count; i++) {
        take_ranges(&loops->loop[i]);
        if (i + 1 < loops->count && !wait_for_rest(&loops->loop[i], spin_rounds)) break;
    }
    float_mode_leave(mode);
}

static void host_task(int32_t index, void *context)
{
    Pool *pool = context;
    (void)index;
    run_share(pool->loops, pool->spin_rounds);
}

/* ---- Own threads ----
 *
 * A worker takes part in loops by going through their gate while it is open. When the caller has nothing left to take it closes the gate, and waits only for workers that are
 * inside. It never waits for one that has yet to get a core: beside busy processes that takes milliseconds. No more workers are awake than there are cores and ranges
 * for. One that finds the gate closed waits for the next loops. */
static const uint64_t INSIDE = 1, OPEN = (uint64_t)1 << 16, ROUND = (uint64_t)1 << 32; /* how many are inside, whether it is open, and which loops these are */

static bool may_enter(uint64_t gate, uint64_t seen) { return (gate & OPEN) != 0 && gate / ROUND != seen; }

/* False: the gate is closed, or the worker was inside before. */
static bool enter(Pool *pool, uint64_t *seen)
{
    uint64_t gate = atomic_load(&pool->gate);
    do {
        if (!may_enter(gate, *seen)) return false;
    } while (!atomic_compare_exchange_weak(&pool->gate, &gate, gate + INSIDE));
    *seen = gate / ROUND;
    return true;
}

static void leave(Pool *pool)
{
    const uint64_t gate = atomic_fetch_sub(&pool->gate, INSIDE) - INSIDE;
    if (gate % ROUND != 0) return; /* it is open, or others are inside */
    pthread_mutex_lock(&pool->lock);
    pthread_cond_signal(&pool->done);
    pthread_mutex_unlock(&pool->lock);
}

static void wait_for_work(Pool *pool, uint64_t seen)
{
    for (int i = 0; i < pool->spin_rounds; i++) {
        if (may_enter(atomic_load_explicit(&pool->gate, memory_order_relaxed), seen)) return;
        machine_pause();
    }
    pthread_mutex_lock(&pool->lock);
    if (!may_enter(atomic_load(&pool->gate), seen)) { /* it counted as awake until now */
        pool->sleeping++;
        while (pool->calls == 0 && !atomic_load(&pool->stop)) pthread_cond_wait(&pool->work, &pool->lock);
        if (pool->calls > 0) pool->calls--;
        pool->sleeping--;
    }
    pthread_mutex_unlock(&pool->lock);
}

static void *worker_main(void *context)
{
    Pool *pool = context;
    uint64_t seen = 0;
    while (!atomic_load(&pool->stop)) {
        if (!enter(pool, &seen)) {
            wait_for_work(pool, seen);
            continue;
        }
        run_share(pool->loops, pool->spin_rounds);
        leave(pool);
    }
    return NULL;
}

static void open_gate(Pool *pool, int useful)
{
    const int most = useful < pool->most ? useful : pool->most;
    const uint64_t gate = atomic_load(&pool->gate);
    ASSERT(gate % ROUND == 0);
    atomic_store(&pool->gate, gate + ROUND + OPEN);
    pthread_mutex_lock(&pool->lock);
    for (int awake = pool->started - pool->sleeping + pool->calls; awake < most; awake++) {
        pool->calls++;
        pthread_cond_signal(&pool->work);
    }
    pthread_mutex_unlock(&pool->lock);
}

static bool is_empty(Pool *pool) { return atomic_load_explicit(&pool->gate, memory_order_acquire) % ROUND == 0; }

static void close_gate(Pool *pool)
{
    atomic_fetch_and(&pool->gate, ~OPEN);
    for (int i = 0; i < pool->spin_rounds; i++) {
        if (is_empty(pool)) return;
        machine_pause();
    }
    pthread_mutex_lock(&pool->lock);
    while (!is_empty(pool)) pthread_cond_wait(&pool->done, &pool->lock);
    pthread_mutex_unlock(&pool->lock);
}

pbmpm_result pool_create(Memory *memory, int threads, const pbmpm_task_hooks *hooks, Pool **out)
{
    Pool *pool = memory_take(memory, pool_bytes(threads));
    *out = pool;
    if (!pool) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the thread pool");
    pool->threads = threads;
    if (hooks) pool->hooks = *hooks;
    const int cores = cpu_core_count();
    const int awake = threads < cores ? threads : cores;
    pool->spin_rounds = cores > 1 ? SPIN_ROUNDS : 0; /* on a single core spinning steals time */
    pool->most = awake > 2 ? awake - 1 : 1;
    pthread_mutex_init(&pool->lock, NULL);
    pthread_cond_init(&pool->work, NULL);
    pthread_cond_init(&pool->done, NULL);
    while (!hooks && pool->started < threads - 1) {
        if (!thread_start(&pool->worker[pool->started], worker_main, pool)) {
            pool_destroy(memory, pool, true);
            *out = NULL;
            return fail(PBMPM_ERROR_THREAD, "could not start thread %d of %d", pool->started + 2, threads);
        }
        pool->started++;
    }
    return PBMPM_OK;
}

void pool_stop(Pool *pool)
{
    pthread_mutex_lock(&pool->lock);
    atomic_store(&pool->stop, true);
    pthread_cond_broadcast(&pool->work);
    pthread_mutex_unlock(&pool->lock);
    for (int i = 0; i < pool->started; i++) thread_join(pool->worker[i]);
    pool->started = 0;
}

void pool_destroy(Memory *memory, Pool *pool, bool joinable)
{
    if (!pool) return;
    if (joinable) {
        pool_stop(pool);
        pthread_cond_destroy(&pool->done);
        pthread_cond_destroy(&pool->work);
        pthread_mutex_destroy(&pool->lock);
    }
    memory_give(memory, pool, pool_bytes(pool->threads));
}

int pool_thread_count(const Pool *pool) { return pool->threads; }

void pool_set_serial(Pool *pool, bool serial) { pool->serial = serial; }

static void share_with_host(Pool *pool)
{
    const uint32_t mode = float_mode_lend();
    void *handle = pool->hooks.enqueue(host_task, pool->threads, pool, pool->hooks.user);
    pool->hooks.finish(handle, pool->hooks.user);
    float_mode_take_back(mode);
}

static void share_with_workers(Pool *pool)
{
    open_gate(pool, pool->loops->ranges - 1);
    run_share(pool->loops, pool->spin_rounds);
    close_gate(pool);
}

/* Whether nothing of them is left to do. */
static bool are_done(Loops *loops)
{
    bool done = true;
    for (int i = 0; i < loops->count; i++) done = done && is_done(&loops->loop[i]);
    return done;
}

/* False, and nothing done: another reader has the threads. */
static bool fork_join(Pool *pool, Loops *loops)
{
    if (atomic_exchange(&pool->taken, true)) return false;
    pool->loops = loops;
    if (pool->hooks.enqueue)
        share_with_host(pool);
    else
        share_with_workers(pool);
    ASSERT(are_done(loops));
    atomic_store(&pool->taken, false);
    return true;
}

typedef struct PointerJob {
    RangeTask *task;
    void *context;
} PointerJob;

static void run_pointed(void *context, int32_t begin, int32_t end)
{
    const PointerJob *job = context;
    job->task(job->context, begin, end);
}

void pool_for(Pool *pool, int32_t count, int32_t grain, RangeTask *task, void *context)
{
    if (count <= 0) return;
    if (pool && !pool->serial && pool->threads > 1 && count > grain) {
        Loops loops;
        loops_open(&loops, pool);
        const PointerJob job = {task, context};
        LOOPS_ADD(&loops, ((Span){count, grain, WORTH_A_FORK_NS}), run_pointed, &job);
        if (fork_join(pool, &loops)) return;
    }
    task(context, 0, count);
}

/* ---- Loops that follow one another ---- */

void loops_open(Loops *loops, Pool *pool)
{
    loops->pool = pool;
    loops->count = loops->ranges = 0;
    loops->ns = 0;
}

void loops_put(Loops *loops, Span span, RangeTask *task, const void *context, size_t bytes)
{
    if (span.count <= 0) return;
    if (loops->count == LOOPS_MAX) loops_run(loops);
    Loop *loop = &loops->loop[loops->count++];
    memcpy(loop->context, context, bytes);
    loop->task = task;
    loop->count = span.count;
    loop->grain = span.grain;
    atomic_init(&loop->next, 0);
    atomic_init(&loop->left, span.count);
    loops->ns += span.ns;
    const int ranges = (int)(((int64_t)span.count + span.grain - 1) / span.grain);
    if (ranges > loops->ranges) loops->ranges = ranges;
}

void loops_run(Loops *loops)
{
    Pool *pool = loops->pool;
    const bool shares = !pool->serial && pool->threads > 1 && loops->ns >= WORTH_A_FORK_NS;
    const bool shared = shares && fork_join(pool, loops);
    for (int i = 0; i < loops->count && !shared; i++) loops->loop[i].task(loops->loop[i].context, 0, loops->loop[i].count);
    loops_open(loops, pool);
}

/* The pool: every item is worked on once, whoever does it. */
#include <pthread.h>
#include <stdatomic.h>
#include <string.h>
#include <time.h>
#include <unity.h>

#include "books.h"
#include "host.h"
#include "base/cpu.h"
#include "base/pool.h"
#include "random.h"

void setUp(void) {}
void tearDown(void) {}

enum { ITEMS = 3000 };

typedef struct Work {
    atomic_int visits[ITEMS];
    atomic_int ranges;
    atomic_uint modes; /* of floating point, of all threads */
    int32_t largest_allowed;
    atomic_bool too_large;
} Work;

static void visit(void *context, int32_t begin, int32_t end)
{
    Work *work = context;
    for (int32_t i = begin; i < end; i++) atomic_fetch_add(&work->visits[i], 1);
    atomic_fetch_add(&work->ranges, 1);
    atomic_fetch_or(&work->modes, host_float_mode() & ~(unsigned)HOST_FLAGS);
    if (end - begin > work->largest_allowed) atomic_store(&work->too_large, true);
}

static void check_loop(Pool *pool, Work *work, int32_t count, int32_t grain, int32_t largest_allowed)
{
    memset(work, 0, sizeof *work);
    work->largest_allowed = largest_allowed;
    pool_for(pool, count, grain, visit, work);
    for (int32_t i = 0; i < ITEMS; i++)
        if (atomic_load(&work->visits[i]) != (i < count)) TEST_FAIL_MESSAGE("an item was left out or done twice");
    TEST_ASSERT_FALSE(atomic_load(&work->too_large));
}

static Pool *open_pool(Memory *memory, int threads, const pbmpm_task_hooks *hooks)
{
    Pool *pool;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, pool_create(memory, threads, hooks, &pool));
    TEST_ASSERT_EQUAL_INT(threads, pool_thread_count(pool));
    return pool;
}

/* Many rounds of all sizes, more threads than cores too. */
static void test_every_item_once(void)
{
    static const int threads[] = {1, 2, 3, 8};
    static Work work;
    for (int k = 0; k < 4; k++) {
        Books books;
        Memory memory = books_memory(&books, 0);
        Pool *pool = open_pool(&memory, threads[k], NULL);
        Random random = {(uint64_t)k};
        for (int round = 0; round < 400; round++) {
            const int32_t count = (int32_t)random_below(&random, ITEMS + 1), grain = 1 + (int32_t)random_below(&random, 64);
            check_loop(pool, &work, count, grain, threads[k] == 1 ? ITEMS : grain);
        }
        pool_destroy(&memory, pool, true);
        books_expect_closed(&books, &memory);
    }
}

static void test_nothing_to_do(void)
{
    static Work work;
    Books books;
    Memory memory = books_memory(&books, 0);
    Pool *pool = open_pool(&memory, 3, NULL);
    check_loop(pool, &work, 0, 4, 0);
    TEST_ASSERT_EQUAL_INT(0, atomic_load(&work.ranges));
    pool_destroy(&memory, pool, true);
    books_expect_closed(&books, &memory);
}

typedef struct Callers {
    pthread_t self;
    atomic_int others;
    bool slow; /* leaves the others time to come, however busy the machine is */
} Callers;

static void note_caller(void *context, int32_t begin, int32_t end)
{
    Callers *callers = context;
    (void)begin;
    (void)end;
    if (!pthread_equal(callers->self, pthread_self())) atomic_fetch_add(&callers->others, 1);
    if (callers->slow) nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
}

static void test_serial_mode_stays_on_the_caller(void)
{
    Books books;
    Memory memory = books_memory(&books, 0);
    Pool *pool = open_pool(&memory, 4, NULL);
    Callers callers = {.self = pthread_self()};
    pool_set_serial(pool, true);
    for (int round = 0; round < 100; round++) pool_for(pool, 1000, 1, note_caller, &callers);
    TEST_ASSERT_EQUAL_INT(0, atomic_load(&callers.others));
    pool_set_serial(pool, false);
    callers.slow = true;
    for (int round = 0; round < 1000 && atomic_load(&callers.others) == 0; round++) pool_for(pool, 10, 1, note_caller, &callers);
    TEST_ASSERT_TRUE(atomic_load(&callers.others) > 0);
    pool_destroy(&memory, pool, true);
    books_expect_closed(&books, &memory);
}

enum { CROWD = 64 };

/* Counts the threads that come: each notes the last loop that it came to. */
typedef struct Crowd {
    atomic_int round, came;
} Crowd;

static void count_threads(void *context, int32_t begin, int32_t end)
{
    static _Thread_local int last;
    Crowd *crowd = context;
    const int round = atomic_load(&crowd->round);
    (void)begin;
    (void)end;
    if (last != round) atomic_fetch_add(&crowd->came, 1);
    last = round;
    nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL); /* time for all to come */
}

/* More would only take turns with the others. Those that were just started are awake for a while. */
static void test_no_more_threads_come_than_have_cores(void)
{
    const int cores = cpu_core_count(), most = cores > 2 ? cores : 2;
    Books books;
    Memory memory = books_memory(&books, 0);
    Pool *pool = open_pool(&memory, CROWD, NULL);
    Crowd crowd = {0};
    int least = CROWD;
    for (int round = 0; round < 100 && least > most; round++) {
        atomic_store(&crowd.came, 0);
        atomic_fetch_add(&crowd.round, 1);
        pool_for(pool, CROWD, 1, count_threads, &crowd);
        if (atomic_load(&crowd.came) < least) least = atomic_load(&crowd.came);
    }
    if (cores < CROWD / 2) TEST_ASSERT_TRUE(least <= most);
    pool_destroy(&memory, pool, true);
    books_expect_closed(&books, &memory);
}

/* Denormals flushed, rounding to nearest, exceptions masked, on every thread; the caller's mode comes back. */
static void test_floating_point_mode_of_parallel_loops(void)
{
    enum { WANTED = HOST_USUAL | HOST_FLUSH, ODD = HOST_USUAL | HOST_TO_ZERO };
    static Work work;
    Books books;
    Memory memory = books_memory(&books, 0);
    Pool *pool = open_pool(&memory, 4, NULL);
    const unsigned before = host_float_mode();
    for (int round = 0; round < 50; round++) {
        host_set_float_mode(ODD);
        memset(&work, 0, sizeof work);
        work.largest_allowed = ITEMS;
        pool_for(pool, ITEMS, 10, visit, &work);
        const unsigned after = host_float_mode() & ~(unsigned)HOST_FLAGS;
        host_set_float_mode(before);
        TEST_ASSERT_EQUAL_HEX32(WANTED, atomic_load(&work.modes));
        TEST_ASSERT_EQUAL_HEX32(ODD, after);
    }
    pool_destroy(&memory, pool, true);
    books_expect_closed(&books, &memory);
}

/* ---- Hooks of the host ---- */

typedef struct Host {
    int enqueued, finished, tasks;
    int32_t count;
    bool backwards;
} Host;

/* Runs the tasks at once, in either order: any order is allowed. */
static void *enqueue(pbmpm_task *task, int32_t count, void *context, void *user)
{
    Host *host = user;
    host->enqueued++;
    host->count = count;
    for (int32_t i = 0; i < count; i++) {
        task(host->backwards ? count - 1 - i : i, context);
        host->tasks++;
    }
    return host;
}

static void finish(void *handle, void *user)
{
    Host *host = user;
    TEST_ASSERT_EQUAL_PTR(host, handle);
    host->finished++;
}

static void test_hooks_do_the_work(void)
{
    static Work work;
    Books books;
    Memory memory = books_memory(&books, 0);
    Host host = {0};
    Pool *pool = open_pool(&memory, 5, &(pbmpm_task_hooks){sizeof(pbmpm_task_hooks), 0, enqueue, finish, &host});
    for (int round = 0; round < 100; round++) {
        host.backwards = round % 2;
        check_loop(pool, &work, 10 + round * 29, 3, 3);
        TEST_ASSERT_EQUAL_INT(5, host.count);
    }
    TEST_ASSERT_EQUAL_INT(100, host.enqueued);
    TEST_ASSERT_EQUAL_INT(100, host.finished);
    TEST_ASSERT_EQUAL_INT(500, host.tasks);
    pool_destroy(&memory, pool, true);
    books_expect_closed(&books, &memory);
}

/* ---- Loops that follow one another ---- */

enum { CHAIN = 3 * LOOPS_MAX, CHAIN_ITEMS = 40 };

typedef struct Chain {
    atomic_int done[CHAIN][CHAIN_ITEMS];
    atomic_bool early;  /* a loop began before the one before it had ended */
    atomic_int others;  /* ranges that were not done by the caller */
    pthread_t self;
    int32_t items[CHAIN];
    int slow; /* the loop whose first item takes long; -1: none */
} Chain;

typedef struct Link {
    Chain *chain;
    int place;
} Link;

static void follow(void *context, int32_t begin, int32_t end)
{
    const Link *link = context;
    Chain *chain = link->chain;
    for (int32_t i = 0; link->place > 0 && i < chain->items[link->place - 1]; i++)
        if (atomic_load_explicit(&chain->done[link->place - 1][i], memory_order_relaxed) != 1) atomic_store(&chain->early, true);
    if (!pthread_equal(chain->self, pthread_self())) atomic_fetch_add(&chain->others, 1);
    if (link->place == chain->slow && begin == 0) nanosleep(&(struct timespec){.tv_nsec = 300000000}, NULL);
    for (int32_t i = begin; i < end; i++) atomic_fetch_add_explicit(&chain->done[link->place][i], 1, memory_order_relaxed);
}

/* Loops of all sizes; those without items leave no gap. */
static void run_chain(Pool *pool, Chain *chain, int count, uint64_t seed, int64_t ns, int slow)
{
    Random random = {seed};
    Loops loops;
    memset(chain, 0, sizeof *chain);
    chain->self = pthread_self();
    chain->slow = slow;
    loops_open(&loops, pool);
    for (int k = 0; k < count; k++) {
        chain->items[k] = (int32_t)random_below(&random, CHAIN_ITEMS + 1);
        if (k == slow) chain->items[k] = CHAIN_ITEMS;
        const Link link = {chain, k};
        LOOPS_ADD(&loops, ((Span){chain->items[k], 1 + (int32_t)random_below(&random, 8), ns}), follow, &link);
    }
    loops_run(&loops);
    TEST_ASSERT_EQUAL_INT(0, loops.count);
    TEST_ASSERT_FALSE_MESSAGE(atomic_load(&chain->early), "a loop began too early");
    for (int k = 0; k < count; k++)
        for (int32_t i = 0; i < CHAIN_ITEMS; i++)
            if (atomic_load(&chain->done[k][i]) != (i < chain->items[k])) TEST_FAIL_MESSAGE("an item was left out or done twice");
}

enum { MUCH_NS = 1000000 };

static void test_loops_follow_one_another(void)
{
    static const int threads[] = {1, 2, 3, 8};
    static Chain chain;
    for (int k = 0; k < 4; k++) {
        Books books;
        Memory memory = books_memory(&books, 0);
        Pool *pool = open_pool(&memory, threads[k], NULL);
        for (int round = 0; round < 60; round++) run_chain(pool, &chain, round % 2 ? CHAIN : 7, (uint64_t)round, MUCH_NS, -1);
        pool_destroy(&memory, pool, true);
        books_expect_closed(&books, &memory);
    }
}

static void test_loops_take_one_turn_of_the_host(void)
{
    static Chain chain;
    Books books;
    Memory memory = books_memory(&books, 0);
    Host host = {0};
    Pool *pool = open_pool(&memory, 5, &(pbmpm_task_hooks){sizeof(pbmpm_task_hooks), 0, enqueue, finish, &host});
    for (int round = 0; round < 20; round++) {
        host.backwards = round % 2;
        run_chain(pool, &chain, LOOPS_MAX, (uint64_t)round, MUCH_NS, -1);
    }
    TEST_ASSERT_EQUAL_INT(20, host.enqueued);
    TEST_ASSERT_EQUAL_INT(20, host.finished);
    pool_destroy(&memory, pool, true);
    books_expect_closed(&books, &memory);
}

/* Who waits for long leaves; the rest is done all the same. */
static void test_loops_get_over_a_thread_that_is_held_up(void)
{
    static Chain chain;
    Books books;
    Memory memory = books_memory(&books, 0);
    Pool *pool = open_pool(&memory, 3, NULL);
    run_chain(pool, &chain, 10, 1, MUCH_NS, 2);
    run_chain(pool, &chain, 10, 2, MUCH_NS, 9);
    run_chain(pool, &chain, 10, 3, MUCH_NS, -1);
    pool_destroy(&memory, pool, true);
    books_expect_closed(&books, &memory);
}

static void test_little_work_stays_on_the_caller(void)
{
    static Chain chain;
    Books books;
    Memory memory = books_memory(&books, 0);
    Host host = {0};
    Pool *pool = open_pool(&memory, 5, &(pbmpm_task_hooks){sizeof(pbmpm_task_hooks), 0, enqueue, finish, &host});
    run_chain(pool, &chain, 10, 1, 10, -1);
    TEST_ASSERT_EQUAL_INT(0, host.enqueued);
    pool_set_serial(pool, true);
    run_chain(pool, &chain, 10, 1, MUCH_NS, -1);
    TEST_ASSERT_EQUAL_INT(0, host.enqueued);
    TEST_ASSERT_EQUAL_INT(0, atomic_load(&chain.others));
    pool_destroy(&memory, pool, true);
    books_expect_closed(&books, &memory);
}

static void test_no_loops_are_no_work(void)
{
    Books books;
    Memory memory = books_memory(&books, 0);
    Pool *pool = open_pool(&memory, 2, NULL);
    Loops loops;
    loops_open(&loops, pool);
    loops_run(&loops);
    TEST_ASSERT_EQUAL_INT(0, loops.count);
    pool_destroy(&memory, pool, true);
    books_expect_closed(&books, &memory);
}

/* ---- Failure ---- */

static void test_no_memory_for_a_pool(void)
{
    Books books;
    Memory memory = books_memory(&books, 0);
    Pool *pool = (Pool *)&books;
    books.fail_at = 1;
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_OUT_OF_MEMORY, pool_create(&memory, 4, NULL, &pool));
    TEST_ASSERT_NULL(pool);
    pool_destroy(&memory, pool, true); /* nothing to destroy */
    books_expect_closed(&books, &memory);
}

static void test_pools_come_and_go(void)
{
    static Work work;
    for (int i = 0; i < 100; i++) {
        Books books;
        Memory memory = books_memory(&books, 0);
        Pool *pool = open_pool(&memory, 1 + i % 5, NULL);
        if (i % 3) check_loop(pool, &work, ITEMS, 50, i % 5 ? 50 : ITEMS);
        pool_destroy(&memory, pool, true);
        books_expect_closed(&books, &memory);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_item_once);
    RUN_TEST(test_nothing_to_do);
    RUN_TEST(test_serial_mode_stays_on_the_caller);
    RUN_TEST(test_no_more_threads_come_than_have_cores);
    RUN_TEST(test_floating_point_mode_of_parallel_loops);
    RUN_TEST(test_hooks_do_the_work);
    RUN_TEST(test_loops_follow_one_another);
    RUN_TEST(test_loops_take_one_turn_of_the_host);
    RUN_TEST(test_loops_get_over_a_thread_that_is_held_up);
    RUN_TEST(test_little_work_stays_on_the_caller);
    RUN_TEST(test_no_loops_are_no_work);
    RUN_TEST(test_no_memory_for_a_pool);
    RUN_TEST(test_pools_come_and_go);
    return UNITY_END();
}

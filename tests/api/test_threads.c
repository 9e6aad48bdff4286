/* Threads: one world used from two threads, many worlds at once, and the host's own job system. */
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "calls.h"

void setUp(void)
{
}

void tearDown(void)
{
    pbmpm_shutdown();
}

/* ---- a gate that holds one thread inside a step ---- */

/* The allocator is called from inside the first step (the grid has to grow); there the stepping thread waits while the
 * other one tries every call. */
typedef struct gate {
    ledger book;
    pbmpm_allocator gated;
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    bool armed;    /* the next allocation stops */
    bool reached;  /* the stepping thread waits in the allocator */
    bool released; /* it may go on */
} gate;

static void *gate_allocate(size_t size, size_t alignment, void *user)
{
    gate *door = user;
    pthread_mutex_lock(&door->mutex);
    if (door->armed) {
        door->armed = false;
        door->reached = true;
        pthread_cond_broadcast(&door->changed);
        while (!door->released)
            pthread_cond_wait(&door->changed, &door->mutex);
    }
    pthread_mutex_unlock(&door->mutex);
    return door->book.allocator.allocate(size, alignment, &door->book);
}

static void gate_release(void *memory, size_t size, void *user)
{
    gate *door = user;
    door->book.allocator.release(memory, size, &door->book);
}

static void use_gate(pbmpm_world_def *def, void *user)
{
    gate *door = user;
    ledger_allocator(&door->book);
    door->gated = (pbmpm_allocator){sizeof door->gated, gate_allocate, gate_release, door};
    def->allocator = &door->gated;
}

typedef struct stepper {
    pbmpm_world_id world;
    gate *door;
    pbmpm_result result;
} stepper;

static void *step_through_gate(void *user)
{
    stepper *walker = user;
    walker->result = pbmpm_world_step(walker->world, 0.001f);
    pthread_mutex_lock(&walker->door->mutex); /* if nothing was allocated, say so instead of waiting for ever */
    walker->door->armed = false;
    pthread_cond_broadcast(&walker->door->changed);
    pthread_mutex_unlock(&walker->door->mutex);
    return NULL;
}

static void test_every_call_is_refused_while_another_thread_steps(void)
{
    static gate door = {.mutex = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER};
    const target ids = target_create(use_gate, &door), twin = target_create(NULL, NULL);
    stepper walker = {ids.world, &door, PBMPM_ERROR_BUSY};
    pbmpm_result results[128];
    pthread_t thread;
    TEST_ASSERT_TRUE(world_call_count <= (int)(sizeof results / sizeof *results));
    door.armed = true;
    TEST_ASSERT_EQUAL_INT(0, pthread_create(&thread, NULL, step_through_gate, &walker));
    pthread_mutex_lock(&door.mutex);
    while (!door.reached && door.armed)
        pthread_cond_wait(&door.changed, &door.mutex);
    const bool reached = door.reached;
    pthread_mutex_unlock(&door.mutex);
    for (int i = 0; i < world_call_count && reached; i++)
        results[i] = world_calls[i].make(&ids);
    const pbmpm_result elsewhere = pbmpm_world_step(twin.world, 0.001f); /* other worlds are free */
    pthread_mutex_lock(&door.mutex);
    door.released = true;
    pthread_cond_broadcast(&door.changed);
    pthread_mutex_unlock(&door.mutex);
    pthread_join(thread, NULL);
    TEST_ASSERT_TRUE_MESSAGE(reached, "the first step took no memory; the gate never closed");
    for (int i = 0; i < world_call_count; i++)
        TEST_ASSERT_EQUAL_STRING_MESSAGE("PBMPM_ERROR_BUSY", pbmpm_result_name(results[i]), world_calls[i].name);
    TEST_ASSERT_EQUAL_STRING("PBMPM_OK", pbmpm_result_name(walker.result));
    TEST_ASSERT_EQUAL_STRING("PBMPM_OK", pbmpm_result_name(elsewhere));
    TEST_ASSERT_EQUAL_HEX64(world_hash(twin.world), world_hash(ids.world)); /* refusals changed nothing */
    OK(pbmpm_world_destroy(ids.world));
}

/* ---- two threads race for one world ---- */

typedef struct racer {
    pbmpm_world_id world;
    atomic_int *busy_seen; /* of both threads */
    int done, busy, other;
} racer;

static void *race(void *user)
{
    enum { BOUND = 20000 };
    racer *self = user;
    for (int i = 0; i < BOUND && atomic_load(self->busy_seen) < 100; i++) {
        switch (pbmpm_world_step(self->world, 0.001f)) {
        case PBMPM_OK: self->done++; break;
        case PBMPM_ERROR_BUSY:
            self->busy++;
            atomic_fetch_add(self->busy_seen, 1);
            break;
        default: self->other++;
        }
    }
    return NULL;
}

static void test_racing_threads_do_no_harm(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL), alone = tank_2d(NULL, NULL);
    atomic_int busy_seen = 0;
    racer racers[2] = {{.world = world, .busy_seen = &busy_seen}, {.world = world, .busy_seen = &busy_seen}};
    pthread_t threads[2];
    for (int i = 0; i < 2; i++)
        TEST_ASSERT_EQUAL_INT(0, pthread_create(&threads[i], NULL, race, &racers[i]));
    for (int i = 0; i < 2; i++)
        pthread_join(threads[i], NULL);
    const int done = racers[0].done + racers[1].done;
    TEST_ASSERT_EQUAL_INT(0, racers[0].other + racers[1].other);
    TEST_ASSERT_TRUE_MESSAGE(racers[0].busy + racers[1].busy > 0, "the two threads never met");
    TEST_ASSERT_EQUAL_UINT64((uint64_t)done, world_stats(world).step_count);
    for (int i = 0; i < done; i++)
        OK(pbmpm_world_step(alone, 0.001f));
    TEST_ASSERT_EQUAL_HEX64(world_hash(alone), world_hash(world));
}

/* ---- many worlds at once ---- */

enum { WORLDS = 6, WORLD_STEPS = 60 };

static void *step_a_world(void *user)
{
    const pbmpm_world_id world = *(pbmpm_world_id *)user;
    for (int i = 0; i < WORLD_STEPS; i++)
        if (pbmpm_world_step(world, 0.005f) != PBMPM_OK)
            return user;
    return NULL;
}

static void two_threads(pbmpm_world_def *def, void *user)
{
    (void)user;
    def->thread_count = 2;
}

static void test_worlds_step_at_the_same_time(void)
{
    pbmpm_world_id worlds[WORLDS];
    pthread_t threads[WORLDS];
    uint64_t right[2];
    for (int kind = 0; kind < 2; kind++) {
        const pbmpm_world_id alone = kind ? block_2d(NULL, NULL) : tank_2d(NULL, NULL);
        TEST_ASSERT_NULL(step_a_world((void *)(uintptr_t)&alone));
        right[kind] = world_hash(alone);
    }
    for (int i = 0; i < WORLDS; i++)
        worlds[i] = i % 2 ? block_2d(two_threads, NULL) : tank_2d(two_threads, NULL);
    for (int i = 0; i < WORLDS; i++)
        TEST_ASSERT_EQUAL_INT(0, pthread_create(&threads[i], NULL, step_a_world, &worlds[i]));
    for (int i = 0; i < WORLDS; i++) {
        void *failed = NULL;
        pthread_join(threads[i], &failed);
        TEST_ASSERT_NULL(failed);
    }
    for (int i = 0; i < WORLDS; i++)
        TEST_ASSERT_EQUAL_HEX64(right[i % 2], world_hash(worlds[i]));
}

static void *make_and_break_worlds(void *failed)
{
    for (int i = 0; i < 50; i++) {
        pbmpm_world_def def;
        pbmpm_world_id world;
        pbmpm_world_def_init(&def, sizeof def);
        def.dimension = 2 + i % 2;
        def.particle_capacity = 64;
        def.thread_count = 1 + i % 3;
        if (pbmpm_world_create(&def, &world) != PBMPM_OK || pbmpm_world_step(world, 0.01f) != PBMPM_OK ||
            pbmpm_world_destroy(world) != PBMPM_OK || pbmpm_world_destroy(world) != PBMPM_ERROR_INVALID_ID)
            return failed;
    }
    return NULL;
}

static void test_worlds_are_made_and_destroyed_at_the_same_time(void)
{
    static char failure_mark;
    pthread_t threads[4];
    for (int i = 0; i < 4; i++)
        TEST_ASSERT_EQUAL_INT(0, pthread_create(&threads[i], NULL, make_and_break_worlds, &failure_mark));
    for (int i = 0; i < 4; i++) {
        void *failed = NULL;
        pthread_join(threads[i], &failed);
        TEST_ASSERT_NULL(failed);
    }
}

/* A world may move from thread to thread. */
static void test_a_world_may_change_its_thread(void)
{
    const pbmpm_world_id here = tank_2d(two_threads, NULL), there = tank_2d(two_threads, NULL);
    for (int part = 0; part < 3; part++) {
        pthread_t thread;
        void *failed = NULL;
        TEST_ASSERT_NULL(step_a_world((void *)(uintptr_t)&here));
        TEST_ASSERT_EQUAL_INT(0, pthread_create(&thread, NULL, step_a_world, (void *)(uintptr_t)&there));
        pthread_join(thread, &failed);
        TEST_ASSERT_NULL(failed);
    }
    TEST_ASSERT_EQUAL_HEX64(world_hash(here), world_hash(there));
}

/* ---- the host's job system ---- */

enum { HOST_THREADS = 3 };

/* One call of enqueue: the shares still to be done. */
typedef struct host_job {
    pbmpm_task *task;
    void *context;
    int32_t count;
    atomic_int next;
    pthread_t threads[HOST_THREADS];
} host_job;

typedef struct host {
    bool threaded; /* own threads; otherwise all shares run inside enqueue, the last one first */
    int enqueued, finished, largest;
} host;

static void *run_shares(void *user)
{
    host_job *job = user;
    for (int32_t i; (i = atomic_fetch_add(&job->next, 1)) < job->count;)
        job->task(job->count - 1 - i, job->context);
    return NULL;
}

static void *host_enqueue(pbmpm_task *task, int32_t count, void *context, void *user)
{
    host *own = user;
    own->enqueued++;
    own->largest = count > own->largest ? count : own->largest;
    host_job *job = calloc(1, sizeof *job);
    *job = (host_job){.task = task, .context = context, .count = count};
    if (!own->threaded)
        run_shares(job);
    for (int i = 0; own->threaded && i < HOST_THREADS; i++)
        pthread_create(&job->threads[i], NULL, run_shares, job);
    return job;
}

static void host_finish(void *handle, void *user)
{
    host *own = user;
    host_job *job = handle;
    own->finished++;
    for (int i = 0; own->threaded && i < HOST_THREADS; i++)
        pthread_join(job->threads[i], NULL);
    free(job);
}

/* Each share at once and nothing to wait for: the handle is null. */
static void *host_enqueue_at_once(pbmpm_task *task, int32_t count, void *context, void *user)
{
    host *own = user;
    own->enqueued++;
    own->largest = count > own->largest ? count : own->largest;
    for (int32_t i = 0; i < count; i++)
        task(i, context);
    return NULL;
}

static void host_finish_nothing(void *handle, void *user)
{
    host *own = user;
    own->finished += handle == NULL;
}

static void use_host(pbmpm_world_def *def, void *user)
{
    static pbmpm_task_hooks hooks = {sizeof hooks, host_enqueue, host_finish, NULL};
    hooks.user = user;
    def->tasks = &hooks;
    def->thread_count = 4;
}

static void use_host_at_once(pbmpm_world_def *def, void *user)
{
    static pbmpm_task_hooks hooks = {sizeof hooks, host_enqueue_at_once, host_finish_nothing, NULL};
    hooks.user = user;
    def->tasks = &hooks;
    def->thread_count = 7;
}

static uint64_t hash_with(const scene *plan, scene_tweak *tweak, void *user)
{
    const stage made = plan->build(tweak, user);
    scene_run(plan, &made, 0, 40);
    const uint64_t hash = world_hash(made.world);
    OK(pbmpm_world_destroy(made.world));
    return hash;
}

static void test_the_hosts_job_system_gives_the_same_results(void)
{
    static host threaded = {.threaded = true}, reversed, at_once;
    for (int i = 0; i < scene_count; i++) {
        const uint64_t right = hash_with(&scenes[i], NULL, NULL);
        TEST_ASSERT_EQUAL_HEX64_MESSAGE(right, hash_with(&scenes[i], use_host, &threaded), scenes[i].name);
        TEST_ASSERT_EQUAL_HEX64_MESSAGE(right, hash_with(&scenes[i], use_host, &reversed), scenes[i].name);
        TEST_ASSERT_EQUAL_HEX64_MESSAGE(right, hash_with(&scenes[i], use_host_at_once, &at_once), scenes[i].name);
    }
    TEST_ASSERT_TRUE_MESSAGE(threaded.enqueued > 0, "no scene is large enough to be cut into shares");
    TEST_ASSERT_EQUAL_INT(threaded.enqueued, threaded.finished);
    TEST_ASSERT_EQUAL_INT(at_once.enqueued, at_once.finished);
    TEST_ASSERT_TRUE(threaded.largest > 1);
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_every_call_is_refused_while_another_thread_steps);
    RUN_TEST(test_racing_threads_do_no_harm);
    RUN_TEST(test_worlds_step_at_the_same_time);
    RUN_TEST(test_worlds_are_made_and_destroyed_at_the_same_time);
    RUN_TEST(test_a_world_may_change_its_thread);
    RUN_TEST(test_the_hosts_job_system_gives_the_same_results);
    return UNITY_END();
}

/* A process that forks: in the child a world can be destroyed and nothing else; the parent does not notice. */
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "calls.h"

void setUp(void)
{
}

void tearDown(void)
{
    pbmpm_shutdown();
}

static void use_threads(pbmpm_world_def *def, void *user)
{
    def->thread_count = *(const int32_t *)user;
}

/* Runs `child` in a child process; returns its answer, 1000 + the signal if it died, or 2000 if it hung. */
static int answer_of(int (*child)(const target *), const target *ids)
{
    int status = 0;
    fflush(stdout);
    const pid_t pid = fork();
    TEST_ASSERT_TRUE(pid >= 0);
    if (pid == 0) {
        alarm(20); /* a deadlock ends the child */
        _exit(child(ids));
    }
    TEST_ASSERT_TRUE(waitpid(pid, &status, 0) == pid);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

/* The answer is the number (from 1) of the first call that was not refused, or 0. */
static int every_call_but_destroy(const target *ids)
{
    for (int i = 0; i < world_call_count - 1; i++)
        if (world_calls[i].make(ids) != PBMPM_ERROR_FORKED)
            return i + 1;
    return 0;
}

static int destroy_twice(const target *ids)
{
    if (pbmpm_world_destroy(ids->world) != PBMPM_OK)
        return 1;
    return pbmpm_world_destroy(ids->world) == PBMPM_ERROR_INVALID_ID ? 0 : 2;
}

static int shut_down(const target *ids)
{
    if (pbmpm_shutdown() != PBMPM_OK)
        return 1;
    return pbmpm_world_destroy(ids->world) == PBMPM_ERROR_INVALID_ID ? 0 : 2;
}

static int make_a_world_of_its_own(const target *ids)
{
    pbmpm_world_def def;
    pbmpm_world_id own;
    (void)ids;
    pbmpm_world_def_init(&def, sizeof def);
    def.particle_capacity = 64;
    def.thread_count = 2;
    return pbmpm_world_create(&def, &own) == PBMPM_OK && pbmpm_world_step(own, 0.01f) == PBMPM_OK &&
                   pbmpm_world_destroy(own) == PBMPM_OK
               ? 0
               : 1;
}

static void check_fork(int32_t thread_count)
{
    const target ids = target_create(use_threads, &thread_count), twin = target_create(use_threads, &thread_count);
    OK(pbmpm_world_step(ids.world, 0.01f));
    OK(pbmpm_world_step(twin.world, 0.01f));
    const int answer = answer_of(every_call_but_destroy, &ids);
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, answer, answer > 0 && answer < world_call_count ? world_calls[answer - 1].name : "the child died");
    TEST_ASSERT_EQUAL_INT(0, answer_of(destroy_twice, &ids));
    TEST_ASSERT_EQUAL_INT(0, answer_of(shut_down, &ids));
    TEST_ASSERT_EQUAL_INT(0, answer_of(make_a_world_of_its_own, &ids));
    for (int i = 0; i < 5; i++) {
        OK(pbmpm_world_step(ids.world, 0.01f));
        OK(pbmpm_world_step(twin.world, 0.01f));
    }
    TEST_ASSERT_EQUAL_HEX64(world_hash(twin.world), world_hash(ids.world));
    OK(pbmpm_world_destroy(ids.world));
}

static void test_fork_with_one_thread(void)
{
    check_fork(1);
}

static void test_fork_with_threads(void)
{
    check_fork(4);
}

/* ---- while other threads are inside of the library ---- */

static atomic_int armed, held, released; /* the next allocation waits until it is released */

static void *slow_allocate(size_t size, size_t alignment, void *user)
{
    (void)user;
    if (atomic_load(&armed)) {
        atomic_store(&held, 1);
        while (!atomic_load(&released))
            usleep(100);
    }
    return aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

static void slow_release(void *memory, size_t size, void *user)
{
    (void)size;
    (void)user;
    free(memory);
}

static void use_slow_memory(pbmpm_world_def *def, void *user)
{
    static const pbmpm_allocator slow = {sizeof slow, slow_allocate, slow_release, NULL};
    (void)user;
    def->allocator = &slow;
}

static void *step_once(void *user)
{
    const target *ids = user;
    return pbmpm_world_step(ids->world, 0.001f) == PBMPM_OK ? NULL : user;
}

static void *query_once(void *user)
{
    const target *ids = user;
    const float point[2] = {1, 1};
    float filling;
    return pbmpm_query_points(ids->world, point, 1, &filling, NULL, NULL) == PBMPM_OK ? NULL : user;
}

/* The fork froze a call in the child; it goes on in the parent. The call takes memory. */
static void check_fork_inside(void *(*call)(void *), target *ids)
{
    pthread_t thread;
    void *failed = NULL;
    atomic_store(&held, 0);
    atomic_store(&released, 0);
    atomic_store(&armed, 1);
    TEST_ASSERT_EQUAL_INT(0, pthread_create(&thread, NULL, call, ids));
    while (!atomic_load(&held))
        usleep(100);
    EXPECT(PBMPM_ERROR_BUSY, pbmpm_world_destroy(ids->world));
    TEST_ASSERT_EQUAL_INT(0, answer_of(every_call_but_destroy, ids));
    TEST_ASSERT_EQUAL_INT(0, answer_of(destroy_twice, ids));
    TEST_ASSERT_EQUAL_INT(0, answer_of(shut_down, ids));
    TEST_ASSERT_EQUAL_INT(0, answer_of(make_a_world_of_its_own, ids));
    EXPECT(PBMPM_ERROR_BUSY, pbmpm_world_destroy(ids->world)); /* nothing of that was felt here */
    atomic_store(&released, 1);
    pthread_join(thread, &failed);
    atomic_store(&armed, 0);
    TEST_ASSERT_NULL(failed);
    OK(pbmpm_world_destroy(ids->world));
}

static void test_fork_while_another_thread_steps(void)
{
    target ids = target_create(use_slow_memory, NULL);
    OK(pbmpm_world_step(ids.world, 0.001f));
    set_solver(ids.world, PBMPM_SOLVER_DUAL); /* which takes memory in its first step */
    check_fork_inside(step_once, &ids);
}

static void test_fork_while_another_thread_reads(void)
{
    target ids = target_create(use_slow_memory, NULL);
    OK(pbmpm_world_step(ids.world, 0.001f));
    check_fork_inside(query_once, &ids); /* the first query takes memory */
}

static atomic_int enough;

static void *create_and_destroy(void *user)
{
    pbmpm_world_def def;
    pbmpm_world_id world;
    pbmpm_world_def_init(&def, sizeof def);
    def.particle_capacity = 1;
    def.dimension = 2;
    def.thread_count = 1;
    while (!atomic_load(&enough))
        if (pbmpm_world_create(&def, &world) != PBMPM_OK || pbmpm_world_destroy(world) != PBMPM_OK)
            return user;
    return NULL;
}

/* Slots that are taken make the search for a free one long, so that forks fall into it. */
static void test_forks_while_other_threads_create_worlds(void)
{
#ifdef PBMPM_SANITIZED
    TEST_IGNORE_MESSAGE("AddressSanitizer's allocator itself hangs in the child of a process whose threads allocate");
#endif
    enum { TAKEN = 150, CREATORS = 2, FORKS = 400 };
    pthread_t thread[CREATORS];
    pbmpm_world_id taken[TAKEN];
    const target nothing = {.world = {0, 0}};
    const pbmpm_world_def def = default_world(2, 0.1f, 1);
    int answer = 0, failures = 0, user = 0;
    for (int i = 0; i < TAKEN; i++)
        taken[i] = create_world(&def);
    for (int i = 0; i < CREATORS; i++)
        TEST_ASSERT_EQUAL_INT(0, pthread_create(&thread[i], NULL, create_and_destroy, &user));
    for (int i = 0; i < FORKS && answer == 0; i++)
        answer = answer_of(make_a_world_of_its_own, &nothing);
    atomic_store(&enough, 1);
    for (int i = 0; i < CREATORS; i++) {
        void *failed;
        pthread_join(thread[i], &failed);
        failures += failed != NULL;
    }
    for (int i = 0; i < TAKEN; i++)
        OK(pbmpm_world_destroy(taken[i]));
    TEST_ASSERT_EQUAL_INT(0, answer);
    TEST_ASSERT_EQUAL_INT(0, failures);
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_fork_with_one_thread);
    RUN_TEST(test_fork_with_threads);
    RUN_TEST(test_fork_while_another_thread_steps);
    RUN_TEST(test_fork_while_another_thread_reads);
    RUN_TEST(test_forks_while_other_threads_create_worlds);
    return UNITY_END();
}

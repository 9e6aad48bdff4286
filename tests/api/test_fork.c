/* A process that forks: in the child a world can be destroyed and nothing else; the parent does not notice. */
#include <stdio.h>
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

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_fork_with_one_thread);
    RUN_TEST(test_fork_with_threads);
    return UNITY_END();
}

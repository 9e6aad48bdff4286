/* Steps in the background: the same results, whoever runs them, in the mode and on the threads that the host expects. */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>
#if !defined(_WIN32)
#include <dirent.h>
#include <signal.h>
#endif

#include "calls.h"
#include "solvers.h"

void setUp(void)
{
}

void tearDown(void)
{
    pbmpm_shutdown();
    pbmpm_set_log_callback(NULL, NULL);
}

/* ---- results ---- */

static void step_both(const stage *made, int step, bool background)
{
    const float dt = 1.0f / 120, position[3] = {0.2f + 2.0f * dt * (float)(step % 40), 0.3f, 0.6f};
    OK(pbmpm_collider_move(made->world, made->paddle, position, NULL));
    if (!background) {
        OK(pbmpm_world_step(made->world, dt));
        return;
    }
    OK(pbmpm_world_step_begin(made->world, dt));
    view_of(made->world, PBMPM_POSITION);
    while (pbmpm_world_step_end(made->world, step % 2) == PBMPM_ERROR_BUSY)
        continue;
}

static void check_equality(int32_t dimension, const way *chosen, scene_tweak *tweak, void *user)
{
    enum { STEPS = 20 };
    const stage one = stirred_pool(dimension, chosen, NULL, NULL), other = stirred_pool(dimension, chosen, tweak, user);
    for (int step = 0; step < STEPS; step++) {
        step_both(&one, step, false);
        step_both(&other, step, step % 5 != 4); /* the two kinds of steps may follow each other */
        TEST_ASSERT_EQUAL_HEX64_MESSAGE(world_hash(one.world), world_hash(other.world), chosen->name);
    }
    TEST_ASSERT_EQUAL_UINT64(STEPS, world_stats(other.world).step_count);
    OK(pbmpm_world_destroy(one.world));
    OK(pbmpm_world_destroy(other.world));
}

static void test_results_are_those_of_steps_that_wait(void)
{
    for (int w = 0; w < way_count; w++)
        check_equality(2 + w % 2, &ways[w], w % 2 ? three_threads : NULL, NULL);
}

static void *enqueue_at_once(pbmpm_task *task, int32_t count, void *context, void *user)
{
    for (int32_t i = count - 1; i >= 0; i--)
        task(i, context);
    *(int *)user += 1;
    return NULL;
}

static void finish_nothing(void *handle, void *user)
{
    (void)handle;
    (void)user;
}

static void use_hooks(pbmpm_world_def *def, void *user)
{
    static pbmpm_task_hooks hooks = {sizeof hooks, 0, enqueue_at_once, finish_nothing, NULL};
    hooks.user = user;
    def->tasks = &hooks;
    def->thread_count = 4;
}

static void test_task_hooks_do_the_work(void)
{
    static int enqueued;
    check_equality(3, &ways[WAY_PAPER], use_hooks, &enqueued);
    TEST_ASSERT_TRUE(enqueued > 0);
}

/* ---- steps that are tasks of the host ---- */

/* A job system that nests. It has no threads: a lone task waits until somebody finishes it, tasks of others run at once. */
typedef struct late_host {
    pbmpm_task *task; /* of the step; null: none waits */
    void *context;
    int steps, finishes, others;
} late_host;

static void nothing_left(int32_t index, void *context)
{
    (void)index;
    (void)context;
}

static void *enqueue_late(pbmpm_task *task, int32_t count, void *context, void *user)
{
    late_host *host = user;
    if (count > 1) {
        host->others++;
        return enqueue_at_once(task, count, context, &(int){0});
    }
    TEST_ASSERT_NULL_MESSAGE(host->task, "two steps are under way");
    host->task = task;
    host->context = context;
    host->steps++;
    return host;
}

static void finish_late(void *handle, void *user)
{
    late_host *host = user;
    pbmpm_task *task = host->task;
    if (handle != host)
        return;
    TEST_ASSERT_NOT_NULL_MESSAGE(task, "a step is finished twice");
    host->finishes++;
    host->task = NULL;
    task(0, host->context);
}

static void use_late_host(pbmpm_world_def *def, void *user)
{
    static pbmpm_task_hooks hooks = {sizeof hooks, 1, enqueue_late, finish_late, NULL};
    hooks.user = user;
    def->tasks = &hooks;
    def->thread_count = 4;
}

/* One that runs everything at once: the step is over when its begin returns. */
static void use_prompt_host(pbmpm_world_def *def, void *user)
{
    static pbmpm_task_hooks hooks = {sizeof hooks, 1, enqueue_at_once, finish_nothing, NULL};
    hooks.user = user;
    def->tasks = &hooks;
    def->thread_count = 4;
}

/* One whose tasks have threads of their own. */
typedef struct task_thread {
    pthread_t thread;
    pbmpm_task *task;
    void *context;
    int32_t count;
} task_thread;

static void *run_tasks(void *user)
{
    const task_thread *own = user;
    host_set_float_mode(HOST_USUAL | HOST_UP); /* a mode of its own, which the step does not take over, and leaves */
    for (int32_t i = 0; i < own->count; i++)
        own->task(i, own->context);
    return host_float_mode() == (HOST_USUAL | HOST_UP) ? NULL : user;
}

static void *enqueue_on_thread(pbmpm_task *task, int32_t count, void *context, void *user)
{
    task_thread *made = malloc(sizeof *made);
    (void)user;
    *made = (task_thread){.task = task, .context = context, .count = count};
    TEST_ASSERT_EQUAL_INT(0, pthread_create(&made->thread, NULL, run_tasks, made));
    return made;
}

static void finish_thread(void *handle, void *user)
{
    task_thread *made = handle;
    void *wrong_mode = NULL;
    (void)user;
    pthread_join(made->thread, &wrong_mode);
    TEST_ASSERT_NULL_MESSAGE(wrong_mode, "a task left another floating-point mode than it found");
    free(made);
}

static void use_threaded_host(pbmpm_world_def *def, void *user)
{
    static pbmpm_task_hooks hooks = {sizeof hooks, 1, enqueue_on_thread, finish_thread, NULL};
    (void)user;
    def->tasks = &hooks;
    def->thread_count = 3;
}

static void test_steps_as_tasks_give_the_same_results(void)
{
    static int enqueued;
    check_equality(2, &ways[WAY_DUAL], use_threaded_host, NULL);
    check_equality(3, &ways[WAY_PAPER], use_threaded_host, NULL);
    check_equality(3, &ways[WAY_PAPER], use_prompt_host, &enqueued);
    TEST_ASSERT_TRUE(enqueued > 0);
}

/* Nobody but who ends the step works on it, and still no call waits for ever. */
static void test_a_step_that_no_thread_has_begun(void)
{
    late_host host = {0};
    int32_t done = 1;
    pbmpm_view view = {.size = sizeof view};
    const int before = host_thread_count();
    const pbmpm_world_id world = tank_2d(use_late_host, &host);
    const pbmpm_view old = view_of(world, PBMPM_POSITION);
    const float first = ((const float *)old.data)[0];
    OK(pbmpm_world_step_begin(world, 0.01f));
    TEST_ASSERT_EQUAL_INT(before, host_thread_count());
    OK(pbmpm_world_step_done(world, &done));
    TEST_ASSERT_EQUAL_INT32(0, done);
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_BUSY, pbmpm_world_step_end(world, 0));
    OK(pbmpm_particles_view(world, PBMPM_POSITION, &view)); /* makes the copy, which the step then finds */
    TEST_ASSERT_EQUAL_FLOAT(first, ((const float *)view.data)[0]);
    OK(pbmpm_world_step_end(world, 1));
    TEST_ASSERT_EQUAL_FLOAT(first, ((const float *)view.data)[0]);
    TEST_ASSERT_EQUAL_INT(1, host.steps);
    TEST_ASSERT_EQUAL_INT(1, host.finishes);
    TEST_ASSERT_EQUAL_UINT64(1, world_stats(world).step_count);
    OK(pbmpm_world_step_begin(world, 0.01f));
    OK(pbmpm_world_destroy(world)); /* finishes it, too */
    TEST_ASSERT_EQUAL_INT(2, host.finishes);
}

/* A poll that finds the step done gives its handle back. */
static void test_polled_steps_are_finished_once(void)
{
    late_host host = {0};
    const pbmpm_world_id world = tank_2d(use_late_host, &host);
    for (int i = 1; i <= 3; i++) {
        OK(pbmpm_world_step_begin(world, 0.01f));
        pbmpm_task *task = host.task;
        task(0, host.context); /* a worker of the host takes it */
        host.task = nothing_left;
        OK(pbmpm_world_step_end(world, 0));
        TEST_ASSERT_EQUAL_INT(i, host.finishes);
    }
    OK(pbmpm_world_step(world, 0.01f)); /* no task of its own */
    TEST_ASSERT_EQUAL_INT(3, host.steps);
}

/* A host that works on the step of another world while it waits for this one's tasks: what it sees of this one's mode afterwards. */
typedef struct helping_host {
    late_host *other;
    unsigned mode;
    int calls, wrong;
} helping_host;

static void *enqueue_helping(pbmpm_task *task, int32_t count, void *context, void *user)
{
    helping_host *own = user;
    own->calls++;
    own->wrong += (host_float_mode() & ~(unsigned)HOST_FLAGS) != own->mode;
    if (own->other->task)
        finish_late(own->other, own->other);
    own->wrong += (host_float_mode() & ~(unsigned)HOST_FLAGS) != own->mode;
    return enqueue_at_once(task, count, context, &(int){0});
}

static void use_helping_host(pbmpm_world_def *def, void *user)
{
    static pbmpm_task_hooks hooks = {sizeof hooks, 1, enqueue_helping, finish_nothing, NULL};
    hooks.user = user;
    def->tasks = &hooks;
    def->thread_count = 3;
}

static void test_each_step_has_the_mode_of_who_began_it(void)
{
    static late_host late;
    static helping_host helper = {.other = &late, .mode = HOST_USUAL};
    late = (late_host){0};
    const stage waiting = stirred_pool(2, &ways[WAY_PAPER], use_late_host, &late), helped = stirred_pool(3, &ways[WAY_PAPER], use_helping_host, &helper);
    host_set_float_mode(HOST_USUAL | HOST_UP);
    const pbmpm_result begun = pbmpm_world_step_begin(waiting.world, 0.01f);
    host_set_float_mode(HOST_USUAL);
    OK(begun);
    OK(pbmpm_world_step(helped.world, 0.01f));
    TEST_ASSERT_EQUAL_INT(1, late.finishes);
    TEST_ASSERT_TRUE(helper.calls > 2);
    TEST_ASSERT_EQUAL_INT(0, helper.wrong);
    late.task = nothing_left;
    OK(pbmpm_world_step_end(waiting.world, 0));
}

/* Nobody computes a step that nobody will see. */
static void test_a_step_that_is_not_begun_is_given_up(void)
{
    late_host host = {0};
    const stage made = stirred_pool(2, &ways[WAY_PAPER], use_late_host, &host);
    OK(pbmpm_world_step_begin(made.world, 0.01f));
    OK(pbmpm_world_destroy(made.world));
    TEST_ASSERT_EQUAL_INT(1, host.finishes);
    TEST_ASSERT_EQUAL_INT(0, host.others);
}

/* ---- the host's functions, and its signals ---- */

static pthread_t own_thread;
static unsigned wanted_mode;
static int calls_elsewhere, wrong_modes; /* calls from the step's thread */

static void note_mode(void)
{
    if (pthread_equal(pthread_self(), own_thread))
        return;
    calls_elsewhere++;
    wrong_modes += (host_float_mode() & ~(unsigned)HOST_FLAGS) != wanted_mode;
}

static void *noting_allocate(size_t size, size_t alignment, void *user)
{
    (void)user;
    note_mode();
    return host_allocate(size, alignment);
}

static void noting_release(void *memory, size_t size, void *user)
{
    (void)size;
    (void)user;
    note_mode();
    host_release(memory);
}

static void *noting_enqueue(pbmpm_task *task, int32_t count, void *context, void *user)
{
    (void)user;
    note_mode();
    for (int32_t i = 0; i < count; i++)
        task(i, context);
    return NULL;
}

static void noting_finish(void *handle, void *user)
{
    (void)handle;
    (void)user;
    note_mode();
}

static void noting_log(pbmpm_log_level level, const char *message, void *user)
{
    (void)level;
    (void)message;
    (void)user;
    note_mode();
}

/* They find the mode of the thread that began the step, as in a step that waits. */
static void test_functions_of_the_host_run_in_its_mode(void)
{
    static const unsigned modes[] = {HOST_USUAL, HOST_USUAL | HOST_UP, HOST_USUAL, HOST_USUAL | HOST_FLUSH}; /* the usual one; rounding up; the usual one; that of the kernels */
    const unsigned own = host_float_mode();
    pbmpm_world_def def = default_world(2, 0.05f, 8192);
    def.allocator = &(pbmpm_allocator){sizeof(pbmpm_allocator), noting_allocate, noting_release, NULL};
    def.tasks = &(pbmpm_task_hooks){sizeof(pbmpm_task_hooks), 0, noting_enqueue, noting_finish, NULL};
    def.thread_count = 2;
    own_thread = pthread_self();
    calls_elsewhere = wrong_modes = 0;
    OK(pbmpm_set_log_callback(noting_log, NULL));
    const pbmpm_world_id world = create_world(&def);
    fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0, 0, 0, 0.7f, 0.7f, 0), (const float[3]){0, 0, 0});
    for (int i = 0; i < 4; i++) {
        wanted_mode = modes[i];
        const int before = calls_elsewhere;
        host_set_float_mode(wanted_mode);
        const pbmpm_result begun = pbmpm_world_step_begin(world, 0.01f);
        host_set_float_mode(own);
        OK(begun);
        OK(pbmpm_world_step_end(world, 1));
        TEST_ASSERT_TRUE(calls_elsewhere > before);
    }
    OK(pbmpm_world_destroy(world));
    OK(pbmpm_set_log_callback(NULL, NULL));
    TEST_ASSERT_EQUAL_INT(0, wrong_modes);
}

#if !defined(_WIN32) /* which has no signals */

/* The signals that a thread of this process blocks. */
static unsigned long long blocked_by(const char *thread)
{
    char path[300], line[200];
    unsigned long long blocked = 0;
    snprintf(path, sizeof path, "/proc/self/task/%s/status", thread);
    FILE *file = fopen(path, "r");
    TEST_ASSERT_NOT_NULL(file);
    while (fgets(line, sizeof line, file))
        sscanf(line, "SigBlk: %llx", &blocked);
    fclose(file);
    return blocked;
}

/* The host's handlers run on the host's threads. Faults are left to whose they are. */
static void test_threads_of_the_library_take_no_signals(void)
{
    static const int faults[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGABRT, SIGSYS};
    unsigned long long all = 0x7fffffff & ~(1ull << (SIGKILL - 1)) & ~(1ull << (SIGSTOP - 1));
    int others = 0;
    sigset_t before, after;
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++)
        all &= ~(1ull << (faults[i] - 1));
    pthread_sigmask(SIG_SETMASK, NULL, &before);
    const pbmpm_world_id world = tank_2d(three_threads, NULL);
    OK(pbmpm_world_step_begin(world, 0.01f));
    OK(pbmpm_world_step_end(world, 1));
    pthread_sigmask(SIG_SETMASK, NULL, &after);
    for (int signal = 1; signal < 32; signal++)
        TEST_ASSERT_EQUAL_INT(sigismember(&before, signal), sigismember(&after, signal));
    DIR *threads = opendir("/proc/self/task");
    TEST_ASSERT_NOT_NULL(threads);
    for (struct dirent *entry; (entry = readdir(threads));) {
        if (entry->d_name[0] == '.' || atol(entry->d_name) == getpid())
            continue;
        others++;
        TEST_ASSERT_EQUAL_HEX64(all, blocked_by(entry->d_name) & all); /* while a thread begins, libc blocks faults, too */
    }
    closedir(threads);
    TEST_ASSERT_TRUE(others >= 3); /* the thread sanitizer has one of its own */
}

#endif

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_results_are_those_of_steps_that_wait);
    RUN_TEST(test_task_hooks_do_the_work);
    RUN_TEST(test_steps_as_tasks_give_the_same_results);
    RUN_TEST(test_a_step_that_no_thread_has_begun);
    RUN_TEST(test_polled_steps_are_finished_once);
    RUN_TEST(test_each_step_has_the_mode_of_who_began_it);
    RUN_TEST(test_a_step_that_is_not_begun_is_given_up);
    RUN_TEST(test_functions_of_the_host_run_in_its_mode);
#if !defined(_WIN32)
    RUN_TEST(test_threads_of_the_library_take_no_signals);
#endif
    return UNITY_END();
}

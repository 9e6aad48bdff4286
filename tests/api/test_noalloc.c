/* A warm step allocates nothing: neither through the world's allocator nor behind its back. */
#include <stdatomic.h>
#include <stddef.h>

#include "solvers.h"

enum { WARM_UP = 60, MEASURED = 60 };

/* The C library's allocation functions are replaced here by ones that count; the shared library's calls land here too.
 * Only glibc offers the originals under other names, and sanitizers have replacements of their own. */
#if defined(__GLIBC__) && !defined(PBMPM_SANITIZED)
#define COUNTS_MALLOC 1
extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *memory, size_t size);
extern void *__libc_memalign(size_t alignment, size_t size);

static atomic_ulong malloc_calls;

void *malloc(size_t size)
{
    atomic_fetch_add(&malloc_calls, 1);
    return __libc_malloc(size);
}

void *calloc(size_t count, size_t size)
{
    atomic_fetch_add(&malloc_calls, 1);
    return __libc_calloc(count, size);
}

void *realloc(void *memory, size_t size)
{
    atomic_fetch_add(&malloc_calls, 1);
    return __libc_realloc(memory, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    atomic_fetch_add(&malloc_calls, 1);
    return __libc_memalign(alignment, size);
}

void *memalign(size_t alignment, size_t size)
{
    atomic_fetch_add(&malloc_calls, 1);
    return __libc_memalign(alignment, size);
}

int posix_memalign(void **memory, size_t alignment, size_t size)
{
    atomic_fetch_add(&malloc_calls, 1);
    *memory = __libc_memalign(alignment, size);
    return *memory ? 0 : 12;
}

static unsigned long malloc_count(void)
{
    return atomic_load(&malloc_calls);
}
#else
#define COUNTS_MALLOC 0
static unsigned long malloc_count(void)
{
    return 0;
}
#endif

void setUp(void)
{
}

void tearDown(void)
{
    pbmpm_shutdown();
}

typedef struct limits {
    ledger book;
    int32_t thread_count;
} limits;

static void use_limits(pbmpm_world_def *def, void *user)
{
    limits *given = user;
    def->allocator = ledger_allocator(&given->book);
    def->thread_count = given->thread_count;
}

/* A tank of liquid and elastic matter at rest, once with 1 thread and once with 3. */
static pbmpm_world_id settled_tank(limits *given, const way *chosen)
{
    const pbmpm_world_id world = tank_2d(use_limits, given);
    const pbmpm_material_id jelly = create_material(world, PBMPM_ELASTIC);
    fill_shape(world, jelly, box_shape(0.5f, 0.65f, 0, 0.2f, 0.1f, 0.5f), (const float[3]){0, 0, 0});
    create_collider(world, sphere_shape(0.5f, 0.1f, 0, 0.1f), false);
    use_way(world, chosen);
    for (int i = 0; i < WARM_UP; i++)
        OK(pbmpm_world_step(world, 0.005f));
    return world;
}

static void check_warm_steps(int32_t thread_count, const way *chosen)
{
    static limits given;
    given = (limits){.thread_count = thread_count};
    const pbmpm_world_id world = settled_tank(&given, chosen);
    const uint64_t calls = given.book.calls, releases = given.book.releases;
    const unsigned long mallocs = malloc_count();
    pbmpm_result worst = PBMPM_OK;
    for (int i = 0; i < MEASURED; i++) {
        const pbmpm_result result = pbmpm_world_step(world, 0.005f);
        worst = result != PBMPM_OK ? result : worst;
    }
    const unsigned long mallocs_after = malloc_count();
    OK(worst);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(calls, given.book.calls, chosen->name);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(releases, given.book.releases, chosen->name);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(mallocs, mallocs_after, chosen->name);
    OK(pbmpm_world_destroy(world));
}

/* All ways to solve a substep but the explicit one, which does not take the tank's incompressible liquid; see test_solvers.c. */
static void check_ways(int32_t thread_count)
{
    for (int w = 0; w < way_count; w++)
        if (ways[w].solver != PBMPM_SOLVER_EXPLICIT)
            check_warm_steps(thread_count, &ways[w]);
}

static void test_a_warm_step_allocates_nothing(void)
{
    check_ways(1);
}

static void test_a_warm_step_with_threads_allocates_nothing(void)
{
    check_ways(3);
}

/* Reading back allocates nothing either. */
static void test_reading_allocates_nothing(void)
{
    static limits given;
    given = (limits){.thread_count = 1};
    const pbmpm_world_id world = settled_tank(&given, &ways[0]);
    const pbmpm_shape ball = sphere_shape(0.5f, 0.25f, 0, 0.2f);
    uint32_t count = 0;
    OK(pbmpm_query_shape(world, &ball, NULL, 0, &count)); /* the first query takes memory to look particles up */
    const uint64_t calls = given.book.calls;
    const unsigned long mallocs = malloc_count();
    OK(pbmpm_world_step(world, 0.005f));
    world_stats(world);
    world_hash(world);
    world_expect_finite(world, "settled tank");
    world_events_of(world, PBMPM_EVENT_SPEED_CLAMPED, NULL);
    OK(pbmpm_query_shape(world, &ball, NULL, 0, &count));
    const unsigned long mallocs_after = malloc_count();
    TEST_ASSERT_EQUAL_UINT64(calls, given.book.calls);
    TEST_ASSERT_EQUAL_UINT64(mallocs, mallocs_after);
}

/* The control: the counters do count. */
static void test_creation_is_counted(void)
{
    static limits given;
    given = (limits){.thread_count = 1};
    const unsigned long mallocs = malloc_count();
    tank_2d(use_limits, &given);
    TEST_ASSERT_TRUE(given.book.calls > 0);
    if (COUNTS_MALLOC)
        TEST_ASSERT_TRUE(malloc_count() > mallocs);
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_a_warm_step_allocates_nothing);
    RUN_TEST(test_a_warm_step_with_threads_allocates_nothing);
    RUN_TEST(test_reading_allocates_nothing);
    RUN_TEST(test_creation_is_counted);
    return UNITY_END();
}

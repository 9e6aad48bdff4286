/* Every allocation of every call may be refused, once or from then on: the call says so and leaves the world as it was, the world lives on as if nothing
 * had been, and everything is given back. With the argument "all" each is, in both dimensions and with threads; else every so many. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "life.h"

enum { SHORT = 13, EXPORTS = 256, NAME = 64 };

static const life_plan plans[] = {
    {.name = "paper", .dimension = 2, .solver = PBMPM_SOLVER_PAPER, .thread_count = 1},
    {.name = "paper, sleeping", .dimension = 3, .solver = PBMPM_SOLVER_PAPER, .sleeping = true, .thread_count = 1},
    {.name = "dual", .dimension = 2, .solver = PBMPM_SOLVER_DUAL, .thread_count = 1},
    {.name = "dual, sleeping", .dimension = 2, .solver = PBMPM_SOLVER_DUAL, .sleeping = true, .thread_count = 1},
    {.name = "dual in cells", .dimension = 3, .solver = PBMPM_SOLVER_DUAL, .pressure = PBMPM_PRESSURE_CELLS, .thread_count = 1},
    {.name = "primal", .dimension = 3, .solver = PBMPM_SOLVER_PRIMAL, .thread_count = 1},
    {.name = "primal, BDF2", .dimension = 2, .solver = PBMPM_SOLVER_PRIMAL, .integrator = PBMPM_INTEGRATOR_BDF2, .thread_count = 3},
    {.name = "explicit", .dimension = 2, .solver = PBMPM_SOLVER_EXPLICIT, .thread_count = 1},
    {.name = "convergent, islands", .dimension = 2, .solver = PBMPM_SOLVER_CONVERGENT, .thread_count = 3},
    {.name = "convergent, one island", .dimension = 3, .solver = PBMPM_SOLVER_CONVERGENT, .together = true, .thread_count = 1},
    {.name = "convergent, sleeping", .dimension = 3, .solver = PBMPM_SOLVER_CONVERGENT, .sleeping = true, .thread_count = 1},
};

static bool all;
static uint64_t faults;
static ledger book;

static char refusal[200]; /* the call that was refused */
static bool done_in_part;  /* it was a step: some islands were done, or what was at rest fell asleep */

/* What the world was before the call that is made. */
static struct {
    char where[200];
    bool lives, steps, behind; /* behind: a step goes on when the call is done */
    uint64_t hash, generation, failures;
    uint32_t count;
} before;

void setUp(void) {}
void tearDown(void)
{
    book.fail_at = 0;
    pbmpm_shutdown();
}

/* What baking takes is the C library's, through this. The test gives it the book's refusals. */
int posix_memalign(void **memory, size_t alignment, size_t size)
{
    if (ledger_refuses(&book)) return ENOMEM;
    *memory = host_allocate(size, alignment);
    return *memory ? 0 : ENOMEM;
}

/* ---- Which functions a life calls ---- */

static char exports[EXPORTS][NAME];
static bool called[EXPORTS];
static uint32_t export_count;

static void read_exports(void)
{
    FILE *file = fopen(PBMPM_TEST_EXPORTS, "r");
    TEST_ASSERT_NOT_NULL(file);
    export_count = 0;
    while (export_count < EXPORTS && fscanf(file, "%63s", exports[export_count]) == 1) export_count++;
    fclose(file);
    TEST_ASSERT_TRUE(export_count > 0 && export_count < EXPORTS);
}

static void mark_called(const char *call, pbmpm_world_id world, void *user)
{
    (void)world;
    (void)user;
    for (uint32_t i = 0; i < export_count; i++) {
        const char *found = strstr(call, exports[i]);
        const char end = found ? found[strlen(exports[i])] : 'x';
        called[i] = called[i] || end == '(' || end == ')';
    }
}

static life_turn expect_ok(pbmpm_result result, pbmpm_world_id world, void *user)
{
    (void)world;
    (void)user;
    OK(result);
    return LIFE_GOES_ON;
}

static void test_a_life_calls_every_function(void)
{
    static life it;
    const life_watch watch = {mark_called, expect_ok, NULL};
    read_exports();
    memset(called, 0, sizeof called);
    TEST_ASSERT_TRUE(live(&plans[0], NULL, &watch, &it));
    for (uint32_t i = 0; i < export_count; i++) TEST_ASSERT_TRUE_MESSAGE(called[i], exports[i]);
}

/* ---- Refusals ---- */

static bool is_of(const char *call, const char *what) { return strstr(call, what) != NULL; }

/* While a step runs in the background the book is the step's. */
static void look(const char *call, pbmpm_world_id world, void *user)
{
    const life_plan *plan = user;
    before.behind = is_of(call, "step_begin") || is_of(call, "step_done");
    if (is_of(call, "step_done") || is_of(call, "step_end")) return;
    const uint64_t fail_at = book.fail_at;
    book.fail_at = 0;
    snprintf(before.where, sizeof before.where, "%s, allocation %u%s, %s", plan->name, (unsigned)fail_at, book.sticky ? " and all that follow" : "", call);
    before.failures = book.failures;
    before.steps = is_of(call, "step");
    before.lives = world.generation != 0;
    if (before.lives) {
        before.hash = before.steps ? world_hash_unordered(world) : world_hash(world);
        before.count = world_count(world);
        OK(pbmpm_world_generation(world, &before.generation));
    }
    book.fail_at = fail_at;
}

/* A step may have stored particles in another order. */
static void expect_as_before(const life_plan *plan, pbmpm_world_id world)
{
    uint64_t generation;
    if (!before.lives) return;
    const bool has_parts = plan->sleeping || (plan->solver == PBMPM_SOLVER_CONVERGENT && !plan->together);
    done_in_part = before.steps && has_parts && world_hash_unordered(world) != before.hash;
    if (done_in_part) return;
    TEST_ASSERT_EQUAL_HEX64_MESSAGE(before.hash, before.steps ? world_hash_unordered(world) : world_hash(world), before.where);
    TEST_ASSERT_EQUAL_UINT32_MESSAGE(before.count, world_count(world), before.where);
    if (before.steps) return;
    OK(pbmpm_world_generation(world, &generation));
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(before.generation, generation, before.where);
}

static life_turn judge(pbmpm_result result, pbmpm_world_id world, void *user)
{
    if (before.behind && result == PBMPM_OK) return LIFE_GOES_ON;
    if (before.steps) book.wrong_threads = 0; /* the step's own */
    if (book.failures == before.failures) {
        TEST_ASSERT_EQUAL_STRING_MESSAGE("PBMPM_OK", pbmpm_result_name(result), before.where);
        return LIFE_GOES_ON;
    }
    TEST_ASSERT_EQUAL_STRING_MESSAGE("PBMPM_ERROR_OUT_OF_MEMORY", pbmpm_result_name(result), before.where);
    expect_as_before(user, world);
    memcpy(refusal, before.where, sizeof refusal);
    before.failures = book.failures;
    return book.sticky ? LIFE_ENDS : LIFE_TRIES_AGAIN;
}

/* One life in which the allocation number `place` is refused (0: none); returns whether it came to its end. */
static bool live_with(const life_plan *plan, uint64_t place, bool sticky, life *it)
{
    const life_watch watch = {look, judge, (void *)(uintptr_t)plan};
    book = (ledger){.fail_at = place, .sticky = sticky};
    done_in_part = false;
    snprintf(refusal, sizeof refusal, "%s, nothing refused", plan->name);
    it->world = it->twin = (pbmpm_world_id){0, 0};
    const bool ended = live(plan, ledger_allocator(&book), &watch, it);
    if (it->world.generation) OK(pbmpm_world_destroy(it->world));
    if (it->twin.generation) OK(pbmpm_world_destroy(it->twin));
    ledger_expect_clean(&book, refusal);
    return ended;
}

/* Returns false when a life asks for less memory than that. */
static bool check_refusal(const life_plan *plan, uint64_t place, bool sticky, const life *right)
{
    static life it;
    const bool ended = live_with(plan, place, sticky, &it);
    if (book.failures == 0) return false;
    faults++;
    TEST_ASSERT_EQUAL_INT_MESSAGE(!sticky, ended, refusal);
    if (sticky) return true;
    if (done_in_part || (plan->sleeping && is_of(refusal, "step"))) return true; /* what was to fall asleep may be closer to it */
    TEST_ASSERT_EQUAL_HEX64_MESSAGE(right->hash, it.hash, refusal);
    TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&right->flow, &it.flow, sizeof it.flow, refusal);
    return true;
}

/* The first allocations that are refused differ from plan to plan. */
static void check_plan(const life_plan *plan, uint64_t number)
{
    static life right;
    TEST_ASSERT_TRUE(live_with(plan, 0, false, &right));
    const uint64_t asked = book.calls, stride = all ? 1 : SHORT;
    TEST_ASSERT_TRUE_MESSAGE(asked > 100, plan->name);
    for (uint64_t sticky = 0; sticky < 2; sticky++)
        for (uint64_t place = 1 + (7 * number + 3 * sticky) % stride; place <= asked; place += stride)
            TEST_ASSERT_TRUE_MESSAGE(check_refusal(plan, place, sticky, &right), refusal);
    TEST_ASSERT_FALSE_MESSAGE(check_refusal(plan, asked + 1, false, &right), refusal);
}

static void test_any_allocation_may_be_refused(void)
{
    for (size_t i = 0; i < sizeof plans / sizeof *plans; i++) {
        life_plan plan = plans[i];
        if (!all) check_plan(&plan, i);
        for (plan.dimension = 2; plan.dimension <= 3 && all; plan.dimension++)
            for (plan.thread_count = 1; plan.thread_count <= 3; plan.thread_count += 2) check_plan(&plan, i);
    }
    printf("%u allocations refused\n", (unsigned)faults);
    TEST_ASSERT_TRUE(faults >= (all ? 20000 : 300));
}

int main(int count, char **arguments)
{
    support_skip_without_isa();
    all = count > 1 && strcmp(arguments[1], "all") == 0;
    UNITY_BEGIN();
    RUN_TEST(test_a_life_calls_every_function);
    RUN_TEST(test_any_allocation_may_be_refused);
    return UNITY_END();
}

/* Assertions inside of the library. */
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include <unity.h>

#include "base/assertion.h"
#include "base/memory.h"

void setUp(void)
{
}

void tearDown(void)
{
    assertion_set_callback(NULL, NULL);
}

typedef struct Told {
    char condition[80], file[200];
    int32_t line;
    int times, ends;
} Told;

static int32_t note(const char *condition, const char *file, int32_t line, void *user)
{
    Told *told = user;
    strncpy(told->condition, condition, sizeof told->condition - 1);
    strncpy(told->file, file, sizeof told->file - 1);
    told->line = line;
    told->times++;
    return told->ends;
}

static void test_the_host_is_told_and_may_go_on(void)
{
    Told told = {.times = 0};
    assertion_set_callback(note, &told);
    assertion_failed("a < b", "src/some.c", 17);
    TEST_ASSERT_EQUAL_INT(1, told.times);
    TEST_ASSERT_EQUAL_STRING("a < b", told.condition);
    TEST_ASSERT_EQUAL_STRING("src/some.c", told.file);
    TEST_ASSERT_EQUAL_INT32(17, told.line);
}

/* How a child that fails a check ends. */
static int signal_of(Told *told)
{
    int status = 0;
    const pid_t child = fork();
    if (child == 0) {
        close(STDERR_FILENO);
        if (told) assertion_set_callback(note, told);
        assertion_failed("a < b", "src/some.c", 17);
        _exit(0);
    }
    TEST_ASSERT_EQUAL_INT(child, waitpid(child, &status, 0));
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

static void test_the_process_ends_unless_the_host_says_no(void)
{
    Told ends = {.ends = 1}, goes_on = {.ends = 0};
    TEST_ASSERT_EQUAL_INT(6, signal_of(NULL)); /* SIGABRT */
    TEST_ASSERT_EQUAL_INT(6, signal_of(&ends));
    TEST_ASSERT_EQUAL_INT(0, signal_of(&goes_on));
}

/* In builds with assertions a broken invariant is seen, with its place in the sources. */
static void test_more_memory_is_given_back_than_was_taken(void)
{
    Told told = {.times = 0};
    Memory memory;
    memory_init(&memory, NULL, 0);
    assertion_set_callback(note, &told);
    void *block = memory_take(&memory, 64);
    memory.used = 32;
    memory_give(&memory, block, 64);
    TEST_ASSERT_EQUAL_INT(ASSERTS, told.times);
    TEST_ASSERT_EQUAL_STRING(ASSERTS ? "memory->used >= size" : "", told.condition);
    TEST_ASSERT_TRUE(!ASSERTS || strstr(told.file, "memory.c"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_host_is_told_and_may_go_on);
    RUN_TEST(test_the_process_ends_unless_the_host_says_no);
    RUN_TEST(test_more_memory_is_given_back_than_was_taken);
    return UNITY_END();
}

/* Which kernels the CPU gets, against what Linux says of it. */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "base/cpu.h"
#include "grid/kernels.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static char flags[8192]; /* of the first core, with blanks around each */

static bool has(const char *flag)
{
    char word[32];
    snprintf(word, sizeof word, " %s ", flag);
    return strstr(flags, word) != NULL;
}

static bool read_flags(void)
{
    FILE *file = fopen("/proc/cpuinfo", "r");
    bool found = false;
    while (file && !found && fgets(flags, sizeof flags - 1, file)) found = strncmp(flags, "flags", 5) == 0;
    if (file) fclose(file);
    char *end = strchr(flags, '\n');
    if (end) *end = ' ';
    return found;
}

static pbmpm_isa best(void)
{
    static const char *const avx512[] = {"avx512f", "avx512dq", "avx512cd", "avx512bw", "avx512vl"};
    if (!has("sse4_2")) return PBMPM_ISA_NONE;
    if (!has("avx2") || !has("fma")) return PBMPM_ISA_SSE4;
    for (size_t i = 0; i < sizeof avx512 / sizeof *avx512; i++)
        if (!has(avx512[i])) return PBMPM_ISA_AVX2;
    return PBMPM_ISA_AVX512;
}

static void test_the_best_kernels_are_chosen(void)
{
#if defined(__aarch64__)
    TEST_ASSERT_EQUAL_INT(PBMPM_ISA_NEON, cpu_isa());
    return;
#endif
    if (!read_flags()) TEST_IGNORE_MESSAGE("this system does not tell what its CPU can do");
#if !defined(_WIN32)
    unsetenv("PBMPM_ISA"); /* asked once: before any other call of it here */
    TEST_ASSERT_EQUAL_INT(best(), cpu_isa());
    setenv("PBMPM_ISA", "sse4", 1);
#endif
    TEST_ASSERT_EQUAL_INT(best(), cpu_isa());
}

/* Lanes are what statistics count with: as many as the kernels work on at once. */
static void test_kernels_know_their_lanes(void)
{
    for (int dimension = 2; dimension <= 3; dimension++)
#if defined(__aarch64__)
        TEST_ASSERT_EQUAL_INT(4, kernels_for(PBMPM_ISA_NEON, dimension)->lanes);
#else
        for (pbmpm_isa isa = PBMPM_ISA_SSE4; isa <= PBMPM_ISA_AVX512; isa++)
            TEST_ASSERT_EQUAL_INT(isa == PBMPM_ISA_SSE4 ? 4 : 8, kernels_for(isa, dimension)->lanes);
#endif
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_best_kernels_are_chosen);
    RUN_TEST(test_kernels_know_their_lanes);
    return UNITY_END();
}

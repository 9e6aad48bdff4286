#include "base/assertion.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/cpu.h"

static pbmpm_assert_callback *assert_callback;
static void *assert_user;

void assertion_set_callback(pbmpm_assert_callback *callback, void *user)
{
    assert_callback = callback;
    assert_user = user;
}

static bool host_goes_on(const char *condition, const char *file, int32_t line)
{
    if (!assert_callback) {
        fprintf(stderr, "pbmpm: %s:%d: does not hold: %s\n", file, (int)line, condition);
        return false;
    }
    const uint32_t mode = float_mode_lend();
    const int32_t ends = assert_callback(condition, file, line, assert_user);
    float_mode_take_back(mode);
    return ends == 0;
}

void assertion_failed(const char *condition, const char *file, int32_t line)
{
    if (!host_goes_on(condition, file, line)) abort();
}

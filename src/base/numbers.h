/* Checks of numbers that come from the caller. A NaN is in no range. */
#ifndef PBMPM_SRC_BASE_NUMBERS_H
#define PBMPM_SRC_BASE_NUMBERS_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The limits are rounded to floats, as the values were: 0.01f is in [0.01, 100]. */
static inline bool in_range(double value, double low, double high)
{
    return value >= (double)(float)low && value <= (double)(float)high;
}

static inline bool all_in_range(const float *values, size_t count, double low, double high)
{
    for (size_t i = 0; i < count; i++)
        if (!in_range(values[i], low, high)) return false;
    return true;
}

/* Whether an enumeration has the value. Callers may pass any 32 bits, and compilers differ in whether enumerations have a sign. */
static inline bool in_enum(int64_t value, int64_t first, int64_t last) { return value >= first && value <= last; }

static inline bool all_finite(const float *values, size_t count) { return all_in_range(values, count, -3.4028235e38, 3.4028235e38); }

#endif

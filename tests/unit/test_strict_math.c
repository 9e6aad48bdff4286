/* The functions that a strict build has in place of the C library's, against those. */
#include "../../src/base/strict_math.c"
#undef exp
#undef expm1
#undef log
#undef log1p
#undef pow
#undef sin
#undef cos
#include <unity.h>

void setUp(void)
{
}

void tearDown(void)
{
}

typedef double function(double x);

enum { PLACES = 20000 };

/* `relative`: the error is taken over the value. */
static void compare(function *own, function *right, double low, double high, double most, int relative)
{
    for (int i = 0; i <= PLACES; i++) {
        const double x = low + (high - low) * i / PLACES, value = right(x);
        TEST_ASSERT_DOUBLE_WITHIN(relative ? most * fabs(value) : most, value, own(x));
    }
}

static void test_they_agree_with_the_C_library(void)
{
    compare(strict_exp, exp, -1, 1, 1e-15, 1);
    compare(strict_exp, exp, -700, 709.7, 1e-15, 1);
    compare(strict_expm1, expm1, -2, 2, 1e-15, 1);
    compare(strict_expm1, expm1, -1e-6, 1e-6, 1e-15, 1);
    compare(strict_log, log, 1e-3, 4, 1e-15, 1);
    compare(strict_log, log, 1, 1.7e308, 1e-15, 1);
    compare(strict_log1p, log1p, -0.99, 1, 1e-15, 1);
    compare(strict_log1p, log1p, -1e-7, 1e-7, 1e-15, 1);
    compare(strict_sin, sin, -10, 10, 1e-15, 0);
    compare(strict_cos, cos, -10, 10, 1e-15, 0);
    compare(strict_sin, sin, -1e5, 1e5, 1e-15, 0);
    compare(strict_cos, cos, -1e5, 1e5, 1e-15, 0);
}

static void test_powers_agree_with_the_C_library(void)
{
    for (int i = 1; i <= 200; i++)
        for (int j = -60; j <= 60; j++) {
            const double x = 0.003 * i * i, y = 0.1 * j;
            TEST_ASSERT_DOUBLE_WITHIN(1e-14 * pow(x, y), pow(x, y), strict_pow(x, y));
        }
}

static void test_their_limits(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(1.0, strict_exp(0.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, strict_exp(-1e9));
    TEST_ASSERT_EQUAL_DOUBLE(INFINITY, strict_exp(1e9));
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, strict_expm1(-INFINITY)); /* as what a grab takes where it takes all */
    TEST_ASSERT_EQUAL_DOUBLE(-INFINITY, strict_log1p(-1.0));
    TEST_ASSERT_EQUAL_DOUBLE(-INFINITY, strict_log(0.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.015625, strict_pow(0.25, 3.0));
    TEST_ASSERT_EQUAL_DOUBLE(4.0, strict_pow(0.5, -2.0));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, strict_pow(0.0, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, strict_pow(0.0, 0.4));
    TEST_ASSERT_DOUBLE_IS_NAN(strict_exp(NAN));
    TEST_ASSERT_DOUBLE_IS_NAN(strict_log(-1.0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_they_agree_with_the_C_library);
    RUN_TEST(test_powers_agree_with_the_C_library);
    RUN_TEST(test_their_limits);
    return UNITY_END();
}

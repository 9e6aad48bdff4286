#include "base/strict_math.h"

#include <stdint.h>
#include <string.h>

static const double LN2_HIGH = 0x1.62e42feep-1, LN2_LOW = 0x1.a39ef35793c76p-33; /* k times the first is exact */
static const double HALF_PI_HIGH = 0x1.921fb544p+0, HALF_PI_MIDDLE = 0x1.0b4611a6p-34, HALF_PI_LOW = 0x1.3198a2e037073p-69;

static double power_of_two(int exponent) /* in [-1022, 1023] */
{
    const uint64_t bits = (uint64_t)(exponent + 1023) << 52;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* sum of x^n / n! from n = first on, over x^first / first!, 20 terms; |x| < 0.8. */
static double tail_of_exp(double x, int first)
{
    double sum = 1.0;
    for (int n = first + 20; n > first; n--) sum = 1.0 + x / n * sum;
    return sum;
}

double strict_exp(double x)
{
    if (!(x < 709.0)) return x < 710.0 ? strict_exp(x - 1.0) * 2.718281828459045 : x != x ? x : INFINITY;
    if (x < -708.0) return 0.0; /* the least that is not denormal, which counts as 0 */
    const double count = floor(x / 0.6931471805599453 + 0.5);
    return tail_of_exp((x - count * LN2_HIGH) - count * LN2_LOW, 0) * power_of_two((int)count);
}

double strict_expm1(double x) { return fabs(x) < 0.5 ? x * tail_of_exp(x, 1) : strict_exp(x) - 1.0; }

/* ln((1 + z) / (1 - z)), |z| < 0.18. */
static double log_of_ratio(double z)
{
    const double z2 = z * z;
    double sum = 0.0;
    for (int n = 25; n > 1; n -= 2) sum = (sum + 1.0 / n) * z2;
    return 2.0 * z * (1.0 + sum);
}

double strict_log(double x)
{
    if (!(x > 0.0)) return x == 0.0 ? -INFINITY : NAN;
    if (x > 0x1p1000) return x < INFINITY ? strict_log(0x1p-100 * x) + 69.31471805599453 : x;
    if (x < 0x1p-1022) return -INFINITY; /* denormal */
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    int exponent = (int)(bits >> 52) - 1023;
    double part = x * power_of_two(-exponent); /* in [1, 2) */
    if (part > 1.4142135623730951) {
        part *= 0.5;
        exponent++;
    }
    const double rest = log_of_ratio((part - 1.0) / (part + 1.0));
    return exponent * LN2_HIGH + (rest + exponent * LN2_LOW);
}

double strict_log1p(double x) { return fabs(x) < 0.25 ? log_of_ratio(x / (2.0 + x)) : strict_log(1.0 + x); }

double strict_pow(double x, double y)
{
    if (y == floor(y) && fabs(y) <= 64.0) { /* whole numbers as products, so that powers of two stay exact */
        double product = 1.0;
        for (int n = (int)fabs(y); n > 0; n--) product *= x;
        return y < 0.0 ? 1.0 / product : product;
    }
    if (y == 0.5) return sqrt(x);
    if (x == 0.0) return y > 0.0 ? 0.0 : INFINITY;
    return strict_exp(y * strict_log(x));
}

/* The quarter of a turn that x is in, from -pi/4 on, and what is beyond. */
static int quarter(double x, double *rest)
{
    const double count = floor(x / 1.5707963267948966 + 0.5);
    *rest = ((x - count * HALF_PI_HIGH) - count * HALF_PI_MIDDLE) - count * HALF_PI_LOW;
    return (int)fmod(count, 4.0) & 3;
}

/* Taylor's sum from x^first / first! on by every second term, with changing signs. */
static double wave(double x, int first)
{
    double sum = 1.0;
    for (int n = first + 20; n > first; n -= 2) sum = 1.0 - x * x / (n * (n - 1)) * sum;
    return first == 0 ? sum : x * sum;
}

static double turned(double x, int ahead)
{
    double rest;
    if (!(fabs(x) < 1e9)) return NAN;
    const int side = (quarter(x, &rest) + ahead) & 3;
    const double value = wave(rest, side & 1 ? 0 : 1);
    return side & 2 ? -value : value;
}

double strict_sin(double x) { return turned(x, 0); }
double strict_cos(double x) { return turned(x, 1); }

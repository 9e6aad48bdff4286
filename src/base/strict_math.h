/* Functions in place of the C library's, for a strict build alone: there every file of the library includes this first.
 *
 * The C library chooses among several forms of these by what the CPU can do, and they differ in the last bit. What it rounds exactly stays: roots, floor,
 * fmod and the like. */
#ifndef PBMPM_SRC_BASE_STRICT_MATH_H
#define PBMPM_SRC_BASE_STRICT_MATH_H

#include <math.h>

/* Within 1e-14 of the value, relative; sine and cosine within 1e-15 of it for arguments up to 1e5. */
double strict_exp(double x);
double strict_expm1(double x);
double strict_log(double x);
double strict_log1p(double x);
double strict_pow(double x, double y);
double strict_sin(double x);
double strict_cos(double x);

#define exp(x) strict_exp(x)
#define expm1(x) strict_expm1(x)
#define log(x) strict_log(x)
#define log1p(x) strict_log1p(x)
#define pow(x, y) strict_pow(x, y)
#define sin(x) strict_sin(x)
#define cos(x) strict_cos(x)

#endif

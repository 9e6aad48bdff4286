/* Comparisons with a bound that is known beforehand. The largest share of its bound that any comparison used up is kept, so
 * that a report can say how sharp the bounds are. */
#ifndef PBMPM_TESTS_CHECK_H
#define PBMPM_TESTS_CHECK_H

#include <stdbool.h>

#include "pbmpm/base.h"

/* What is being tested, named in failures. */
void check_subject(const char *subject, pbmpm_isa isa, int dimension);

/* Fails unless |actual - expected| <= bound; a NaN fails. `what` and `index` name the value. */
void check_near(double expected, double actual, double bound, const char *what, long index);
void check_true(bool condition, const char *what, long index);

/* Prints and forgets the largest share. */
void check_report(const char *label);

#endif

#include "check.h"

#include <math.h>
#include <stdio.h>
#include <unity.h>

#include "base/cpu.h"

static char subject_text[128] = "", message[512];
static double worst_share;

void check_subject(const char *subject, pbmpm_isa isa, int dimension)
{
    snprintf(subject_text, sizeof subject_text, "%s, %s, %dD", subject, cpu_isa_name(isa), dimension);
}

void check_near(double expected, double actual, double bound, const char *what, long index)
{
    const double error = fabs(actual - expected);
    if (!(error <= bound)) {
        snprintf(message, sizeof message, "%s: %s [%ld] is %.9g, expected %.9g; error %.3g, bound %.3g", subject_text, what, index,
                 actual, expected, error, bound);
        TEST_FAIL_MESSAGE(message);
    }
    if (error > 0.0) worst_share = fmax(worst_share, error / bound);
}

void check_true(bool condition, const char *what, long index)
{
    if (condition) return;
    snprintf(message, sizeof message, "%s: %s [%ld]", subject_text, what, index);
    TEST_FAIL_MESSAGE(message);
}

void check_report(const char *label)
{
    printf("%s: largest error / bound %.3g\n", label, worst_share);
    worst_share = 0.0;
}

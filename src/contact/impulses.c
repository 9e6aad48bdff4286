#include "contact/impulses.h"

#include <string.h>

#include "base/result.h"

pbmpm_result impulses_enable(Impulses *impulses, Memory *memory)
{
    if (!impulses->sum) impulses->sum = memory_take(memory, IMPULSE_PLACES * sizeof *impulses->sum);
    return impulses->sum ? PBMPM_OK : fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for impulses");
}

void impulses_free(Impulses *impulses, Memory *memory)
{
    memory_give(memory, impulses->sum, IMPULSE_PLACES * sizeof *impulses->sum);
    array_free(memory, &impulses->contact);
    array_free(memory, &impulses->notes);
    *impulses = (Impulses){0};
}

void impulses_clear(Impulses *impulses)
{
    if (impulses->sum) memset(impulses->sum, 0, IMPULSE_PLACES * sizeof *impulses->sum);
}

static void subtract_moment(double angular[3], const double arm[3], const double momentum[3])
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        angular[a] -= arm[b] * momentum[c] - arm[c] * momentum[b];
    }
}

void impulse_add(ImpulseSum *sum, const double point[3], const double gained[3])
{
    for (int a = 0; a < 3; a++) sum->linear[a] -= gained[a];
    subtract_moment(sum->angular, point, gained);
}

void impulses_shift(Impulses *impulses, const double way[3])
{
    for (int place = 0; place < IMPULSE_PLACES && impulses->sum; place++) subtract_moment(impulses->sum[place].angular, way, impulses->sum[place].linear);
}

pbmpm_impulse impulse_about(const ImpulseSum *sum, const double point[3], int dimension)
{
    pbmpm_impulse impulse = {.size = sizeof impulse};
    memcpy(impulse.linear, sum->linear, sizeof impulse.linear);
    memcpy(impulse.angular, sum->angular, sizeof impulse.angular);
    subtract_moment(impulse.angular, point, sum->linear);
    for (int a = 0; a < 2 && dimension == 2; a++) impulse.angular[a] = 0.0;
    return impulse;
}

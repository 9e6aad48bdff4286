#include "random.h"

static uint64_t next(Random *random)
{
    uint64_t z = random->state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

uint32_t random_below(Random *random, uint32_t limit) { return (uint32_t)((next(random) >> 32) * limit >> 32); }

double random_in(Random *random, double low, double high)
{
    return low + (high - low) * (double)(next(random) >> 11) / 9007199254740992.0;
}

void random_array(Random *random, double *values, int count, double low, double high)
{
    for (int i = 0; i < count; i++) values[i] = random_in(random, low, high);
}

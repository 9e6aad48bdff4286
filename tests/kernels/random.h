/* A repeatable stream of random numbers (splitmix64). */
#ifndef PBMPM_TESTS_RANDOM_H
#define PBMPM_TESTS_RANDOM_H

#include <stdint.h>

typedef struct Random {
    uint64_t state;
} Random;

uint32_t random_below(Random *random, uint32_t limit);
double random_in(Random *random, double low, double high);
void random_array(Random *random, double *values, int count, double low, double high);

#endif

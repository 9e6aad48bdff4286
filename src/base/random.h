/* Repeatable numbers: for the same seed the same on every machine. */
#ifndef PBMPM_SRC_BASE_RANDOM_H
#define PBMPM_SRC_BASE_RANDOM_H

#include <stdint.h>

/* A number in [-1/2, 1/2) from a counter: the finaliser of SplitMix64 (G. Steele, D. Lea, C. Flood, OOPSLA 2014). */
static inline double random_number(uint64_t seed, uint64_t counter)
{
    uint64_t x = (seed << 32 ^ counter) + 0x9e3779b97f4a7c15u;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return (double)((x ^ x >> 31) >> 11) * 0x1p-53 - 0.5;
}

#endif

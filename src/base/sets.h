/* Disjoint sets of numbers: up[i] leads towards the lowest number of the set that i is in. */
#ifndef PBMPM_SRC_BASE_SETS_H
#define PBMPM_SRC_BASE_SETS_H

#include <stdint.h>

/* Paths are halved on the way. */
static inline int32_t sets_root(int32_t *up, int32_t i)
{
    while (up[i] != i) {
        up[i] = up[up[i]];
        i = up[i];
    }
    return i;
}

static inline void sets_join(int32_t *up, int32_t a, int32_t b)
{
    const int32_t root_a = sets_root(up, a), root_b = sets_root(up, b);
    if (root_a < root_b)
        up[root_b] = root_a;
    else
        up[root_a] = root_b;
}

#endif

#include "grid/bodies.h"

#include "base/sets.h"

/* A root is the lowest of its set, so it has its number before the others ask for it. */
static int32_t number_sets(int32_t *up, int32_t blocks)
{
    int32_t count = 0;
    for (int32_t b = 0; b < blocks; b++) up[b] = sets_root(up, b);
    for (int32_t b = 0; b < blocks; b++) up[b] = up[b] == b ? -1 - count++ : up[b];
    for (int32_t b = 0; b < blocks; b++)
        if (up[b] >= 0) up[b] = up[up[b]]; /* a root's number, as -1 - number */
    for (int32_t b = 0; b < blocks; b++) up[b] = -1 - up[b];
    return count;
}

bool bodies_find(Bodies *bodies, Memory *memory, const Grid *grid)
{
    if (!array_reserve(memory, &bodies->of_block, (size_t)grid->node_blocks, sizeof(int32_t))) return false;
    int32_t *up = bodies->of_block.data;
    for (int32_t b = 0; b < grid->node_blocks; b++) up[b] = b;
    for (int32_t b = 0; b < grid->particle_blocks; b++) {
        const int32_t *neighbour = (const int32_t *)grid->neighbour.data + (size_t)b * (size_t)grid->neighbours;
        for (int n = 0; n < grid->neighbours; n++)
            if (neighbour[n] >= 0) sets_join(up, b, neighbour[n]);
    }
    bodies->count = number_sets(up, grid->node_blocks);
    return true;
}

void bodies_free(Bodies *bodies, Memory *memory) { array_free(memory, &bodies->of_block); }

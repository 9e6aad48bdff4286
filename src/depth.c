#include "depth.h"

#include <math.h>

/* How far a block lies along gravity, in blocks times |g|. */
static double block_depth(const World *world, int32_t block)
{
    double along = 0.0;
    for (int a = 0; a < world->def.dimension; a++)
        along += (double)world->settings.gravity[a] * ((const int32_t *)world->grid.coordinate.data)[3 * block + a];
    return along;
}

double depth_along_gravity(const World *world)
{
    enum { BINS = 64, ROUNDS = 4 };
    const uint32_t *begin = world->grid.block_begin.data;
    const double trim = 0.02 * world->particles.count;
    double low = INFINITY, high = -INFINITY;
    for (int32_t block = 0; block < world->grid.particle_blocks; block++) {
        low = fmin(low, block_depth(world, block));
        high = fmax(high, block_depth(world, block));
    }
    for (int round = 0; round < ROUNDS && high > low; round++) {
        double count[BINS] = {0}, below = 0.0;
        const double width = (high - low) / BINS;
        for (int32_t block = 0; block < world->grid.particle_blocks; block++) {
            const double bin = (block_depth(world, block) - low) / width;
            if (bin < 0.0) below += begin[block + 1] - begin[block];
            if (bin >= 0.0 && bin <= BINS) count[bin < BINS ? (int)bin : BINS - 1] += begin[block + 1] - begin[block];
        }
        int first = 0;
        double sum = below;
        while (first < BINS - 1 && sum + count[first] < trim) sum += count[first++];
        int last = first;
        while (last < BINS - 1 && sum + count[last] < world->particles.count - trim) sum += count[last++];
        high = low + (last + 1) * width;
        low = low + first * width;
    }
    return (high - low) * K_BLOCK_AXIS;
}

double matter_depth(const World *world)
{
    double strength = 0.0;
    for (int a = 0; a < world->def.dimension; a++) strength += (double)world->settings.gravity[a] * (double)world->settings.gravity[a];
    if (strength > 0.0) return fmax(1.0, depth_along_gravity(world) / sqrt(strength));
    return pow((double)world->grid.particle_blocks * world->grid.block_cells, 1.0 / world->def.dimension);
}

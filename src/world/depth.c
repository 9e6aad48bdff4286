#include "world/depth.h"

#include <math.h>
#include <string.h>

/* A block with particles, or one that flies: how far it lies along gravity, in blocks times |g|, and how many they are. */
typedef struct Layer {
    double depth;
    uint32_t particles;
} Layer;

static uint32_t liquid_in(const World *world, int32_t block)
{
    const Grid *grid = &world->grid;
    const uint32_t *block_run = grid->block_run.data;
    uint32_t particles = 0;
    for (uint32_t run = block_run[block]; run < block_run[block + 1]; run++)
        if (world->materials.kernel[grid->run_key[run] >> K_RUN_CELL_BITS].kind == K_LIQUID) particles += grid->run_begin[run + 1] - grid->run_begin[run];
    return particles;
}

static int32_t layers_awake(const World *world) { return world->grid.particle_blocks + (int32_t)(world->grid.end_row - world->grid.flight_row); }

/* Those that fly follow the blocks of the grid, and blocks that are asleep them. */
static Layer layer_of(const World *world, int32_t i, bool liquid)
{
    const Grid *grid = &world->grid;
    int32_t corner[3], place[3];
    Layer layer = {.depth = 0.0};
    if (i < grid->particle_blocks) {
        const uint32_t *begin = grid->block_begin.data;
        memcpy(place, (const int32_t *)grid->coordinate.data + 3 * i, sizeof place);
        layer.particles = liquid ? liquid_in(world, i) : begin[i + 1] - begin[i];
    } else if (i < layers_awake(world)) {
        const uint32_t row = grid->flight_row + (uint32_t)(i - grid->particle_blocks);
        for (int a = 0; a < grid->dimension; a++) place[a] = (world->particles.cell[a][row] - grid->anchor[a]) / K_BLOCK_AXIS;
        layer.particles = !liquid || world->materials.kernel[world->particles.material[row]].kind == K_LIQUID;
    } else {
        const SleepBlock *block = sleep_list_block(&world->sleep.asleep, (uint32_t)(i - layers_awake(world)));
        sleep_place(&world->sleep, grid->anchor, grid->dimension, corner);
        for (int a = 0; a < 3; a++) place[a] = block->place[a] - corner[a];
        layer.particles = block->rows;
    }
    for (int a = 0; a < grid->dimension; a++) layer.depth += (double)world->settings.gravity[a] * place[a];
    return layer;
}

/* Of so many particles in the first `layers`; liquid: in those of liquids alone. */
static double depth_of(const World *world, int32_t layers, double particles, bool liquid)
{
    enum { BINS = 64, ROUNDS = 4 }; /* each round looks closer at where the ends lie: far below a block, however far a lone drop flew */
    static const double TRIMMED = 0.02; /* share of the particles at each end, which may be spray; by trial */
    const double trim = TRIMMED * particles;
    double low = INFINITY, high = -INFINITY;
    for (int32_t i = 0; i < layers; i++) {
        const Layer layer = layer_of(world, i, liquid);
        if (layer.particles == 0) continue;
        low = fmin(low, layer.depth);
        high = fmax(high, layer.depth);
    }
    for (int round = 0; round < ROUNDS && high > low; round++) {
        double count[BINS] = {0}, below = 0.0;
        const double width = (high - low) / BINS;
        for (int32_t i = 0; i < layers; i++) {
            const Layer layer = layer_of(world, i, liquid);
            const double bin = (layer.depth - low) / width;
            if (bin < 0.0) below += layer.particles;
            if (bin >= 0.0 && bin <= BINS) count[bin < BINS ? (int)bin : BINS - 1] += layer.particles;
        }
        int first = 0;
        double sum = below;
        while (first < BINS - 1 && sum + count[first] < trim) sum += count[first++];
        int last = first;
        while (last < BINS - 1 && sum + count[last] < particles - trim) sum += count[last++];
        high = low + (last + 1) * width;
        low = low + first * width;
    }
    return (high - low) * K_BLOCK_AXIS;
}

double depth_along_gravity(const World *world, bool asleep_too)
{
    const int32_t layers = layers_awake(world) + (asleep_too ? (int32_t)world->sleep.asleep.count : 0);
    return depth_of(world, layers, world->grid.end_row - (asleep_too ? 0 : world->grid.first_row), false);
}

double gravity_strength(const World *world)
{
    double square = 0.0;
    for (int a = 0; a < world->def.dimension; a++) square += (double)world->settings.gravity[a] * (double)world->settings.gravity[a];
    return sqrt(square);
}

double gravity_direction(const World *world, double down[3])
{
    const double strength = gravity_strength(world);
    for (int a = 0; a < 3; a++) down[a] = a < world->def.dimension && strength > 0.0 ? (double)world->settings.gravity[a] / strength : 0.0;
    return strength;
}

double gravity_fall(const World *world, const Substep *substep)
{
    return gravity_strength(world) * substep->dt * substep->dt / (double)world->def.cell_size;
}

double matter_depth(const World *world)
{
    const double strength = gravity_strength(world);
    if (strength > 0.0) return fmax(1.0, depth_along_gravity(world, false) / strength);
    return pow((double)(world->grid.particle_blocks + world->grid.left_blocks) * world->grid.block_cells, 1.0 / world->def.dimension);
}

double liquid_depth(const World *world)
{
    const double strength = gravity_strength(world);
    uint32_t particles = 0;
    for (int32_t block = 0; block < grid_row_blocks(&world->grid); block++) particles += liquid_in(world, block);
    return strength > 0.0 && particles > 0 ? fmax(1.0, depth_of(world, layers_awake(world), particles, true) / strength) : 1.0;
}

double slowest_pressure(const World *world) { return 3.14159265358979 / (4.0 * matter_depth(world)); }

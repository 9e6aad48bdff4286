#include "solvers/dual/granular_bound.h"

#include <math.h>

#include "solvers/dual/dual_gains.h"
#include "solvers/passes.h"

enum { BLOCK_GRAIN = 8 };

/* Of sums of energies in single precision. */
static const double ROUNDING = 5e-7;

/* Of a body. */
typedef struct BodyBound {
    double growth; /* what it may gain */
    float kept;    /* the share of its stresses that is left */
} BodyBound;

bool granular_bound_prepare(World *world)
{
    return array_reserve(&world->memory, &world->dual.bounds, (size_t)world->grid.node_blocks, sizeof(BodyBound)) &&
           array_reserve(&world->memory, &world->dual.growth, (size_t)world->grid.particle_blocks, sizeof(double));
}

void granular_bound_free(World *world)
{
    array_free(&world->memory, &world->dual.bounds);
    array_free(&world->memory, &world->dual.growth);
}

/* ---- What growth may gain ---- */

static double grain_growth(const World *world, uint32_t row)
{
    const KernelArgs *a = &world->args;
    const int d = world->particles.dimension;
    const double asked = fmin(1.0 / fmax((double)world->particles.volume_ratio[row], (double)K_LIQUID_RATIO_MIN) - 1.0, (double)a->dual.growth_max);
    const int place[3] = {0, d == 2 ? 2 : 3, 5};
    double trace = 0.0;
    for (int c = 0; c < d; c++) trace += (double)a->dual.stress[place[c]][row];
    return fmax(0.0, trace) * (double)a->cells.settle * fmax(0.0, asked);
}

static double liquid_growth(const World *world, uint32_t row, const KernelMaterial *material)
{
    const KernelArgs *a = &world->args;
    const double inverse = 1.0 / fmax((double)world->particles.volume_ratio[row], (double)K_LIQUID_RATIO_MIN), pressure = (double)a->dual.pressure[row];
    const double asked = fmin(inverse - 1.0 - pressure * (double)material->inverse_stiffness * inverse * inverse, (double)a->dual.growth_max);
    return world->particles.dimension * pressure * fmax(0.0, asked);
}

static double growth_in(const World *world, int32_t block)
{
    const Grid *grid = &world->grid;
    const uint32_t *block_run = grid->block_run.data;
    double sum = 0.0;
    for (uint32_t run = block_run[block]; run < block_run[block + 1]; run++) {
        const KernelMaterial *material = &world->materials.kernel[grid->run_key[run] >> K_RUN_CELL_BITS];
        for (uint32_t row = grid->run_begin[run]; row < grid->run_begin[run + 1]; row++) {
            const double mass = 0.25 * (double)world->particles.mass[row];
            if (material->yields == K_SAND) sum += mass * grain_growth(world, row);
            else if (material->kind == K_LIQUID) sum += mass * liquid_growth(world, row, material);
        }
    }
    return sum;
}

static bool gains(const DualGain *gain, double growth) { return gain->gain > growth + ROUNDING * (fabs(gain->work) + gain->brought + gain->kinetic); }

static void sum_growth(void *context, int32_t begin, int32_t end)
{
    World *world = context;
    double *growth = world->dual.growth.data;
    for (int32_t block = begin; block < end; block++) growth[block] = gains(dual_gain_in(world, block), 0.0) ? growth_in(world, block) : 0.0;
}

/* ---- What is kept ---- */

/* See the header. */
static double kept_of(const DualGain *gain, double growth)
{
    const double a = 0.5 * gain->own, g = gain->weighed, b = gain->gain - a + g - growth;
    return a > 0.0 ? fmin(1.0, fmax(0.0, (sqrt(b * b + 4.0 * a * g) - b) / (2.0 * a))) : 1.0;
}

static void scale(float *value, size_t count, float kept)
{
    for (size_t i = 0; i < count; i++) value[i] *= kept;
}

static void scale_blocks(void *context, int32_t begin, int32_t end)
{
    World *world = context;
    const Grid *grid = &world->grid;
    const size_t tile = (size_t)grid->tile_nodes * K_NODE_WIDTH + K_TILE_PAD;
    const uint32_t *block_begin = grid->block_begin.data;
    const int32_t *of_block = world->dual.gains.bodies.of_block.data;
    for (int32_t block = begin; block < end; block++) {
        const float kept = ((const BodyBound *)world->dual.bounds.data)[of_block[block]].kept;
        const size_t first = block_begin[block], count = block_begin[block + 1] - first;
        if (kept == 1.0f) continue;
        scale((float *)grid->tile.data + (size_t)block * tile, tile, kept);
        scale(world->args.dual.pressure + first, count, kept);
        for (int i = 0; i < 6 && world->args.dual.stress[i]; i++) scale(world->args.dual.stress[i] + first, count, kept);
    }
}

/* How many bodies gain. */
static int find_kept(World *world, bool last)
{
    const int32_t *of_block = world->dual.gains.bodies.of_block.data, count = world->dual.gains.bodies.count;
    const double *growth = world->dual.growth.data;
    BodyBound *bound = world->dual.bounds.data;
    int failed = 0;
    for (int32_t body = 0; body < count; body++) bound[body] = (BodyBound){0.0, 1.0f};
    for (int32_t block = 0; block < world->grid.particle_blocks; block++) bound[of_block[block]].growth += growth[block];
    for (int32_t body = 0; body < count; body++) {
        const DualGain *gain = dual_gain(world, body);
        if (!gains(gain, bound[body].growth)) continue;
        bound[body].kept = last ? 0.0f : (float)kept_of(gain, bound[body].growth);
        failed++;
    }
    return failed;
}

/* Where walls are touched s is not exact, so it is sought again; without any stress nothing gains. */
void granular_bound_keep(World *world, const ContactFrame *contacts)
{
    enum { SEARCHES = 3 };
    world->args.dual.momentum = 0.0f;
    for (int search = 0;; search++) {
        Loops loops;
        dual_gains_find(world);
        pool_for(world->pool, world->grid.particle_blocks, BLOCK_GRAIN, sum_growth, world);
        if (find_kept(world, search == SEARCHES) == 0 || search > SEARCHES) return;
        pool_for(world->pool, world->grid.particle_blocks, BLOCK_GRAIN, scale_blocks, world);
        loops_open(&loops, world->pool);
        solver_add_nodes(&loops, world, world->kernels->push_nodes, &world->args, contacts);
        loops_run(&loops);
    }
}

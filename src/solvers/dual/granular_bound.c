#include "solvers/dual/granular_bound.h"

#include <math.h>
#include <string.h>

#include "solvers/dual/dual_gains.h"
#include "solvers/passes.h"

enum { BLOCK_GRAIN = 8, W = K_NODE_WIDTH };

/* Of a block and of a body, see the header. */
typedef struct Bound {
    double growth; /* what it may gain */
    double answer; /* A */
    double idle;   /* G */
    bool gains;
    float kept; /* the share s of its stresses that is left */
} Bound;

bool granular_bound_prepare(World *world)
{
    const size_t blocks = (size_t)world->grid.node_blocks;
    return array_reserve(&world->memory, &world->dual.bounds, 2 * blocks, sizeof(Bound));
}

void granular_bound_free(World *world)
{
    array_free(&world->memory, &world->dual.bounds);
}

/* Those of blocks stand behind those of bodies, of which there are no more. */
static Bound *of_blocks(const World *world) { return (Bound *)world->dual.bounds.data + world->grid.node_blocks; }

/* ---- What growth may gain ---- */

static double trace_of(const World *world, uint32_t row)
{
    const int d = world->particles.dimension, place[3] = {0, d == 2 ? 2 : 3, 5};
    double trace = 0.0;
    for (int c = 0; c < d; c++) trace += (double)world->args.dual.stress[place[c]][row];
    return trace;
}

/* tr S g of a particle. */
static double growth_of(const World *world, uint32_t row, bool grain)
{
    const KernelArgs *a = &world->args;
    const double missing = 1.0 / fmax((double)world->particles.volume_ratio[row], (double)K_LIQUID_RATIO_MIN) - 1.0;
    const double asked = fmax(0.0, fmin(grain ? (double)a->cells.settle * missing : missing, (double)a->dual.growth_max));
    return asked * (grain ? fmax(0.0, trace_of(world, row)) : world->particles.dimension * (double)a->dual.pressure[row]);
}

static bool stores_energy(const KernelMaterial *material) { return material->kind == K_LIQUID ? material->inverse_stiffness > 0.0f : material->yields != K_SAND; }

static double growth_in(const World *world, int32_t block)
{
    const Grid *grid = &world->grid;
    const uint32_t *block_run = grid->block_run.data;
    double sum = 0.0;
    for (uint32_t run = block_run[block]; run < block_run[block + 1]; run++) {
        const KernelMaterial *material = &world->materials.kernel[grid->run_key[run] >> K_RUN_CELL_BITS];
        if (stores_energy(material)) return INFINITY; /* what it gives back is its own */
        for (uint32_t row = grid->run_begin[run]; row < grid->run_begin[run + 1]; row++)
            sum += 0.25 * (double)world->particles.mass[row] * growth_of(world, row, material->yields == K_SAND);
    }
    return sum;
}

static bool gains(const DualGain *gain, double growth) { return gain->gain > growth + ENERGY_ROUNDING * (fabs(gain->work) + gain->brought + gain->kinetic); }

static void sum_growth(void *context, int32_t begin, int32_t end)
{
    World *world = context;
    Bound *of_block = of_blocks(world);
    for (int32_t block = begin; block < end; block++)
        of_block[block] = (Bound){.growth = block < world->grid.particle_blocks && gains(dual_gain_in(world, block), 0.0) ? growth_in(world, block) : 0.0};
}

/* Adds up blocks. True if a body gains. */
static bool find_gaining(World *world)
{
    const int32_t *body_of = world->grid.body.data, count = world->grid.bodies;
    const Bound *of_block = of_blocks(world);
    Bound *bound = world->dual.bounds.data;
    bool any = false;
    pool_for(world->pool, world->grid.node_blocks, BLOCK_GRAIN, sum_growth, world);
    for (int32_t body = 0; body < count; body++) bound[body] = (Bound){.kept = 1.0f};
    for (int32_t block = 0; block < world->grid.node_blocks; block++) bound[body_of[block]].growth += of_block[block].growth;
    for (int32_t body = 0; body < count; body++) {
        bound[body].gains = gains(dual_gain(world, body), bound[body].growth);
        any = any || bound[body].gains;
    }
    return any;
}

/* ---- What is kept ---- */

/* With nodes at u_0, and those at u_1 in dual.kept. */
static void sum_answers(void *context, int32_t begin, int32_t end)
{
    World *world = context;
    const size_t floats = (size_t)world->grid.block_cells * W;
    Bound *of_block = of_blocks(world);
    for (int32_t block = begin; block < end; block++) {
        const float *u = (const float *)world->grid.node.data + (size_t)block * floats, *before = world->args.grid.node_before + (size_t)block * floats;
        const float *with = (const float *)world->dual.kept.data + (size_t)block * floats;
        for (size_t i = 0; i < floats; i++) {
            const size_t c = i % W;
            const double mass = (double)u[i - c + 3];
            if (c == 3 || mass == 0.0) continue;
            const double answer = (double)with[i] - (double)u[i], away = (double)u[i] - ((double)before[i] - (double)world->args.gravity[c]);
            of_block[block].answer += mass * answer * answer;
            of_block[block].idle += 0.5 * mass * away * away;
        }
    }
}

/* See the header. */
static float kept_of(const DualGain *gain, const Bound *bound)
{
    const double a = 0.5 * bound->answer, g = bound->idle, b = gain->gain - a + g - bound->growth;
    return a > 0.0 ? (float)fmin(1.0, fmax(0.0, (sqrt(b * b + 4.0 * a * g) - b) / (2.0 * a))) : 1.0f;
}

static void find_kept(World *world)
{
    const int32_t *body_of = world->grid.body.data;
    const Bound *of_block = of_blocks(world);
    Bound *bound = world->dual.bounds.data;
    pool_for(world->pool, world->grid.node_blocks, BLOCK_GRAIN, sum_answers, world);
    for (int32_t block = 0; block < world->grid.node_blocks; block++) {
        bound[body_of[block]].answer += of_block[block].answer;
        bound[body_of[block]].idle += of_block[block].idle;
    }
    for (int32_t body = 0; body < world->grid.bodies; body++)
        if (bound[body].gains) bound[body].kept = kept_of(dual_gain(world, body), &bound[body]);
}

static void scale(float *value, size_t count, float kept)
{
    for (size_t i = 0; i < count; i++) value[i] *= kept;
}

static void scale_blocks(void *context, int32_t begin, int32_t end)
{
    World *world = context;
    const Grid *grid = &world->grid;
    const size_t tile = (size_t)grid->tile_nodes * W + K_TILE_PAD;
    const uint32_t *block_begin = grid->block_begin.data;
    const int32_t *body_of = world->grid.body.data;
    for (int32_t block = begin; block < end; block++) {
        const Bound *bound = (const Bound *)world->dual.bounds.data + body_of[block];
        const size_t first = block_begin[block], count = block_begin[block + 1] - first;
        if (!bound->gains) continue;
        scale((float *)grid->tile.data + (size_t)block * tile, tile, bound->kept);
        scale(world->args.dual.pressure + first, count, bound->kept);
        for (int i = 0; i < 6 && world->args.dual.stress[i]; i++) scale(world->args.dual.stress[i] + first, count, bound->kept);
    }
}

/* Moves nodes by the share `pushed` of what stresses push. */
static void push(World *world, const ContactFrame *contacts, float pushed)
{
    Loops loops;
    memset(world->args.dual.node_push, 0, (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells * W * sizeof(float));
    world->args.dual.momentum = pushed - 1.0f; /* the push of before is 0 now: see push_node_blocks() in ispc/dual.isph */
    loops_open(&loops, world->pool);
    solver_add_nodes(&loops, world, world->kernels->push_nodes, &world->args, contacts);
    loops_run(&loops);
    world->args.dual.momentum = 0.0f;
}

void granular_bound_keep(World *world, const ContactFrame *contacts)
{
    dual_gains_find(world);
    if (!find_gaining(world)) return;
    memcpy(world->dual.kept.data, world->grid.node.data, (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells * W * sizeof(float));
    push(world, contacts, 0.0f);
    find_kept(world);
    pool_for(world->pool, world->grid.particle_blocks, BLOCK_GRAIN, scale_blocks, world);
    push(world, contacts, 1.0f);
    dual_gains_find(world);
}

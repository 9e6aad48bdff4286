#include "solvers/dual/dual_gains.h"

#include <string.h>

#include "contact/walls.h"

enum { SUMS = sizeof(DualGain) / sizeof(double), BLOCK_GRAIN = 8, W = K_NODE_WIDTH };

bool dual_gains_prepare(World *world)
{
    DualGains *gains = &world->dual.gains;
    return array_reserve(&world->memory, &gains->of_block, (size_t)world->grid.node_blocks, sizeof(DualGain)) &&
           array_reserve(&world->memory, &gains->of_body, (size_t)world->grid.bodies, sizeof(DualGain));
}

void dual_gains_free(World *world)
{
    DualGains *gains = &world->dual.gains;
    array_free(&world->memory, &gains->of_block);
    array_free(&world->memory, &gains->of_body);
}

static bool is_at_obstacle(const World *world, int32_t block)
{
    const Colliders *colliders = &world->colliders;
    const uint32_t *begin = colliders->contact_begin.data;
    if (colliders->contacts > 0 && begin[block + 1] > begin[block]) return true;
    return walls_any(&world->walls) && ((const uint64_t *)world->walls.marked.data)[block] != 0;
}

static DualGain sum_block(const World *world, int32_t block)
{
    const size_t floats = (size_t)world->grid.block_cells * W, start = (size_t)block * floats;
    const float *node = (const float *)world->grid.node.data + start, *push = world->args.dual.node_push + start, *before = world->args.grid.node_before + start;
    DualGain sum = {.at_obstacle = is_at_obstacle(world, block) ? 1.0 : 0.0};
    for (size_t i = 0; i < floats; i += W) {
        const double mass = (double)node[i + 3];
        if (mass == 0.0) continue;
        sum.mass += mass;
        for (size_t c = 0; c < 3; c++) {
            const double u = (double)node[i + c], brought = (double)before[i + c] - (double)world->args.gravity[c], away = u - brought, q = (double)push[i + c];
            sum.brought += 0.5 * mass * brought * brought;
            sum.gain += q * u - 0.5 * mass * away * away;
            sum.work += q * u;
            sum.kinetic += 0.5 * mass * u * u;
            sum.momentum[c] += mass * u;
        }
    }
    return sum;
}

static void sum_blocks(void *context, int32_t begin, int32_t end)
{
    World *world = *(World **)context;
    DualGain *sums = world->dual.gains.of_block.data;
    for (int32_t block = begin; block < end; block++) sums[block] = sum_block(world, block);
}

static void add(DualGain *to, const DualGain *from)
{
    double sum[SUMS], more[SUMS];
    memcpy(sum, to, sizeof sum);
    memcpy(more, from, sizeof more);
    for (int k = 0; k < SUMS; k++) sum[k] += more[k];
    memcpy(to, sum, sizeof sum);
}

void dual_gains_find(World *world)
{
    DualGains *gains = &world->dual.gains;
    const int32_t *of_block = world->grid.body.data;
    const DualGain *sums = gains->of_block.data;
    DualGain *body = gains->of_body.data;
    Loops loops;
    loops_open(&loops, world->pool);
    LOOPS_ADD(&loops, grid_nodes(&world->grid, BLOCK_GRAIN), sum_blocks, &world);
    loops_run(&loops);
    memset(body, 0, (size_t)world->grid.bodies * sizeof *body);
    for (int32_t block = 0; block < world->grid.node_blocks; block++) add(&body[of_block[block]], &sums[block]);
}

const DualGain *dual_gain(const World *world, int32_t body) { return (const DualGain *)world->dual.gains.of_body.data + body; }

const DualGain *dual_gain_in(const World *world, int32_t block) { return dual_gain(world, body_of_block(&world->grid, block)); }

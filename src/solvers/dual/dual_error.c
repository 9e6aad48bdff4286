#include "solvers/dual/dual_error.h"

#include <math.h>
#include <string.h>

#include "world/depth.h"

enum { BLOCK_GRAIN = 8 };

bool dual_error_prepare(World *world)
{
    DualState *dual = &world->dual;
    const size_t blocks = (size_t)world->grid.node_blocks, nodes = blocks * (size_t)world->grid.block_cells;
    return array_reserve(&world->memory, &dual->kept, nodes * K_NODE_WIDTH, sizeof(float)) &&
           array_reserve(&world->memory, &dual->moved2, blocks, sizeof(double));
}

void dual_error_free(World *world)
{
    array_free(&world->memory, &world->dual.kept);
    array_free(&world->memory, &world->dual.moved2);
}

/* Where nothing weighs, both ends of matter are alike, and the slowest mode is half a wave instead of a quarter. */
static double slowest_mode(const World *world) { return slowest_pressure(world) * (gravity_strength(world) > 0.0 ? 1.0 : 2.0); }

DualModes dual_modes_of(const World *world, double relaxation)
{
    DualModes modes = {.slowest = slowest_mode(world), .relaxation = relaxation};
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (world->particles.of_material[slot] > 0 && !material_is_solid(&world->materials, slot))
            modes.softness = fmax(modes.softness, (double)world->materials.kernel[slot].inverse_stiffness);
    modes.response = modes.slowest;
    return modes;
}

/* Error per residual in a mode. */
static double share_of(const DualModes *modes, double root) { return root / (modes->relaxation * (root * root + modes->softness)); }

double dual_predicted_error(const DualModes *modes, double residual)
{
    const double moving = fmin(modes->response / modes->slowest, 1.0); /* of the residual, at most */
    return sqrt(share_of(modes, modes->slowest) * share_of(modes, fmax(modes->response, modes->slowest))) * moving * residual;
}

void dual_find_response(DualModes *modes, double residual, double moved, double momentum)
{
    if (residual > 0.0) modes->response = (1.0 - momentum) * moved / residual;
}

static void compare_blocks(void *context, int32_t begin, int32_t end)
{
    World *world = *(World **)context;
    const size_t floats = (size_t)world->grid.block_cells * K_NODE_WIDTH;
    double *moved2 = world->dual.moved2.data;
    for (int32_t block = begin; block < end; block++) {
        const float *node = (const float *)world->grid.node.data + (size_t)block * floats;
        float *kept = (float *)world->dual.kept.data + (size_t)block * floats;
        float sum = 0.0f;
        for (size_t i = 0; i < floats; i += K_NODE_WIDTH) {
            const float x = node[i] - kept[i], y = node[i + 1] - kept[i + 1], z = node[i + 2] - kept[i + 2];
            sum += node[i + 3] * (x * x + y * y + z * z);
        }
        moved2[block] = (double)sum;
        memcpy(kept, node, floats * sizeof *kept);
    }
}

void dual_compare_displacements(World *world, Loops *loops) { LOOPS_ADD(loops, grid_nodes(&world->grid, BLOCK_GRAIN), compare_blocks, &world); }

/* The sums of the blocks are added in order, so they do not depend on the number of threads. */
double dual_compared(const World *world)
{
    const double *moved2 = world->dual.moved2.data;
    double sum = 0.0;
    for (int32_t block = 0; block < world->grid.node_blocks; block++) sum += moved2[block];
    return sum;
}

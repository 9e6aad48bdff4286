#include "contact/reach.h"

#include <string.h>

#include "base/result.h"

enum { NODES_MAX = 27 };

/* The nodes that a particle of a cell reaches. Returns how many there are. */
static int nodes_of(const Grid *grid, int32_t block, uint32_t cell, int64_t nodes[NODES_MAX])
{
    const int local[3] = {(int)(cell & 3), (int)(cell >> 2 & 3), (int)(cell >> 4)}, deep = grid->dimension == 3;
    int way[3], count = 0;
    for (way[2] = -deep; way[2] <= deep; way[2]++)
        for (way[1] = -1; way[1] <= 1; way[1]++)
            for (way[0] = -1; way[0] <= 1; way[0]++) {
                const int64_t node = grid_node_beside(grid, block, local, way);
                if (node != GRID_NOWHERE) nodes[count++] = node;
            }
    return count;
}

pbmpm_result reach_find(ContactFrame *frame, const KernelMaterial *material, Memory *memory)
{
    const Grid *grid = frame->grid;
    const uint32_t *block_run = grid->block_run.data;
    Array *array = &frame->colliders->solid;
    if (!array_reserve(memory, array, (size_t)grid->node_blocks, sizeof(uint64_t)))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the nodes that solids reach in %d blocks", grid->node_blocks);
    uint64_t *solid = array->data;
    if (grid->node_blocks > 0) memset(solid, 0, (size_t)grid->node_blocks * sizeof *solid);
    for (int32_t block = 0; block < grid->particle_blocks; block++)
        for (uint32_t run = block_run[block]; run < block_run[block + 1]; run++)
            if (material[grid->run_key[run] >> K_RUN_CELL_BITS].kind != K_LIQUID) {
                int64_t nodes[NODES_MAX];
                const int count = nodes_of(grid, block, grid->run_key[run] & K_RUN_CELL_MASK, nodes);
                for (int i = 0; i < count; i++) solid[nodes[i] / grid->block_cells] |= (uint64_t)1 << (nodes[i] % grid->block_cells);
            }
    frame->solid = solid;
    return PBMPM_OK;
}

static bool acts_on_all(const Obstacle *obstacle, const pbmpm_material_def *material, const uint32_t *of_material)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS && obstacle->meets != 0; slot++)
        if (of_material[slot] > 0 && !obstacle_meets(obstacle, material[slot].groups)) return false;
    return true;
}

pbmpm_result reach_find_groups(ContactFrame *frame, const pbmpm_material_def *material, const uint32_t *of_material, Memory *memory)
{
    const Grid *grid = frame->grid;
    const size_t count = (size_t)grid->node_blocks * (size_t)grid->block_cells;
    const uint32_t *block_run = grid->block_run.data;
    Array *array = &frame->colliders->groups;
    bool all = true;
    for (int i = 0; i < frame->colliders->obstacle_count && all; i++) all = acts_on_all(&frame->colliders->obstacle[i], material, of_material);
    if (all || count == 0) return PBMPM_OK;
    if (!array_reserve(memory, array, count, sizeof(uint32_t)))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the groups of matter in %d blocks", grid->node_blocks);
    uint32_t *groups = array->data;
    memset(groups, 0, count * sizeof *groups);
    for (int32_t block = 0; block < grid->particle_blocks; block++)
        for (uint32_t run = block_run[block]; run < block_run[block + 1]; run++) {
            int64_t nodes[NODES_MAX];
            const int reached = nodes_of(grid, block, grid->run_key[run] & K_RUN_CELL_MASK, nodes);
            for (int i = 0; i < reached; i++) groups[nodes[i]] |= material[grid->run_key[run] >> K_RUN_CELL_BITS].groups;
        }
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (of_material[slot] > 0) frame->present |= material[slot].groups;
    frame->groups = groups;
    frame->material = material;
    return PBMPM_OK;
}

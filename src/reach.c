#include "reach.h"

#include <string.h>

#include "result.h"

/* The nodes that a particle of a cell reaches. */
static void mark(const Grid *grid, int32_t block, int cell, uint64_t *solid)
{
    const int local[3] = {cell & 3, cell >> 2 & 3, cell >> 4}, deep = grid->dimension == 3;
    int way[3];
    for (way[2] = -deep; way[2] <= deep; way[2]++)
        for (way[1] = -1; way[1] <= 1; way[1]++)
            for (way[0] = -1; way[0] <= 1; way[0]++) {
                const int64_t node = grid_node_beside(grid, block, local, way);
                if (node != GRID_NOWHERE) solid[node / grid->block_cells] |= (uint64_t)1 << (node % grid->block_cells);
            }
}

pbmpm_result reach_find(ContactFrame *frame, const KernelMaterial *material, Memory *memory)
{
    const Grid *grid = frame->grid;
    const uint32_t *block_run = grid->block_run.data;
    Array *array = &frame->colliders->solid;
    if (!array_reserve(memory, array, (size_t)grid->node_blocks, sizeof(uint64_t)))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the nodes that solids reach in %d blocks", grid->node_blocks);
    uint64_t *solid = array->data;
    memset(solid, 0, (size_t)grid->node_blocks * sizeof *solid);
    for (int32_t block = 0; block < grid->particle_blocks; block++)
        for (uint32_t run = block_run[block]; run < block_run[block + 1]; run++)
            if (material[grid->run_key[run] >> K_RUN_CELL_BITS].kind != K_LIQUID) mark(grid, block, (int)(grid->run_key[run] & K_RUN_CELL_MASK), solid);
    frame->solid = solid;
    return PBMPM_OK;
}

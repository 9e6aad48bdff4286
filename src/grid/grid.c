#include "grid/grid.h"

#include "base/result.h"

/* Per particle, and the end of the runs of each part. */
static size_t scratch_bytes(uint32_t capacity) { return ((size_t)capacity + GRID_PARTS) * 4; }

pbmpm_result grid_init(Grid *grid, Memory *memory, int dimension, uint32_t capacity)
{
    const bool deep = dimension == 3;
    *grid = (Grid){.dimension = dimension,
                   .neighbours = deep ? 27 : 9,
                   .block_cells = deep ? K_BLOCK_AXIS * K_BLOCK_AXIS * K_BLOCK_AXIS : K_BLOCK_AXIS * K_BLOCK_AXIS,
                   .tile_nodes = deep ? K_TILE_AXIS * K_TILE_AXIS * K_TILE_AXIS : K_TILE_AXIS * K_TILE_AXIS,
                   .capacity = capacity};
    const size_t bytes = scratch_bytes(capacity);
    const bool ok = (grid->run_begin = memory_take(memory, bytes)) && (grid->run_key = memory_take(memory, bytes)) &&
                    (grid->block_of = memory_take(memory, bytes)) && (grid->order = memory_take(memory, bytes)) &&
                    (grid->order_scratch = memory_take(memory, bytes));
    if (ok) return PBMPM_OK;
    grid_free(grid, memory);
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory to sort %u particles", capacity);
}

void grid_free(Grid *grid, Memory *memory)
{
    const size_t bytes = scratch_bytes(grid->capacity);
    void *whole[] = {grid->run_begin, grid->run_key, grid->block_of, grid->order, grid->order_scratch};
    for (size_t i = 0; i < sizeof whole / sizeof *whole; i++) memory_give(memory, whole[i], bytes);
    grid_free_part(grid, memory);
}

void grid_free_part(Grid *grid, Memory *memory)
{
    Array *arrays[] = {&grid->coordinate,  &grid->neighbour,    &grid->body,  &grid->block_begin, &grid->block_run, &grid->tile,  &grid->tile_volume,
                       &grid->node,        &grid->node_base,    &grid->node_volume, &grid->node_density,
                       &grid->node_reach,  &grid->edged,        &grid->counts,      &grid->travel,
                       &grid->found,       &grid->sorted,       &grid->table};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) array_free(memory, arrays[i]);
    *grid = (Grid){0};
}

bool grid_reserve_nodes(Grid *grid, Memory *memory, bool with_volume)
{
    const size_t nodes = (size_t)grid->node_blocks * (size_t)grid->block_cells;
    return array_reserve(memory, &grid->node, nodes * K_NODE_WIDTH, sizeof(float)) &&
           array_reserve(memory, &grid->node_reach, (size_t)grid->node_blocks, sizeof(float)) &&
           (!with_volume || (array_reserve(memory, &grid->node_volume, nodes, sizeof(float)) &&
                             array_reserve(memory, &grid->edged, (size_t)grid->node_blocks, sizeof(uint32_t))));
}

bool grid_is_sound(const Grid *grid)
{
    const uint32_t *begin = grid->block_begin.data, *run = grid->block_run.data;
    const int32_t *neighbour = grid->neighbour.data, *body = grid->body.data, blocks = grid_row_blocks(grid), self = grid->neighbours / 2;
    bool sound = grid->still_blocks <= grid->particle_blocks && grid->particle_blocks <= grid->node_blocks;
    if (blocks == 0) return sound;
    sound = sound && begin[0] == grid->first_row && begin[blocks] == grid->end_row && run[0] == 0 && run[blocks] == grid->runs;
    for (int32_t b = 0; b < blocks; b++) sound = sound && begin[b] < begin[b + 1] && run[b] < run[b + 1];
    for (uint32_t r = 0; r < grid->runs; r++) {
        const bool in_cell = (grid->run_key[r] & K_RUN_CELL_MASK) < (uint32_t)grid->block_cells;
        sound = sound && in_cell && grid->run_begin[r] < grid->run_begin[r + 1];
    }
    for (int32_t b = 0; b < grid->node_blocks; b++) {
        sound = sound && neighbour[b * grid->neighbours + self] == b;
        for (int n = 0; n < grid->neighbours; n++) {
            const int32_t other = neighbour[b * grid->neighbours + n];
            sound = sound && other < grid->node_blocks && (other < 0 || body[other] == body[b]);
        }
    }
    return sound;
}

void grid_share(Grid *part, const Grid *whole, int place, uint32_t first, uint32_t end)
{
    part->dimension = whole->dimension;
    part->neighbours = whole->neighbours;
    part->block_cells = whole->block_cells;
    part->tile_nodes = whole->tile_nodes;
    part->first_row = first;
    part->end_row = end;
    part->block_of = whole->block_of;
    part->order = whole->order;
    part->order_scratch = whole->order_scratch;
    part->flies = whole->flies;
    part->flies_context = whole->flies_context;
    if (place == 0) return; /* the whole grid itself */
    part->run_begin = whole->run_begin + first + place;
    part->run_key = whole->run_key + first + place;
}

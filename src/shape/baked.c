#include "shape/baked.h"

#include <string.h>

#include "base/result.h"

static size_t value_bytes(const DistanceGrid *grid) { return distance_grid_nodes(grid) * sizeof(float); }

static pbmpm_result free_slot(BakedTable *table, Memory *memory, uint32_t *index)
{
    if (!table->slot) table->slot = memory_take(memory, PBMPM_MAX_BAKED * sizeof *table->slot);
    if (!table->slot) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for baked solids");
    for (*index = 0; *index < PBMPM_MAX_BAKED; ++*index)
        if (table->slot[*index].generation == 0) return PBMPM_OK;
    return fail(PBMPM_ERROR_CAPACITY, "a world holds at most %d baked solids", PBMPM_MAX_BAKED);
}

pbmpm_result baked_add(BakedTable *table, Memory *memory, int dimension, const void *data, uint64_t size, uint32_t generation, pbmpm_baked_id *id)
{
    DistanceGrid grid;
    const void *values;
    uint32_t index;
    pbmpm_result result = distance_grid_read(data, size, &grid, &values);
    if (result != PBMPM_OK) return result;
    if (grid.dimension != dimension)
        return fail(PBMPM_ERROR_INVALID_ARGUMENT, "the baked solid is for %d dimensions, the world has %d", grid.dimension, dimension);
    result = free_slot(table, memory, &index);
    if (result != PBMPM_OK) return result;
    float *value = memory_take(memory, value_bytes(&grid));
    if (!value) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for a baked solid of %zu bytes", value_bytes(&grid));
    memcpy(value, values, value_bytes(&grid));
    grid.value = value;
    grid.moments = distance_grid_moments(&grid);
    table->slot[index] = (Baked){generation, grid, value};
    *id = (pbmpm_baked_id){index, generation};
    return PBMPM_OK;
}

void baked_remove(BakedTable *table, Memory *memory, uint32_t index)
{
    Baked *baked = &table->slot[index];
    memory_give(memory, baked->value, value_bytes(&baked->grid));
    *baked = (Baked){0};
}

void baked_free(BakedTable *table, Memory *memory)
{
    for (uint32_t i = 0; table->slot && i < PBMPM_MAX_BAKED; i++)
        if (table->slot[i].generation != 0) baked_remove(table, memory, i);
    memory_give(memory, table->slot, PBMPM_MAX_BAKED * sizeof *table->slot);
    table->slot = NULL;
}

const DistanceGrid *baked_find(const BakedTable *table, pbmpm_baked_id id)
{
    if (!table->slot || id.index >= PBMPM_MAX_BAKED || id.generation == 0) return NULL;
    const Baked *baked = &table->slot[id.index];
    return baked->generation == id.generation ? &baked->grid : NULL;
}

uint32_t baked_generation(const BakedTable *table, const DistanceGrid *grid)
{
    for (uint32_t i = 0; grid && i < PBMPM_MAX_BAKED; i++)
        if (&table->slot[i].grid == grid) return table->slot[i].generation;
    return 0;
}

pbmpm_baked_info baked_describe(const DistanceGrid *grid)
{
    pbmpm_baked_info info = {.size = sizeof info, .dimension = grid->dimension, .spacing = (float)grid->spacing, .bytes = distance_grid_bytes(grid)};
    for (int a = 0; a < 3; a++) {
        info.count[a] = (uint32_t)grid->count[a];
        info.minimum[a] = (float)grid->low[a];
        info.maximum[a] = (float)distance_grid_high(grid, a);
    }
    return info;
}

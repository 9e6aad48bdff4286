/* The baked solids that a world has loaded. */
#ifndef PBMPM_SRC_SHAPE_BAKED_H
#define PBMPM_SRC_SHAPE_BAKED_H

#include "base/memory.h"
#include "pbmpm/solid.h"
#include "shape/distance_grid.h"

typedef struct Baked {
    uint32_t generation; /* 0: free slot */
    DistanceGrid grid;
    float *value;
} Baked;

typedef struct BakedTable {
    Baked *slot; /* PBMPM_MAX_BAKED; null until the first is loaded. Stays where it is. */
} BakedTable;

/* Copies a stored solid into the world's memory. */
pbmpm_result baked_add(BakedTable *table, Memory *memory, int dimension, const void *data, uint64_t size, uint32_t generation, pbmpm_baked_id *id);
/* The solid is live. */
void baked_remove(BakedTable *table, Memory *memory, uint32_t index);
void baked_free(BakedTable *table, Memory *memory);

/* Null if not live. */
const DistanceGrid *baked_find(const BakedTable *table, pbmpm_baked_id id);

/* That of a live one: no other had it before at this place. Null has 0. */
uint32_t baked_generation(const BakedTable *table, const DistanceGrid *grid);

pbmpm_baked_info baked_describe(const DistanceGrid *grid);

#endif

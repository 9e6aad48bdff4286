/* What takes particles out: drains and kill bounds. */
#ifndef PBMPM_SRC_WORLD_SINKS_H
#define PBMPM_SRC_WORLD_SINKS_H

#include "base/memory.h"
#include "pbmpm/drain.h"
#include "shape/shapes.h"

typedef struct Drain {
    uint32_t generation; /* 0: free slot */
    pbmpm_drain_def def;
    pbmpm_shape shape;
    Solid solid;
    uint64_t drained;
    double drained_mass;
} Drain;

typedef struct Sinks {
    Drain *slot;   /* PBMPM_MAX_DRAINS; null until there is one */
    uint32_t used; /* slots [used, PBMPM_MAX_DRAINS) were never taken */
    pbmpm_kill_bounds bounds;
} Sinks;

void sinks_free(Sinks *sinks, Memory *memory);

pbmpm_drain_def drain_defaults(void);
pbmpm_kill_bounds kill_bounds_defaults(void);
/* Null if valid, else what is wrong. */
const char *drain_problem(const pbmpm_drain_def *def, const pbmpm_shape *shape, int dimension);
const char *kill_bounds_problem(const pbmpm_kill_bounds *bounds, int dimension);
pbmpm_result sinks_add(Sinks *sinks, Memory *memory, const pbmpm_drain_def *def, const pbmpm_shape *shape, int dimension, uint32_t generation,
                       pbmpm_drain_id *id);
Drain *sinks_find(const Sinks *sinks, pbmpm_drain_id id); /* null if not live */
void drain_set(Drain *drain, const pbmpm_drain_def *def, const pbmpm_shape *shape, int dimension);

#endif

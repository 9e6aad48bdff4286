/* Force fields. */
#ifndef PBMPM_SRC_WORLD_FORCES_H
#define PBMPM_SRC_WORLD_FORCES_H

#include "base/memory.h"
#include "pbmpm/force.h"
#include "shape/shapes.h"

typedef struct Force {
    uint32_t generation; /* 0: free slot */
    pbmpm_force_def def;
    pbmpm_shape shape;
    Solid solid;
    double axis[3]; /* def.direction as a unit vector; 2D: the third axis, but for a uniform force */
    double impulse[3]; /* [kg m/s] of the step */
    uint32_t nodes;
} Force;

typedef struct Forces {
    Force *slot;   /* PBMPM_MAX_FORCES; null until there is one */
    uint32_t used; /* slots [used, PBMPM_MAX_FORCES) were never taken */
    Array share;   /* ForceShare per node block and force that is on; then what held[] points to */
    uint64_t *held; /* per node block: bit n, a grab with the share 1 holds node n */
    Array before;  /* the predictor without forces, for solvers that want it */
    bool holds;    /* there is such a node */
    uint32_t on;   /* forces that were on in the present substep */
} Forces;

void forces_free(Forces *forces, Memory *memory);

pbmpm_force_def force_defaults(void);
/* Null if valid, else what is wrong. */
const char *force_problem(const pbmpm_force_def *def, const pbmpm_shape *shape, int dimension);
pbmpm_result forces_add(Forces *forces, Memory *memory, const pbmpm_force_def *def, const pbmpm_shape *shape, int dimension, uint32_t generation,
                        pbmpm_force_id *id);
Force *forces_find(const Forces *forces, pbmpm_force_id id); /* null if not live */
/* Beyond this distance from its shape a force is not felt [m]; may be INFINITY. */
double force_reach(const Force *force);
/* A new step: nothing has been done yet. */
void forces_begin_step(Forces *forces);
void force_set(Force *force, const pbmpm_force_def *def, const pbmpm_shape *shape, int dimension);

#endif

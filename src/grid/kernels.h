/* The ISPC kernels of one dimension and instruction set. */
#ifndef PBMPM_SRC_GRID_KERNELS_H
#define PBMPM_SRC_GRID_KERNELS_H

#include "kernel_types.h"
#include "pbmpm/base.h"

/* Works on the blocks [begin, end). */
typedef void Kernel(KernelArgs *args, int32_t begin, int32_t end);

typedef struct Kernels {
    Kernel *scatter;       /* particle blocks: first P2G */
    Kernel *predict_nodes; /* node blocks: predictor */
    Kernel *iterate;       /* particle blocks: G2P, projection, P2G */
    Kernel *update_nodes;  /* node blocks: grid update */
    Kernel *integrate;     /* particle blocks: last G2P and integration */
    Kernel *fly;           /* flights: the whole substep */
    Kernel *drift;         /* particle blocks that sleep: what they would do */
    Kernel *dual_begin;    /* particle blocks: dual solver, first P2G of the multipliers */
    Kernel *dual_iterate;  /* particle blocks: G2P, proximal step, P2G of the multipliers */
    Kernel *push_nodes;    /* node blocks: displacement from the multipliers */
    Kernel *cells_begin;   /* particle blocks: dual solver with pressures in cells, what the cells hold */
    Kernel *cells_mean;    /* node blocks: means of the cells */
    Kernel *solids_begin;  /* particle blocks: what the cells hold of solids, for the guess */
    Kernel *solids_mean;   /* node blocks: adds it to the means */
    Kernel *cells_push;    /* particle blocks: pressures to nodes */
    Kernel *cells_carry;   /* particle blocks: pressures that particles start the guess from, to nodes */
    Kernel *cells_add;     /* particle blocks: adds what the guess found; pressures to nodes */
    Kernel *cells_trace;   /* particle blocks: G2P, traces of D to cells */
    Kernel *second_order;  /* particle blocks: G2P, what strain does beyond its trace to cells */
    Kernel *cells_update;  /* node blocks: proximal step of the cells */
    Kernel *respond_nodes; /* node blocks: displacement from pressures alone */
    Kernel *cells_respond; /* node blocks: means of the traces */
    Kernel *force_first;   /* particle blocks: energies, their gradient and stiffness to nodes */
    Kernel *force;         /* particle blocks: energy and its gradient */
    Kernel *force_nodes;   /* node blocks: sums of the tiles */
    Kernel *hold_pressure; /* particle blocks: what liquids press with while the primal solver works */
    Kernel *end_sketch;    /* particle blocks: notes where the sketch has taken solids */
    Kernel *viscous;       /* particle blocks: G2P, viscous stress, P2G */
    Kernel *viscous_nodes; /* node blocks: a stage of viscosity */
    int lanes;             /* particles per gang */
} Kernels;

/* `isa` is supported; `dimension` is 2 or 3. */
const Kernels *kernels_for(pbmpm_isa isa, int dimension);

#endif

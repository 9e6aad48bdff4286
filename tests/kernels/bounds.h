/* How far the kernels, in single precision, may be from the reference.
 *
 * U is the unit round-off of a float: every operation has a relative error of at most U. A chain of k operations on terms of one
 * sign has at most about k U; where terms cancel, the bound refers to the sum of their sizes. From there errors are carried
 * on by the sensitivity of each step (condition factors), which is derived at each function. Nothing is fitted. */
#ifndef PBMPM_TESTS_BOUNDS_H
#define PBMPM_TESTS_BOUNDS_H

#include "reference.h"

#define UNIT_ROUNDOFF 5.9604644775390625e-8 /* 2^-24 */

/* Operations between the inputs and one term of a transfer: 5 for the weight or weight times offset on each of 3 axes, 2 to
 * multiply them, 3 for mass, time step and cell size, 2 for the value, and 9 additions inside a particle. */
#define TRANSFER_ROUNDINGS 32
/* Products of small weights are flushed to zero below 2^-126; each term loses less than this share of its largest factor. */
#define FLUSHED 1e-36

/* Bounds of a node's sums. */
typedef struct BoundNode {
    double carried[3]; /* from errors of the particles */
    double size[3];    /* sum of the sizes of all terms */
    int terms;
} BoundNode;

/* Bounds of entries of d and D. */
typedef struct BoundParticle {
    double d, D;
} BoundParticle;

/* Error of what reference_gather() returns: sums of w u and 4 w u (x_i - x_p). */
BoundParticle bound_gather(const RefGrid *grid, const RefParticle *p);
/* Error of tr D, summed over the links between neighbouring nodes: the middle node of a row takes part in two. */
double bound_trace(const RefGrid *grid, const RefParticle *p);

/* Error of the rotation of A in the Frobenius norm, given that of A. */
double bound_rotation(int dimension, const double *A, double error);

/* Error of D after reference_project(), given those of d and D before; D is the projected one's input. */
double bound_project(int dimension, const RefParticle *p, const double d[3], const double D[9], BoundParticle error);

/* Adds one particle's part, given the errors of its d and D. `bounds` is indexed like `grid`. */
void bound_scatter(const RefGrid *grid, BoundNode *bounds, const RefParticle *p, const double d[3], const double D[9],
                   BoundParticle error);
/* The same for a particle's multiplier, given the error of its entries. What a pressure, also one of solids, adds to the middle node of a row the kernel makes of what it
 * adds to the outer two: so sizes of those count there. */
void bound_push(const RefGrid *grid, BoundNode *bounds, const RefParticle *p, const double S[9], double error);
/* Of a node's momentum along one axis. The last rounding of each addition counts: there are as many as terms. */
double bound_of_sum(const BoundNode *node, int axis);

/* Error of F' = (I + D) F in the Frobenius norm. */
double bound_advance(int dimension, const double *F, const double D[9], double error);

/* How much farther apart two matrices near F can be after reference_limit_strain() than before. */
double strain_limit_sensitivity(int dimension, const KernelMaterial *material, const double *F);

#endif

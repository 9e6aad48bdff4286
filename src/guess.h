/* A guess of the pressure to start the dual solver from.
 *
 * The dual solver moves pressure by about a cell per iteration: what is wrong over the depth of a pool takes as many iterations as
 * the pool has cells. Here the volume constraint is solved as if it were an equation, by conjugate gradients with a multilevel
 * preconditioner, for pressures at cell centres (cells.isph), among the cells that are under pressure or want to be. A few iterations reach
 * through the whole pool. What the guess leaves out, tension-free surfaces and elastic stresses, is the dual solver's. */
#ifndef PBMPM_SRC_GUESS_H
#define PBMPM_SRC_GUESS_H

#include "solver.h"

/* Takes memory for the blocks of this substep. */
pbmpm_result guess_prepare(World *world);
void guess_free(World *world);

/* Prepares the preconditioner. The nodes are used and left in disorder. */
void guess_begin(World *world, const ContactFrame *contacts);

/* How far args.cell_pressure, whose displacements the nodes hold, is from balancing volume: the residual in the metric of the preconditioner. */
double guess_measure(World *world, const ContactFrame *contacts);

/* Improves args.cell_pressure by `iterations` steps, from what guess_measure() found and returned as `size`. */
void guess_solve(World *world, const ContactFrame *contacts, int iterations, double size);

/* Back to the pressures before guess_solve(). */
void guess_take_back(World *world);

#endif

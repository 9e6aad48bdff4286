/* A guess of the pressure to start the dual solver from.
 *
 * The dual solver moves pressure by about a cell per iteration: what is wrong over the depth of a pool takes as many iterations as
 * the pool has cells. Here the volume constraint is solved as if it were an equation, by conjugate gradients with a multilevel
 * preconditioner, for pressures at cell centres (cells.isph), among the cells that are under pressure or want to be. A few iterations reach
 * through the whole pool. What the guess leaves out, tension-free surfaces and elastic stresses, is the dual solver's. */
#ifndef PBMPM_SRC_SOLVERS_DUAL_PRESSURE_GUESS_H
#define PBMPM_SRC_SOLVERS_DUAL_PRESSURE_GUESS_H

#include "world/world.h"

/* Takes memory for the blocks of this substep. */
pbmpm_result guess_prepare(World *world);
void guess_free(World *world);

/* The density that pressures of cells are measured by, the lightest liquid's; 0 where there is but one, or where no guess but the cells' own iterations
 * find them, whose steps are safe for multipliers. See cells.isph. */
double guess_density(const World *world);

/* Prepares the preconditioner. The nodes are used and left in disorder. */
void guess_begin(World *world, const ContactFrame *contacts);

/* Improves args.cells.pressure, whose displacements the nodes hold, by up to `iterations` steps; args.cells.pressure_old keeps it as it was. The nodes are left
 * in disorder. */
void guess_solve(World *world, const ContactFrame *contacts, int iterations);

/* Runs the loops, after which the nodes hold the displacements of args.cells.pressure, and returns how good that is: greater is better. */
double guess_gain(World *world, Loops *loops);

/* Adds a loop that goes back to the pressures before guess_solve(). */
void guess_take_back(World *world, Loops *loops);

#endif

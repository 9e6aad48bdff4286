/* More iterations of the dual solver for solids among liquids.
 *
 * Liquids start from a guess that reaches through a pool, and a few iterations are enough for them. What a solid resists by shear has no such
 * guess: a stress takes about as many iterations as sound takes cells per substep, and with fewer than that a body is kneaded to crumbs by any jet.
 * So in a world with both, blocks with solids get rounds by themselves, while all other multipliers rest. Each round ascends the same dual
 * energy as an iteration over all blocks, so their fixed point is the same. Half of them come before the iterations over all blocks, half after. */
#ifndef PBMPM_SRC_SOLVERS_DUAL_ROUNDS_H
#define PBMPM_SRC_SOLVERS_DUAL_ROUNDS_H

#include "world/world.h"

/* Rounds cost about what iterations do: beyond, a raised number of iterations is the honest price of a stiff body. By trial. */
enum { ROUNDS_MOST = 16 };

/* How many rounds bodies take whose stiffness without unit, c (2 mu + lambda), is `stiffness`, given the iterations over all blocks. */
int rounds_wanted(double stiffness, int iterations);

/* Takes memory for the blocks of this substep. False: there is none. */
bool rounds_reserve(World *world);

/* Lists the blocks with solids, and those of the nodes that they touch. */
void rounds_begin(World *world);

/* The displacements are those of the present multipliers, before and after. */
void rounds_run(World *world, const ContactFrame *contacts, int rounds);

#endif

/* Nodes at walls that follow nodes before them (walls.h) in the primal's parts of the joint solver: those of which a solid reaches one that they follow.
 *
 * There u = E u~ + c0, as in the dual; c0 is what the dual left. So the gradient for u~ is E^T g. What is left of g at the followers,
 * g - A g with A of the entry, is what their walls give: the sum over all nodes stays, for each follower's weights add up to 1. */
#ifndef PBMPM_SRC_SOLVERS_PRIMAL_PRIMAL_FOLLOW_H
#define PBMPM_SRC_SOLVERS_PRIMAL_PRIMAL_FOLLOW_H

#include "solvers/primal/primal_solve.h"

/* Loops: p->node of the followers; E^T of the gradient in p->force, after finish_gradient(). */
void primal_add_follow(Primal *p, Loops *loops);
void primal_add_fold(Primal *p, Loops *loops);

#endif

/* Nodes at walls that follow nodes before them, in the primal's parts of the joint solver: those near solids, see joint.h.
 *
 * A follower is a contact whose surface its parents lead: n.u >= n.s + k n.(b - s), with s the wall's motion and b the mean of the
 * parents', as in walls_unilateral.h. While it is active n.u is that. So the parents bear k n (n.g) of the gradient g there, by their
 * weights. What is left of g is the wall's impulse: the sum over all nodes stays. Parents that stay bear nothing: a spring that holds
 * them would be let go with the stress of solids (push_staying() in joint.c).
 * Where it sticks, u = A b + c0 with A of the entry and c0 as the dual left it; the parents bear A g. */
#ifndef PBMPM_SRC_SOLVERS_PRIMAL_PRIMAL_FOLLOWERS_H
#define PBMPM_SRC_SOLVERS_PRIMAL_PRIMAL_FOLLOWERS_H

#include "solvers/primal/primal_solve.h"

/* Loops that take p->node of the followers to where it is led. */
void primal_add_followers(Primal *p, Loops *loops);

/* After finish_gradient(): a loop that gives the parents their part of p->force. */
void primal_add_fold(Primal *p, Loops *loops);

#endif

/* Rigid bodies among the unknowns of the primal solver: they yield to solids while these are solved for.
 *
 * A rigid body that solids may meet has the unknown q, one number for each of its ways. Its obstacle goes z + W q in the substep, z as it was sent. W = s B has the inverse
 * of its inertia, W W', in the units of nodes. So its part of the energy that primal.h minimises is
 *
 *     |q - a|^2 / 2,
 *
 * where a is what is right if matter gives nothing more. Let J be what matter gave in the step so far, X what the body's velocity has of it already, and F the push of
 * gravity and the host. They act evenly over the step, and the velocity has all of that. In part p of P
 *
 *     a = s (B'(J - X - F dt (1 - (p+1)/P)) - c) / ...,   c: the change of its velocity that z has already.
 *
 * Contacts ask for n.(u_i - z_i - C_i W q) >= -gap_i, C_i the motion of the contact's foot. Where they are active nodes go along: u = P u + (1 - P) C W q, P the projection of
 * constraints_remove(). So the gradient by q is
 *
 *     r = q - a - W' sum C_i' f_i + W' sum C_i' (1 - P) g_i,
 *
 * f_i that of friction at the node, which depends on the slip alone. At the solution q - a is all that contacts give. Steps are preconditioned like those of nodes:
 * to change q by one way costs what it weighs, 1, and the stiffness of nodes that go along,
 *
 *     D = 1 + sum W' C_i' (m_i + k_i) C_i W.
 *
 * Where friction holds, nodes go along the surface, too: with T: (u, q) -> (u + P C W q, q) the preconditioner is T diag(B, 1/D) T'. Thus what is light follows what is stiff,
 * whatever the step: added mass and stiffness are in D. */
#ifndef PBMPM_SRC_SOLVERS_PRIMAL_PRIMAL_YIELD_H
#define PBMPM_SRC_SOLVERS_PRIMAL_PRIMAL_YIELD_H

#include "solvers/primal/primal_solve.h"

/* Lists the bodies that yield and their contacts, once these are found. */
pbmpm_result primal_yield_list(World *world, const ContactFrame *contacts);
void primal_yield_free(World *world);

/* All below do nothing where no body yields. In the order of a solution: before the first evaluation; */
void primal_yield_open(Primal *p);

/* where bodies begin, at p->node that obeys no contacts yet; */
void primal_yield_start(Primal *p);

/* what an evaluation at p->node adds: energy and slopes; */
void primal_yield_evaluate(Primal *p);

/* what a pair adds to the products in p->total; then the newest pair may go again; */
void primal_yield_keep_pair(Primal *p);
void primal_yield_drop_pair(Primal *p);

/* the place is accepted: what it adds to p->first; */
void primal_yield_accept(Primal *p);

/* a direction without pairs: from the gradient; */
void primal_yield_begin_plain(Primal *p);

/* a direction: before p->right changes by the pairs; after, its own part; what goes along in p->direction, and what that adds to p->total; all of it at last. */
void primal_yield_add_changes(Primal *p);
void primal_yield_find_direction(Primal *p);
void primal_yield_add_steps(Primal *p);

/* a step of the share p->share; back to what is accepted; */
void primal_yield_try(Primal *p);
void primal_yield_return(Primal *p);

/* the momentum of bodies with what they touch, of an unfinished solution; */
void primal_yield_keep_momentum(Primal *p);

/* what contacts gave, as constraints_book_impulses(); */
void primal_yield_book(Primal *p, const float *after);

/* whether a piece of matter presses such a body; */
bool primal_yield_presses(const Primal *p, int32_t matter);

/* the end: bodies go where they yielded to. */
void primal_yield_close(Primal *p);

#endif

/* Rigid bodies among the unknowns of the primal solver: they yield to solids while these are solved for.
 *
 * A rigid body that solids may meet has the unknown q, one number for each of its ways. Its obstacle goes z + W q in the substep, z as it was sent. W = s B has the inverse
 * of its inertia, W W', in the units of nodes. So its part of the energy that primal.h minimises is
 *
 *     |q - a|^2 / 2,
 *
 * where a is what is right if matter gives nothing more. Let J be what matter gave in the step so far, X what the body's velocity has of it already (rigid.h), and F the
 * push of gravity and the host. They act evenly over the step, and the velocity has all of that. c is the change of velocity that z has from the parts before.
 * With `unit` = q over velocity along the ways, in part p of P
 *
 *     a = unit (B' (J - X - F dt (P - p - 1)) - c).
 *
 * Contacts ask for n.(u_i - z_i - C_i W q) >= -gap_i, C_i the motion of the place of the node. Where they are active nodes go along: u = P u + (1 - P) C W q, P the projection of
 * constraints_remove(). So the gradient by q is
 *
 *     r = q - a - W' sum C_i' f_i + W' sum C_i' (1 - P) g_i,
 *
 * f_i that of friction at the node, which depends on the slip alone. At the solution q - a is all that contacts give. With T: (u, q) -> (u + f C W q, q), matter that goes along
 * by the share f (primal_yield_along.c), the preconditioner is T diag(B, D^-1) T'. D is what a way costs then. Thus what is light follows what is stiff: both its own weight and
 * the stiffness of what it presses are in D. Obeyed one step late, contacts of the stiffness k throw off what has k dt^2 / m > 4.
 *
 * L-BFGS, its pairs and Armijo's rule are those of primal_search.c, in the space of u and q. Where an unfinished solution ends: primal_yield_heaps.c, primal_yield_book.c. Without walls
 * of liquid, which have a law of their own (wall_bodies.h). Not among sand: it rests and flows by turns, and the dual, which solves what flows, knows no q. */
#ifndef PBMPM_SRC_SOLVERS_PRIMAL_PRIMAL_YIELD_H
#define PBMPM_SRC_SOLVERS_PRIMAL_PRIMAL_YIELD_H

#include "solvers/primal/primal_solve.h"

/* Lists the bodies that yield and their contacts, once these are found. */
pbmpm_result primal_yield_list(World *world, const ContactFrame *contacts);

/* Where no body yields they do nothing, or there is no p->joined, and nobody calls them. In the order of a solution: before the first evaluation; */
void primal_yield_open(Primal *p);

/* the search of all that these bodies touch, or null; */
Search *primal_yield_join(const Primal *p);

/* where bodies begin, at p->node that obeys no contacts yet; */
void primal_yield_start(Primal *p);

/* what an evaluation at p->node adds: energy and slopes; */
void primal_yield_evaluate(Primal *p);

/* what a pair adds to the products in p->joined->total; then the newest pair may go again; */
void primal_yield_keep_pair(Primal *p);
void primal_yield_drop_pair(Primal *p);

/* the place is accepted: what it adds to p->joined->first; */
void primal_yield_accept(Primal *p);

/* a direction without pairs: from the gradient; */
void primal_yield_begin_plain(Primal *p);

/* a direction: before p->right changes by the pairs; after, its own part; what goes along in p->direction, and what that adds to p->joined->total; all of it at last. */
void primal_yield_add_changes(Primal *p);
void primal_yield_find_direction(Primal *p);
void primal_yield_add_steps(Primal *p);

/* a step of the share p->joined->share, if that tries one; back to what is accepted; */
void primal_yield_try(Primal *p);
void primal_yield_return(Primal *p);

/* the momentum of bodies with what they touch, of an unfinished solution; */
void primal_yield_keep_momentum(Primal *p);

/* what contacts gave, as constraints_book_impulses(); */
void primal_yield_book(Primal *p, const float *after);

/* whether a piece of matter presses such a body; */
bool primal_yield_presses(const Primal *p, int32_t matter);

/* of a body with which a piece of matter is alone, for primal_bounce.c: the square of its change, |q - a|^2, that times its motion, and the energy that it lost; false: it is not
 * alone with one; */
typedef struct YieldBounce {
    double square, along, lost;
} YieldBounce;
bool primal_yield_bounce(const Primal *p, int32_t matter, YieldBounce *bounce);

/* the end: bodies go where they yielded to. */
void primal_yield_close(Primal *p);

#endif

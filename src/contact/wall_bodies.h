/* Rigid bodies among the walls: they yield to matter while it is solved for.
 *
 * What matter does to a body and the body to matter happens at once. With z the body's motion as its obstacle has it, w what gravity and earlier impulses make of it
 * in this substep, C its motion at the nodes that follow it, and K = B B^T what it yields to impulses beside what
 * walls of the domain hold, its own part y of the motion
 *     c0 = C (z + w + y),   K^-1 y = C^T (p - m u)
 * is one of the unknowns of walls.h. With u~ eliminated
 *     K^-1 y = G - S y,   y = B (1 + B^T S B)^-1 B^T G,   S = C^T m C - C^T m E M^-1 E^T m C
 * where G is C^T (p - m u) without y. Because M >= E^T m E, p to u stays symmetric, and its norm at most that of 1/m: a body that weighs less than the matter it moves
 * is as stable as any. Obeyed one step late it would throw itself out of the water, at any step (P. Causin et al. 2005, the added-mass effect).
 *
 * Bodies that move the same nodes know of each other through S. Of |R_1 y_1 + ... + R_k y_k|^2 <= k sum |R_i y_i|^2 each takes its part, so S counts once more per
 * neighbour. What a body was given beyond what it yielded, by friction, contacts and neighbours, it yields to in the next step. */
#ifndef PBMPM_SRC_CONTACT_WALL_BODIES_H
#define PBMPM_SRC_CONTACT_WALL_BODIES_H

#include "contact/walls_job.h"

/* Lists the obstacles that are rigid bodies. False: out of memory, here and below. */
bool wall_bodies_list(Walls *walls, const ContactFrame *frame, Memory *memory);

/* A node of the list that follows a wall of an obstacle: with the part `share` of the motion of the wall's foot [m]. */
typedef struct WallFoot {
    const Obstacle *obstacle;
    uint32_t follower;
    const double *foot;
    const float *share; /* a symmetric matrix, the upper triangle row by row */
} WallFoot;

/* The obstacle is a listed body. `moved`: w there. */
bool wall_bodies_grip(Walls *walls, const ContactFrame *frame, Memory *memory, const WallFoot *at, float moved[3]);

/* Finds S, once all nodes are listed. */
bool wall_bodies_bind(Walls *walls, const ContactFrame *frame, Memory *memory);

/* Bodies do not yield, until they do: G is in the vectors then. */
void wall_bodies_hold(const ApplyJob *job);
void wall_bodies_yield(const ApplyJob *job);

/* The substep is solved: bodies keep what they yielded to. */
void wall_bodies_keep(const Walls *walls, const ContactFrame *frame);

#endif

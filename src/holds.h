/* Contacts as the constraints of a minimisation over displacements: a node may approach a surface by the gap and slide along it; nodes
 * inside an obstacle that sticks are held. All work on the node blocks [begin, end). */
#ifndef PBMPM_SRC_HOLDS_H
#define PBMPM_SRC_HOLDS_H

#include "colliders.h"

/* Moves displacements (K_NODE_WIDTH floats per node) to what the contacts allow; without friction. */
void holds_project(const ContactFrame *frame, float *displacement, int32_t begin, int32_t end);

/* Finds the active contacts: those that hold, or that touch and are pushed against the surface by -gradient. What the active ones hold is taken out
 * of the gradient. */
void holds_find(const ContactFrame *frame, const float *displacement, float *gradient, int32_t begin, int32_t end);

/* Takes out of a vector what the active contacts hold. */
void holds_remove(const ContactFrame *frame, float *vector, int32_t begin, int32_t end);

/* Friction with the impulses of a solution, -gradient: a node that its surface carries along or brakes loses at most the coefficient
 * times the normal impulse over its mass; where the surface sticks, all. */
void holds_rub(const ContactFrame *frame, const float *gradient, const float *mass_node, float *displacement,
               int32_t begin, int32_t end);

/* Books what the contacts gave to matter: what the active ones hold of the gradient, and what rubbing changed from `before` to `after`.
 * Nodes that a truncated solution leaves out of balance change momentum too. Matter has it from the obstacles in the end, so contacts share it in
 * proportion to what they gave; without any it stays unaccounted. Uses up `gradient` and `before`. */
void holds_book(const ContactFrame *frame, float *gradient, float *before, const float *after, const float *base);

/* The work that moving surfaces do on the nodes of a block, if it is done on them: sum of gradient . surface over active contacts. */
double holds_work(const ContactFrame *frame, const float *gradient, int32_t block);

/* Takes out of a body's mean displacement what the active contacts of a block do not allow; a body that is held stands still. */
void holds_turn_aside(const ContactFrame *frame, int32_t block, double displacement[3]);

/* How many contacts of a block are active and not held for good. */
uint32_t holds_touching(const ContactFrame *frame, int32_t block);

/* The share of each direction that held nodes are held in, for the diagonals of a preconditioner: 3 numbers in [0, 1] per node, written
 * to the first three floats of `share`, which are 0 elsewhere. */
void holds_share(const ContactFrame *frame, float *share, int32_t begin, int32_t end);

/* Whether a node of the block is at or in an obstacle. */
bool holds_any(const ContactFrame *frame, int32_t block);

#endif

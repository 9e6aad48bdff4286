/* Contacts as the constraints of a minimisation over displacements: a node may approach a surface by the gap and slide along it; nodes
 * inside an obstacle that sticks are held. All work on the node blocks [begin, end). */
#ifndef PBMPM_SRC_CONTACT_CONTACT_CONSTRAINTS_H
#define PBMPM_SRC_CONTACT_CONTACT_CONSTRAINTS_H

#include "contact/contacts.h"

/* Moves displacements (K_NODE_WIDTH floats per node) to what the contacts allow; without friction. Where nodes follow is known later: see
 * constraints_lead(). */
void constraints_project(const ContactFrame *frame, float *displacement, int32_t begin, int32_t end);

/* Whether a contact holds or touches its node. */
bool constraints_touch(const Contact *contact, const float *u);

/* Whether a contact that does not hold touches, and is pushed by -gradient. */
bool constraints_push(const Contact *contact, const float *u, const float *gradient);

/* Takes a node that follows to its surface: if the contact is active, else not beyond it. */
void constraints_lead(const Contact *contact, float *u);

/* Finds the active contacts: those that hold, or that touch and are pushed against the surface by -gradient. What the active ones hold is taken out
 * of the gradient. */
void constraints_find_active(const ContactFrame *frame, const float *displacement, float *gradient, int32_t begin, int32_t end);

/* Takes out of a vector what the active contacts hold. */
void constraints_remove(const ContactFrame *frame, float *vector, int32_t begin, int32_t end);

/* Takes out of a vector of motions those that are not a node's own: of nodes that are held, or follow others. */
void constraints_remove_led(const ContactFrame *frame, float *vector, int32_t block);

/* As constraints_remove(), of a block's own vector. */
void constraints_remove_from(const ContactFrame *frame, float *vector, int32_t block);

/* Takes out of a node's vector what one contact holds. */
void constraints_take_out(const Contact *contact, float *vector);

/* ---- Friction ----
 *
 * In the energy that is minimised, sum_i f_i huber(|v_i|), v the slip of an active contact's node along the surface, f its limit: coefficient times what
 * the contact pushes in the iteration before. The gradient is f v / max(|v|, least), and f / max(|v|, least) the stiffness.
 *
 * What nodes push swings in an unfinished solution; their sum does not: inner forces add up to nothing, so a body's change of momentum is what its
 * contacts push. Limits are scaled to it, per body and direction of the normals. */
enum { FRICTION_GROUPS = 6 };

typedef struct FrictionGroup {
    float normal[3]; /* of its first contact */
    double push[3];
    double scale;
} FrictionGroup;

/* A body's contacts. */
typedef struct BodyFriction {
    int groups;
    bool held;        /* by nodes that stick for good: then what contacts push is not known */
    double gained[3]; /* momentum, without that of friction */
    FrictionGroup group[FRICTION_GROUPS];
} BodyFriction;

/* The least slip of a substep [cells]. */
float constraints_slip_min(const Substep *substep);

bool constraints_have_friction(const ContactFrame *frame);

/* Sorts contacts into groups; `body`: one per body, without groups. */
void constraints_group(const ContactFrame *frame, const int32_t *body_of_block, BodyFriction *body);

/* gradient += sign times friction, at the displacements u. Returns its energy. */
double constraints_friction(const ContactFrame *frame, const float *u, float *gradient, float sign, float least, int32_t block);

/* 0: it slips, or is held. */
float constraints_friction_coefficient(const Contact *contact);

/* What friction adds to the gradient at a node; false: nothing. */
bool constraints_rub(const Contact *contact, const float *u, float least, float rub[3]);

/* Friction's stiffness along the surface. */
float constraints_friction_stiffness(const Contact *contact, const float *u, float least);

/* to += sign times friction's stiffness times vector. */
void constraints_apply_friction_stiffness(const ContactFrame *frame, const float *u, const float *vector, float *to, float sign, float least, int32_t block);

/* Adds friction's stiffness to the first three floats of `weight`, which are stiffnesses along the axes. */
void constraints_friction_diagonal(const ContactFrame *frame, const float *u, float *weight, float least, int32_t block);

/* Along surfaces that rub: vector / (1 + friction's stiffness times inverse). `inverse`: one float per node. */
void constraints_soften(const ContactFrame *frame, const float *u, const float *inverse, float *vector, float least, int32_t block);

/* What friction of the contacts of a block pulls back if all nodes go by `way` from u, taken from `pull`, and its stiffness, added. */
void constraints_pull(const ContactFrame *frame, const float *u, const double way[3], float least, int32_t block, double pull[3], double *stiffness);

/* Sums what the active contacts of a block push, from a gradient without friction, and friction as it was; then scales, then new limits. */
void constraints_sum_push(const ContactFrame *frame, const float *u, const float *gradient, float least, int32_t block, BodyFriction *body);
void constraints_scale(BodyFriction *body);
void constraints_set_limits(const ContactFrame *frame, int32_t block, const BodyFriction *body);

/* Whether a contact holds its node in all directions. */
bool constraints_stick(const Contact *contact);

/* ---- What contacts give ---- */

/* Books what the contacts gave to matter at u: what the active ones hold of the gradient, and friction.
 * Nodes that a truncated solution leaves out of balance change momentum too. Matter has it from the obstacles in the end, so contacts share it in
 * proportion to what they gave; without any it stays unaccounted. `after`: the displacements that make the velocities. Uses up `gradient`. */
void constraints_book_impulses(const ContactFrame *frame, float *gradient, const float *u, const float *after, const float *base, float least);

/* The first half of that: what each contact gave. */
void constraints_book_contacts(const ContactFrame *frame, float *gradient, const float *u, float least);

/* What was booked of a block's contacts becomes `factor` times as much. */
void constraints_scale_impulses(const ContactFrame *frame, int32_t block, double factor);

/* The energy that friction of a block takes. */
double constraints_friction_loss(const ContactFrame *frame, const float *u, float least, int32_t block);

/* In the joint solver, and where matter pushes rigid bodies: the work that moving surfaces do on the nodes of a block, if it is done on them. It is the sum of
 * (gradient - friction) . surface over active contacts. */
double constraints_work(const ContactFrame *frame, const float *gradient, const float *u, float least, int32_t block);

/* What active contacts of moving surfaces do, with its sign: what recedes takes energy. */
typedef struct ContactExchange {
    double work, size;             /* sums of work and of sizes of impulses */
    double given[3], surface[3];   /* of impulses, and of surfaces' motions times sizes */
} ContactExchange;

enum { EXCHANGE_SUMS = sizeof(ContactExchange) / sizeof(double) };

/* Adds those of a block. */
void constraints_exchange(const ContactFrame *frame, const float *gradient, const float *u, float least, int32_t block, ContactExchange *sum);

/* Adds those of what holds a block's nodes that stay (joint.h): work by their own motion, or of those that follow by that of their walls, and the motion of these. */
void constraints_exchange_staying(const ContactFrame *frame, const float *gradient, int32_t block, ContactExchange *sum);

/* The work of moving surfaces on a body that gained this momentum. Impulses of an unfinished solution do not add up to it: what is missing goes with the surfaces' mean
 * motion. So energies are compared alike by all who move along, however far the solution is. */
double constraints_exchanged_work(const ContactExchange *all, const double gained[3]);

/* Takes out of a body's mean displacement what the active contacts of a block do not allow; a body that is held stands still. */
void constraints_turn_aside(const ContactFrame *frame, int32_t block, double displacement[3]);

/* The share of that displacement that no contact of the block ends. */
double constraints_free_share(const ContactFrame *frame, int32_t block, const double displacement[3]);

/* How many contacts of a block are active and not held for good. */
uint32_t constraints_active(const ContactFrame *frame, int32_t block);

/* The share of each direction that held nodes are held in, for the diagonals of a preconditioner: 3 numbers in [0, 1] per node, written
 * to the first three floats of `share`, which are 0 elsewhere. */
void constraints_held_share(const ContactFrame *frame, float *share, int32_t begin, int32_t end);

/* Whether a node of the block is held in all directions. */
bool constraints_any_stick(const ContactFrame *frame, int32_t block);

/* How many contacts a block has. */
uint32_t constraints_count(const ContactFrame *frame, int32_t block);

/* Which nodes of the block may approach an obstacle by this at most: a bit each. */
uint64_t constraints_within(const ContactFrame *frame, float most, int32_t block);

/* How far a displaced node may go on towards the surface. */
float constraints_room(const Contact *contact, const float *u);

#endif

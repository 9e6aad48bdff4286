/* What the dual's stresses gain per body in a substep. With w the displacement that matter brought, u that which was found, and q the push of the stresses, a body gains
 *
 *     K(u) - m g.u - K(w) = q.u - m/2 |u - w|^2
 *
 * beside the work of walls and of force fields: the work of the stresses less what backward Euler takes. What walls do is c.u with c their push, and c.u <= c.v with v the motion
 * of the wall; so it drops out, at rest or not, and who moves along finds the same gain. */
#ifndef PBMPM_SRC_SOLVERS_DUAL_DUAL_GAINS_H
#define PBMPM_SRC_SOLVERS_DUAL_DUAL_GAINS_H

#include "world/world.h"

/* Of a body [kg cell^2 / substep^2, kg]. */
typedef struct DualGain {
    double gain;
    double work;       /* q.u */
    double brought;    /* K(w) */
    double kinetic;    /* K(u) */
    double mass;
    double momentum[3];
    double at_obstacle; /* above 0: it may touch one */
} DualGain;

/* False without memory. */
bool dual_gains_prepare(World *world);
void dual_gains_free(World *world);

/* Finds those of all bodies. */
void dual_gains_find(World *world);

/* Of body number `body`, and of that in a block. */
const DualGain *dual_gain(const World *world, int32_t body);
const DualGain *dual_gain_in(const World *world, int32_t block);

#endif

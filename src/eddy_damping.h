/* Eddy damping: liquids of the dual and the joint solver pay for what their pressures gain.
 *
 * Incompressible liquid stores no energy. What the dual does to mend its volume is work of its pressures that nothing paid for, and where particles move it stirs a
 * pool for ever. With w the displacement that matter brought, u that which was found, and q the push of the pressures, a substep gains
 *
 *     K(u) - m g.u - K(w) = q.u - m/2 |u - w|^2
 *
 * beside the work of walls, and of force fields: the work of the pressures less what backward Euler takes. What mends stirs eddies of some cells, and transfers smooth eddies where
 * particles have no affine velocities: of their energy E, those that turn as fast as k v have the part (k h)^2 / 4 there (h: a cell). So, as if all of a body's
 * kinetic energy K about its mean motion were that of eddies, its affine velocities keep the share s,
 *
 *     s^2 = 1 - gain / (K (k h)^2 / 4).
 *
 * A wave of many cells has little of its energy there, and goes on. What the grid shows to be crushed keeps all: what it gains bursts it, and stirs no eddies. Momentum
 * does not change; angular momentum may only where a body touches an obstacle, so one that touches none keeps all: nothing presses it. In the joint solver the gain is that of
 * the primal's last part, see primal_liquid.c, and a body that may touch one pays. */
#ifndef PBMPM_SRC_EDDY_DAMPING_H
#define PBMPM_SRC_EDDY_DAMPING_H

#include "world.h"

/* False without memory. */
bool eddy_damping_prepare(World *world);
void eddy_damping_free(World *world);

/* After the dual has ended: finds the shares for the integration. */
void eddy_damping_find(World *world);

/* s of a body that gained this, with this kinetic energy about its mean motion [both in the same unit]. */
float eddy_damping_share(double gain, double kinetic);

/* Sets args.affine_kept and returns it: a share per block of particles, for the caller to fill. Null where nothing is damped. */
float *eddy_damping_shares(World *world);

#endif

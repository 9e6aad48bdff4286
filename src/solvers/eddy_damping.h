/* Eddy damping: liquids of the dual and the joint solver pay for what their pressures gain.
 *
 * Incompressible liquid stores no energy. What the dual does to mend its volume is work of its pressures that nothing paid for, and where particles move it stirs a
 * pool for ever. What a body gains is that of dual_gains.h. What mends stirs eddies of some cells, and transfers smooth eddies where particles have no affine velocities: of their energy E, those that turn as fast as k v have the part (k h)^2 / 4 there (h: a cell). So, as if all of a body's
 * kinetic energy K about its mean motion were that of eddies, its affine velocities keep the share s,
 *
 *     s^2 = 1 - gain / (K (k h)^2 / 4).
 *
 * What that does not pay is owed: a stiff body that turned in a full box drove the water by 5 % a second. From the motion that a substep leaves to that which matter
 * brings to the next, transfers lose energy; so with `left` what it left less what it gained, the debt is
 *
 *     debt' = debt + K(w) - left,
 *
 * what matter has more than gravity, fields and obstacles gave it. Bodies that gain pay it with what they gain, in the same proportion. A debt below zero is credit: where a wave
 * rises and falls, what one substep loses another brings back. Credit is forgotten, by 1/e in the time in which matter falls through its depth and rises again, without gravity at once; a splash does not pay for what
 * stirs later. With 1/20 of a second instead waves of a tank kept 0.63 of their height over nine periods, with half a second 0.94, and forgetting nothing lets pools over a ridge stir as
 * if there were no account (tests/field, standing_wave and creased_floor). The account is of one group of islands; where particles come to it or leave, it begins anew.
 *
 * A wave of many cells has little of its energy there, and goes on. What the grid shows to be crushed keeps all: what it gains bursts it, and stirs no eddies. Momentum
 * does not change; angular momentum may only where a body touches an obstacle, so one that touches none keeps all: nothing presses it. In the joint solver the gain is that of
 * the primal's last part, see primal_liquid.c, and a body that may touch one pays. */
#ifndef PBMPM_SRC_SOLVERS_EDDY_DAMPING_H
#define PBMPM_SRC_SOLVERS_EDDY_DAMPING_H

#include "world/world.h"

/* False without memory. */
bool eddy_damping_prepare(World *world);
void eddy_damping_free(World *world);

/* Whether there is something to damp. */
bool eddy_damping_acts(const World *world);

/* After the dual has ended, and dual_gains_find(): finds the shares for the integration. */
void eddy_damping_find(World *world);

/* s of a body that has to pay this, with this kinetic energy about its mean motion [both in the same unit]. */
float eddy_damping_share(double gain, double kinetic);

/* What the bodies of a group gained together, and what they brought and left [kg cell^2 / substep^2]. */
typedef struct EddyGains {
    double gained; /* of those that pay */
    double before, left;
} EddyGains;

/* Settles the account of the group. Returns what has to be paid over what was gained, at least 1. */
double eddy_damping_settle(World *world, const EddyGains *gains);

/* The debt that the group's last substep left [kg cell^2 / substep^2]; none where there is credit. */
double eddy_damping_owed(const World *world);

/* Somebody else changed the motion of particles: debts are forgotten. */
void eddy_damping_forget(World *world);

/* Sets args.dual.affine_kept and returns it: a share per block of particles, for the caller to fill. Null where nothing is damped. */
float *eddy_damping_shares(World *world);

#endif

/* Walls hold viscous liquid: no slip.
 *
 * While viscosity acts, a node behind a wall takes its whole motion from nodes before it in proportion to the distance, and not its normal part alone: the flow of a
 * viscous liquid is at rest on the wall, and to first order linear in the distance. With E the map of walls.h, E~ that map, and K the viscous operator,
 *     u~ changes by M^-1 E~^T K (E~ u~ + c~0),   E~ = E B.
 * At a node with orthogonal normals n_k and scales s_k (walls_find.c), E = sum_k s_k n_k n_k^T + (1 - sum_k n_k n_k^T) and
 *     B = sum_k (product of s_j, j != k) n_k n_k^T + (product of all s_j) (1 - sum_k n_k n_k^T),
 * products over the walls that hold it. So what viscosity gives a node behind a wall is multiplied by B, and E^T brings it to the nodes before the wall. What a node
 * that was let go has itself (walls_unilateral.h) is part of E, and multiplied by B, too: so the map is symmetric. Its norm is at most that without the wall, as long as no factor is greater than 1 in size: M counts the mass behind the wall once.
 * What B takes away is what the wall gives. It is in proportion to the viscosity: water slips, honey sticks.
 *
 * Rigid bodies do not hold: they yield to E^T alone, and would be pushed back and forth by a shear that they are told of one step late. */
#ifndef PBMPM_SRC_CONTACT_WALL_SHEAR_H
#define PBMPM_SRC_CONTACT_WALL_SHEAR_H

#include "contact/walls_job.h"

/* One stage of a Runge-Kutta-Legendre round, see ispc/viscosity.isph: u_j = last u_(j-1) + before u_(j-2) + what viscosity changes. `base` and `push` have
 * u_(j-1) and u_(j-2), without walls; 4 floats per node. */
typedef struct WallStage {
    float *base, *push;
    float last, before;
} WallStage;

/* Begins to count what walls give. */
void wall_shear_begin(const Walls *walls);

/* Adds the loops before a stage, which must live until they ran. They put the nodes behind walls where E~ says; and behind it, before walls are obeyed. */
void wall_shear_hold(const Walls *walls, const ContactFrame *frame, Loops *loops, const WallStage *stage);
void wall_shear_give(const Walls *walls, const ContactFrame *frame, Loops *loops, const WallStage *stage);

/* Adds what the walls gave since to the impulses of their obstacles. */
void wall_shear_book(const Walls *walls, const ContactFrame *frame);

#endif

/* Walls push and do not pull: Signorini's condition, at nodes that solids reach; in the joint solver also at those that follow such nodes.
 *
 * A node that follows a wall's normal n holds n.(u - s) = k n.(b - s), with b the motion before it, s that of the wall and k <= 1, see walls.h. Unilateral it is
 *     n.(u - s) >= k n.(b - s),
 * and the wall gives the node what that takes: an impulse along n that is never negative. Of all admissible motions the one nearest to the momenta p is sought, in
 * the norm of the masses. For one node m and its parent M, with u* = p / m and b* = P / M, it is u = u*, b = b* where these obey the condition, and else the motion that
 * follows. So u* and b* decide, in each walls_apply() anew; a map to the nearest point of a convex set is no longer than that to a plane in it, as dual.isph needs.
 * With several parents b* is their mean.
 *
 * Where it is let go a node has its normal motion itself; along the wall it still follows, see walls.h, unless it slips, see joint.h.
 * Liquid is held by the pressure before the wall, which its particles do not bear: see leaves() in walls_find.c. */
#ifndef PBMPM_SRC_CONTACT_WALLS_UNILATERAL_H
#define PBMPM_SRC_CONTACT_WALLS_UNILATERAL_H

#include "contact/walls_job.h"

/* Whether what a listed node has itself or is followed by hangs on such nodes. */
bool unilateral_beside(const Walls *walls, const WallNode *node);

/* Decides which walls hold. To be added before momenta are sent back. */
void unilateral_add(const ApplyJob *job, Loops *loops);

/* The same by the predictor, for what is found once: S of wall_bodies.h. */
void unilateral_begin(const Walls *walls, const ContactFrame *frame, Pool *pool);

#endif

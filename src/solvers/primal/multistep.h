/* BDF2, the backward difference of second order, for elastic bodies of the primal solver.
 *
 * With the last displacement d, the velocity v and the one before, w, a substep of length dt obeys
 *     u = d/3 + (2 dt/9) (4 v - w) + (4/9) dt^2 a(u),   v' = (3 u - d) / (2 dt):
 * backward Euler with another predictor and 4/9 of all forces and stiffnesses. The same for the displacement gradients and affine velocities.
 *
 * It needs a past of equal steps. A body takes a step of backward Euler when a particle in it has none: new or edited matter, after a step
 * of another length, or that was pushed by an obstacle. An impact is no smooth motion: v' = (3 u - d) / (2 dt) of a body that has been stopped
 * would be -d / (2 dt), a bounce that comes from nothing. So a body that an obstacle pushes finishes with v' = u / dt, and has no past. Nodes
 * held for good by an obstacle that sticks do not count. Bodies with liquid, sand or visco always take backward Euler. */
#ifndef PBMPM_SRC_SOLVERS_PRIMAL_MULTISTEP_H
#define PBMPM_SRC_SOLVERS_PRIMAL_MULTISTEP_H

#include "world/world.h"

/* No particle has a past. For substeps that do not keep it. */
void multistep_expire(World *world);

/* Takes memory if this substep is one of BDF2; else the past expires. Bodies have been found. */
pbmpm_result multistep_prepare(World *world);
void multistep_free(World *world);

/* Chooses the share of forces for each block, see KernelArgs.primal.block_share. */
void multistep_bind(World *world);

/* Scales the predictor's forces by the shares. After this node_base is the predictor of the step, without contacts. */
void multistep_predict(World *world, int32_t begin, int32_t end);

/* Lets the blocks of a body finish with backward Euler and forget its past. */
void multistep_forget(World *world, int32_t block);

#endif

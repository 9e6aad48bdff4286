/* The solver of a substep: its choice, binding the kernels, the predictor, integration. */
#ifndef PBMPM_SRC_SOLVERS_SOLVER_H
#define PBMPM_SRC_SOLVERS_SOLVER_H

#include "world/world.h"

/* Chooses the solver of this substep and takes the memory that it needs. The grid is built. */
pbmpm_result solver_prepare(World *world);

/* What PBMPM_SOLVER_CONVERGENT stands for in the next substep where matter of these kinds, see islands.h, touches. */
pbmpm_solver solver_for(const World *world, uint32_t matter);

/* Whether the substep may need the volume on the grid, asked before the grid is built; and whether it does. */
bool solver_may_want_volume(const World *world);
bool solver_wants_volume(const World *world);

/* Points the kernel arguments at the world's arrays, for substeps as in world->substep. */
void solver_bind(World *world, bool with_volume);

/* First P2G and predictor. */
void solver_predict(World *world);

/* Solves for the displacements of the nodes. `contacts`: what they obey. */
void solver_solve(World *world, const ContactFrame *contacts);

/* Last G2P: moves the particles of these blocks and updates J and F. */
void solver_integrate(World *world, int32_t begin, int32_t end);

/* Before the first block and after the last one. */
void solver_before_going(World *world);
void solver_after_going(World *world, const ContactFrame *contacts);

/* Whether solver_after_going() changes particles, by what all of them did. */
bool solver_ends_by_primal(const World *world);

/* Whether nodes at walls follow others, see walls.h: so walls bear the pressure of a liquid. For solids without liquid they
 * do not, for what leans on two walls would creep round the corner between them: a block in a box as wide as itself sank by 1 to 4 % in 20 s. One
 * iteration bears no weight whatever it does; where they follow what lies in a row of cells then has no strain that later, stiffer substeps throw up. */
bool solver_follows_walls(const World *world);

#endif

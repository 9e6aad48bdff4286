/* What all solvers share: binding the kernels, the predictor, the choice of a solver, stop rules, integration. */
#ifndef PBMPM_SRC_SOLVERS_SOLVER_H
#define PBMPM_SRC_SOLVERS_SOLVER_H

#include "world/world.h"

/* Chooses the solver of this substep and takes the memory that it needs. The grid is built. */
pbmpm_result solver_prepare(World *world);

/* What PBMPM_SOLVER_CONVERGENT stands for where matter of these kinds, see islands.h, touches; itself for the joint solver. */
pbmpm_solver solver_for(uint32_t matter, int iterations);

/* Whether the substep needs the volume on the grid; asked before the grid is built. */
bool solver_wants_volume(const World *world);

/* Points the kernel arguments at the world's arrays, for substeps of `dt` seconds. */
void solver_bind(World *world, float dt, bool with_volume);

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

/* ---- For the solvers ---- */

/* Whether the dual solver works in this substep, alone or with the primal. */
bool solver_uses_dual(const World *world);

/* A kg cell^2 / substep^2 in Joule. */
double solver_joule(const World *world);

/* Solids get the moduli that the dual solver is asked for, or the primal. */
void solver_set_solids(World *world, bool by_dual);

/* Runs a kernel over all particle blocks. */
void solver_over_particles(World *world, Kernel *kernel);

/* The same over those whose particles sleep. */
void solver_over_still(World *world, Kernel *kernel);

/* Makes the motion of the nodes admissible at walls and contacts. */
void solver_obey(World *world, const ContactFrame *contacts);

/* Runs a kernel over all particle blocks, and then one over all node blocks, which then obey `contacts` (may be null). */
void solver_over_both(World *world, Kernel *rows, Kernel *nodes, const ContactFrame *contacts);

/* The same as loops that are added to others. *args and *contacts have to live as long as those. */
void solver_add_rows(Loops *loops, const World *world, Kernel *kernel, KernelArgs *args);
void solver_add_nodes(Loops *loops, const World *world, Kernel *kernel, KernelArgs *args, const ContactFrame *contacts);

/* Whether the grid was built with a particle of a liquid. */
bool solver_holds_liquid(const World *world);
bool solver_holds_sand(const World *world);

/* Whether the solver of this substep asks for the volume on the grid, beside the materials; asked before solver_prepare(). */
bool solver_wants_volume(const World *world);

/* The share per substep that makes def->volume_feedback per 1/60 s at any rate. */
float solver_feedback_share(const pbmpm_material_def *def, float dt);

/* Whether nodes at walls follow others, see walls.h: so walls bear the pressure of a liquid. For solids without liquid they
 * do not, for what leans on two walls would creep round the corner between them: a block in a box as wide as itself sank by 1 to 4 % in 20 s. One
 * iteration bears no weight whatever it does; where they follow what lies in a row of cells then has no strain that later, stiffer substeps throw up. */
bool solver_follows_walls(const World *world);

/* Whether the time budget of the step is spent. */
bool solver_time_is_up(const World *world);

/* Whether another iteration is wanted after record.iterations_used of them, with the error that is predicted now [cells].
 * Records the prediction and, at the end, what ended the iterations. */
bool solver_may_go_on(World *world, double predicted_error);

#endif

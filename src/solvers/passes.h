/* What solvers are made of: kernels over blocks, stop rules, and what they ask of a substep. */
#ifndef PBMPM_SRC_SOLVERS_PASSES_H
#define PBMPM_SRC_SOLVERS_PASSES_H

#include "world/world.h"

/* Whether the dual solver works in this substep, alone or with the primal. */
bool solver_uses_dual(const World *world);

/* Whether the dual and the primal work together in this substep, see joint.h. */
static inline bool joint_is_chosen(const World *world) { return world->record.solver == SOLVER_JOINT; }

/* Steps before the iterations: of the guess (the joint solver's takes N), and of the primal alone on solids in a
 * liquid. By trial. Three carry pressure through a pool of some 12 cells. A fourth calms two floors of tests/field
 * (ridge_15 from 24 to 2 mm/s, shelf from 16 to 2) and stirs others (ball from 14 to 21, drips from 74 to 108). It
 * costs a tenth of a step, and heaps of sand flatten by two degrees more. */
enum { LEADING_STEPS = 3 };

/* Largest growth that crushed liquid is asked for: by the paper's solver without gravity, per substep; by the dual, see growth_max() in dual/dual.c. By trial. */
static const double CRUSHED_GROWTH = 0.3;

#define ENERGY_ROUNDING 5e-7 /* of sums of energies in single precision */

/* A kg cell^2 / substep^2 in Joule. */
double solver_joule(const World *world);

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

/* Whether J of a material follows what the grid holds: of what keeps no shape, and of sand with the dual solver, see ispc/granular.isph. */
bool solver_follows_grid(const World *world, uint32_t slot);

/* The share per substep that makes def->volume_feedback per 1/60 s at any rate. */
float solver_feedback_share(const World *world, const pbmpm_material_def *def);

/* Whether the time budget of the step is spent. */
bool solver_time_is_up(const World *world);

/* Whether another iteration is wanted after record.iterations_used of them, with the error that is predicted now [cells].
 * Records the prediction and, at the end, what ended the iterations. */
bool solver_may_go_on(World *world, double predicted_error);

#endif

/* The position based solver: C. Lewin, "A Position Based Material Point Method", SIGGRAPH 2024 Talks.
 *
 * Each iteration gathers the displacements of the nodes to the particles, projects each particle's displacement gradient
 * towards its material's constraint, and scatters the result back as new node displacements. */
#ifndef PBMPM_SRC_SOLVERS_PAPER_H
#define PBMPM_SRC_SOLVERS_PAPER_H

#include "world/world.h"

/* What the projections need to know about the substep. */
void paper_set_materials(World *world);

void paper_solve(World *world, const ContactFrame *contacts);

/* The share of the deviator that each iteration removes: the material's own, and what stands for its kinematic viscosity nu. A change dD is the
 * impulse of the stress -rho dx^2 / (4 dt^2) dD; with dD = -s dev(D), D = dt grad v, that is 2 rho nu dev(grad v) with nu = s dx^2 / (8 dt), once
 * per iteration. At most 1. */
double paper_viscous_share(const World *world, const pbmpm_material_def *def, const Substep *substep);

#endif

/* The dual solver: backward Euler with the materials' own moduli, for liquids and for liquids and elastic bodies together.
 * The equations stand in ispc/dual.isph. */
#ifndef PBMPM_SRC_DUAL_H
#define PBMPM_SRC_DUAL_H

#include "solver.h"

/* Takes memory for the blocks and particles of this substep. */
pbmpm_result dual_prepare(World *world);

void dual_free(World *world);

void dual_solve(World *world, const ContactFrame *contacts);

/* The share of an elastic material's stiffness that the iterations of a substep can hold, and the share that they are asked for. */
double dual_stiffness_share(const World *world, const pbmpm_material_def *def, double substep);
double dual_stiffness_cap(const World *world, const pbmpm_material_def *def, double substep);

#endif

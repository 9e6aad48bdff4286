/* Explicit MLS-MPM (Y. Hu et al., "A Moving Least Squares Material Point Method with Displacement Discontinuity and Two-Way Rigid Body
 * Coupling", ACM TOG 37(4), 2018), to compare with: u = u* - (1/m) sum m w T (x_i - x_p) with the stresses T at the start of the substep. */
#ifndef PBMPM_SRC_SOLVERS_EXPLICIT_H
#define PBMPM_SRC_SOLVERS_EXPLICIT_H

#include "world/world.h"

/* What the kernels need to know of materials. */
void explicit_set_materials(World *world);

/* Takes memory for the blocks and particles of this substep. */
pbmpm_result explicit_prepare(World *world);

void explicit_solve(World *world, const ContactFrame *contacts);

#endif

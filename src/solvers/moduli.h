/* What solvers but the paper's make of the moduli of materials: they lose their units. */
#ifndef PBMPM_SRC_SOLVERS_MODULI_H
#define PBMPM_SRC_SOLVERS_MODULI_H

#include "world/world.h"

/* c = 4 dt^2 / (dx^2 rho) makes the energy of a substep sum m/2 |u - u*|^2 + sum m dx^2/4 c Psi, see ispc/dual.isph. */
double moduli_unit(const pbmpm_material_def *def, const Substep *substep);

/* All materials: solids as stiff as they are, and so are liquids. Those without a bulk modulus are as stiff as `stiffest`, which
 * bounds all of them with PBMPM_SOLVER_CONVERGENT. */
void moduli_set(World *world, float stiffest);

/* The share of its stiffness that sand gets of the dual and the primal solver. F holds the deviator that it bears as c mu times a strain, to 2^-23 c mu: with the most
 * to 1e-3, a hundredth of the pressure below one cell at 60 Hz. What iterations hold is far less. */
double moduli_sand_share(const pbmpm_material_def *def, const Substep *substep);

/* A solid with a share of its stiffness. */
void moduli_set_solid(World *world, uint32_t slot, double share);

#endif

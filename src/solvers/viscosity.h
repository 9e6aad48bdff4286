/* Kinematic viscosity of liquids: changes the predictor before the pressure is solved for. The equations stand in
 * ispc/viscosity.isph. */
#ifndef PBMPM_SRC_SOLVERS_VISCOSITY_H
#define PBMPM_SRC_SOLVERS_VISCOSITY_H

#include "world/world.h"

/* Stages that a substep takes at most; what needs more acts with less viscosity. */
enum { VISCOUS_STAGES_MAX = 64 };

/* The share of the deviator that a liquid's viscosity takes in a substep, at most what all stages can. */
double viscosity_share(const World *world, const pbmpm_material_def *def);

/* Takes memory for the blocks of this substep, if any liquid is viscous. */
pbmpm_result viscosity_prepare(World *world);

void viscosity_apply(World *world, const ContactFrame *contacts);

#endif

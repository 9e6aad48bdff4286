/* Kinematic viscosity of liquids: changes the predictor before the pressure is solved for. The equations stand in
 * ispc/viscosity.isph. */
#ifndef PBMPM_SRC_SOLVERS_VISCOSITY_H
#define PBMPM_SRC_SOLVERS_VISCOSITY_H

#include "world/world.h"

/* A substep takes so many rounds of so many stages at most; what needs more acts with less viscosity. The stress of liquid that bears nothing is not linear, and long
 * rounds do not know that: random motion in 3D lost 10 % of its energy in one of 32 stages, and gained 11 % in one of 64. By trial. */
enum { VISCOUS_STAGES_MAX = 32, VISCOUS_ROUNDS_MAX = 4 };

/* What a liquid's viscosity makes of D in a substep, at most what all stages can: `share` in ispc/viscosity.isph. */
double viscosity_share(const World *world, const pbmpm_material_def *def);

/* Whether any liquid in this substep is viscous by its own material; the paper's solver has another way. */
bool viscosity_acts(const World *world);

/* Takes memory for the blocks of this substep, if any liquid is viscous. */
pbmpm_result viscosity_prepare(World *world);

void viscosity_apply(World *world, const ContactFrame *contacts);

#endif

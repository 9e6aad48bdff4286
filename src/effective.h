/* How stiff materials are with a world's settings. */
#ifndef PBMPM_SRC_EFFECTIVE_H
#define PBMPM_SRC_EFFECTIVE_H

#include "world.h"

/* `substep`: its length [s]. */
pbmpm_effective effective_modulus(const World *world, const pbmpm_material_def *def, double substep);

#endif

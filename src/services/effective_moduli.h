/* How stiff materials are with a world's settings. */
#ifndef PBMPM_SRC_SERVICES_EFFECTIVE_MODULI_H
#define PBMPM_SRC_SERVICES_EFFECTIVE_MODULI_H

#include "world/world.h"

/* Of a live material in such a substep. With PBMPM_SOLVER_CONVERGENT it looks where the particles are. */
pbmpm_effective effective_modulus(World *world, uint32_t slot, const Substep *substep);

#endif

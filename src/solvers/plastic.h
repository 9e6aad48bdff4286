/* What the kernels want to know of sand and viscoplastic materials for a substep. */
#ifndef PBMPM_SRC_SOLVERS_PLASTIC_H
#define PBMPM_SRC_SOLVERS_PLASTIC_H

#include "world/world.h"

/* Sets how a material yields. `bulk_over_shear`: (2 mu + d lambda) / (2 mu) of the solver's law. */
void plastic_set(World *world, uint32_t slot, double bulk_over_shear);

#endif

/* What drains and kill bounds do in a step. */
#ifndef PBMPM_SRC_STEP_DRAINING_H
#define PBMPM_SRC_STEP_DRAINING_H

#include "world/world.h"

/* Gives the particles that drains and bounds take the status K_REMOVED, and says how many. The particles are as the grid sorted them. */
uint32_t sinks_mark(World *world, uint32_t substep);

#endif

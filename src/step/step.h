/* One step of a world. */
#ifndef PBMPM_SRC_STEP_STEP_H
#define PBMPM_SRC_STEP_STEP_H

#include "world/world.h"

/* Advances the world by dt seconds in settings.substeps parts; dt is valid. */
pbmpm_result world_step(World *world, float dt);

#endif

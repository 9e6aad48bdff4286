/* The grids of groups of islands; see islands.h. */
#ifndef PBMPM_SRC_STEP_BUILD_GROUPS_H
#define PBMPM_SRC_STEP_BUILD_GROUPS_H

#include "world/world.h"

/* In place of grid_build(): finds the islands and builds the grid of each group. */
pbmpm_result islands_build(World *world);

#endif

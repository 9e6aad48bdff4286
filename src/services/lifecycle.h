/* Making worlds and taking them apart. */
#ifndef PBMPM_SRC_SERVICES_LIFECYCLE_H
#define PBMPM_SRC_SERVICES_LIFECYCLE_H

#include "world/world.h"

/* The definition is valid. */
pbmpm_result world_create(const pbmpm_world_def *def, World **world);
void world_destroy(World *world);

#endif

/* Which materials touch which colliders. */
#ifndef PBMPM_SRC_SERVICES_COLLIDER_TOUCHES_H
#define PBMPM_SRC_SERVICES_COLLIDER_TOUCHES_H

#include "world/world.h"

/* Arguments have been checked. On failure nothing has changed but *count. */
pbmpm_result collider_touches_find(World *world, pbmpm_touch *touches, uint32_t capacity, uint32_t *count);

#endif

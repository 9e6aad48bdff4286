/* How much of an obstacle is under matter; pbmpm/rigid.h says what that is. */
#ifndef PBMPM_SRC_SERVICES_SUBMERGED_H
#define PBMPM_SRC_SERVICES_SUBMERGED_H

#include "world/world.h"

/* Of all matter. */
enum { ANY_MATERIAL = -1 };

/* The collider is bounded. `material`: a slot, or ANY_MATERIAL. */
pbmpm_result submerged_measure(World *world, const Collider *collider, int material, pbmpm_submersion *submersion);

#endif

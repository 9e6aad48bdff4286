/* Moving the origin of a world, for scenes that are larger than the precision of a float. */
#ifndef PBMPM_SRC_SERVICES_ORIGIN_H
#define PBMPM_SRC_SERVICES_ORIGIN_H

#include "world/world.h"

/* By the whole blocks nearest to `wanted` [m]; writes to `moved` what that was. On failure nothing has changed. */
pbmpm_result origin_shift(World *world, const double wanted[3], double moved[3]);

#endif

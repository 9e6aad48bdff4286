/* How far it is to an obstacle along a line. */
#ifndef PBMPM_SRC_SERVICES_RAY_H
#define PBMPM_SRC_SERVICES_RAY_H

#include "world/world.h"

/* Metres from a point to the first obstacle that matter of a material meets, however thin that is; infinitely many if there is none within `far`.
 * `along`: of length 1, in 2D without a third number. An obstacle that the line goes along, or away from, stops nothing. */
double ray_to_obstacle(const World *world, uint32_t slot, const double from[3], const double along[3], double far);

/* The same of the domain's walls. */
double ray_to_wall(const World *world, const double from[3], const double along[3], double far);

#endif

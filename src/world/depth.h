/* How high matter stands. */
#ifndef PBMPM_SRC_WORLD_DEPTH_H
#define PBMPM_SRC_WORLD_DEPTH_H

#include "world/world.h"

/* The length along gravity over which even matter lies if all but a fiftieth at either end do so, in cells times |g|: a stray particle far away
 * does not count. It follows matter that moves without leaps: what it asks for would make bodies swing. */
double depth_along_gravity(const World *world);

/* The same of those in the grid, in cells; without gravity the edge of a cube as large as the blocks with matter. At least 1. Found once the
 * grid stands, for all who ask in that substep. */
void matter_depth_find(World *world);
double matter_depth(const World *world);

/* The same of the liquid in the grid alone, found at once. 1 without gravity. */
double liquid_depth(const World *world);

/* sqrt(a) of the slowest mode of the pressure in matter that rests on something: a wave with the wave number k per cell has the eigenvalue
 * a = (k / 2)^2 of "scatter stresses, gather gradients", and the slowest is a quarter wave over the n cells of the depth, a = (pi / 4n)^2. */
double slowest_pressure(const World *world);

/* |g| [m/s^2]. */
double gravity_strength(const World *world);

/* The direction that gravity pulls in; zeros without gravity. Returns |g|. */
double gravity_direction(const World *world, double down[3]);

/* What gravity moves matter by in a substep: |g| dt^2 / dx [cells]. */
double gravity_fall(const World *world, const Substep *substep);

#endif

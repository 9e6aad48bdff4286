/* Where obstacles, walls of the domain and drains came, went or changed since the last step: what rested there may have lost what it stood on. Known is the box around
 * all of these places. Obstacles that move are none of them: what they free is seen by its motion. */
#ifndef PBMPM_SRC_WORLD_STIRRED_H
#define PBMPM_SRC_WORLD_STIRRED_H

#include "world/world.h"

/* What is closer than `reach` cells to a solid; null: everything. */
void stirred_add(World *world, const Solid *solid, double reach);

void stirred_shift(World *world, const double by[3]); /* the origin, by so much [m] */

/* At the end of a step. */
void stirred_clear(World *world);

/* Whether a block of the grid reaches there. */
bool stirred_meets(const World *world, int32_t block);

#endif

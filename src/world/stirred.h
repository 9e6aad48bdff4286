/* Where obstacles, drains and forces came, went or changed since the last step: what rested there may have lost what it stood on. */
#ifndef PBMPM_SRC_WORLD_STIRRED_H
#define PBMPM_SRC_WORLD_STIRRED_H

#include "world/world.h"

/* What is closer than `reach` cells to a solid. */
void stirred_add(World *world, const Solid *solid, double reach);

/* At the end of a step. */
void stirred_clear(World *world);

/* Whether a block of the grid reaches there. */
bool stirred_meets(const World *world, int32_t block);

#endif

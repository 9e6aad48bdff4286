/* The groups of a world's islands, see islands.h: which there are, and one at a time. */
#ifndef PBMPM_SRC_WORLD_ISLAND_GROUPS_H
#define PBMPM_SRC_WORLD_ISLAND_GROUPS_H

#include "world/world.h"

/* Which of KIND_SOLID and so on the particles are that are counted in particles.of_material. */
uint32_t islands_kinds(const World *world);

/* Whether more than one group may come of it: the convergent solver, and matter of several kinds. */
bool islands_wanted(const World *world);

/* Between steps: finds the groups that the next substep will have, without their grids. False: no memory. */
bool islands_foresee(World *world);

/* All that is done between them is done to one group. */
void islands_enter(World *world, int group);
void islands_leave(World *world, int group);

/* Between steps: the grid of a group of the last substep. */
const Grid *islands_grid(const World *world, int group);

#endif

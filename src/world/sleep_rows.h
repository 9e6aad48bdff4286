/* Where the particles of blocks that sleep stand among the others. */
#ifndef PBMPM_SRC_WORLD_SLEEP_ROWS_H
#define PBMPM_SRC_WORLD_SLEEP_ROWS_H

#include "world/world.h"

/* Whether the particles of a block of the grid stay where they are in this substep. */
bool sleep_is_still(const World *world, int32_t block);

/* Blocks that are leaving are asleep from now on; those that are woken are not. The grid of the last substep is no longer that of the rows. */
void sleep_settle(World *world);

/* Substeps until what happens at one end of a block of these rows is known at the other: 0 in elastic matter and clay, FLT_MAX in liquid alone. */
float sleep_crossing(const World *world, uint32_t first, uint32_t count);

/* Takes all that are woken or called (stage drowsy) out of those that are asleep; they become active. */
void sleep_take_out(World *world);

/* After all else of a snapshot was restored: who sleeps must be where it says, else all wake. */
void sleep_check_rows(World *world);

#endif

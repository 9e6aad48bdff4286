/* Who sleeps in a substep; see sleep_list.h. */
#ifndef PBMPM_SRC_STEP_SLEEP_H
#define PBMPM_SRC_STEP_SLEEP_H

#include "world/world.h"

/* Follows the settings: begins or ends sleeping. */
void sleep_begin_step(World *world);

/* In place of grid_build(): decides who sleeps and builds the grid of the others. */
pbmpm_result sleep_build(World *world, bool with_volume);

/* Before the solution: keeps what it changes of still particles. */
pbmpm_result sleep_prepare(World *world);

/* After the solution, before particles move: decides which still blocks wake at once. */
void sleep_judge(World *world);

#endif

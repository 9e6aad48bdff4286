/* Waking spreads as waves do.
 *
 * A block that would move no longer bears what leans on it. Were that only told from block to block, one per substep, a tower would hang in the air while its foot
 * falls. So it is told to all that a wave of stress reaches within the substep. */
#ifndef PBMPM_SRC_WORLD_SLEEP_WAVES_H
#define PBMPM_SRC_WORLD_SLEEP_WAVES_H

#include "world/world.h"

/* After still blocks of the grid were marked as woken: marks all that waves from them reach in a substep. */
void sleep_wake_by_waves(World *world);

#endif

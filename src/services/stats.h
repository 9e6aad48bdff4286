/* Statistics. Nothing here changes the state. */
#ifndef PBMPM_SRC_SERVICES_STATS_H
#define PBMPM_SRC_SERVICES_STATS_H

#include "world/world.h"

/* What the last step has noted, and with a pass over the particles what there is now. */
void stats_of_step(World *world, pbmpm_stats *stats);
void stats_of_world(World *world, pbmpm_stats *stats);

#endif

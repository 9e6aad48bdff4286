/* Bodies sleep and wake as one.
 *
 * A block that sleeps does not move, however slowly its neighbours pull it along, and the strain of these does not know. So a slab that a hand drew at 0.02 m/s was torn along
 * an edge of blocks, and a tower hung in the air while its foot fell. A block of a solid that is disturbed tells all that a wave of stress comes to. In elastic
 * matter and clay that is the whole body: their stress is solved for implicitly, so all of it knows within a substep. In sand, which a bed may be miles of, it is what the wave
 * reaches in a substep. Liquid tells nobody. */
#ifndef PBMPM_SRC_WORLD_SLEEP_WAVES_H
#define PBMPM_SRC_WORLD_SLEEP_WAVES_H

#include "world/world.h"

/* After still blocks of the grid were marked as woken: from these and from those that are disturbed, still and sleeping blocks that waves reach wake, and awake ones are not
 * quiet. Returns whether any was woken. */
bool sleep_wake_by_waves(World *world);

#endif

/* What readers of a world make for each other. Several threads may read a world at once: the first that needs one of these makes it, the others wait
 * for it, and it serves all until the particles change. Whoever may write calls these, too; nobody is there to wait for then. */
#ifndef PBMPM_SRC_SERVICES_READERS_H
#define PBMPM_SRC_SERVICES_READERS_H

#include "world/world.h"

/* d floats [m] per particle, and kilograms. */
const float *readers_positions(World *world);
const float *readers_kilograms(World *world);

/* After it particles_row() only reads. */
void readers_find_rows(World *world);

/* Makes world->particle_tree, for which it may take memory. */
pbmpm_result readers_build_particle_tree(World *world);

/* Bytes that the world holds. */
uint64_t readers_memory_used(World *world);

#endif
